#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "assets/bake/simplify/object_history.h"
#include "assets/bake/simplify/symmetry.h"
#include "tests/unit/bake/simplify/shapes.h"

namespace caryatid::bake {
namespace {

Object object_of(const Surface& surface) {
  Object out;
  out.name = "test";
  for (const Vec3d& p : surface.position) {
    out.mesh.position_m.push_back(0.1f * Vec3(p));
    out.mesh.normal.push_back(glm::normalize(Vec3(p)));
    out.mesh.uv.push_back({0.5f, 0.5f});
    out.mesh.influence.push_back({});
  }
  out.mesh.triangles = surface.triangles;
  return out;
}

// A wavy ball that is symmetric about x = 0, positions bit for bit and triangles: one half, and its
// mirror image.
Object symmetric_ball() {
  Object out = object_of(ball(20, 0.0));
  std::vector<Vec3d> places;
  for (const Vec3& p : out.mesh.position_m) places.emplace_back(p);
  const std::vector<std::uint32_t> mirror = mirror_points(places, 1e-6);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : out.mesh.triangles) {
    if (places[t[0]].x + places[t[1]].x + places[t[2]].x < 0) continue;
    triangles.push_back(t);
    triangles.push_back({mirror[t[0]], mirror[t[2]], mirror[t[1]]});
  }
  out.mesh.triangles = triangles;
  for (std::uint32_t v = 0; v < mirror.size(); ++v) {
    Vec3& p = out.mesh.position_m[v];
    if (mirror[v] == v) p.x = 0;
    if (mirror[v] < v) continue;
    p *= 1.0f + 0.1f * std::sin(40.0f * p.y) * std::cos(25.0f * std::abs(p.x));
    if (mirror[v] > v) out.mesh.position_m[mirror[v]] = {-p.x, p.y, p.z};
  }
  return out;
}

// Positions at the finest level of at most `triangles`.
std::vector<Vec3> level(const ObjectHistory& h, std::size_t triangles) {
  std::vector<std::uint32_t> version(h.base_vertex_count);
  for (std::uint32_t slot = 0; slot < version.size(); ++slot) version[slot] = slot;
  std::size_t count = h.base_triangles.size();
  for (const SplitRecord& split : h.splits) {
    count += split.triangles.size();
    if (count > triangles) break;
    for (const auto& change : split.changed) version[change.slot] = change.version_after;
    for (const auto& addition : split.added) version.push_back(addition.version);
  }
  std::vector<Vec3> out;
  for (const std::uint32_t v : version) out.push_back(h.versions[v].position_m);
  return out;
}

// Vertices without a partner on the other side.
std::size_t unpaired(const std::vector<Vec3>& points) {
  std::size_t n = 0;
  for (const Vec3& p : points)
    n += std::none_of(points.begin(), points.end(), [&](const Vec3& q) {
      return glm::distance(Vec3(-p.x, p.y, p.z), q) < 1e-6f;
    });
  return n;
}

TEST(ObjectCollapse, LevelsOfASymmetricMeshAreSymmetric) {
  const Object object = symmetric_ball();
  ASSERT_EQ(unpaired(object.mesh.position_m), 0u);
  const ObjectHistory h = simplify_object(object, {.base_triangles = 60});
  const ObjectHistory free =
      simplify_object(object, {.base_triangles = 60, .symmetric_pairs = false});
  std::size_t most = 0, most_free = 0;
  for (std::size_t n = 60; n < object.mesh.triangles.size(); n += 4) {
    most = std::max(most, unpaired(level(h, n)));
    most_free = std::max(most_free, unpaired(level(free, n)));
  }
  // Between the two collapses of a pair: three vertices on this side, one on that, at most.
  EXPECT_LE(most, 6u);
  EXPECT_GT(most_free, 20u);
}

TEST(ObjectCollapse, WhatCountsLessGoesFirst) {
  const Object object = object_of(ball(24, 0.1));
  const ObjectHistory even = simplify_object(object, {.base_triangles = 200});
  const ObjectHistory front = simplify_object(
      object, {.base_triangles = 200, .importance = importance_from_front(object.mesh, 0.01f)});
  const auto behind = [](const ObjectHistory& h) {
    const std::vector<Vec3> points = level(h, 200);
    return std::count_if(points.begin(), points.end(), [](const Vec3& p) { return p.z < -0.05f; });
  };
  EXPECT_LT(behind(front), 0.7 * static_cast<double>(behind(even)));
}

TEST(ObjectCollapse, BakedShadeResistsAsReliefDoes) {
  Object object = object_of(grid(20, 20, 0.0));
  object.mesh.occlusion.assign(object.mesh.position_m.size(), 0.0f);
  for (std::size_t v = 0; v < object.mesh.position_m.size(); ++v) {
    object.mesh.normal[v] = {0, 0, 1};
    if (std::abs(object.mesh.position_m[v].x - 1.0f) < 0.11f) object.mesh.occlusion[v] = 1.0f;
  }
  const ObjectHistory h = simplify_object(object, {.base_triangles = 100, .pose_weight = 10.0});
  // The dark stripe stays a stripe: nobody far from it has become dark.
  double dark = 0, far = 0;
  for (std::size_t v = 0; v < h.base_vertex_count; ++v) {
    dark = std::max(dark, static_cast<double>(h.versions[v].occlusion));
    if (std::abs(h.versions[v].position_m.x - 1.0f) > 0.4f)
      far = std::max(far, static_cast<double>(h.versions[v].occlusion));
  }
  EXPECT_GT(dark, 0.8);
  EXPECT_LT(far, 0.3);
}

// A dark dot whose vertex may not go would darken all the triangles that grow around it.
TEST(ObjectCollapse, ADarkDotStaysAsDarkAsItWasOnTheWhole) {
  Object object = object_of(grid(20, 20, 0.0));
  object.mesh.occlusion.assign(object.mesh.position_m.size(), 0.0f);
  for (Vec3& n : object.mesh.normal) n = {0, 0, 1};
  std::uint32_t dot = 0;
  for (std::uint32_t v = 0; v < object.mesh.position_m.size(); ++v)
    if (glm::length(object.mesh.position_m[v] - Vec3{1, 1, 0}) <
        glm::length(object.mesh.position_m[dot] - Vec3{1, 1, 0}))
      dot = v;
  object.mesh.occlusion[dot] = 1.0f;
  object.locked.push_back(dot);
  // Weight 0: shade doesn't resist.
  const ObjectHistory h = simplify_object(object, {.base_triangles = 60, .pose_weight = 0.0});
  const auto shade = [](const auto& triangles, auto&& at, auto&& dark) {
    double sum = 0, area = 0;
    for (const auto& t : triangles) {
      const auto a = glm::length(glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])));
      area += static_cast<double>(a);
      for (const std::uint32_t v : t) sum += static_cast<double>(a * dark(v)) / 3;
    }
    return sum / area;
  };
  const double before = shade(
      object.mesh.triangles, [&](std::uint32_t v) { return object.mesh.position_m[v]; },
      [&](std::uint32_t v) { return object.mesh.occlusion[v]; });
  const double after = shade(
      h.base_triangles, [&](std::uint32_t v) { return h.versions[v].position_m; },
      [&](std::uint32_t v) { return h.versions[v].occlusion; });
  EXPECT_LT(after, 3 * before);  // Without care: 14 times.
  EXPECT_GT(after, 0.3 * before);
}

TEST(Mirror, PairsPointsAndLeavesOthersAlone) {
  const std::vector<Vec3d> points = {{1, 0, 0}, {-1, 0, 1e-9}, {0, 2, 0}, {3, 3, 3}};
  const std::vector<std::uint32_t> mirror = mirror_points(points, 1e-6);
  EXPECT_EQ(mirror, (std::vector<std::uint32_t>{1, 0, 2, kNone}));
  const std::vector<Vec3d> lopsided = {{1, 0, 0}, {-1, 0, 0}, {3, 3, 3}, {4, 4, 4}};
  EXPECT_EQ(mirror_points(lopsided, 1e-6), std::vector<std::uint32_t>(4, kNone));
}

}  // namespace
}  // namespace caryatid::bake
