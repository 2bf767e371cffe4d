#pragma once
// What is solid in a posed face, for tests of contact: teeth, flesh, eyeballs. Each answers how
// deep a point lies in it, in metres; 0 outside. They measure surfaces, not vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "assets/bake/simplify/distance.h"
#include "core/base/vec.h"

namespace caryatid::bake::solids {

using Triangle = std::array<std::uint32_t, 3>;

inline Surface surface_of(std::span<const Vec3> position, std::span<const Triangle> triangles) {
  Surface out;
  for (const Vec3& p : position) out.position.emplace_back(p);
  for (const Triangle& t : triangles) out.triangles.push_back({t[0], t[1], t[2]});
  return out;
}

// A place on a surface that goes where its triangle goes.
struct Sample {
  Triangle corner{};
  std::array<float, 3> weight{};
  Vec3 at(std::span<const Vec3> p) const {
    return weight[0] * p[corner[0]] + weight[1] * p[corner[1]] + weight[2] * p[corner[2]];
  }
  Vec3 normal(std::span<const Vec3> p) const {
    const Vec3 n = glm::cross(p[corner[1]] - p[corner[0]], p[corner[2]] - p[corner[0]]);
    return n / std::max(glm::length(n), 1e-12f);
  }
};

// Samples no farther apart than `spacing_m` at rest, corners and edges included.
inline void add_samples(const Triangle& t, std::span<const Vec3> p, float spacing_m,
                        std::vector<Sample>* out) {
  float longest = 0.0f;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, glm::length(p[t[i]] - p[t[(i + 1) % 3]]));
  const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing_m)));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const float u = static_cast<float>(i) / static_cast<float>(n);
      const float w = static_cast<float>(j) / static_cast<float>(n);
      out->push_back({t, {1.0f - u - w, u, w}});
    }
}

// A row of teeth with its gum, as a wall around an upright axis behind it: what lies before the
// wall at its height and bearing is outside.
class Teeth {
 public:
  Teeth(std::span<const Vec3> position, std::span<const Triangle> triangles)
      : tree_(surface_of(position, triangles)) {
    low_ = Vec3(1e9f);
    Vec3 high{-1e9f};
    for (const Vec3& p : position) low_ = glm::min(low_, p), high = glm::max(high, p);
    axis_ = {0.5f * (low_.x + high.x), 0.0f, glm::mix(low_.z, high.z, 0.35f)};
    rows_ = static_cast<std::size_t>((high.y - low_.y) / kHeight_m) + 2;
    radius_.assign(rows_ * kBearings, 0.0f);
    std::vector<Sample> fine;
    for (const Triangle& t : triangles) add_samples(t, position, 0.4f * kHeight_m, &fine);
    for (const Sample& s : fine) raise(s.at(position));
  }

  float depth_m(Vec3 p) const {
    const std::size_t i = cell(p);
    if (i == kNowhere || radius(p) >= radius_[i]) return 0.0f;
    return static_cast<float>(tree_.distance(Vec3d(p)));
  }

 private:
  static constexpr float kHeight_m = 0.00025f, kBearing_rad = 0.01f;
  static constexpr std::size_t kBearings = 361, kNowhere = ~std::size_t{0};

  float radius(Vec3 p) const { return std::hypot(p.x - axis_.x, p.z - axis_.z); }
  std::size_t cell(Vec3 p) const {
    const float row = (p.y - low_.y) / kHeight_m;
    const float bearing = std::atan2(p.x - axis_.x, p.z - axis_.z) / kBearing_rad + kBearings / 2;
    if (!(row >= 0.0f && row < static_cast<float>(rows_) && bearing >= 0.0f &&
          bearing < static_cast<float>(kBearings)))
      return kNowhere;
    return static_cast<std::size_t>(row) * kBearings + static_cast<std::size_t>(bearing);
  }
  void raise(Vec3 p) {
    if (const std::size_t i = cell(p); i != kNowhere) radius_[i] = std::max(radius_[i], radius(p));
  }

  SurfaceTree tree_;
  Vec3 low_{0}, axis_{0};
  std::size_t rows_ = 0;
  std::vector<float> radius_;
};

// Skin as the hull of flesh. A ray forwards from a point tells how many layers of flesh it lies in.
class Flesh {
 public:
  Flesh(std::span<const Vec3> position, std::span<const Triangle> triangles)
      : position_(position), triangles_(triangles), cells_(kCells * kCells) {
    low_ = Vec3(1e9f);
    for (const Vec3& p : position) low_ = glm::min(low_, p);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      Vec3 low{1e9f}, high{-1e9f};
      for (const std::uint32_t v : triangles[t])
        low = glm::min(low, position[v]), high = glm::max(high, position[v]);
      for (int y = index(low.y - low_.y); y <= index(high.y - low_.y); ++y)
        for (int x = index(low.x - low_.x); x <= index(high.x - low_.x); ++x)
          cells_[static_cast<std::size_t>(y * kCells + x)].push_back(t);
    }
  }

  // 0 in the air, 1 in flesh, 2 where flesh has passed through flesh.
  int layers(Vec3 p) const {
    int count = 0;
    for (const std::uint32_t t :
         cells_[static_cast<std::size_t>(index(p.y - low_.y) * kCells + index(p.x - low_.x))])
      count += crossing(p, triangles_[t]);
    return count;
  }

  // Of a point of the skin with its normal: how far the skin that faces it has passed over it.
  float depth_m(Vec3 p, Vec3 normal) const {
    constexpr float kOff_m = 3e-5f;
    if (layers(p + kOff_m * normal) < 1) return 0.0f;
    constexpr float kFar_m = 0.004f;  // Deeper is as bad.
    float least = kFar_m;
    const Vec3 d = p - low_;
    for (int y = index(d.y - kFar_m); y <= index(d.y + kFar_m); ++y)
      for (int x = index(d.x - kFar_m); x <= index(d.x + kFar_m); ++x)
        for (const std::uint32_t t : cells_[static_cast<std::size_t>(y * kCells + x)]) {
          const Vec3 a = position_[triangles_[t][0]], b = position_[triangles_[t][1]],
                     c = position_[triangles_[t][2]];
          if (std::min({a.z, b.z, c.z}) - p.z > least || p.z - std::max({a.z, b.z, c.z}) > least ||
              glm::dot(glm::cross(b - a, c - a), normal) >= 0.0f)
            continue;
          least = std::min(least, distance(p, a, b, c));
        }
    return least;
  }

 private:
  static constexpr int kCells = 256;
  static constexpr float kCell_m = 0.0015f;
  static int index(float d) { return std::clamp(static_cast<int>(d / kCell_m), 0, kCells - 1); }

  // +1 where the ray leaves flesh, -1 where it enters.
  int crossing(Vec3 p, const Triangle& t) const {
    const auto side = [&](Vec3 a, Vec3 b) {
      return (double{b.x} - double{a.x}) * (double{p.y} - double{a.y}) -
             (double{b.y} - double{a.y}) * (double{p.x} - double{a.x});
    };
    const Vec3 a = position_[t[0]], b = position_[t[1]], c = position_[t[2]];
    const double u = side(b, c), v = side(c, a), w = side(a, b), sum = u + v + w;
    const bool front = u > 0 && v > 0 && w > 0, back = u < 0 && v < 0 && w < 0;
    if (!front && !back) return 0;
    const double z = (u * double{a.z} + v * double{b.z} + w * double{c.z}) / sum;
    return z <= double{p.z} ? 0 : front ? 1 : -1;
  }

  // Nearest of a few points: enough for a depth that is compared with tenths of a millimetre.
  static float distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    float least = 1e9f;
    constexpr int kSteps = 6;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const float u = static_cast<float>(i) / kSteps, w = static_cast<float>(j) / kSteps;
        least = std::min(least, glm::length(p - ((1.0f - u - w) * a + u * b + w * c)));
      }
    return least;
  }

  std::span<const Vec3> position_;
  std::span<const Triangle> triangles_;
  std::vector<std::vector<std::uint32_t>> cells_;
  Vec3 low_{0};
};

}  // namespace caryatid::bake::solids
