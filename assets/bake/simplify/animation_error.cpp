#include "assets/bake/simplify/animation_error.h"

#include <algorithm>
#include <map>

#include "core/face/fap_table.h"

namespace caryatid::bake {
namespace {

// Version of every live slot at the finest level of at most `triangles`.
std::vector<std::uint32_t> shown_versions(const ObjectHistory& history, std::uint32_t triangles) {
  std::vector<std::uint32_t> version(history.base_vertex_count);
  for (std::uint32_t slot = 0; slot < version.size(); ++slot) version[slot] = slot;
  std::size_t count = history.base_triangles.size();
  for (const SplitRecord& split : history.splits) {
    count += split.triangles.size();
    if (count > triangles) break;
    for (const auto& change : split.changed) version[change.slot] = change.version_after;
    for (const auto& addition : split.added) version.push_back(addition.version);
  }
  return version;
}

// 0 where the unit is not a length.
float fapu_m(const pack::Character& facts, face::FapUnit unit) {
  switch (unit) {
    case face::FapUnit::mns:
      return facts.mouth_nose_m / 1024.0f;
    case face::FapUnit::mw:
      return facts.mouth_width_m / 1024.0f;
    case face::FapUnit::ens:
      return facts.eye_nose_m / 1024.0f;
    case face::FapUnit::es:
      return facts.eye_separation_m / 1024.0f;
    case face::FapUnit::irisd:
      return facts.iris_diameter_m / 1024.0f;
    case face::FapUnit::none:
    case face::FapUnit::au:
      break;
  }
  return 0.0f;
}

Vec3 move_of(const std::vector<Move>& moves, std::uint32_t vertex) {
  const auto at = std::lower_bound(moves.begin(), moves.end(), vertex,
                                   [](const Move& m, std::uint32_t v) { return m.vertex < v; });
  return at != moves.end() && at->vertex == vertex ? at->displacement_m : Vec3(0);
}

Vec3 move_of(const VertexVersion& version, std::size_t channel) {
  for (const VertexVersion::ChannelMove& m : version.moves)
    if (m.channel == channel) return m.displacement_m;
  return Vec3(0);
}

}  // namespace

std::vector<AnimationError> animation_error(const Character& character, std::uint32_t object,
                                            const ObjectHistory& history, std::uint32_t triangles) {
  const Object& full = character.objects[object];
  const std::vector<std::uint32_t> version = shown_versions(history, triangles);
  std::map<int, AnimationError> by_fap;
  // Channels of one FAP and one way add up to its full ramp.
  std::map<std::pair<int, bool>, std::vector<std::size_t>> ramps;
  for (std::size_t c = 0; c < full.moves.size(); ++c)
    ramps[{character.channels[c].fap, character.channels[c].to > 0.0f}].push_back(c);
  for (const auto& [ramp, channels] : ramps) {
    const float unit_m = fapu_m(character.facts, face::fap_info(ramp.first).unit);
    if (unit_m == 0.0f) continue;
    AnimationError& error = by_fap[ramp.first];
    error.fap = ramp.first;
    error.lost_points = 0;
    for (const FeaturePoint& point : character.feature_points) {
      if (point.object != object) continue;
      const std::uint32_t slot = history.slot_of_vertex[point.vertex];
      if (slot >= version.size()) {
        ++error.lost_points;
        continue;
      }
      const VertexVersion& now = history.versions[version[slot]];
      Vec3 wanted{0}, got = now.position_m - full.mesh.position_m[point.vertex];
      for (const std::size_t c : channels) {
        wanted += move_of(full.moves[c], point.vertex);
        got += move_of(now, c);
      }
      error.moved_fapu = std::max(error.moved_fapu, glm::length(wanted) / unit_m);
      error.worst_fapu = std::max(error.worst_fapu, glm::distance(wanted, got) / unit_m);
    }
  }
  std::vector<AnimationError> out;
  for (const auto& [fap, error] : by_fap) out.push_back(error);
  return out;
}

}  // namespace caryatid::bake
