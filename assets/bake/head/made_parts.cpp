#include "assets/bake/head/made_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace caryatid::bake::foreign {
namespace {

// Triangles of a grid of columns x rows vertices, row by row; `around` joins last and first column.
void sew(Mesh& mesh, std::uint32_t columns, std::uint32_t rows, bool around) {
  const std::uint32_t quads = around ? columns : columns - 1;
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c < quads; ++c) {
      const std::uint32_t n = (c + 1) % columns;
      const std::uint32_t a = r * columns + c, b = r * columns + n, d = a + columns,
                          e = b + columns;
      mesh.triangles.push_back({a, d, b});
      mesh.triangles.push_back({b, d, e});
    }
}

void add(Mesh& mesh, Vec3 p, Vec3 normal, Vec2 uv) {
  mesh.position_m.push_back(p);
  mesh.normal.push_back(normal);
  mesh.uv.push_back(uv);
  mesh.base_vertex.push_back(kNone);
}

// The arch of the teeth from the front (t = 0) to the sides (t = +-1), and its outward direction.
struct Arch {
  Vec3 front;  // Foremost point of the front teeth.
  float half_width_m, depth_m;

  Vec3 at(float t) const {
    return front + Vec3(half_width_m * std::sin(1.4f * t) / std::sin(1.4f), 0,
                        -depth_m * std::pow(std::abs(t), 2.2f));
  }
  Vec3 outward(float t) const {
    constexpr float kStep = 0.01f;
    const Vec3 along = at(t + kStep) - at(t - kStep);
    return glm::normalize(Vec3(-along.z, 0, along.x));
  }
};

Arch arch_of(const PlacedHead& head) {
  const Vec3 upper = head.at(2, 2), lower = head.at(2, 3);
  const Vec3 corners = 0.5f * (head.at(2, 4) + head.at(2, 5));
  const float width = head.at(2, 4).x - head.at(2, 5).x;
  constexpr float kBehindLips_m = 0.0042f, kLeastHalf_m = 0.02f, kLeastDepth_m = 0.026f;
  const float front = std::min(upper.z, lower.z) - kBehindLips_m;
  return {{0.5f * (upper.x + lower.x), 0.5f * (upper.y + lower.y), front},
          std::max(0.46f * width, kLeastHalf_m),
          std::max(1.5f * (front - corners.z) + 0.012f, kLeastDepth_m)};
}

}  // namespace

Vec2 eyeball_uv(Vec3 p, Vec3 center) {
  const Vec3 d = glm::normalize(p - center);
  const float angle = std::acos(std::clamp(d.z, -1.0f, 1.0f));
  const float r = 0.5f * angle / (0.5f * std::numbers::pi_v<float>);
  const float side = std::hypot(d.x, d.y);
  if (side < 1e-6f) return {0.5f, 0.5f};
  return {std::clamp(0.5f + r * d.x / side, 0.0f, 1.0f),
          std::clamp(0.5f - r * d.y / side, 0.0f, 1.0f)};
}

Mesh ball_mesh(Vec3 center, float radius) {
  constexpr std::uint32_t kColumns = 24, kRows = 14;
  Mesh mesh;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      // Rings about the line of sight, from the pupil to beyond the equator.
      const float angle = 0.02f + 2.0f * static_cast<float>(r) / (kRows - 1);
      const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(c) / float{kColumns};
      const Vec3 n{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                   std::cos(angle)};
      const Vec3 p = center + radius * n;
      add(mesh, p, n, eyeball_uv(p, center));
    }
  sew(mesh, kColumns, kRows, true);
  const auto pupil = static_cast<std::uint32_t>(mesh.position_m.size());
  add(mesh, center + Vec3(0, 0, radius), {0, 0, 1}, {0.5f, 0.5f});
  for (std::uint32_t c = 0; c < kColumns; ++c)
    mesh.triangles.push_back({pupil, c, (c + 1) % kColumns});
  return mesh;
}

namespace {

// Splits every edge that has a middle, so that neighbours stay joined: into two, three or four.
void split_edges(const std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>& middles,
                 Triangles& triangles) {
  Triangles out;
  for (auto t : triangles) {
    std::array<std::uint32_t, 3> m{};  // Of the edges 01, 12, 20.
    const auto find = [&] {
      int count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = middles.find(std::minmax(t[i], t[(i + 1) % 3]));
        m[i] = at == middles.end() ? kNone : at->second;
        count += m[i] != kNone;
      }
      return count;
    };
    const int count = find();
    // Turned so that the first edge is split, and of two the first two.
    while (count > 0 && count < 3 && (m[0] == kNone || (count == 2 && m[1] == kNone))) {
      t = {t[1], t[2], t[0]};
      find();
    }
    if (count == 0) out.push_back(t);
    if (count == 1) out.insert(out.end(), {{t[0], m[0], t[2]}, {m[0], t[1], t[2]}});
    if (count == 2)
      out.insert(out.end(), {{m[0], t[1], m[1]}, {t[0], m[0], m[1]}, {t[0], m[1], t[2]}});
    if (count == 3)
      out.insert(out.end(), {{t[0], m[0], m[2]}, {t[1], m[1], m[0]}, {t[2], m[2], m[1]}, m});
  }
  triangles = std::move(out);
}

}  // namespace

LoosePart finer_iris(LoosePart ball, Vec3 center, float radius_m) {
  constexpr float kLongest_m = 0.001f;
  constexpr int kPasses = 5;
  const auto in_iris = [&](Vec3 p) {
    return p.z > center.z && glm::length(Vec2(p - center)) < radius_m;
  };
  for (int pass = 0; pass < kPasses; ++pass) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    for (const auto& t : ball.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = ball.position_m[t[i]], b = ball.position_m[t[(i + 1) % 3]];
        const Vec3 middle = 0.5f * (a + b);
        if (glm::length(b - a) < kLongest_m || !(in_iris(a) || in_iris(b) || in_iris(middle)))
          continue;
        const auto [found, fresh] = middles.emplace(
            std::minmax(t[i], t[(i + 1) % 3]), static_cast<std::uint32_t>(ball.position_m.size()));
        if (fresh) ball.position_m.push_back(middle);
      }
    if (middles.empty()) break;
    split_edges(middles, ball.triangles);
  }
  return ball;
}

Mesh teeth_mesh(const PlacedHead& head, bool upper) {
  // Front, edge and back of a row of teeth, as one strip bent along the arch.
  constexpr std::uint32_t kColumns = 43;
  constexpr float kCrown_m = 0.0095f, kThick_m = 0.004f, kMeet_m = -0.0012f;
  struct Profile {
    float up_m, in_m, v;
    Vec2 normal;  // Along the outward direction, and away from the edge.
  };
  constexpr Profile kProfile[] = {{kCrown_m + 0.004f, 0.0022f, 0.0f, {1.0f, 0.1f}},
                                  {kCrown_m, 0.0003f, 0.15f, {1.0f, 0.0f}},
                                  {0.5f * kCrown_m, 0.0f, 0.55f, {1.0f, 0.0f}},
                                  {0.0007f, 0.0004f, 0.92f, {0.9f, -0.4f}},
                                  {0.0f, 0.0012f, 1.0f, {0.2f, -1.0f}},
                                  {0.001f, kThick_m, 0.9f, {-0.9f, -0.4f}},
                                  {kCrown_m, kThick_m + 0.002f, 0.1f, {-1.0f, 0.0f}}};
  const Arch arch = arch_of(head);
  const float way = upper ? 1.0f : -1.0f;
  // The lower row bites a little behind the upper one.
  const float back_m = upper ? 0.0f : 0.0016f;
  Mesh mesh;
  for (const Profile& p : kProfile)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const float t = 2.0f * static_cast<float>(c) / (kColumns - 1) - 1.0f;
      const Vec3 out = arch.outward(t);
      const Vec3 at = arch.at(t) - (p.in_m + back_m) * out + Vec3(0, kMeet_m + way * p.up_m, 0);
      const Vec3 normal = glm::normalize(p.normal.x * out + Vec3(0, way * p.normal.y, 0));
      add(mesh, at, normal, {0.5f + 0.5f * t, p.v});
    }
  sew(mesh, kColumns, std::size(kProfile), false);
  if (!upper)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

Mesh tongue_mesh(const PlacedHead& head) {
  constexpr std::uint32_t kColumns = 16, kRows = 10;
  constexpr float kHalfLength_m = 0.024f, kHalfHeight_m = 0.0055f, kBehindTeeth_m = 0.0068f,
                  kBelowLine_m = 0.0026f;
  const Arch arch = arch_of(head);
  const Vec3 half{0.62f * arch.half_width_m, kHalfHeight_m, kHalfLength_m};
  const Vec3 center = arch.front - Vec3(0, kBelowLine_m, kHalfLength_m + kBehindTeeth_m);
  Mesh mesh;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const float angle = 0.12f + 2.9f * static_cast<float>(r) / (kRows - 1);
      const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(c) / float{kColumns};
      const Vec3 n{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                   std::cos(angle)};
      add(mesh, center + half * n, glm::normalize(n / half),
          {0.5f + 0.45f * n.x, 0.5f + 0.45f * n.z});
    }
  sew(mesh, kColumns, kRows, true);
  const auto tip = static_cast<std::uint32_t>(mesh.position_m.size());
  add(mesh, center + Vec3(0, 0, half.z), {0, 0, 1}, {0.5f, 0.95f});
  for (std::uint32_t c = 0; c < kColumns; ++c)
    mesh.triangles.push_back({tip, c, (c + 1) % kColumns});
  return mesh;
}

}  // namespace caryatid::bake::foreign
