#include "core/face/deform.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace caryatid::face {
namespace {

constexpr float kNormalStep = 1.0f / 127.0f;

std::int8_t quantise(float value) {
  const float scaled = std::clamp(value * 127.0f, -127.0f, 127.0f);
  return static_cast<std::int8_t>(scaled < 0.0f ? scaled - 0.5f : scaled + 0.5f);
}

mesh::DynamicVertex displaced(mesh::DynamicVertex vertex, const Displacement& by) {
  vertex.position_m += by.position_m;
  if (by.normal == Vec3(0)) return vertex;
  const Vec3 normal =
      Vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) * kNormalStep + by.normal;
  const float length = std::sqrt(glm::dot(normal, normal));
  if (!(length > 1e-6f)) return vertex;
  for (int i = 0; i < 3; ++i) vertex.normal[i] = quantise(normal[i] / length);
  return vertex;
}

bool has_moves(const ObjectFat& fat, std::uint32_t version) {
  return fat.first[version] != fat.first[version + 1];
}

}  // namespace

Displacement displacement_of(const ObjectFat& fat, std::span<const float> channel_weight,
                             std::uint32_t version, SumMoves sum) {
  // The bounds hold for a loaded pack; while a refinement arrives, its bytes are not yet checked.
  const auto end = std::min<std::size_t>(fat.first[version + 1], fat.moves.size());
  const std::size_t begin = std::min<std::size_t>(fat.first[version], end);
  const MoveSum moved = sum(fat.moves.subspan(begin, end - begin), channel_weight);
  const Vec3 d(moved.d[0], moved.d[1], moved.d[2]);
  const Vec3 n(moved.normal[0], moved.normal[1], moved.normal[2]);
  return {d * pack::kMoveStep_m, n * kNormalStep};
}

Status DeformJob::run() const {
  if (mesh == nullptr) return {Code::invalid_argument};
  const std::span<const std::uint16_t> versions = mesh->version();
  const std::span<const std::uint16_t> others = mesh->morph_version();
  for (const std::uint16_t version : versions)
    if (version + std::size_t{1} >= fat.first.size()) return {Code::out_of_capacity};
  const std::span<mesh::DynamicVertex> live = mesh->dynamic();
  const float morph = mesh->morphing() ? mesh->morph_weight() : 0.0f;
  for (std::uint32_t slot = 0; slot < versions.size(); ++slot) {
    const std::uint32_t version = versions[slot];
    const bool morphs = morph > 0.0f && others[slot] != mesh::kNoVersion &&
                        others[slot] + std::size_t{1} < fat.first.size();
    if (!has_moves(fat, version) && !(morphs && has_moves(fat, others[slot]))) continue;
    Displacement by = displacement_of(fat, channel_weight, version, sum);
    if (morphs) {
      const Displacement to = displacement_of(fat, channel_weight, others[slot], sum);
      by.position_m += morph * (to.position_m - by.position_m);
      by.normal += morph * (to.normal - by.normal);
    }
    const mesh::DynamicVertex vertex = displaced(mesh->rest(slot), by);
    if (std::memcmp(&vertex, &live[slot], sizeof(vertex)) == 0) continue;
    live[slot] = vertex;
    if (dirty != nullptr) dirty->add(slot);
  }
  return {};
}

}  // namespace caryatid::face
