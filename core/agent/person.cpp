#include "core/agent/person.h"

#include <algorithm>

#include "core/body/helper_joints.h"
#include "core/face/deform.h"

namespace caryatid::agent {
namespace {

using body::HanimJoint;
using body::index_of;

mesh::MeshSource source_of(const pack::View& view, const pack::Object& o) {
  mesh::MeshSource s;
  s.versions = view.versions.subspan(o.first_version, o.version_count);
  s.base_indices = view.base_indices.subspan(o.first_base_index, 3 * o.base_triangle_count);
  s.splits = view.splits.subspan(o.first_split, o.split_count);
  s.split_data = view.split_data;
  s.base_vertex_count = o.base_vertex_count;
  s.max_vertex_count = o.max_vertex_count;
  s.max_triangle_count = o.max_triangle_count;
  return s;
}

face::ObjectFat fat_of(const pack::View& view, const pack::Object& o) {
  return {view.fat_first.subspan(o.first_version, o.version_count + 1), view.fat_moves};
}

std::size_t scratch_words(const pack::View& view) {
  std::size_t words = 0;
  for (const pack::Object& o : view.objects)
    words = std::max(words, std::size_t{3} * o.max_triangle_count);
  return words;
}

Vec3 to_vec(const float* p) { return {p[0], p[1], p[2]}; }

}  // namespace

std::size_t Person::arena_bytes(const pack::View& view) {
  constexpr std::size_t kAlignment = 16;
  std::size_t bytes = scratch_words(view) * sizeof(std::uint16_t) + kAlignment +
                      view.channels.size() * sizeof(float) + kAlignment;
  for (const pack::Object& o : view.objects)
    bytes += mesh::LiveMesh::arena_bytes(source_of(view, o));
  return bytes;
}

Status Person::start(const pack::View& view, Arena& arena) {
  view_ = view;
  if (view.joints.size() > kMaxJoints || view.objects.size() > kMaxObjects)
    return {Code::out_of_capacity, 0};
  skeleton_ = body::upright_skeleton();
  for (const pack::Joint& j : view.joints) {
    if (j.hanim >= body::kSkinJointCount) return {Code::corrupt_data, 0};
    if (j.hanim < body::kHanimJointCount) skeleton_.center_m[j.hanim] = to_vec(j.center_m);
  }
  body::derive_soles(skeleton_);
  for (std::size_t side = 0; side < 2; ++side) {
    body::Sole& sole = skeleton_.sole[side];
    Vec2* points[] = {&sole.heel_back, &sole.heel, &sole.toe, &sole.toe_tip};
    for (int i = 0; i < 4; ++i)
      if (const auto* p =
              pack::find_feature_point(view, pack::kSoleGroup, static_cast<int>(4 * side) + i + 1))
        *points[i] = {p->position_m[2], p->position_m[1]};
    sole.ball = sole.toe;
  }
  index_scratch_ = arena.take<std::uint16_t>(scratch_words(view));
  channel_weights_ = arena.take<float>(view.channels.size());
  if (index_scratch_.size() < scratch_words(view) || channel_weights_.size() < view.channels.size())
    return {Code::out_of_capacity, 0};
  for (std::size_t o = 0; o < view.objects.size(); ++o) {
    Part& part = parts_[o];
    part = Part{};
    part.source = source_of(view, view.objects[o]);
    CARYATID_TRY(part.checker.start(part.source));
    CARYATID_TRY(part.mesh.start(part.source, arena, index_scratch_));
    const auto first = fat_of(view, view.objects[o]).first;
    part.deforms = first.front() < first[view.objects[o].base_vertex_count];
  }
  limits_ = face::limits_of(view.channels);
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    rest_face_.set(fap, view.rest_face[static_cast<std::size_t>(fap)]);
  geometry_.eye_separation_m = view.character->eye_separation_m;
  geometry_.iris_diameter_m = view.character->iris_diameter_m;
  geometry_.mouth_nose_m = view.character->mouth_nose_m;
  geometry_.mouth_width_m = view.character->mouth_width_m;
  geometry_.jaw_center_m = skeleton_.center(HanimJoint::temporomandibular);
  if (const auto* chin = pack::find_feature_point(view, 2, 1))
    geometry_.chin_m = to_vec(chin->position_m);
  show(rest_face_, body::BapFrame{}, Affine{}, 0.0f);
  return {};
}

Status Person::refine(const pack::Loader& loader) {
  Status worst;
  for (std::size_t o = 0; o < object_count(); ++o) {
    Part& part = parts_[o];
    const std::uint32_t ready = loader.splits_ready(o);
    if (part.broken || ready <= part.checked) continue;
    const Status s = part.checker.check(part.source, part.checked, ready, index_scratch_);
    if (!s.ok()) {
      part.broken = true;
      worst = s;
      continue;
    }
    part.checked = ready;
    part.mesh.set_available(ready);
  }
  return worst;
}

std::uint32_t Person::triangle_count() const {
  std::uint32_t sum = 0;
  for (std::size_t o = 0; o < object_count(); ++o) sum += parts_[o].mesh.triangle_count();
  return sum;
}

void Person::set_levels(std::span<const std::uint32_t> triangles) {
  for (std::size_t o = 0; o < std::min(object_count(), triangles.size()); ++o)
    parts_[o].mesh.set_level(triangles[o]);
}

void Person::approach(std::span<const std::uint32_t> triangles, std::uint32_t max_records,
                      float duration_s) {
  std::uint32_t left = 2 * max_records;  // A record adds or takes two triangles inside a surface.
  for (std::size_t o = 0; o < std::min(object_count(), triangles.size()) && left > 0; ++o) {
    mesh::LiveMesh& m = parts_[o].mesh;
    if (duration_s > 0.0f && m.morphing()) continue;
    const std::uint32_t now = m.triangle_count();
    const std::uint32_t next = triangles[o] > now ? now + std::min(triangles[o] - now, left)
                                                  : now - std::min(now - triangles[o], left);
    m.morph_to_level(next, duration_s);
    const std::uint32_t reached = m.target_triangle_count();
    left -= std::min(left, reached > now ? reached - now : now - reached);
  }
}

void Person::show(const face::FapFrame& faps, const body::BapFrame& baps, const Affine& place,
                  float dt_s) {
  for (std::size_t o = 0; o < object_count(); ++o) parts_[o].mesh.advance(dt_s);
  pose(faps, baps, place);
  deform(faps);
  wrinkles_ = face::wrinkles_of(faps);
  refresh_views();
}

void Person::pose(const face::FapFrame& faps, const body::BapFrame& baps, const Affine& place) {
  const face::FaceTransforms turns = face::evaluate_transforms(geometry_, faps);
  std::array<Quat, body::kHanimJointCount> extra;
  extra.fill(Quat{1, 0, 0, 0});
  extra[index_of(HanimJoint::skullbase)] = turns.head;
  extra[index_of(HanimJoint::l_eyeball_joint)] = turns.left_eye;
  extra[index_of(HanimJoint::r_eyeball_joint)] = turns.right_eye;
  extra[index_of(HanimJoint::temporomandibular)] = turns.jaw;
  std::array<Affine, body::kSkinJointCount> posed;
  body::PoseJob job;
  job.skeleton = &skeleton_;
  job.baps = &baps;
  job.convention = convention_;
  job.extra = extra;
  job.out = posed;
  if (!job.run().ok() || !body::pose_helpers(skeleton_, posed).ok()) return;
  const auto shift = [&posed](HanimJoint joint, Vec3 by) {
    Affine move;
    for (int r = 0; r < 3; ++r) move.row[r].w = by[r];
    posed[index_of(joint)] = posed[index_of(joint)] * move;
  };
  shift(HanimJoint::l_eyeball_joint, {0, 0, turns.left_eye_thrust_m});
  shift(HanimJoint::r_eyeball_joint, {0, 0, turns.right_eye_thrust_m});
  shift(HanimJoint::temporomandibular, turns.jaw_shift_m);
  for (std::size_t j = 0; j < view_.joints.size(); ++j)
    joints_[j] = place * posed[view_.joints[j].hanim];
}

void Person::deform(const face::FapFrame& faps) {
  deformed_ = 0;
  if (!face::evaluate_channels(view_.channels, faps, channel_weights_).ok()) return;
  for (std::size_t o = 0; o < object_count(); ++o) {
    Part& part = parts_[o];
    if (!part.deforms) continue;
    face::DeformJob job;
    job.fat = fat_of(view_, view_.objects[o]);
    job.channel_weight = channel_weights_;
    job.mesh = &part.mesh;
    job.dirty = &part.dirty;
    job.sum = sum_moves_;
    if (job.run().ok()) deformed_ += part.mesh.vertex_count();
  }
}

void Person::refresh_views() {
  for (std::size_t o = 0; o < object_count(); ++o) {
    const mesh::LiveMesh& m = parts_[o].mesh;
    mesh_views_[o] = {m.dynamic(), m.fixed(), m.indices(), m.vertex_count(), m.triangle_count()};
  }
}

void Person::collect_patches(FixedVector<scene::MeshPatch, kMaxObjects>* out) {
  out->clear();
  records_ = 0;
  for (std::size_t o = 0; o < object_count(); ++o) {
    Part& part = parts_[o];
    scene::MeshPatch patch{static_cast<std::uint16_t>(o), part.mesh.dirty_dynamic(),
                           part.mesh.dirty_fixed(), part.mesh.dirty_indices()};
    const mesh::DirtyRange deformed = part.dirty.clipped(part.mesh.vertex_count());
    if (deformed.count > 0) {
      patch.dynamic.add(deformed.first);
      patch.dynamic.add(deformed.first + deformed.count - 1);
    }
    part.dirty = {};
    part.mesh.clear_dirty();
    const std::uint32_t applied = part.mesh.applied();
    records_ += std::max(applied, part.applied) - std::min(applied, part.applied);
    part.applied = applied;
    if (patch.dynamic.count + patch.fixed.count + patch.indices.count > 0) (void)out->push(patch);
  }
}

Vec3 Person::feature_point_m(int group, int index) const {
  const pack::FeaturePoint* p = pack::find_feature_point(view_, group, index);
  if (p == nullptr) return Vec3{0};
  if (p->object == pack::kNoObject) return joints_[p->vertex].point(to_vec(p->position_m));
  const pack::Object& object = view_.objects[p->object];
  const mesh::LiveMesh& m = parts_[p->object].mesh;
  const mesh::StaticVertex& fixed = m.fixed()[p->vertex];
  Vec3 sum{0};
  for (std::size_t k = 0; k < 4; ++k)
    sum += static_cast<float>(fixed.weight[k]) / 255.0f *
           joints_[object.bone[std::min<std::size_t>(fixed.bone[k], kMaxBonesPerDraw - 1)]].point(
               m.dynamic()[p->vertex].position_m);
  return sum;
}

}  // namespace caryatid::agent
