#include "assets/bake/pack/writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

#include "assets/bake/pack/quantise.h"
#include "assets/bake/pack/texels.h"
#include "assets/bake/simplify/symmetry.h"
#include "core/base/crc.h"
#include "core/base/limits.h"
#include "core/face/fit.h"
#include "core/mesh/progressive.h"
#include "core/pack/loader.h"

namespace caryatid::bake {
namespace {

using pack::SectionId;

// What the agent keeps beside image and live meshes: mixer, poses, programme, draw list.
constexpr std::uint32_t kAgentWork_bytes = 768 * 1024;

[[noreturn]] void refuse(const std::string& object, const std::string& what) {
  throw std::runtime_error("object " + object + ": " + what);
}

template <class T>
std::uint32_t append(std::vector<std::byte>* out, const T* items, std::size_t count) {
  const std::size_t at = out->size();
  out->resize(at + count * sizeof(T));
  if (count > 0) std::memcpy(out->data() + at, items, count * sizeof(T));
  return static_cast<std::uint32_t>(at);
}

template <std::size_t N>
void copy_name(char (&out)[N], const std::string& name) {
  std::memset(out, 0, N);
  std::memcpy(out, name.data(), std::min(name.size(), N - 1));
}

struct SectionBytes {
  SectionId id;
  std::uint32_t stride;
  std::vector<std::byte> bytes;
};

// A piece of a section that travels as one chunk.
struct Piece {
  SectionId section;
  std::uint32_t offset, bytes;
};

// Where the data of one object ends after each stage: stage 0 is the base mesh.
struct StageEnd {
  std::uint32_t split, word, version, move;
};

class Writer {
 public:
  Writer(const Character& character, const PackOptions& options)
      : character_(character), options_(options) {}
  std::vector<std::byte> run(PackReport* report);

 private:
  SectionBytes& section(SectionId id) {
    return *std::find_if(sections_.begin(), sections_.end(),
                         [id](const SectionBytes& s) { return s.id == id; });
  }
  template <class T>
  std::uint32_t put(SectionId id, const T* items, std::size_t count) {
    return append(&section(id).bytes, items, count) / static_cast<std::uint32_t>(sizeof(T));
  }
  template <class T>
  std::uint32_t size(SectionId id) {
    return static_cast<std::uint32_t>(section(id).bytes.size() / sizeof(T));
  }
  void put_tables();
  void put_textures();
  void put_object(std::uint32_t index);
  void put_versions(const ObjectHistory& history, const pack::Object& object);
  std::vector<StageEnd> put_splits(const ObjectHistory& history, const pack::Object& object);
  void put_feature_points();
  void plan_pieces();
  void add_piece(SectionId id, std::uint32_t from, std::uint32_t to);
  std::uint32_t arena_bytes(std::uint32_t image_bytes) const;
  std::vector<std::byte> assemble(PackReport* report);

  const Character& character_;
  const PackOptions& options_;
  // In the order of the image.
  std::vector<SectionBytes> sections_ = {
      {SectionId::character, sizeof(pack::Character), {}},
      {SectionId::joints, sizeof(pack::Joint), {}},
      {SectionId::materials, sizeof(pack::Material), {}},
      {SectionId::textures, sizeof(pack::Texture), {}},
      {SectionId::objects, sizeof(pack::Object), {}},
      {SectionId::channels, sizeof(pack::Channel), {}},
      {SectionId::feature_points, sizeof(pack::FeaturePoint), {}},
      {SectionId::rest_face, sizeof(float), {}},
      {SectionId::fit, sizeof(pack::FitRule), {}},
      {SectionId::licences, sizeof(char), {}},
      {SectionId::base_indices, sizeof(std::uint16_t), {}},
      {SectionId::versions, sizeof(pack::Vertex), {}},
      {SectionId::fat_first, sizeof(std::uint32_t), {}},
      {SectionId::fat_moves, sizeof(pack::Move), {}},
      {SectionId::splits, sizeof(pack::Split), {}},
      {SectionId::split_data, sizeof(std::uint16_t), {}},
      {SectionId::texels, sizeof(std::byte), {}},
  };
  std::vector<pack::Object> objects_;
  std::vector<AnimationError> animation_;  // Of the head.
  std::vector<ObjectHistory> histories_;
  std::vector<std::vector<StageEnd>> stages_;  // By object.
  std::vector<pack::Texture> textures_;
  std::vector<Piece> pieces_;
  std::uint32_t base_piece_count_ = 0;
  std::uint32_t total_triangles_ = 0;
};

void Writer::put_tables() {
  for (const Joint& j : character_.joints) {
    const pack::Joint joint{{j.center_m.x, j.center_m.y, j.center_m.z}, j.parent, j.hanim};
    put(SectionId::joints, &joint, 1);
  }
  put(SectionId::materials, character_.materials.data(), character_.materials.size());
  put(SectionId::channels, character_.channels.data(), character_.channels.size());
  put(SectionId::rest_face, character_.rest_face.data(), character_.rest_face.size());
  const auto fit = face::fit_or_default(character_.fit);
  put(SectionId::fit, fit.data(), fit.size());
  std::string text;
  for (const Licence& l : character_.licences)
    text += l.source + ": " + l.licence + (l.author.empty() ? "" : ", " + l.author) + "\n";
  put(SectionId::licences, text.data(), text.size());
}

void Writer::put_textures() {
  for (const Image& image : character_.images) {
    const auto power = [](std::uint32_t n) { return n > 0 && n <= 1024 && (n & (n - 1)) == 0; };
    if (!power(image.width) || !power(image.height) ||
        image.rgba.size() != std::size_t{4} * image.width * image.height)
      throw std::runtime_error("texture " + image.name +
                               ": sides must be powers of two up to 1024, with 4 bytes a texel");
    std::uint32_t levels = 0;
    const std::vector<std::byte> texels = make_texels(image, &levels);
    pack::Texture t{};
    t.width = static_cast<std::uint16_t>(image.width);
    t.height = static_cast<std::uint16_t>(image.height);
    t.format = image.has_alpha ? pack::TextureFormat::rgba4444 : pack::TextureFormat::rgb565;
    t.level_count = static_cast<std::uint16_t>(levels);
    t.texel_offset = put(SectionId::texels, texels.data(), texels.size());
    t.texel_bytes = static_cast<std::uint32_t>(texels.size());
    while (t.base_level + 1u < levels &&
           std::max(image.width, image.height) >> t.base_level > options_.base_texture_side)
      ++t.base_level;
    textures_.push_back(t);
  }
  put(SectionId::textures, textures_.data(), textures_.size());
}

std::vector<std::uint16_t> palette_of(const ObjectHistory& history, const std::string& name) {
  std::set<std::uint16_t> joints;
  for (const VertexVersion& v : history.versions)
    for (std::size_t i = 0; i < 4; ++i)
      if (v.influence.weight[i] > 0.0f) joints.insert(v.influence.joint[i]);
  if (joints.size() > kMaxBonesPerDraw)
    refuse(name, "it hangs on " + std::to_string(joints.size()) +
                     " joints; split it so that each " + "part has at most " +
                     std::to_string(kMaxBonesPerDraw));
  return {joints.begin(), joints.end()};
}

void Writer::put_object(std::uint32_t index) {
  Object source = character_.objects[index];
  for (const FeaturePoint& p : character_.feature_points)
    if (p.object == index) source.locked.push_back(p.vertex);
  ObjectOptions options;
  options.pose_weight = options_.pose_weight;
  const double by_role = options_.base_fraction[static_cast<std::size_t>(source.role)];
  const double fraction =
      source.name == "body" ? std::max(by_role, options_.torso_fraction) : by_role;
  options.base_triangles =
      static_cast<std::uint32_t>(fraction * static_cast<double>(source.mesh.triangles.size()));
  if (source.role == pack::ObjectRole::head)
    options.importance = importance_of_head(character_, index);
  ObjectHistory history = simplify_object(source, options);
  if (source.role == pack::ObjectRole::head)
    animation_ = animation_error(character_, index, history, options.base_triangles);
  if (!options_.refine) {
    history.splits.clear();
    history.versions.resize(history.base_vertex_count);
    history.max_vertex_count = history.base_vertex_count;
    history.max_triangle_count = static_cast<std::uint32_t>(history.base_triangles.size());
  }
  if (history.versions.size() >= mesh::kNoVersion || history.max_triangle_count > 0xFFFF)
    refuse(source.name, "it has too many vertices or triangles for 16-bit numbers; split it");
  const std::vector<std::uint16_t> palette = palette_of(history, source.name);
  pack::Object o{};
  copy_name(o.name, source.name);
  o.role = source.role;
  o.material = static_cast<std::uint16_t>(source.material);
  o.bone_count = static_cast<std::uint16_t>(palette.size());
  std::copy(palette.begin(), palette.end(), o.bone);
  o.first_version = size<pack::Vertex>(SectionId::versions);
  o.version_count = static_cast<std::uint32_t>(history.versions.size());
  o.base_vertex_count = history.base_vertex_count;
  o.max_vertex_count = history.max_vertex_count;
  o.first_base_index = size<std::uint16_t>(SectionId::base_indices);
  o.base_triangle_count = static_cast<std::uint32_t>(history.base_triangles.size());
  o.max_triangle_count = history.max_triangle_count;
  o.first_split = size<pack::Split>(SectionId::splits);
  o.split_count = static_cast<std::uint32_t>(history.splits.size());
  Vec3 low{1e30f}, high{-1e30f};
  for (const Vec3& p : source.mesh.position_m) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const Vec3 center = 0.5f * (low + high);
  for (const Vec3& p : source.mesh.position_m)
    o.radius_m = std::max(o.radius_m, glm::length(p - center));
  for (int i = 0; i < 3; ++i) o.center_m[i] = center[i];
  for (const auto& t : history.base_triangles)
    for (const std::uint32_t slot : t) {
      const auto word = static_cast<std::uint16_t>(slot);
      put(SectionId::base_indices, &word, 1);
    }
  put_versions(history, o);
  stages_.push_back(put_splits(history, o));
  total_triangles_ += o.max_triangle_count;
  objects_.push_back(o);
  histories_.push_back(std::move(history));
}

void Writer::put_versions(const ObjectHistory& history, const pack::Object& object) {
  const std::span<const std::uint16_t> palette(object.bone, object.bone_count);
  for (const VertexVersion& v : history.versions) {
    const pack::Vertex vertex = quantise(v, palette);
    put(SectionId::versions, &vertex, 1);
    const std::uint32_t first = size<pack::Move>(SectionId::fat_moves);
    put(SectionId::fat_first, &first, 1);
    for (const VertexVersion::ChannelMove& m : v.moves) {
      const pack::Move move = quantise(m);
      put(SectionId::fat_moves, &move, 1);
    }
  }
}

// Stage k ends where the mesh has base * ratio^k triangles, so that each stage is as large a step.
std::vector<StageEnd> Writer::put_splits(const ObjectHistory& history, const pack::Object& object) {
  std::vector<std::uint16_t> words;
  const auto word = [&words](std::size_t value) {
    words.push_back(static_cast<std::uint16_t>(value));
  };
  std::vector<StageEnd> ends;
  std::uint32_t splits = 0, versions = history.base_vertex_count;
  std::uint32_t triangles = object.base_triangle_count;
  const auto end_stage = [&] {
    const std::uint32_t version = object.first_version + versions;
    std::uint32_t move = size<pack::Move>(SectionId::fat_moves);
    if (version < size<std::uint32_t>(SectionId::fat_first))
      std::memcpy(&move, section(SectionId::fat_first).bytes.data() + 4 * std::size_t{version}, 4);
    ends.push_back(
        {object.first_split + splits, size<std::uint16_t>(SectionId::split_data), version, move});
  };
  end_stage();
  const double span = static_cast<double>(object.max_triangle_count) /
                      std::max<double>(object.base_triangle_count, 1);
  for (const SplitRecord& r : history.splits) {
    words.clear();
    pack::Split s{};
    s.data = size<std::uint16_t>(SectionId::split_data);
    if (!r.reordered.empty()) {
      s.flags = pack::kReorder;
      word(r.reordered.size());
      for (const std::uint32_t t : r.reordered) word(t);
    } else {
      s.first_version = static_cast<std::uint16_t>(versions);
      s.moved_count = static_cast<std::uint16_t>(r.moved.size());
      s.changed_count = static_cast<std::uint8_t>(r.changed.size());
      s.added_vertices = static_cast<std::uint8_t>(r.added.size());
      s.added_triangles = static_cast<std::uint8_t>(r.triangles.size());
      for (const auto& c : r.changed) {
        word(c.slot);
        word(c.version_before);
      }
      for (const auto& a : r.added) word(a.parent);
      for (const auto& t : r.triangles)
        for (const std::uint32_t slot : t) word(slot);
      for (const std::uint32_t t : r.moved) word(t);
      versions += s.changed_count + s.added_vertices;
      triangles += s.added_triangles;
    }
    put(SectionId::splits, &s, 1);
    put(SectionId::split_data, words.data(), words.size());
    ++splits;
    const double k = static_cast<double>(ends.size()) / options_.stages;
    const bool last = splits == history.splits.size();
    if (last || (ends.size() < options_.stages &&
                 triangles >= object.base_triangle_count * std::pow(span, k)))
      end_stage();
  }
  return ends;
}

void Writer::put_feature_points() {
  for (const FeaturePoint& p : character_.feature_points) {
    pack::FeaturePoint out{};
    out.group = p.group;
    out.index = p.index;
    out.object = p.object == kNone ? pack::kNoObject : static_cast<std::uint16_t>(p.object);
    out.vertex = p.vertex;
    if (p.object != kNone) {
      const ObjectHistory& history = histories_.at(p.object);
      const std::uint32_t slot =
          p.vertex < history.slot_of_vertex.size() ? history.slot_of_vertex[p.vertex] : kNone;
      if (slot >= history.base_vertex_count)
        refuse(character_.objects[p.object].name, "feature point " + std::to_string(p.group) + "." +
                                                      std::to_string(p.index) +
                                                      " stands on a vertex without triangles");
      out.vertex = slot;
    }
    for (int i = 0; i < 3; ++i) out.position_m[i] = p.position_m[i];
    put(SectionId::feature_points, &out, 1);
  }
}

void Writer::add_piece(SectionId id, std::uint32_t from, std::uint32_t to) {
  const std::uint32_t stride = section(id).stride;
  if (from < to) pieces_.push_back({id, from * stride, (to - from) * stride});
}

void Writer::plan_pieces() {
  for (const SectionBytes& s : sections_) {
    if (s.id == SectionId::versions) break;  // From here on in stages.
    add_piece(s.id, 0, static_cast<std::uint32_t>(s.bytes.size() / s.stride));
  }
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    const pack::Object& object = objects_[o];
    const StageEnd& end = stages_[o][0];
    add_piece(SectionId::versions, object.first_version, end.version);
    add_piece(SectionId::fat_first, object.first_version, end.version + 1);
    std::uint32_t first_move = 0;
    std::memcpy(&first_move,
                section(SectionId::fat_first).bytes.data() + 4 * std::size_t{object.first_version},
                4);
    add_piece(SectionId::fat_moves, first_move, end.move);
  }
  for (const pack::Texture& t : textures_) {
    const std::uint32_t small = mip_bytes(t.width, t.height, 0, t.base_level);
    add_piece(SectionId::texels, t.texel_offset + small, t.texel_offset + t.texel_bytes);
  }
  base_piece_count_ = static_cast<std::uint32_t>(pieces_.size());
  for (std::size_t stage = 1; stage <= options_.stages; ++stage) {
    for (const auto& ends : stages_) {
      if (stage >= ends.size()) continue;
      const StageEnd &a = ends[stage - 1], &b = ends[stage];
      add_piece(SectionId::fat_moves, a.move, b.move);
      add_piece(SectionId::fat_first, a.version, b.version + 1);
      add_piece(SectionId::versions, a.version, b.version);
      add_piece(SectionId::split_data, a.word, b.word);
      add_piece(SectionId::splits, a.split, b.split);
    }
    if (stage == 1)  // Sharp textures matter more than the last triangles.
      for (const pack::Texture& t : textures_)
        add_piece(SectionId::texels, t.texel_offset,
                  t.texel_offset + mip_bytes(t.width, t.height, 0, t.base_level));
  }
}

std::uint32_t Writer::arena_bytes(std::uint32_t image_bytes) const {
  std::uint32_t meshes = 0, largest = 0;
  for (const pack::Object& o : objects_) {
    mesh::MeshSource source;
    source.max_vertex_count = o.max_vertex_count;
    source.max_triangle_count = o.max_triangle_count;
    meshes += mesh::LiveMesh::arena_bytes(source);
    largest = std::max(largest, o.max_triangle_count);
  }
  return image_bytes + meshes + 6 * largest + kAgentWork_bytes;
}

const char* name_of(SectionId id, char (&text)[5]) {
  const auto word = static_cast<std::uint32_t>(id);
  std::memcpy(text, &word, 4);
  text[4] = '\0';
  return text;
}

std::vector<std::byte> Writer::assemble(PackReport* report) {
  std::vector<pack::Section> table;
  std::uint32_t image_bytes = 0;
  for (const SectionBytes& s : sections_) {
    table.push_back({static_cast<std::uint32_t>(s.id), image_bytes,
                     static_cast<std::uint32_t>(s.bytes.size()), s.stride});
    image_bytes += (static_cast<std::uint32_t>(s.bytes.size()) + 15u) & ~15u;
  }
  if (pieces_.size() > pack::kMaxChunks)
    throw std::runtime_error("the character has too many objects for the chunk table of a pack");
  std::vector<pack::Chunk> chunks;
  std::vector<std::byte> payload;
  std::uint32_t base_payload_bytes = 0;
  for (const Piece& p : pieces_) {
    const SectionBytes& s = section(p.section);
    const std::span<const std::byte> bytes(s.bytes.data() + p.offset, p.bytes);
    chunks.push_back(
        {static_cast<std::uint32_t>(&s - sections_.data()), p.offset, p.bytes, crc32c(bytes)});
    payload.insert(payload.end(), bytes.begin(), bytes.end());
    if (chunks.size() == base_piece_count_)
      base_payload_bytes = static_cast<std::uint32_t>(payload.size());
  }
  std::vector<std::byte> tables;
  append(&tables, table.data(), table.size());
  append(&tables, chunks.data(), chunks.size());
  pack::PackHeader header{};
  std::memcpy(header.magic, pack::kMagic, sizeof header.magic);
  header.version = pack::kVersion;
  header.section_count = static_cast<std::uint32_t>(table.size());
  header.chunk_count = static_cast<std::uint32_t>(chunks.size());
  header.base_chunk_count = base_piece_count_;
  header.file_bytes = static_cast<std::uint32_t>(sizeof header + tables.size() + payload.size());
  header.image_bytes = image_bytes;
  header.arena_bytes = arena_bytes(image_bytes);
  header.tables_crc = crc32c(tables);
  header.header_crc = crc32c(std::as_bytes(std::span(&header, 1)).first(60));
  std::vector<std::byte> file;
  append(&file, &header, 1);
  append(&file, tables.data(), tables.size());
  append(&file, payload.data(), payload.size());
  if (report != nullptr) {
    report->animation = animation_;
    char text[5];
    for (const SectionBytes& s : sections_)
      report->sections.push_back({name_of(s.id, text), static_cast<std::uint32_t>(s.bytes.size())});
    for (const pack::Object& o : objects_)
      report->objects.push_back(
          {o.name, o.base_triangle_count, o.max_triangle_count, o.version_count, o.split_count});
    report->file_bytes = header.file_bytes;
    report->base_part_bytes =
        static_cast<std::uint32_t>(sizeof header + tables.size()) + base_payload_bytes;
    report->arena_bytes = header.arena_bytes;
  }
  return file;
}

std::vector<std::byte> Writer::run(PackReport* report) {
  if (character_.objects.size() > kMaxObjects || character_.images.size() > kMaxTextures ||
      character_.materials.size() > kMaxMaterials || character_.joints.size() > kMaxJoints)
    throw std::runtime_error("the character has more objects, textures, materials or joints than " +
                             std::string("core/base/limits.h allows"));
  put_tables();
  put_textures();
  for (std::uint32_t o = 0; o < character_.objects.size(); ++o) put_object(o);
  const std::uint32_t moves = size<pack::Move>(SectionId::fat_moves);
  put(SectionId::fat_first, &moves, 1);
  put(SectionId::objects, objects_.data(), objects_.size());
  put_feature_points();
  pack::Character facts = character_.facts;
  copy_name(facts.name, character_.name);
  facts.total_triangles = total_triangles_;
  put(SectionId::character, &facts, 1);
  plan_pieces();
  return assemble(report);
}

}  // namespace

std::vector<std::byte> write_pack(const Character& character, const PackOptions& options,
                                  PackReport* report) {
  return Writer(character, options).run(report);
}

}  // namespace caryatid::bake
