// The geomorph of LiveMesh: between two levels the finer connectivity is shown, and every slot that
// a record between them touches glides between its own version and the one its ancestor shows at
// the coarser level. At both ends the picture equals the level itself.
#include <algorithm>
#include <cmath>

#include "core/mesh/progressive.h"
#include "core/mesh/split.h"

namespace caryatid::mesh {
namespace {

std::int8_t blend(std::int8_t a, std::int8_t b, float t) {
  const float x = static_cast<float>(a) + t * static_cast<float>(b - a);
  return static_cast<std::int8_t>(x < 0.0f ? x - 0.5f : x + 0.5f);
}

std::uint16_t blend(std::uint16_t a, std::uint16_t b, float t) {
  const float x = static_cast<float>(a) + t * (static_cast<float>(b) - static_cast<float>(a));
  return static_cast<std::uint16_t>(x + 0.5f);
}

Vec3 position(const pack::Vertex& v) { return {v.position_m[0], v.position_m[1], v.position_m[2]}; }

}  // namespace

DynamicVertex LiveMesh::rest(std::uint32_t slot) const {
  const pack::Vertex& a = source_.versions[version_[slot]];
  DynamicVertex out{position(a), {a.normal[0], a.normal[1], a.normal[2], a.normal[3]}};
  if (other_[slot] == kNoVersion) return out;
  const pack::Vertex& b = source_.versions[other_[slot]];
  out.position_m = (1.0f - weight_) * position(a) + weight_ * position(b);
  for (int i = 0; i < 4; ++i) out.normal[i] = blend(a.normal[i], b.normal[i], weight_);
  return out;
}

void LiveMesh::add_to_morph(std::uint32_t slot, std::uint16_t version) {
  if (other_[slot] == kNoVersion) morph_slots_[morph_count_++] = static_cast<std::uint16_t>(slot);
  other_[slot] = version;
}

// Pairs every slot that records [coarse, fine) touch with its version at level `coarse`. The mesh
// stands at `fine`. Downwards the earliest version before wins; then, upwards, a new slot takes
// over what its parent shows at the coarse level.
void LiveMesh::pair_versions(std::uint32_t coarse, std::uint32_t fine) {
  for (std::uint32_t s = fine; s-- > coarse;) {
    if (is_reorder(source_.splits[s])) continue;
    const SplitWords w = words_of(source_.splits[s], source_.split_data);
    for (std::size_t i = 0; i < w.changed.size(); i += 2)
      add_to_morph(w.changed[i], w.changed[i + 1]);
  }
  std::uint32_t slot = vertex_count_;
  for (std::uint32_t s = coarse; s < fine; ++s) slot -= source_.splits[s].added_vertices;
  for (std::uint32_t s = coarse; s < fine; ++s) {
    if (is_reorder(source_.splits[s])) continue;
    for (const std::uint16_t parent : words_of(source_.splits[s], source_.split_data).parents)
      add_to_morph(slot++, other_[parent] == kNoVersion ? version_[parent] : other_[parent]);
  }
}

void LiveMesh::morph_to_level(std::uint32_t triangles, float duration_s) {
  end_morph();
  const std::uint32_t target = cursor_for(triangles);
  const std::uint32_t from = cursor_;
  if (duration_s <= 0.0f || target == from) return move_cursor(target);
  coarsening_ = target < from;
  if (coarsening_) {
    target_triangles_ = triangle_count_;
    for (std::uint32_t s = target; s < from; ++s)
      target_triangles_ -= source_.splits[s].added_triangles;
  } else {
    move_cursor(target);
  }
  coarse_cursor_ = std::min(from, target);
  pair_versions(coarse_cursor_, std::max(from, target));
  weight_ = coarsening_ ? 0.0f : 1.0f;
  weight_per_s_ = (coarsening_ ? 1.0f : -1.0f) / duration_s;
  show_morph();
}

void LiveMesh::advance(float dt_s) {
  if (!morphing()) return;
  weight_ = std::clamp(weight_ + weight_per_s_ * dt_s, 0.0f, 1.0f);
  if (weight_ == (coarsening_ ? 1.0f : 0.0f)) return end_morph();
  show_morph();
}

void LiveMesh::show_morph() {
  for (const std::uint16_t slot : morph_slots_.first(morph_count_)) {
    const pack::Vertex& a = source_.versions[version_[slot]];
    const pack::Vertex& b = source_.versions[other_[slot]];
    dynamic_[slot] = rest(slot);
    for (int i = 0; i < 2; ++i) fixed_[slot].uv[i] = blend(a.uv[i], b.uv[i], weight_);
    dirty_dynamic_.add(slot);
    dirty_fixed_.add(slot);
  }
}

void LiveMesh::end_morph() {
  if (!morphing()) return;
  for (const std::uint16_t slot : morph_slots_.first(morph_count_)) {
    other_[slot] = kNoVersion;
    put_version(slot, version_[slot]);
  }
  morph_count_ = 0;
  weight_ = 0.0f;
  if (coarsening_) move_cursor(coarse_cursor_);
  coarsening_ = false;
}

}  // namespace caryatid::mesh
