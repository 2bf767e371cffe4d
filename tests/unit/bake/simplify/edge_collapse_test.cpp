#include "assets/bake/simplify/edge_collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/distance.h"
#include "assets/bake/simplify/error_bound.h"
#include "assets/bake/simplify/fast_cost.h"
#include "assets/bake/simplify/history.h"
#include "assets/bake/simplify/placement.h"
#include "tests/unit/bake/simplify/shapes.h"

namespace caryatid::bake {
namespace {

Surface down_to(Surface s, std::uint32_t faces, CollapseReport* report = nullptr) {
  CollapseOptions options;
  options.target_triangles = faces;
  return collapse_edges(std::move(s), options, report);
}

// Every triangle as positions, from its least corner on; sorted. Equal for surfaces that differ in
// numbers only.
std::vector<std::array<std::array<double, 3>, 3>> shape_of(const Surface& s) {
  std::vector<std::array<std::array<double, 3>, 3>> out;
  for (const Triangle& t : s.triangles) {
    std::array<std::array<double, 3>, 3> c;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d& p = s.position[t[i]];
      c[i] = {p.x, p.y, p.z};
    }
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    out.push_back(c);
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(EdgeCollapse, ATetrahedronStays) {
  Surface s{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  EXPECT_EQ(down_to(s, 0).triangles.size(), 4u);
}

TEST(EdgeCollapse, MeetsItsTargetWithinOne) {
  for (const std::uint32_t n : {20u, 101u, 500u}) {
    const std::size_t faces = down_to(ball(16, 0.1), n).triangles.size();
    EXPECT_LE(faces, n);
    EXPECT_GE(faces + 1, n);
  }
}

TEST(EdgeCollapse, ClosedVolumeIsKept) {
  const Surface s = ball(60, 0.15);
  const double before = facts_of(s).volume;
  for (const std::uint32_t n : {5000u, 1000u, 200u, 60u})
    EXPECT_NEAR(facts_of(down_to(s, n)).volume / before, 1.0, 1e-12);
}

TEST(EdgeCollapse, AFlatSquareKeepsItsBorderExactly) {
  const Surface s = down_to(grid(12, 12, 0.0), 20);
  const SurfaceFacts facts = facts_of(s);
  EXPECT_LE(facts.triangles, 20u);
  EXPECT_NEAR(facts.border_length, 48.0, 1e-9);
  for (const Vec3d& p : s.position) EXPECT_NEAR(p.z, 0.0, 1e-12);
}

TEST(EdgeCollapse, TopologyIsKept) {
  for (const Surface& s : {ball(20, 0.2), grid(15, 20, 1.0)}) {
    const SurfaceFacts before = facts_of(s), after = facts_of(down_to(s, 60));
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.border_loops, before.border_loops);
  }
}

TEST(EdgeCollapse, LockedVerticesStandStill) {
  const Surface s = ball(16, 0.1);
  CollapseOptions options;
  options.target_triangles = 40;
  options.locked = {7, 33, 100};
  const Surface out = collapse_edges(s, options);
  for (const std::uint32_t v : options.locked)
    EXPECT_NE(std::find(out.position.begin(), out.position.end(), s.position[v]),
              out.position.end());
}

TEST(EdgeCollapse, IsDeterministic) {
  const Surface a = down_to(ball(20, 0.1), 100), b = down_to(ball(20, 0.1), 100);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.triangles, b.triangles);
}

// The numbering of the file says nothing: vertices and triangles shuffled give the same surface.
TEST(EdgeCollapse, OrderOfTheInputDoesNotMatter) {
  const Surface s = ball(20, 0.1);
  Surface shuffled;
  std::vector<std::uint32_t> order(s.position.size()), number(s.position.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random(7);
  std::shuffle(order.begin(), order.end(), random);
  for (std::uint32_t i = 0; i < order.size(); ++i) number[order[i]] = i;
  for (const std::uint32_t v : order) shuffled.position.push_back(s.position[v]);
  for (const Triangle& t : s.triangles)
    shuffled.triangles.push_back({number[t[1]], number[t[2]], number[t[0]]});
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
  EXPECT_EQ(shape_of(down_to(s, 300)), shape_of(down_to(shuffled, 300)));
}

// The four-edge float cost against the double one of the equations, around a bumpy vertex pair.
TEST(FastCost, AgreesWithTheEquations) {
  const Vec3d a(0, 0, 0.3), b(1, 0.1, 0.2);
  const Vec3d l(0.5, 0.9, 0), r(0.5, -1, 0.1);
  const Vec3d a1(-0.6, 0.7, 0), a2(-0.7, -0.6, 0.05), b1(1.7, 0.6, -0.1), b2(1.6, -0.8, 0);
  const std::array<std::array<Vec3d, 3>, 8> triangles = {{{a, b, l},
                                                          {b, a, r},
                                                          {a, l, a1},
                                                          {a, a1, a2},
                                                          {a, a2, r},
                                                          {b, b1, l},
                                                          {b, b2, b1},
                                                          {b, r, b2}}};
  const Vec3d middle = 0.5 * (a + b);
  EdgeSums sums;
  VertexQuadric qa, qb;
  for (const auto& t : triangles) {
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    const TriangleTerm term(static_cast<float>(n.x), static_cast<float>(n.y),
                            static_cast<float>(n.z));
    sums.add_triangle(n, dot(n, t[0] - middle),
                      static_cast<double>(area_weight(static_cast<float>(length2(n)))));
    for (const Vec3d& p : t) {
      if (p == a) qa.add(term);
      if (p == b) qb.add(term);
    }
  }
  const double exact = 72.0 * collapse_cost(sums, best_position(sums).value());
  EdgeBatch batch{};
  for (std::uint32_t lane = 0; lane < 4; ++lane) {
    batch.set_ends(lane, qa, qb);
    const Vec3d left = cross(b - a, l - a), right = cross(r - a, b - a);
    for (int i = 0; i < 3; ++i) {
      batch.half[i][lane] = static_cast<float>(0.5 * (b - a)[i]);
      batch.left[i][lane] = static_cast<float>(left[i]);
      batch.right[i][lane] = static_cast<float>(right[i]);
    }
  }
  batch.evaluate();
  EXPECT_GT(exact, 0.0);
  for (const float cost : batch.cost) EXPECT_NEAR(static_cast<double>(cost), exact, 1e-4 * exact);
}

TEST(FastCost, AreaWeightIsAboutAnEighthRoot) {
  for (float n2 = 1e-12f; n2 < 1e12f; n2 *= 1.7f)
    EXPECT_NEAR(area_weight(n2) * std::pow(n2, 1.0f / 16.0f), 1.0f, 0.07f) << n2;
}

TEST(History, FinestLevelIsTheOriginalBitForBit) {
  const Surface s = ball(16, 0.1);
  CollapseOptions options;
  options.target_triangles = 12;
  const History h = record_history(s, options);
  HistoryCursor cursor(h);
  cursor.go_to(100000);
  EXPECT_EQ(cursor.surface().position, s.position);
  EXPECT_EQ(cursor.surface().triangles, s.triangles);
}

TEST(History, EveryLevelIsThatOfTheSimplificationItself) {
  const Surface s = grid(12, 15, 0.8);
  CollapseOptions options;
  options.target_triangles = 10;
  const History h = record_history(s, options);
  HistoryCursor cursor(h);
  for (const std::uint32_t n : {300u, 50u, 200u, 51u, 120u}) {
    cursor.go_to(n);
    const Surface direct = down_to(s, n);
    EXPECT_EQ(shape_of(cursor.surface()), shape_of(direct));
  }
}

// The other goal: stops before the measured distance passes the bound, and not long before.
TEST(ErrorBound, StopsWhenTheMeasuredDistanceWouldPassIt) {
  const Surface s = ball(24, 0.15);
  CollapseOptions options;
  options.target_triangles = 4;
  const History h = record_history(s, options);
  std::size_t before = s.triangles.size();
  for (const double bound : {0.002, 0.01, 0.05}) {
    const Surface level = coarsest_within(h, s, bound, 0);
    EXPECT_LE(measure_error(s, level).hausdorff(), bound);
    EXPECT_LT(level.triangles.size(), before);
    before = level.triangles.size();
    HistoryCursor cursor(h);
    cursor.go_to(static_cast<std::uint32_t>(before - 8));
    EXPECT_GT(measure_error(s, cursor.surface()).hausdorff(), 0.8 * bound);
  }
}

TEST(ErrorBound, BothGoalsTogetherStopAtTheFirst) {
  const Surface s = ball(24, 0.15);
  CollapseOptions options;
  options.target_triangles = 4;
  const History h = record_history(s, options);
  const std::size_t by_error = coarsest_within(h, s, 0.02, 0).triangles.size();
  const auto more = static_cast<std::uint32_t>(by_error + 200);
  EXPECT_NEAR(static_cast<double>(coarsest_within(h, s, 0.02, more).triangles.size()), more, 2.0);
  EXPECT_EQ(coarsest_within(h, s, 0.02, 4).triangles.size(), by_error);
  EXPECT_EQ(coarsest_within(h, s, 0.0, 0).triangles.size(), s.triangles.size());
}

TEST(History, FileComesBackTheSame) {
  CollapseOptions options;
  options.target_triangles = 12;
  const History h = record_history(grid(6, 9, 0.8), options);
  const std::string bytes = format_history(h);
  EXPECT_EQ(format_history(parse_history(bytes, "h")), bytes);
}

TEST(History, AnyFlippedBitIsRefused) {
  CollapseOptions options;
  options.target_triangles = 12;
  const std::string bytes = format_history(record_history(grid(4, 4, 0.8), options));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::string bad = bytes;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_THROW((void)parse_history(bad, "h"), std::runtime_error) << i;
  }
  EXPECT_THROW((void)parse_history(bytes.substr(0, bytes.size() - 1), "h"), std::runtime_error);
}

TEST(Distance, OfParallelSquaresIsTheirGap) {
  Surface a = grid(3, 3, 0.0), b = a;
  for (Vec3d& p : b.position) p.z = 0.25;
  const SurfaceError e = measure_error(a, b);
  EXPECT_NEAR(e.mean(), 0.25, 1e-12);
  EXPECT_NEAR(e.rms(), 0.25, 1e-12);
  EXPECT_NEAR(e.hausdorff(), 0.25, 1e-12);
}

}  // namespace
}  // namespace caryatid::bake
