#include "core/lod/share.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace caryatid::lod {
namespace {

ObjectNeed object(float px, float importance = 1.0f) {
  ObjectNeed need;
  need.min_triangles = 100;
  need.max_triangles = 10000;
  need.screen_px = px;
  need.importance = importance;
  return need;
}

std::array<std::uint32_t, 2> share(const ObjectNeed& a, const ObjectNeed& b, float budget_us) {
  const std::array<ObjectNeed, 2> objects{a, b};
  const std::array<float, 2> cost{0.1f, 0.1f};
  std::array<std::uint32_t, 2> out{};
  share_budget(objects, cost, budget_us, out);
  return out;
}

TEST(Share, EqualObjectsGetEqualShares) {
  const auto n = share(object(5000), object(5000), 800);
  EXPECT_EQ(n[0], n[1]);
  EXPECT_NEAR(n[0], 4000, 10);
}

TEST(Share, WhatIsSeenMoreGetsMore) {
  EXPECT_GT(share(object(9000), object(3000), 800)[0], share(object(3000), object(3000), 800)[0]);
  EXPECT_GT(share(object(9000, 1), object(9000, 0.3f), 800)[0], 4000u);
  ObjectNeed speaking = object(9000), aside = object(9000);
  speaking.expression = 1.0f;
  aside.axis_closeness = 0.0f;
  EXPECT_GT(share(speaking, object(9000), 800)[0], 4000u);
  EXPECT_LT(share(aside, object(9000), 800)[0], 4000u);
}

TEST(Share, ErrorFallsAsOneOverN) {  // Four times the weight: twice the triangles.
  const auto n = share(object(8000), object(2000), 900);
  EXPECT_NEAR(static_cast<double>(n[0]) / n[1], 2.0, 0.01);
}

TEST(Share, WhatIsNotSeenGetsItsMinimum) {
  EXPECT_EQ(share(object(0), object(5000), 800)[0], 100u);
  EXPECT_EQ(share(object(0), object(0), 800)[1], 100u);
}

TEST(Share, MinimaAreDrawnEvenWithoutABudget) {
  const auto n = share(object(5000), object(50), -100);
  EXPECT_EQ(n[0], 100u);
  EXPECT_EQ(n[1], 100u);
}

TEST(Share, AmpleBudgetGivesTheFullMeshes) {
  const auto n = share(object(5000), object(50), 1e6f);
  EXPECT_EQ(n[0], 10000u);
  EXPECT_EQ(n[1], 10000u);
}

TEST(Share, SpendsTheBudgetAndMoreOfItNeverHurtsAnObject) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::array<ObjectNeed, 8> objects;
    std::array<float, 8> cost{};
    float least = 0, most = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      objects[i] = object(random.between(0, 1e6f), random.unit());
      objects[i].min_triangles = random.next() % 1000;
      objects[i].max_triangles = objects[i].min_triangles + random.next() % 20000;
      cost[i] = random.between(0.01f, 0.3f);
      least += cost[i] * static_cast<float>(objects[i].min_triangles);
      most += cost[i] * static_cast<float>(objects[i].max_triangles);
    }
    std::array<std::uint32_t, 8> before{}, out{};
    for (float part = 0.0f; part <= 1.0f; part += 0.1f) {
      const float budget = least + part * (most - least) * 0.9f;
      const float spent = share_budget(objects, cost, budget, out);
      EXPECT_LE(spent, budget * 1.0001f + 1.0f);
      for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_GE(out[i], std::max(before[i], objects[i].min_triangles));
        EXPECT_LE(out[i], objects[i].max_triangles);
      }
      before = out;
    }
  }
}

}  // namespace
}  // namespace caryatid::lod
