#include "core/body/bap_table.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace caryatid::body {
namespace {

TEST(BapTable, GroupsHoldEveryBapOnce) {
  std::set<int> seen;
  for (int group = 1; group <= kBapGroupCount; ++group)
    for (const int bap : bap_group(group)) {
      EXPECT_EQ(bap_info(bap).group, group) << bap;
      EXPECT_TRUE(seen.insert(bap).second) << bap;
    }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kBapCountExtended));
}

TEST(BapTable, NamesAreFoundAndUnique) {
  for (int bap = 1; bap <= kBapCount; ++bap) EXPECT_EQ(find_bap(bap_info(bap).name), bap);
  EXPECT_EQ(find_bap("l_wing_flexion"), 0);
}

TEST(BapTable, EveryBapNamesItsJointFirst) {
  for (int bap = 1; bap <= kBapCount; ++bap) {
    const BapInfo& info = bap_info(bap);
    EXPECT_EQ(std::strncmp(info.name, info.joint, std::strlen(info.joint)), 0) << bap;
  }
}

TEST(BapTable, OnlyTheRootMoves) {
  for (int bap = 1; bap <= kBapCount; ++bap)
    EXPECT_EQ(bap_info(bap).unit == BapUnit::length_mm, bap >= 181 && bap <= 183) << bap;
}

// A left joint's parameter and its right twin share axes and steps: mirroring is by value alone.
TEST(BapTable, SidesShareAxes) {
  for (int bap = 4; bap < 47; bap += 2) {
    EXPECT_EQ(bap_info(bap).axis_visage, bap_info(bap + 1).axis_visage) << bap;
    EXPECT_EQ(bap_info(bap).axis_greta, bap_info(bap + 1).axis_greta) << bap;
    EXPECT_EQ(bap_info(bap).quantiser_visage, bap_info(bap + 1).quantiser_visage) << bap;
  }
}

TEST(BapTable, ConventionsDifferInTheKneeButNotInTheRoot) {
  const BapInfo& knee = bap_info(find_bap("l_knee_flexion"));
  EXPECT_EQ(axis_vector(knee.axis(BapConvention::visage)), Vec3(-1, 0, 0));
  EXPECT_EQ(axis_vector(knee.axis(BapConvention::greta)), Vec3(1, 0, 0));
  const BapInfo& tilt = bap_info(find_bap("HumanoidRoot_rt_body_tilt"));
  EXPECT_EQ(tilt.axis_visage, BapAxis::plus_x);
  EXPECT_EQ(tilt.axis_greta, BapAxis::plus_x);
}

TEST(BapTable, ExtensionsHaveUnitSteps) {
  EXPECT_EQ(bap_info(187).group, 20);
  EXPECT_EQ(bap_info(296).group, 24);
  EXPECT_EQ(bap_info(250).quantiser(BapQuantisers::visage), 1);
}

}  // namespace
}  // namespace caryatid::body
