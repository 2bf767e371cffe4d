#include "core/body/bap_table.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "core/body/bap_axes.h"
#include "core/body/hanim.h"

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

// The table of axes is another reading of the same annex: both must know the same joints.
TEST(BapTable, JointsAgreeWithTheAxes) {
  for (int bap = 1; bap <= kBapCount; ++bap) {
    if (bap_info(bap).unit != BapUnit::angle_1e5_rad) continue;
    const char* joint = bap_info(bap).joint;
    const auto found = find_hanim_joint({joint, std::strlen(joint)});
    ASSERT_TRUE(found.ok()) << bap;
    EXPECT_EQ(found.value, bap_axis(bap).joint) << bap;
  }
}

TEST(BapTable, ExtensionsHaveUnitSteps) {
  EXPECT_EQ(bap_info(187).group, 20);
  EXPECT_EQ(bap_info(296).group, 24);
  EXPECT_EQ(bap_info(250).quantiser(BapQuantisers::visage), 1);
}

}  // namespace
}  // namespace caryatid::body
