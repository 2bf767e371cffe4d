#include "core/scene/compose.h"

#include <algorithm>
#include <cmath>

#include "core/base/trig.h"
#include "core/body/hanim.h"

namespace caryatid::scene {
namespace {

// Studio light for a face behind a screen: a large soft key above the visitor's right shoulder, a
// fill from the other side, a rim that lifts hair and shoulders off the background.
void light(DrawList* list) {
  list->key = {glm::normalize(Vec3{0.45f, 0.55f, 0.85f}), {0.78f, 0.74f, 0.68f}};
  list->fill = {glm::normalize(Vec3{-0.8f, 0.15f, 0.6f}), {0.20f, 0.22f, 0.26f}};
  list->rim = {glm::normalize(Vec3{-0.5f, 0.5f, -0.8f}), {0.50f, 0.48f, 0.46f}};
  list->ambient_up = {0.26f, 0.27f, 0.29f};
  list->ambient_down = {0.15f, 0.13f, 0.12f};
  list->background_top = {0.115f, 0.110f, 0.105f};
  list->background_bottom = {0.300f, 0.285f, 0.265f};
}

Vec3 center_of(const ComposeJob& job, const pack::Object& o) {
  return job.joints[o.bone[0]].point({o.center_m[0], o.center_m[1], o.center_m[2]});
}

// One wide soft shadow of the body, and a dark one where each foot is near the floor.
void cast_shadows(const ComposeJob& job, DrawList* out) {
  constexpr float kFadeHeight_m = 0.15f;  // Of the ankle above its height at rest.
  out->floor_shadows.clear();
  (void)out->floor_shadows.push({job.feet_m + Vec3{0, 0.002f, 0}, 0.36f, 0.26f, 0.4f});
  for (std::size_t j = 0; j < job.pack->joints.size(); ++j) {
    const pack::Joint& joint = job.pack->joints[j];
    if (joint.hanim != body::index_of(body::HanimJoint::l_ankle) &&
        joint.hanim != body::index_of(body::HanimJoint::r_ankle))
      continue;
    const Vec3 rest{joint.center_m[0], joint.center_m[1], joint.center_m[2]};
    const Vec3 ankle = job.joints[j].point(rest);
    const float lifted = (ankle.y - job.feet_m.y - rest.y) / kFadeHeight_m;
    // The sole reaches further to the toes than to the heel.
    const Vec3 toes = job.joints[j].direction({0, 0, 0.05f});
    const Vec3 sole{ankle.x + toes.x, job.feet_m.y + 0.003f, ankle.z + toes.z};
    (void)out->floor_shadows.push(
        {sole, 0.10f, 0.19f, 0.75f * std::clamp(1.0f - lifted, 0.0f, 1.0f)});
  }
}

// Where an object comes in drawing order; opaque ones tie and are sorted by distance.
int layer(const pack::View& pack, const pack::Object& o) {
  const pack::Material& m = pack.materials[o.material];
  if ((m.flags & pack::kCornea) != 0) return 3;
  if ((m.flags & pack::kAlphaBlend) == 0) return 0;
  return o.role == pack::ObjectRole::hair ? 2 : 1;
}

struct Order {
  std::uint16_t object;
  int layer;
  float distance_m;

  bool before(const Order& other) const {
    if (layer != other.layer) return layer < other.layer;
    if (layer == 0 && distance_m != other.distance_m) return distance_m < other.distance_m;
    return object < other.object;
  }
};

void sort_items(FixedVector<Order, kMaxObjects>* orders) {  // Few and nearly sorted: insertion.
  for (std::size_t i = 1; i < orders->size(); ++i)
    for (std::size_t k = i; k > 0 && (*orders)[k].before((*orders)[k - 1]); --k)
      std::swap((*orders)[k], (*orders)[k - 1]);
}

Status add_item(const ComposeJob& job, std::uint16_t object, DrawList* out) {
  const pack::Object& o = job.pack->objects[object];
  DrawItem item;
  item.object = object;
  item.material = o.material;
  item.triangle_count = job.meshes[object].triangle_count;
  item.first_bone = static_cast<std::uint16_t>(out->bones.size());
  item.bone_count = o.bone_count;
  for (std::size_t b = 0; b < o.bone_count; ++b)
    if (!out->bones.push(job.joints[o.bone[b]])) return {Code::out_of_capacity, 0};
  return out->items.push(item) ? Status{} : Status{Code::out_of_capacity, 0};
}

}  // namespace

Status ComposeJob::run(DrawList* out) const {
  if (pack == nullptr || out == nullptr || meshes.size() != pack->objects.size() ||
      joints.size() != pack->joints.size())
    return {Code::invalid_argument, 0};
  out->camera = camera;
  out->shading = shading;
  out->render_scale = render_scale;
  out->wrinkles = wrinkles;
  out->meshes = meshes;
  light(out);
  cast_shadows(*this, out);
  out->items.clear();
  out->bones.clear();
  FixedVector<Order, kMaxObjects> orders;
  for (std::uint16_t o = 0; o < pack->objects.size(); ++o)
    if (meshes[o].triangle_count > 0) {
      const Vec3 away = center_of(*this, pack->objects[o]) - camera.position_m;
      (void)orders.push({o, layer(*pack, pack->objects[o]), glm::dot(away, away)});
    }
  sort_items(&orders);
  for (const Order& order : orders) CARYATID_TRY(add_item(*this, order.object, out));
  return {};
}

Importance importance(const ComposeJob& job, std::size_t object, std::uint32_t width,
                      std::uint32_t height) {
  const pack::Object& o = job.pack->objects[object];
  const Vec4 eye = job.camera.view * Vec4{center_of(job, o), 1.0f};
  const float depth_m = -eye.z;
  if (depth_m <= 0.05f) return {};
  const Vec4 clip = job.camera.projection * eye;
  const float x = clip.x / clip.w, y = clip.y / clip.w;
  // Half sizes of the sphere's square in clip space; the projection may be turned by 90 degrees.
  const auto scale = [&](int row) {
    return std::abs(job.camera.projection[0][row]) + std::abs(job.camera.projection[1][row]);
  };
  const float rx = o.radius_m / depth_m * scale(0), ry = o.radius_m / depth_m * scale(1);
  const auto overlap = [](float center, float half) {
    return std::max(std::min(center + half, 1.0f) - std::max(center - half, -1.0f), 0.0f);
  };
  const float w = static_cast<float>(width), h = static_cast<float>(height);
  Importance out;
  out.screen_px = 0.25f * overlap(x, rx) * overlap(y, ry) * w * h * (kPi / 4.0f);
  const float off = std::sqrt(x * x + y * y) / 1.41421356f;
  out.axis_closeness = std::clamp(1.0f - off, 0.0f, 1.0f);
  return out;
}

}  // namespace caryatid::scene
