#include "assets/bake/texture/head_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>

#include "assets/bake/texture/atlas.h"
#include "assets/bake/texture/hairline.h"
#include "assets/bake/texture/wrinkles.h"

namespace caryatid::bake {
namespace {

constexpr std::uint32_t kSide = 1024, kLinesSide = 512;
constexpr float kMillimetre = 0.001f;
constexpr Vec3 kMucosa{0.42f, 0.145f, 0.13f};  // The mouth's lining, linear.

// A monotone map of an interval to 0..1 that gives [low, high] the share `room`.
struct Stretch {
  float begin, low, high, end, room;
  float operator()(float x) const {
    const float outside = (low - begin) + (end - high);
    const float before = (1.0f - room) * (low - begin) / outside;
    if (x < low) return before * (x - begin) / (low - begin);
    if (x < high) return before + room * (x - low) / (high - low);
    return before + room + (1.0f - room - before) * (x - high) / (end - high);
  }
};

struct Island {
  std::vector<std::uint32_t> vertices;
  Vec2 low{9.0f}, high{-9.0f};
};

std::vector<Island> islands_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.uv.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[1])] = root(t[2]);
  }
  std::map<std::uint32_t, Island> by_root;
  for (std::uint32_t v = 0; v < mesh.uv.size(); ++v) {
    Island& island = by_root[root(v)];
    island.vertices.push_back(v);
    island.low = glm::min(island.low, mesh.uv[v]);
    island.high = glm::max(island.high, mesh.uv[v]);
  }
  std::vector<Island> out;
  for (auto& [key, island] : by_root) out.push_back(std::move(island));
  std::sort(out.begin(), out.end(),
            [](const Island& a, const Island& b) { return a.vertices.size() > b.vertices.size(); });
  return out;
}

// The face island turned upright and stretched; the others (mouth bag, sockets) in a strip below
// it.
void lay_out(Mesh& mesh, Vec2 eye_uv, Vec2 chin_uv) {
  const std::vector<Island> islands = islands_of(mesh);
  constexpr float kEdge = 3.0f / kSide, kFaceRoom = 0.88f;
  const Island& face = islands.front();
  // In the base's layout the face lies on its side: up is -u, the figure's left is -v.
  const float reach = std::abs(chin_uv.x - eye_uv.x), middle = 0.5f * (face.low.y + face.high.y);
  const Stretch down{face.low.x, eye_uv.x - 0.75f * reach, chin_uv.x + 0.1f * reach, face.high.x,
                     0.72f};
  const Stretch across{face.low.y, middle - 0.95f * reach, middle + 0.95f * reach, face.high.y,
                       0.66f};
  for (const std::uint32_t v : face.vertices)
    mesh.uv[v] = {kEdge + (1.0f - 2.0f * kEdge) * across(mesh.uv[v].y),
                  kEdge + (kFaceRoom - 2.0f * kEdge) * down(mesh.uv[v].x)};
  const float width = 1.0f / static_cast<float>(std::max<std::size_t>(islands.size() - 1, 1));
  for (std::size_t i = 1; i < islands.size(); ++i)
    for (const std::uint32_t v : islands[i].vertices) {
      const Vec2 t =
          (mesh.uv[v] - islands[i].low) / glm::max(islands[i].high - islands[i].low, 1e-4f);
      mesh.uv[v] = {width * static_cast<float>(i - 1) + kEdge + (width - 2.0f * kEdge) * t.x,
                    kFaceRoom + kEdge + (1.0f - kFaceRoom - 2.0f * kEdge) * t.y};
    }
}

class Painter {
 public:
  Painter(const Character& c, const SkinRecipe& recipe, const std::vector<Vec3>& border_m)
      : character_(c), recipe_(recipe), border_m_(border_m) {
    constexpr std::array<int, 10> kOutline = {3, 5, 10, 1, 9, 6, 4, 8, 2, 7};
    for (const int i : kOutline) outline_.push_back(flat(8, i));
    for (const int i : {4, 6, 2, 7, 5}) line_.push_back(flat(2, i));
    eye_[0] = at(3, 5);
    eye_[1] = at(3, 6);
    // The lid's edge lies on the ball.
    ball_m_ = glm::length(at(3, 1) - eye_[0]);
    neck_m_ = at(2, 1).y - 0.035f;
  }

  Vec3 paint(const SkinPoint& p, Vec3 skin) const {
    if (!p.is_outer) return p.position_m.y < at(9, 15).y ? kMucosa : skin;
    float to_border_m = 1.0f;
    for (const Vec3& b : border_m_)
      to_border_m = std::min(to_border_m, glm::length(b - p.position_m));
    const float there = smooth_step(0.005f, 0.045f, to_border_m);
    Vec3 c = skin;
    c = grain(p, c);
    c = blush(p, c);
    c = stubble(p, c);
    c = nostrils(p, c);
    c = lips(p, c);
    c = lids(p, c);
    return glm::mix(skin, c, there);
  }

 private:
  Vec3 at(int group, int index) const {
    for (const FeaturePoint& f : character_.feature_points)
      if (f.group == group && f.index == index) return f.position_m;
    throw std::runtime_error(character_.name + ": the head can't be painted without its points");
  }
  Vec2 flat(int group, int index) const { return Vec2{at(group, index)}; }

  // Signed distance to the outline of the lips seen from the front; negative inside.
  float lip_distance_m(Vec2 p) const {
    float nearest = 1e9f;
    bool inside = false;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Vec2 a = outline_[i], b = outline_[(i + 1) % outline_.size()];
      const Vec2 d = b - a;
      const float t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0f, 1.0f);
      nearest = std::min(nearest, glm::length(p - a - d * t));
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        inside = !inside;
    }
    return inside ? -nearest : nearest;
  }
  float line_distance_m(Vec2 p) const {
    float nearest = 1e9f;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Vec2 d = line_[i + 1] - line_[i];
      const float t = std::clamp(glm::dot(p - line_[i], d) / glm::dot(d, d), 0.0f, 1.0f);
      nearest = std::min(nearest, glm::length(p - line_[i] - d * t));
    }
    return nearest;
  }

  // Pores darken, their rims do not; blotches of blood and pigment at two sizes.
  Vec3 grain(const SkinPoint& p, Vec3 c) const {
    const Vec3 q = p.position_m;
    const float pore = noise(q * 1450.0f) * 0.6f + noise(q * 2600.0f) * 0.4f;
    const float blotch = noise(q * 120.0f) * 0.6f + noise(q * 320.0f) * 0.4f;
    const float blood = noise(q * 75.0f + Vec3{7.3f});
    c *= 1.0f + 0.045f * std::min(pore, 0.25f) + 0.025f * blotch;
    return c * (Vec3{1.0f} + blood * Vec3{0.020f, -0.012f, -0.014f});
  }

  float near(Vec3 p, Vec3 center, float radius_m) const {
    const float d = glm::length(p - center) / radius_m;
    return std::exp(-d * d);
  }

  Vec3 blush(const SkinPoint& p, Vec3 c) const {
    float warm = 0.0f;
    for (const int i : {3, 4}) warm += near(p.position_m, at(5, i) + Vec3{0, -0.012f, 0}, 0.022f);
    for (const int i : {5, 6}) warm += 0.5f * near(p.position_m, at(10, i), 0.025f);
    warm += 0.5f * near(p.position_m, at(9, 3), 0.012f);
    return c * (Vec3{1.0f} + recipe_.blush * std::min(warm, 1.0f) * Vec3{0.10f, -0.14f, -0.12f});
  }

  Vec3 stubble(const SkinPoint& p, Vec3 c) const {
    if (recipe_.stubble <= 0.0f) return c;
    const Vec3 q = p.position_m;
    // Beard: below a line from the nose to the ear's lobe, above the throat, and round the mouth.
    const float lobe = smooth_step(0.02f, 0.065f, std::abs(q.x));
    const float top =
        glm::mix(at(9, 15).y - 0.002f, at(10, 5).y + 0.004f, lobe) -
        0.016f * (1.0f - std::abs(2.0f * smooth_step(0.012f, 0.06f, std::abs(q.x)) - 1.0f));
    float amount =
        smooth_step(top + 0.006f, top - 0.008f, q.y) * (1.0f - smooth_step(top, top + 0.006f, q.y));
    amount *= smooth_step(neck_m_ - 0.005f, neck_m_ + 0.03f, q.y);
    amount *= smooth_step(-0.5f * kMillimetre, 3.0f * kMillimetre, lip_distance_m(Vec2{q}));
    const float hair = 0.75f + 0.35f * noise(q * 1900.0f) + 0.15f * noise(q * 260.0f);
    return glm::mix(c, c * Vec3{0.60f, 0.63f, 0.68f},
                    std::clamp(recipe_.stubble * amount * hair, 0.0f, 1.0f));
  }

  Vec3 nostrils(const SkinPoint& p, Vec3 c) const {
    float dark = 0.0f;
    for (const int i : {4, 5}) {
      const Vec3 hole = at(9, i) + Vec3{0, 0.003f, -0.002f};
      dark = std::max(dark,
                      near(p.position_m, hole, 0.0055f) * smooth_step(-0.15f, -0.75f, p.normal.y));
    }
    return c * glm::mix(Vec3{1.0f}, Vec3{0.34f, 0.24f, 0.22f}, dark);
  }

  Vec3 lips(const SkinPoint& p, Vec3 c) const {
    const Vec3 q = p.position_m;
    if (q.z < at(8, 3).z - 0.016f) return c;
    const float inside =
        smooth_step(0.9f * kMillimetre, -0.9f * kMillimetre, lip_distance_m(Vec2{q}));
    if (inside <= 0.0f) return c;
    const auto linear = [](Vec3 s) {
      return Vec3{srgb_to_linear(s.x), srgb_to_linear(s.y), srgb_to_linear(s.z)};
    };
    // Fine vertical creases, and the shade of the line where the lips meet.
    const float crease = 1.0f + 0.10f * noise(Vec3{q.x * 900.0f, q.y * 130.0f, q.z * 130.0f});
    const Vec3 painted = glm::mix(c, linear(recipe_.lips), recipe_.lips_strength) * crease;
    const float line = std::exp(-std::pow(line_distance_m(Vec2{q}) / (1.1f * kMillimetre), 2.0f));
    return glm::mix(c, painted * glm::mix(Vec3{1.0f}, Vec3{0.42f, 0.30f, 0.30f}, line), inside);
  }

  Vec3 lids(const SkinPoint& p, Vec3 c) const {
    const Vec3 q = p.position_m;
    const Vec3 eye = q.x > 0 ? eye_[0] : eye_[1];
    if (glm::length(q - eye) > 2.2f * ball_m_ || q.z < eye.z) return c;
    const float above_ball_m = glm::length(q - eye) - ball_m_;
    const float rim = smooth_step(1.3f * kMillimetre, 0.2f * kMillimetre, above_ball_m);
    const bool upper = q.y > eye.y;
    const float lash = upper ? smooth_step(0.4f * kMillimetre, 1.2f * kMillimetre, above_ball_m) *
                                   smooth_step(3.4f * kMillimetre, 1.6f * kMillimetre, above_ball_m)
                             : 0.0f;
    const float shade = upper
                            ? smooth_step(1.0f * kMillimetre, 3.0f * kMillimetre, above_ball_m) *
                                  smooth_step(9.0f * kMillimetre, 4.0f * kMillimetre, above_ball_m)
                            : 0.0f;
    c *= glm::mix(Vec3{1.0f}, Vec3{0.60f, 0.50f, 0.48f}, recipe_.eye_shadow * shade);
    c *= glm::mix(Vec3{1.0f}, Vec3{0.22f, 0.18f, 0.17f}, recipe_.lash_line * lash);
    return glm::mix(c, c * Vec3{1.04f, 0.86f, 0.83f}, 0.7f * rim);
  }

  const Character& character_;
  const SkinRecipe& recipe_;
  const std::vector<Vec3>& border_m_;
  std::vector<Vec2> outline_, line_;
  Vec3 eye_[2];
  float ball_m_ = 0.0f, neck_m_ = 0.0f;
};

// The face's island and those of the neck, which reach the border; not the bag of the mouth and the
// sockets.
std::vector<bool> outer_vertices(const Mesh& head, const std::vector<Vec3>& border_m) {
  std::vector<bool> out(head.uv.size(), false);
  bool is_face = true;  // The first is the largest.
  for (const Island& island : islands_of(head)) {
    const bool outer =
        is_face || std::any_of(island.vertices.begin(), island.vertices.end(), [&](auto v) {
          return std::find(border_m.begin(), border_m.end(), head.position_m[v]) != border_m.end();
        });
    is_face = false;
    for (const std::uint32_t v : island.vertices) out[v] = outer;
  }
  return out;
}

SkinMap map_of(const Mesh& head, const std::vector<Vec2>& old_uv, const std::vector<bool>& outer,
               std::uint32_t side) {
  SkinMap out{side, std::vector<SkinPoint>(std::size_t{side} * side)};
  for (const auto& t : head.triangles)
    for_texels(side, head.uv[t[0]], head.uv[t[1]], head.uv[t[2]],
               [&](std::uint32_t x, std::uint32_t y, Vec3 w) {
                 SkinPoint p;
                 for (int k = 0; k < 3; ++k) {
                   const std::uint32_t v = t[static_cast<std::size_t>(k)];
                   p.position_m += w[k] * head.position_m[v];
                   p.normal += w[k] * head.normal[v];
                   p.old_uv += w[k] * old_uv[v];
                 }
                 p.is_outer = outer[t[0]];
                 p.there = true;
                 out.point[std::size_t{y} * side + x] = p;
               });
  return out;
}

}  // namespace

HeadImages paint_head(const Character& character, const SkinRecipe& recipe, const Image& skin,
                      const std::vector<Vec3>& border_m, Mesh& head) {
  const LinearImage source = to_linear(skin);
  const std::vector<Vec2> old_uv = head.uv;
  const auto uv_of = [&](int group, int index) {
    for (const FeaturePoint& f : character.feature_points)
      if (f.group == group && f.index == index) return old_uv[f.vertex];
    throw std::runtime_error(character.name + ": the head can't be laid out without its points");
  };
  lay_out(head, 0.5f * (uv_of(3, 1) + uv_of(3, 2)), uv_of(2, 1));
  const std::vector<bool> is_outer = outer_vertices(head, border_m);

  const Painter painter(character, recipe, border_m);
  const SkinMap map = map_of(head, old_uv, is_outer, kSide);
  LinearImage atlas(kSide, kSide, Vec4{0.0f});
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const SkinPoint& p = map.at(x, y);
      if (!p.there) continue;
      const Vec3 color{sample_bicubic(source, p.old_uv)};
      atlas.at(x, y) = Vec4{painter.paint(p, glm::max(color, 0.0f)), 1.0f};
    }
  paint_hairline(character, map, recipe.hairline_m, atlas);
  bleed_alpha(atlas, 0.02f);
  for (Vec4& t : atlas.texel) t.w = 1.0f;
  const SkinMap coarse = map_of(head, old_uv, is_outer, kLinesSide);
  return {to_srgb(atlas, character.name + "_head"), draw_wrinkles(character, coarse, recipe.lines)};
}

}  // namespace caryatid::bake
