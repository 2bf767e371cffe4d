#include "assets/bake/light/occlusion.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <vector>

#include "assets/bake/light/ray_tree.h"

namespace caryatid::bake {
namespace {

constexpr int kRays = 96;
constexpr float kReach_m = 0.25f;     // Beyond it light comes round anyway.
constexpr float kLift_m = 0.0008f;    // Off the own surface.
constexpr float kDeepest = 0.88f;     // Skin in the closed mouth or nostrils.
constexpr float kMouth_m = 0.040f;    // From the front teeth to where the mouth is dark.
constexpr float kHairOpacity = 0.6f;  // Strands let light through.

bool stays_open(pack::ObjectRole role) {
  return role == pack::ObjectRole::eye || role == pack::ObjectRole::lash ||
         role == pack::ObjectRole::brow;
}

// How much of a hair triangle is strands: its texture's alpha, at the corners of a small grid.
float coverage(const Image& image, const Mesh& m, const std::array<std::uint32_t, 3>& t) {
  constexpr int kSteps = 6;
  float sum = 0.0f;
  int count = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j, ++count) {
      const float a = static_cast<float>(i) / kSteps, b = static_cast<float>(j) / kSteps;
      const Vec2 uv = a * m.uv[t[0]] + b * m.uv[t[1]] + (1.0f - a - b) * m.uv[t[2]];
      const auto texel = [](float at, std::uint32_t size) {
        const float wrapped = at - std::floor(at);
        return std::min(static_cast<std::uint32_t>(wrapped * static_cast<float>(size)), size - 1);
      };
      const std::size_t x = texel(uv.x, image.width), y = texel(uv.y, image.height);
      sum += static_cast<float>(image.rgba[4 * (y * image.width + x) + 3]) / 255.0f;
    }
  return sum / static_cast<float>(count);
}

float opacity_of(const Character& c, const Object& o, const std::array<std::uint32_t, 3>& t) {
  const pack::Material& material = c.materials[o.material];
  if ((material.flags & pack::kAlphaBlend) == 0) return 1.0f;
  if (material.texture >= c.images.size()) return kHairOpacity;
  return kHairOpacity * coverage(c.images[material.texture], o.mesh, t);
}

RayTree tree_of(const Character& c) {
  std::vector<RayTree::Triangle> all;
  for (const Object& o : c.objects) {
    const bool clear = o.role == pack::ObjectRole::lash || o.role == pack::ObjectRole::brow ||
                       (c.materials[o.material].flags & pack::kCornea) != 0;
    if (clear) continue;
    for (const auto& t : o.mesh.triangles)
      all.push_back({{o.mesh.position_m[t[0]], o.mesh.position_m[t[1]], o.mesh.position_m[t[2]]},
                     opacity_of(c, o, t)});
  }
  return RayTree(std::move(all));
}

// Directions over the hemisphere about +Z, denser where a matt surface gathers more light.
std::vector<Vec3> cosine_directions() {
  std::vector<Vec3> out;
  for (int i = 0; i < kRays; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kRays;
    const float r = std::sqrt(u), angle = 2.39996323f * static_cast<float>(i);  // Golden angle.
    out.push_back({r * std::cos(angle), r * std::sin(angle), std::sqrt(1.0f - u)});
  }
  return out;
}

float hidden_share(const RayTree& tree, const std::vector<Vec3>& directions, Vec3 position_m,
                   Vec3 normal) {
  const Vec3 side = std::abs(normal.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 x = glm::normalize(glm::cross(side, normal)), y = glm::cross(normal, x);
  float sum = 0.0f;
  for (const Vec3& d : directions) {
    const Vec3 ray = d.x * x + d.y * y + d.z * normal;
    const RayTree::Hit hit = tree.first_hit(position_m + kLift_m * normal, ray, kReach_m);
    sum += hit.opacity * (1.0f - hit.distance_m / kReach_m);
  }
  return sum / static_cast<float>(directions.size());
}

// Where teeth and tongue are.
struct Mouth {
  Vec3 low{1e9f}, high{-1e9f};

  explicit Mouth(const Character& c) {
    for (const Object& o : c.objects)
      if (o.role == pack::ObjectRole::mouth)
        for (const Vec3& p : o.mesh.position_m) low = glm::min(low, p), high = glm::max(high, p);
  }
  bool has(Vec3 p) const {
    constexpr Vec3 kMargin{0.006f, 0.010f, 0.004f};
    return glm::all(glm::greaterThan(p, low - kMargin)) &&
           glm::all(glm::lessThan(p, high + kMargin));
  }
  // Open at the front teeth, dark at the molars, smoothly between.
  float shade(Vec3 p) const {
    const float depth = std::clamp((high.z - p.z) / kMouth_m, 0.0f, 1.0f);
    return 0.06f + 0.84f * depth * depth * (3.0f - 2.0f * depth);
  }
};

// Shaded by depth, as if the mouth were open: teeth, tongue, and the lining, which rays at rest
// find in the dark right behind the lips.
void shade_mouth(Character& c) {
  constexpr float kClosed = 0.7f;
  const Mouth mouth(c);
  for (Object& o : c.objects)
    for (std::size_t v = 0; v < o.mesh.position_m.size(); ++v) {
      const Vec3 p = o.mesh.position_m[v];
      float& occlusion = o.mesh.occlusion[v];
      if (o.role == pack::ObjectRole::mouth) occlusion = mouth.shade(p);
      if (o.role == pack::ObjectRole::head && occlusion > kClosed && mouth.has(p))
        occlusion = std::max(mouth.shade(p), 0.45f);
    }
}

}  // namespace

void bake_occlusion(Character& character) {
  const RayTree tree = tree_of(character);
  const std::vector<Vec3> directions = cosine_directions();
  for (Object& o : character.objects) {
    Mesh& m = o.mesh;
    m.occlusion.assign(m.position_m.size(), 0.0f);
    if (stays_open(o.role) || o.role == pack::ObjectRole::mouth) continue;
    for (std::size_t v = 0; v < m.position_m.size(); ++v)
      m.occlusion[v] =
          std::min(hidden_share(tree, directions, m.position_m[v], m.normal[v]), kDeepest);
  }
  shade_mouth(character);
}

}  // namespace caryatid::bake
