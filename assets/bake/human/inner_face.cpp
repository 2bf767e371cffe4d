#include "assets/bake/human/inner_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "assets/bake/simplify/distance.h"
#include "core/body/hanim.h"

namespace caryatid::bake {
namespace {

constexpr float kStep_m = 1e-4f;
constexpr int kHalf = 90;  // Steps from the eye's middle to the edge of the picture of it.
constexpr int kSide = 2 * kHalf + 1;

Vec3 eye_center_m(const Character& c, int side) {
  const auto joint = body::index_of(side == 0 ? body::HanimJoint::l_eyeball_joint
                                              : body::HanimJoint::r_eyeball_joint);
  for (const Joint& j : c.joints)
    if (j.hanim == joint) return j.center_m;
  throw std::runtime_error(c.name + ": there is no eyeball joint");
}

// Brightness 0..1 as coded, and depth, of the eye's front on a grid around its centre; the nearest
// surface wins.
struct FrontView {
  std::vector<float> light = std::vector<float>(kSide * kSide, 1.0f);
  std::vector<float> z_m = std::vector<float>(kSide * kSide, -1.0f);

  static std::size_t at(int x, int y) {
    return static_cast<std::size_t>((y + kHalf) * kSide + x + kHalf);
  }
};

float brightness(const Image& image, Vec2 uv) {
  const auto texel = [](float t, std::uint32_t size) {
    return static_cast<std::size_t>(
        std::clamp(t * static_cast<float>(size), 0.0f, static_cast<float>(size - 1)));
  };
  const std::uint8_t* p =
      &image.rgba[4 * (texel(uv.y, image.height) * image.width + texel(uv.x, image.width))];
  return (0.30f * static_cast<float>(p[0]) + 0.59f * static_cast<float>(p[1]) +
          0.11f * static_cast<float>(p[2])) /
         255.0f;
}

void draw(const Mesh& mesh, const Image& image, Vec3 center, FrontView& view) {
  for (const auto& t : mesh.triangles) {
    Vec3 p[3];
    for (int i = 0; i < 3; ++i)
      p[i] = (mesh.position_m[t[static_cast<std::size_t>(i)]] - center) / kStep_m;
    const float area =
        (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area < 1e-6f) continue;  // From behind.
    const auto low = glm::min(p[0], glm::min(p[1], p[2])),
               high = glm::max(p[0], glm::max(p[1], p[2]));
    if (high.x < -kHalf || low.x > kHalf || high.y < -kHalf || low.y > kHalf) continue;
    const auto cell = [](float v) {
      return static_cast<int>(std::clamp(v, float{-kHalf}, float{kHalf}));
    };
    for (int y = cell(std::ceil(low.y)); y <= cell(std::floor(high.y)); ++y)
      for (int x = cell(std::ceil(low.x)); x <= cell(std::floor(high.x)); ++x) {
        const Vec2 q{x, y};
        const auto weight = [&](const Vec3& a, const Vec3& b) {
          return ((a.x - q.x) * (b.y - q.y) - (a.y - q.y) * (b.x - q.x)) / area;
        };
        const float w0 = weight(p[1], p[2]), w1 = weight(p[2], p[0]), w2 = 1.0f - w0 - w1;
        if (std::min({w0, w1, w2}) < -1e-4f) continue;
        const float z = (w0 * p[0].z + w1 * p[1].z + w2 * p[2].z) * kStep_m;
        const std::size_t at = FrontView::at(x, y);
        if (z <= view.z_m[at]) continue;
        view.z_m[at] = z;
        view.light[at] =
            brightness(image, w0 * mesh.uv[t[0]] + w1 * mesh.uv[t[1]] + w2 * mesh.uv[t[2]]);
      }
  }
}

FrontView front_view(const Character& c, Vec3 center) {
  FrontView view;
  for (const Object& object : c.objects) {
    const pack::Material& material = c.materials[object.material];
    if (object.role != pack::ObjectRole::eye || (material.flags & pack::kCornea) != 0 ||
        material.texture == pack::kNoTexture)
      continue;
    draw(object.mesh, c.images[material.texture], center, view);
  }
  return view;
}

// Mean brightness by distance from a middle, in steps.
std::vector<float> profile(const FrontView& view, float mx, float my, int radii) {
  std::vector<float> sum(static_cast<std::size_t>(radii), 0.0f), count(sum.size(), 0.0f);
  for (int y = -kHalf; y <= kHalf; ++y)
    for (int x = -kHalf; x <= kHalf; ++x) {
      const auto r = static_cast<std::size_t>(
          std::hypot(static_cast<float>(x) - mx, static_cast<float>(y) - my));
      if (r >= sum.size()) continue;
      sum[r] += view.light[FrontView::at(x, y)];
      count[r] += 1.0f;
    }
  for (std::size_t r = 0; r < sum.size(); ++r) sum[r] /= std::max(count[r], 1.0f);
  return sum;
}

// Mean place of the dark spot that is nearest to the middle: an iris may have a dark rim, too.
Vec3 middle_of_pupil(const FrontView& view) {
  const float darkest = *std::min_element(view.light.begin(), view.light.end());
  constexpr float kPupilLevel = 0.06f;
  const auto is_dark = [&](int x, int y) {
    return std::abs(x) <= kHalf && std::abs(y) <= kHalf &&
           view.light[FrontView::at(x, y)] < darkest + kPupilLevel;
  };
  std::pair<int, int> seed{kSide, kSide};
  for (int y = -kHalf; y <= kHalf; ++y)
    for (int x = -kHalf; x <= kHalf; ++x)
      if (is_dark(x, y) && x * x + y * y < seed.first * seed.first + seed.second * seed.second)
        seed = {x, y};
  std::vector<bool> seen(view.light.size(), false);
  std::vector<std::pair<int, int>> open{seed};
  Vec3 sum{0};
  float count = 0;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    if (!is_dark(x, y) || seen[FrontView::at(x, y)]) continue;
    seen[FrontView::at(x, y)] = true;
    sum += Vec3(static_cast<float>(x) * kStep_m, static_cast<float>(y) * kStep_m,
                view.z_m[FrontView::at(x, y)]);
    count += 1;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      open.emplace_back(x + dx, y + dy);
  }
  return sum / count;
}

// Where a profile passes a level between `from` and `to`, either way; -1 when it does not.
float crossing(const std::vector<float>& p, int from, int to, float level) {
  const int step = to > from ? 1 : -1;
  for (int r = from; r != to; r += step) {
    const float a = p[static_cast<std::size_t>(r)], b = p[static_cast<std::size_t>(r + step)];
    if ((a < level) != (b < level))
      return static_cast<float>(r) + static_cast<float>(step) * (level - a) / (b - a) + 0.5f;
  }
  return -1.0f;
}

const Mesh& mesh_named(const Character& c, const char* name) {
  for (const Object& object : c.objects)
    if (object.name == name) return object.mesh;
  throw std::runtime_error(c.name + ": neutral face: there is no " + name);
}

std::uint32_t farthest(const Mesh& mesh, Vec3 towards) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 1; v < mesh.position_m.size(); ++v)
    if (glm::dot(mesh.position_m[v], towards) > glm::dot(mesh.position_m[best], towards)) best = v;
  return best;
}

// The teeth, and where their front rows meet.
struct Bite {
  Surface surface;
  float height_m = 0;

  explicit Bite(const Character& c) {
    float edge[2] = {0, 0};
    for (const bool upper : {true, false}) {
      const Mesh& mesh = mesh_named(c, upper ? "upper_teeth" : "lower_teeth");
      add(mesh);
      // The edges of the incisors: the lowest or highest place near the middle, in front.
      constexpr float kMiddle_m = 0.004f, kFront_m = 0.005f;
      const float front = mesh.position_m[farthest(mesh, {0, 0, 1})].z;
      float best = upper ? 1e9f : -1e9f;
      for (const Vec3& p : mesh.position_m)
        if (std::abs(p.x) < kMiddle_m && p.z > front - kFront_m)
          best = upper ? std::min(best, p.y) : std::max(best, p.y);
      edge[upper ? 0 : 1] = best;
    }
    height_m = 0.5f * (edge[0] + edge[1]);
  }

 private:
  void add(const Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(surface.position.size());
    for (const Vec3& p : mesh.position_m) surface.position.emplace_back(p);
    for (const auto& [a, b, d] : mesh.triangles) {
      surface.triangles.push_back({first + a, first + b, first + d});
    }
  }
};

}  // namespace

TongueMeasure measure_tongue(const Character& c) {
  const Bite bite(c);
  const Mesh& tongue = mesh_named(c, "tongue");
  const auto at = [&](Vec3 towards) { return tongue.position_m[farthest(tongue, towards)]; };
  const Vec3 tip = at({0, 0, 1}), left = at({1, 0, 0}), right = at({-1, 0, 0});
  const Vec3 broad = 0.5f * (left + right);
  return {static_cast<float>(SurfaceTree(bite.surface).distance(Vec3d(tip))), tip.y - bite.height_m,
          std::atan2(tip.y - broad.y, tip.z - broad.z),
          std::atan2(left.y - right.y, left.x - right.x)};
}

void settle_tongue(Character& c) {
  const Bite bite(c);
  Mesh* tongue = nullptr;
  for (Object& object : c.objects)
    if (object.name == "tongue") tongue = &object.mesh;
  if (!tongue) return;
  const Vec3 tip = tongue->position_m[farthest(*tongue, {0, 0, 1})];
  const float root_z = tongue->position_m[farthest(*tongue, {0, 0, -1})].z;
  // Forward from well behind the teeth, at the height of the bite, until it touches.
  constexpr float kBehind_m = 0.03f, kTouch_m = 0.0003f;
  const SurfaceTree teeth(bite.surface);
  Vec3d goal{0, double{bite.height_m}, double{tip.z - kBehind_m}};
  for (int i = 0; i < 200 && goal.z < double{tip.z + kBehind_m}; ++i) {
    const double free = teeth.distance(goal);
    if (free < double{kTouch_m}) break;
    goal.z += free - 0.8 * double{kTouch_m};
  }
  if (goal.z >= double{tip.z + kBehind_m})
    throw std::runtime_error(c.name + ": neutral face: no front teeth before the tongue");
  const Vec3 shift = Vec3(goal) - tip;
  for (Vec3& p : tongue->position_m) {
    constexpr float kRootShare = 0.3f;  // Behind it nothing moves.
    const float along = (p.z - root_z) / (tip.z - root_z);
    const float t = std::clamp((along - kRootShare) / (1.0f - kRootShare), 0.0f, 1.0f);
    p += t * t * (3.0f - 2.0f * t) * shift;
  }
}

IrisMeasure measure_iris(const Character& c, int side) {
  const FrontView view = front_view(c, eye_center_m(c, side));
  const Vec3 pupil_m = middle_of_pupil(view);
  const float mx = pupil_m.x / kStep_m, my = pupil_m.y / kStep_m;
  constexpr int kRadii = 85, kWhite = 80;  // 8 mm: white on every eye.
  const std::vector<float> p = profile(view, mx, my, kRadii);
  const float white = p[kWhite];
  const float iris = crossing(p, kWhite, 20, 0.5f * (white + p[45]));
  const float top = iris < 0 ? 0 : *std::max_element(p.begin(), p.begin() + int(0.8f * iris));
  const float pupil = crossing(p, 3, 60, 0.5f * (p[3] + top));
  if (iris < 0 || pupil < 0 || top < p[3] + 0.02f || white < top)
    throw std::runtime_error(c.name +
                             ": neutral face: no pupil and iris can be told apart on the " +
                             (side == 0 ? "left" : "right") + " eye; use another eye texture");
  return {pupil_m, 2 * pupil * kStep_m, 2 * iris * kStep_m};
}

void settle_gaze(Character& c) {
  for (int side = 0; side < 2; ++side) {
    const Vec3 center = eye_center_m(c, side);
    const Vec3 gaze = glm::normalize(measure_iris(c, side).pupil_m);
    const Quat turn(gaze, Vec3(0, 0, 1));
    constexpr float kLargestEyeball_m = 0.025f;  // The other eye is farther off.
    for (Object& object : c.objects) {
      if (object.role != pack::ObjectRole::eye) continue;
      for (std::size_t v = 0; v < object.mesh.position_m.size(); ++v) {
        Vec3& p = object.mesh.position_m[v];
        if (glm::length(p - center) > kLargestEyeball_m) continue;
        p = center + turn * (p - center);
        object.mesh.normal[v] = turn * object.mesh.normal[v];
      }
    }
  }
}

}  // namespace caryatid::bake
