#include "assets/bake/pack/small.h"

#include <algorithm>

#include "assets/bake/texture/image.h"

namespace caryatid::bake {
namespace {

// Displacements below this do not show on a head of a thousand triangles.
constexpr float kSeen_m = 0.0006f;

bool is_kept(const Object& object, float neck_m) {
  switch (object.role) {
    case pack::ObjectRole::head:
    case pack::ObjectRole::eye:
    case pack::ObjectRole::brow:
    case pack::ObjectRole::hair:
      return true;
    case pack::ObjectRole::body:
      return object.name == "body";
    case pack::ObjectRole::clothes:  // What reaches up to the neck.
      return std::any_of(object.mesh.position_m.begin(), object.mesh.position_m.end(),
                         [neck_m](Vec3 p) { return p.y > neck_m; });
    default:
      return false;
  }
}

}  // namespace

Character small_character(const Character& full, std::uint32_t texture_side) {
  Character out = full;
  out.objects.clear();
  float chin_m = 0.0f;
  for (const FeaturePoint& p : full.feature_points)
    if (p.group == 2 && p.index == 1) chin_m = p.position_m.y;
  std::vector<std::uint32_t> moved_to(full.objects.size(), kNone);
  for (std::uint32_t o = 0; o < full.objects.size(); ++o) {
    if (!is_kept(full.objects[o], chin_m - 0.14f)) continue;
    moved_to[o] = static_cast<std::uint32_t>(out.objects.size());
    out.objects.push_back(full.objects[o]);
    for (auto& moves : out.objects.back().moves)
      std::erase_if(moves, [](const Move& m) { return glm::length(m.displacement_m) < kSeen_m; });
  }
  out.feature_points.clear();
  for (FeaturePoint p : full.feature_points) {
    if (p.object != kNone) p.object = moved_to[p.object];
    const bool dropped = p.object == kNone && moved_to.size() > 0 && p.group == 6;
    const bool teeth = p.group == 9 && p.index >= 8 && p.index <= 11;
    if (!dropped && !teeth) out.feature_points.push_back(p);
  }
  for (pack::Material& m : out.materials) m.detail = pack::kNoTexture;  // Too fine to be seen.
  std::vector<bool> used(out.images.size(), false);
  for (const Object& o : out.objects)
    if (const std::uint16_t t = out.materials[o.material].texture; t != pack::kNoTexture)
      used[t] = true;
  for (std::size_t i = 0; i < out.images.size(); ++i) {
    Image& image = out.images[i];
    if (!used[i]) image = Image{image.name, 1, 1, {0, 0, 0, 255}, false};
    const std::uint32_t side = image.width >= 1024 ? 2 * texture_side : texture_side;
    if (image.width <= side && image.height <= side) continue;
    image =
        to_srgb(resize(to_linear(image), std::min(image.width, side), std::min(image.height, side)),
                image.name);
  }
  return out;
}

}  // namespace caryatid::bake
