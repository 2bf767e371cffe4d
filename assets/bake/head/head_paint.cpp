#include "assets/bake/head/head_paint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "assets/bake/head/skin_edit.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake::foreign {
namespace {

constexpr std::uint32_t kSide = 512;
constexpr float kCorner = 0.06f;  // Side of the corners that mouth and sockets have.

float smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

Vec3 middle_of(const PlacedHead& head) {
  return head.lids_m() - Vec3(0, 0.45f * head.eyes_to_chin_m(), 1.3f * head.eye_separation_m);
}

// Value noise in 0..1 that repeats nowhere on a head.
float noise(Vec3 p) {
  const Vec3 cell = glm::floor(p), f = p - cell, w = f * f * (3.0f - 2.0f * f);
  const auto at = [&](float x, float y, float z) {
    const float h =
        std::sin(glm::dot(cell + Vec3(x, y, z), Vec3(127.1f, 311.7f, 74.7f))) * 43758.5f;
    return h - std::floor(h);
  };
  const auto row = [&](float y, float z) { return glm::mix(at(0, y, z), at(1, y, z), w.x); };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), w.y), glm::mix(row(0, 1), row(1, 1), w.y), w.z);
}

// Distance of p from a chain of places; `along` gets the share of the chain where that is.
float distance_to(const std::vector<Vec3>& chain, Vec3 p, bool flat, float* along = nullptr) {
  float best = 1e9f;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    Vec3 a = chain[i - 1], ab = chain[i] - a, ap = p - a;
    if (flat) ab.z = ap.z = 0;
    const float t = std::clamp(glm::dot(ap, ab) / std::max(glm::dot(ab, ab), 1e-12f), 0.0f, 1.0f);
    const float d = glm::length(ap - t * ab);
    if (d < best) {
      best = d;
      if (along) *along = (static_cast<float>(i - 1) + t) / static_cast<float>(chain.size() - 1);
    }
  }
  return best;
}

bool inside(const std::vector<Vec3>& polygon, Vec3 p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec3 a = polygon[i], b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

// What the painter knows of the face, as lines in space.
class Face {
 public:
  Face(const PlacedHead& head, const Openings& openings) : head_(head) {
    for (int side = 0; side < fat::kSides; ++side) {
      const auto s = static_cast<std::size_t>(side);
      brow_[s] = {head.at(4, 1 + side), head.at(4, 3 + side), head.at(4, 5 + side)};
      for (const std::uint32_t v : openings.eye[s].upper)
        upper_rim_[s].push_back(head.position_m[v]);
      for (const std::uint32_t v : openings.eye[s].rim) rim_[s].push_back(head.position_m[v]);
      rim_[s].push_back(rim_[s].front());
    }
    for (std::size_t c = 0; c < fat::kLipColumns; ++c)
      lips_.push_back(head.position_m[openings.lips[0].row[0][c]]);
    for (std::size_t c = fat::kLipColumns; c-- > 0;)
      lips_.push_back(head.position_m[openings.lips[1].row[0][c]]);
    for (std::size_t s = 0; s < 2; ++s)
      for (const std::uint32_t v : openings.lips[s].row[1]) inner_[s].push_back(head.position_m[v]);
    hair_ = head.vertex.contains({11, 1}) && head.vertex.contains({11, 2}) &&
            head.vertex.contains({11, 3});
  }

  Vec3 colour(Vec3 p) const {
    Vec3 c = skin(p);
    c = glm::mix(c, kHair * (0.8f + 0.4f * noise(p * Vec3(900, 250, 900))), hair(p));
    c = glm::mix(c, kLips * (0.94f + 0.12f * noise(p * Vec3(1500, 500, 500))), lip(p));
    for (std::size_t s = 0; s < 2; ++s) {
      const float lash = smooth(0.0012f, 0.0003f, distance_to(upper_rim_[s], p, false));
      const float rim = smooth(0.0018f, 0.0f, distance_to(rim_[s], p, false));
      c = glm::mix(c, Vec3(0.62f, 0.36f, 0.32f), 0.5f * rim);
      c = glm::mix(c, kHair, 0.6f * lash);
      c = glm::mix(c, kHair, brow(s, p));
    }
    return c;
  }

 private:
  static constexpr Vec3 kHair{0.16f, 0.11f, 0.08f}, kLips{0.69f, 0.37f, 0.35f};

  Vec3 skin(Vec3 p) const {
    Vec3 c{0.82f, 0.63f, 0.54f};
    const Vec3 flush{0.80f, 0.50f, 0.44f};
    const float es = head_.eye_separation_m;
    for (const PointId& id : {PointId{5, 3}, PointId{5, 4}, PointId{9, 3}}) {
      const auto at = head_.vertex.find(id);
      if (at == head_.vertex.end()) continue;
      const float d = glm::length(head_.position_m[at->second] - p) / es;
      c = glm::mix(c, flush, 0.45f * std::exp(-4.0f * d * d));
    }
    return c * (0.96f + 0.05f * noise(p * 250.0f) + 0.03f * noise(p * 1200.0f));
  }

  float lip(Vec3 p) const {
    if (p.z < lips_.front().z - 0.03f) return 0.0f;
    const float d = distance_to(lips_, p, true);
    // Never thinner than this: at the corners a coarse outer contour cuts across.
    const float line = std::min(distance_to(inner_[0], p, true), distance_to(inner_[1], p, true));
    return std::max(smooth(-0.0009f, 0.0009f, inside(lips_, p) ? d : -d),
                    smooth(0.0026f, 0.0012f, line));
  }

  float brow(std::size_t s, Vec3 p) const {
    if (p.z < brow_[s].back().z - 0.015f) return 0.0f;
    float along = 0;
    const float d = distance_to(brow_[s], p, true, &along);
    const float half = glm::mix(0.0040f, 0.0014f, along * along);
    const float hairs = 0.75f + 0.25f * noise(p * Vec3(2600, 700, 600));
    return hairs * 0.85f * smooth(1.25f * half, 0.55f * half, d);
  }

  // Above the hair line, which falls towards the back from the height it has in front, and behind
  // the ears.
  float hair(Vec3 p) const {
    if (!hair_) return 0.0f;
    const Vec3 top = head_.at(11, 1);
    const Vec3 side = 0.5f * (head_.at(11, 2) + head_.at(11, 3));
    const Vec3 middle = middle_of(head_);
    const float es = head_.eye_separation_m;
    constexpr float kFall = 0.42f;
    const float wide = 0.5f * std::abs(head_.at(11, 2).x - head_.at(11, 3).x);
    const float t = std::clamp(std::abs(p.x - top.x) / std::max(wide, 1e-4f), 0.0f, 1.0f);
    const float line = glm::mix(top.y, side.y, t * t) +
                       kFall * std::min(p.z - glm::mix(top.z, side.z, t * t), 0.0f);
    const float above = smooth(-0.003f, 0.006f, p.y - line);
    const float behind = smooth(0.0f, -0.2f * es, p.z - middle.z + 0.35f * es) *
                         smooth(-0.2f * es, 0.2f * es, p.y - middle.y + 0.2f * es);
    return 0.93f * std::max(above, behind);
  }

  const PlacedHead& head_;
  std::array<std::vector<Vec3>, 2> brow_, upper_rim_, rim_;
  std::vector<Vec3> lips_;                  // The outer contour, closed.
  std::array<std::vector<Vec3>, 2> inner_;  // The inner one, by side.
  bool hair_ = false;
};

// Calls visit(texel index, barycentric weights) for the texels that a triangle covers in uv.
template <class Visit>
void cover(const std::array<Vec2, 3>& uv, std::uint32_t side, const Visit& visit) {
  std::array<Vec2, 3> p;
  Vec2 low{1e9f}, high{-1e9f};
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = uv[i] * static_cast<float>(side) - 0.5f;
    low = glm::min(low, p[i]);
    high = glm::max(high, p[i]);
  }
  const auto cross = [](Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; };
  const float area = cross(p[1] - p[0], p[2] - p[0]);
  if (std::abs(area) < 1e-6f) return;
  const auto texel = [&](float x) {
    return static_cast<std::uint32_t>(std::clamp(x, 0.0f, static_cast<float>(side - 1)));
  };
  constexpr float kAround = -0.6f;  // A texel's rim besides, for filtering.
  for (std::uint32_t y = texel(low.y - 1); y <= texel(high.y + 1); ++y)
    for (std::uint32_t x = texel(low.x - 1); x <= texel(high.x + 1); ++x) {
      const Vec2 q{x, y};
      const Vec3 w{cross(p[1] - q, p[2] - q) / area, cross(p[2] - q, p[0] - q) / area,
                   cross(p[0] - q, p[1] - q) / area};
      const float least = std::min({w.x, w.y, w.z});
      if (least > kAround / std::max(std::sqrt(std::abs(area)), 1.0f))
        visit(std::size_t{y} * side + x, w);
    }
}

}  // namespace

Vec2 skin_uv(const PlacedHead& head, Zone zone, Vec3 p) {
  if (zone != Zone::face) {  // v: how deep behind the lips or lids.
    const bool mouth = zone == Zone::mouth;
    const float front = mouth ? head.at(2, 2).z : head.lids_m().z;
    const float deep = std::clamp((front - p.z) / 0.03f, 0.0f, 1.0f);
    return {mouth ? 0.5f * kCorner : 1.0f - 0.5f * kCorner, kCorner * (0.1f + 0.8f * deep)};
  }
  const Vec3 d = glm::normalize(p - middle_of(head));
  const float r = 0.49f * std::sqrt(std::max(0.5f * (1.0f - d.z), 0.0f));
  const float side = std::hypot(d.x, d.y);
  if (side < 1e-6f) return {0.5f, 0.5f};
  return {0.5f + r * d.x / side, 0.5f - r * d.y / side};
}

Mesh skin_mesh(const PlacedHead& head, const Openings& openings, std::span<const Vec3> normal) {
  Mesh mesh;
  std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> wedges;
  constexpr float kAcrossPole = 0.3f;
  constexpr float kUvGrid = 4096.0f;
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    const auto& corner = head.triangles[t];
    Zone zone = Zone::face;
    for (const std::uint32_t v : corner)
      if (openings.zone[v] != Zone::face) zone = openings.zone[v];
    std::array<Vec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) uv[i] = skin_uv(head, zone, head.position_m[corner[i]]);
    float spread = 0;
    for (std::size_t i = 0; i < 3; ++i)
      spread = std::max(spread, glm::distance(uv[i], uv[(i + 1) % 3]));
    const bool pole = zone == Zone::face && spread > kAcrossPole &&
                      head.position_m[corner[0]].z < middle_of(head).z;
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 at = pole ? uv[0] : uv[i];
      const auto [found, fresh] =
          wedges.emplace(std::tuple{corner[i], int(at.x * kUvGrid), int(at.y * kUvGrid)},
                         static_cast<std::uint32_t>(mesh.position_m.size()));
      triangle[i] = found->second;
      if (!fresh) continue;
      mesh.position_m.push_back(head.position_m[corner[i]]);
      mesh.normal.push_back(normal[corner[i]]);
      mesh.uv.push_back(at);
      mesh.base_vertex.push_back(corner[i]);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

Image paint_skin(const PlacedHead& head, const Openings& openings, const Mesh& mesh) {
  const Face face(head, openings);
  LinearImage out(kSide, kSide, Vec4(0.60f, 0.38f, 0.30f, 1.0f));
  std::vector<bool> painted(out.texel.size(), false);
  const auto linear = [](Vec3 c) {
    return Vec4(srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z), 1.0f);
  };
  for (const auto& t : mesh.triangles) {
    bool face_only = true;
    for (const std::uint32_t v : t) face_only &= openings.zone[mesh.base_vertex[v]] == Zone::face;
    if (!face_only) continue;
    cover({mesh.uv[t[0]], mesh.uv[t[1]], mesh.uv[t[2]]}, kSide, [&](std::size_t texel, Vec3 w) {
      const bool within = std::min({w.x, w.y, w.z}) >= 0.0f;
      if (painted[texel] && !within) return;
      painted[texel] = within;
      out.texel[texel] = linear(face.colour(
          w.x * mesh.position_m[t[0]] + w.y * mesh.position_m[t[1]] + w.z * mesh.position_m[t[2]]));
    });
  }
  const auto corner = static_cast<std::uint32_t>(kCorner * kSide);
  for (std::uint32_t y = 0; y < corner; ++y)
    for (std::uint32_t x = 0; x < corner; ++x) {
      const float deep = static_cast<float>(y) / static_cast<float>(corner);
      out.at(x, y) = linear(glm::mix(Vec3(0.62f, 0.30f, 0.29f), Vec3(0.16f, 0.05f, 0.05f), deep));
      out.at(kSide - 1 - x, y) =
          linear(glm::mix(Vec3(0.70f, 0.46f, 0.42f), Vec3(0.35f, 0.16f, 0.15f), deep));
    }
  return to_srgb(out, "skin");
}

Image paint_eye(float iris_diameter_m, float ball_radius_m) {
  constexpr std::uint32_t kEyeSide = 256;
  const float iris = std::asin(std::clamp(0.5f * iris_diameter_m / ball_radius_m, 0.1f, 0.9f)) /
                     std::numbers::pi_v<float>;  // In uv, see eyeball_uv().
  LinearImage out(kEyeSide, kEyeSide, Vec4(0));
  for (std::uint32_t y = 0; y < kEyeSide; ++y)
    for (std::uint32_t x = 0; x < kEyeSide; ++x) {
      const Vec2 d{(static_cast<float>(x) + 0.5f) / kEyeSide - 0.5f,
                   (static_cast<float>(y) + 0.5f) / kEyeSide - 0.5f};
      const float r = glm::length(d) / iris, turn = std::atan2(d.y, d.x);
      const Vec3 white =
          glm::mix(Vec3(0.80f, 0.78f, 0.76f), Vec3(0.70f, 0.52f, 0.48f), smooth(1.6f, 3.2f, r));
      const float fibre = noise(Vec3(9.0f * std::cos(turn), 9.0f * std::sin(turn), 1.5f * r));
      const Vec3 brown = glm::mix(Vec3(0.20f, 0.10f, 0.045f), Vec3(0.42f, 0.26f, 0.12f),
                                  0.6f * fibre + 0.4f * smooth(0.9f, 0.4f, r));
      Vec3 c = glm::mix(brown, Vec3(0.05f, 0.03f, 0.02f), smooth(0.80f, 0.98f, r));
      c = glm::mix(c, white, smooth(0.95f, 1.08f, r));
      c = glm::mix(Vec3(0.008f), c, smooth(0.31f, 0.36f, r));
      out.at(x, y) = Vec4(c * c, 1.0f);  // About linear.
    }
  return to_srgb(out, "eye");
}

Image paint_teeth() {
  constexpr std::uint32_t kWidth = 256, kHeight = 32;
  // From the middle outwards: incisors, canine, premolars, molars; shares of half the arch.
  constexpr float kEdges[] = {0.17f, 0.31f, 0.45f, 0.58f, 0.70f, 0.86f, 1.0f};
  LinearImage out(kWidth, kHeight, Vec4(0));
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float u = std::abs(2.0f * (static_cast<float>(x) + 0.5f) / kWidth - 1.0f);
      const float v = (static_cast<float>(y) + 0.5f) / kHeight;
      float gap = u;
      for (const float e : kEdges) gap = std::min(gap, std::abs(u - e));
      Vec3 c = glm::mix(Vec3(0.70f, 0.64f, 0.54f), Vec3(0.80f, 0.76f, 0.68f), v);
      c *= glm::mix(0.45f, 1.0f, smooth(0.0f, 0.02f, gap)) * (1.0f - 0.35f * u * u);
      c = glm::mix(Vec3(0.50f, 0.18f, 0.17f), c, smooth(0.06f, 0.14f, v));
      out.at(x, y) = Vec4(c * c, 1.0f);
    }
  return to_srgb(out, "teeth");
}

Image plain_image(const char* name, Vec3 srgb) {
  constexpr std::uint32_t kTexels = 16;
  Image out{name, 4, 4, {}, false};
  for (std::uint32_t i = 0; i < kTexels; ++i)
    for (const float c : {srgb.x, srgb.y, srgb.z, 1.0f})
      out.rgba.push_back(static_cast<std::uint8_t>(255.0f * c + 0.5f));
  return out;
}

}  // namespace caryatid::bake::foreign
