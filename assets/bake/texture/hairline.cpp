#include "assets/bake/texture/hairline.h"

#include <unordered_map>

namespace caryatid::bake {
namespace {

constexpr float kSpacing_m = 0.0015f;  // Of samples on the style.
constexpr float kSearch_m = 0.022f;    // Nothing is painted further from the style than this.
constexpr float kUnder_m = 0.004f;     // A style may dip so deep beneath the skin,
constexpr float kOver_m = 0.020f;      // or stand so high above it.
constexpr std::uint32_t kCoarse = 4;   // Texels of the atlas to a cell of the distance field.
constexpr int kStrand = 13;            // Half the length of a strand, texels.

// Points where the style is dense, in a grid of cells.
class Style {
 public:
  explicit Style(const Character& c) {
    for (const Object& o : c.objects) {
      const std::uint16_t texture = c.materials[o.material].texture;
      if (o.role != pack::ObjectRole::hair || texture >= c.images.size()) continue;
      const LinearImage image = to_linear(c.images[texture]);
      for (const auto& t : o.mesh.triangles) sample(o.mesh, t, image);
    }
    if (count_ > 0) color_ /= static_cast<float>(count_);
  }

  bool empty() const { return count_ == 0; }
  Vec3 color() const { return color_; }  // Mean, linear.

  // Distance along the skin to the nearest dense hair over it; kSearch_m: none.
  float distance_m(const SkinPoint& p) const {
    float nearest = kSearch_m;
    const glm::ivec3 low = cell(p.position_m - kSearch_m), high = cell(p.position_m + kSearch_m);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const auto found = cells_.find(key({x, y, z}));
          if (found == cells_.end()) continue;
          for (const Vec3& s : found->second) {
            const Vec3 d = s - p.position_m;
            const float height = glm::dot(d, p.normal);
            if (height < -kUnder_m || height > kOver_m) continue;
            nearest = std::min(nearest, glm::length(d - height * p.normal));
          }
        }
    return nearest;
  }

 private:
  static glm::ivec3 cell(Vec3 p) { return glm::ivec3(glm::floor(p / 0.01f)); }
  static std::int64_t key(glm::ivec3 c) {
    return (std::int64_t{c.x} + 512) << 40 | (std::int64_t{c.y} + 512) << 20 |
           (std::int64_t{c.z} + 512);
  }

  void sample(const Mesh& m, const std::array<std::uint32_t, 3>& t, const LinearImage& image) {
    const Vec3 a = m.position_m[t[0]], b = m.position_m[t[1]], c = m.position_m[t[2]];
    const float longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
    const int steps = std::clamp(static_cast<int>(longest / kSpacing_m) + 1, 1, 100);
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(steps);
        const float v = static_cast<float>(j) / static_cast<float>(steps);
        const Vec2 uv = m.uv[t[0]] * (1 - u - v) + m.uv[t[1]] * u + m.uv[t[2]] * v;
        const Vec4 texel = sample_bilinear(image, uv);
        if (texel.w < 0.6f) continue;
        const Vec3 at = a * (1 - u - v) + b * u + c * v;
        cells_[key(cell(at))].push_back(at);
        color_ += Vec3{texel};
        ++count_;
      }
  }

  std::unordered_map<std::int64_t, std::vector<Vec3>> cells_;
  Vec3 color_{0};
  std::size_t count_ = 0;
};

// Where no hair grows: the ears and the skin behind them.
class Ears {
 public:
  explicit Ears(const Character& c) {
    const auto at = [&](int index) {
      for (const FeaturePoint& f : c.feature_points)
        if (f.group == 10 && f.index == index) return f.position_m;
      return Vec3{1.0f};
    };
    // Of the left one; the right one mirrors it nearly.
    top_ = at(1);
    lobe_m_ = at(5).y;
    side_m_ = std::min(at(7).x, at(9).x);
  }
  float share(Vec3 p) const {
    constexpr float kSoft_m = 0.010f;
    const auto within = [](float low, float high, float v) {
      return smooth_step(low - kSoft_m, low, v) * smooth_step(high + kSoft_m, high, v);
    };
    const float beside = smooth_step(side_m_ - 0.004f, side_m_ + 0.002f, std::abs(p.x));
    return beside * within(lobe_m_, top_.y + 0.002f, p.y) *
           within(top_.z - kBehind_m, top_.z + kBefore_m, p.z);
  }

 private:
  static constexpr float kBehind_m = 0.030f, kBefore_m = 0.012f;  // Of the ear, about its top.
  Vec3 top_;
  float lobe_m_, side_m_;
};

// Numbers over the atlas.
struct Field {
  std::uint32_t side;
  std::vector<float> value;
  Field(std::uint32_t s, float fill) : side(s), value(std::size_t{s} * s, fill) {}
  float& at(std::uint32_t x, std::uint32_t y) { return value[std::size_t{y} * side + x]; }
  float at(int x, int y) const {
    const int top = static_cast<int>(side) - 1;
    const auto cx = static_cast<std::size_t>(std::clamp(x, 0, top));
    return value[static_cast<std::size_t>(std::clamp(y, 0, top)) * side + cx];
  }
};

Field distances(const Style& style, const SkinMap& skin) {
  Field out(skin.side / kCoarse, kSearch_m);
  for (std::uint32_t y = 0; y < out.side; ++y)
    for (std::uint32_t x = 0; x < out.side; ++x) {
      const SkinPoint& p = skin.at(x * kCoarse + kCoarse / 2, y * kCoarse + kCoarse / 2);
      if (p.there && p.is_outer) out.at(x, y) = style.distance_m(p);
    }
  for (int pass = 0; pass < 2; ++pass) {  // Single samples must not show.
    const Field before = out;
    for (std::uint32_t y = 0; y < out.side; ++y)
      for (std::uint32_t x = 0; x < out.side; ++x) {
        float sum = 0.0f;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            sum += before.at(static_cast<int>(x) + dx, static_cast<int>(y) + dy);
        out.at(x, y) = sum / 9.0f;
      }
  }
  return out;
}

float interpolate(const Field& f, float x, float y) {
  x -= 0.5f, y -= 0.5f;
  const float fx = std::floor(x), fy = std::floor(y), tx = x - fx, ty = y - fy;
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  return glm::mix(glm::mix(f.at(ix, iy), f.at(ix + 1, iy), tx),
                  glm::mix(f.at(ix, iy + 1), f.at(ix + 1, iy + 1), tx), ty);
}

// Strands lie across the style's edge: noise smeared along the slope of the distance. About 0..1.
class Strands {
 public:
  explicit Strands(const Field& distance) : distance_(distance) {}

  float distance_m(float x, float y) const {
    return interpolate(distance_, x / kCoarse, y / kCoarse);
  }
  float operator()(std::uint32_t x, std::uint32_t y) const {
    const Vec2 begin{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
    float fine = 0.0f, tuft = 0.0f;
    int count = 0;
    for (const float way : {1.0f, -1.0f}) {
      Vec2 p = begin;
      for (int i = 0; i < kStrand; ++i, ++count) {
        const int cx = static_cast<int>(std::floor(p.x)), cy = static_cast<int>(std::floor(p.y));
        fine += lattice(cx, cy, 1);
        tuft += lattice(cx / 4, cy / 4, 2);
        p += way * slope(p);
      }
    }
    // Means of so many even numbers, brought back to a spread of about a quarter.
    const float gain = 0.30f / std::sqrt(static_cast<float>(count)) * 1.7f;
    return 0.5f + gain * (0.75f * fine + 0.25f * tuft);
  }

 private:
  Vec2 slope(Vec2 p) const {
    constexpr float kStep = 4.0f;
    const Vec2 d{distance_m(p.x + kStep, p.y) - distance_m(p.x - kStep, p.y),
                 distance_m(p.x, p.y + kStep) - distance_m(p.x, p.y - kStep)};
    const float length = glm::length(d);
    return length > 1e-7f ? d / length : Vec2{0, 1};
  }
  const Field& distance_;
};

}  // namespace

void paint_hairline(const Character& character, const SkinMap& skin, float reach_m,
                    LinearImage& atlas) {
  const Style style(character);
  if (style.empty()) return;
  const Ears ears(character);
  const Field distance = distances(style, skin);
  const Strands strands(distance);
  for (std::uint32_t y = 0; y < skin.side; ++y)
    for (std::uint32_t x = 0; x < skin.side; ++x) {
      const SkinPoint& p = skin.at(x, y);
      if (!p.there || !p.is_outer) continue;
      const float d =
          strands.distance_m(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float uneven = 1.0f + 0.35f * noise(p.position_m * 90.0f) +
                           0.25f * noise(p.position_m * 260.0f + Vec3{3.1f});
      const float density = 1.0f - smooth_step(0.0f, reach_m * uneven, d);
      if (density <= 0.0f) continue;
      const float strand = strands(x, y);
      // Strands over a veil of those too fine to be drawn.
      float alpha =
          0.75f * smooth_step(-0.25f, 0.30f, density * (1.0f + 0.6f * density) - (1.0f - strand)) +
          0.25f * density;
      alpha *= 1.0f - ears.share(p.position_m);
      const Vec3 color = style.color() * (0.75f + 0.6f * strand);
      Vec4& texel = atlas.at(x, y);
      texel = Vec4{glm::mix(Vec3{texel}, color, 0.94f * alpha), texel.w};
    }
}

}  // namespace caryatid::bake
