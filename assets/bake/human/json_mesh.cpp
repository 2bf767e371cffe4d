#include "assets/bake/human/json_mesh.h"

#include <stdexcept>

#include "assets/bake/files/files.h"

namespace caryatid::bake {

Json read_json(const std::filesystem::path& file) {
  Json json = Json::parse(read_file(file), nullptr, false);
  if (json.is_discarded())
    throw std::runtime_error(file.string() + ": is not JSON; fetch the base human again");
  return json;
}

std::vector<Vec3> read_positions(const Json& mesh) {
  const auto numbers = mesh.at("vertices").get<std::vector<float>>();
  std::vector<Vec3> out(numbers.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = Vec3{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]} * kMetresPerDecimetre;
  return out;
}

std::vector<Vec2> read_uvs(const Json& mesh) {
  const auto numbers = mesh.at("uvs").at(0).get<std::vector<float>>();
  std::vector<Vec2> out(numbers.size() / 2);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return out;
}

std::vector<Quad> read_quads(const Json& mesh, std::size_t vertex_count, std::size_t uv_count) {
  // Face type bits: 1 quad, 2 material, 8 texture coordinates. Then 4 vertices, material, 4 uvs.
  constexpr unsigned kQuadWithMaterialAndUv = 11;
  constexpr std::size_t kWords = 10;
  const auto words = mesh.at("faces").get<std::vector<std::uint32_t>>();
  if (words.size() % kWords != 0) throw std::runtime_error("faces: not quads with material and uv");
  std::vector<Quad> out(words.size() / kWords);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint32_t* w = words.data() + i * kWords;
    if (w[0] != kQuadWithMaterialAndUv) throw std::runtime_error("faces: type is not 11");
    for (std::size_t k = 0; k < 4; ++k) {
      out[i].vertex[k] = w[1 + k];
      out[i].uv[k] = w[6 + k];
      if (w[1 + k] >= vertex_count || w[6 + k] >= uv_count)
        throw std::runtime_error("faces: index out of range");
    }
    out[i].group = static_cast<std::uint16_t>(w[5]);
  }
  return out;
}

std::vector<Influence> read_influences(const Json& mesh, std::size_t vertex_count,
                                       std::size_t bone_count) {
  const auto indices = mesh.at("skinIndices").get<std::vector<std::uint32_t>>();
  const auto weights = mesh.at("skinWeights").get<std::vector<float>>();
  const auto each = mesh.value("influencesPerVertex", std::size_t{4});  // 1 to 4 by file.
  if (each > 4 || indices.size() != each * vertex_count || weights.size() != indices.size())
    throw std::runtime_error("skin weights: wrong count");
  std::vector<Influence> out(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) {
    float sum = 0;
    for (std::size_t k = 0; k < each; ++k) {
      const std::uint32_t joint = indices[each * i + k] / 2;
      if (joint >= bone_count) throw std::runtime_error("skin weights: no such bone");
      out[i].joint[k] = static_cast<std::uint16_t>(joint);
      out[i].weight[k] = weights[each * i + k];
      sum += weights[each * i + k];
    }
    if (sum <= 0) out[i].weight = {1, 0, 0, 0}, sum = 1;
    for (float& w : out[i].weight) w /= sum;
  }
  return out;
}

Licence read_licence(const Json& mesh, std::string source) {
  Licence out{std::move(source), "", ""};
  const Json& metadata = mesh.at("metadata");
  if (!metadata.contains("license")) return out;
  const Json& licence = metadata.at("license");
  out.licence = licence.value("license", "");
  out.author = licence.value("author", "");
  return out;
}

}  // namespace caryatid::bake
