#include "core/face/fap_table.h"

#include <gtest/gtest.h>

namespace caryatid::face {
namespace {

TEST(FapTable, PartnersPointAtEachOther) {
  for (int fap = 1; fap <= kFapCount; ++fap) {
    const int partner = fap_info(fap).partner;
    if (partner == 0) continue;
    EXPECT_EQ(fap_info(partner).partner, fap) << fap;
    EXPECT_EQ(fap_info(partner).unit, fap_info(fap).unit) << fap;
    EXPECT_EQ(fap_info(partner).quantiser, fap_info(fap).quantiser) << fap;
    EXPECT_EQ(fap_info(partner).intra_max, fap_info(fap).intra_max) << fap;
  }
}

TEST(FapTable, GroupsCoverAllFapsInOrder) {
  int next = 1;
  for (int group = 1; group <= kFapGroupCount; ++group) {
    EXPECT_EQ(fap_group(group).first, next);
    for (; next <= fap_group(group).last; ++next) EXPECT_EQ(fap_info(next).group, group);
  }
  EXPECT_EQ(next, kFapCount + 1);
}

TEST(FapTable, NamesAreFoundAndUnique) {
  for (int fap = 1; fap <= kFapCount; ++fap) EXPECT_EQ(find_fap(fap_info(fap).name), fap);
  EXPECT_EQ(find_fap("raise_tail"), 0);
  EXPECT_EQ(find_fap(""), 0);
}

TEST(FapTable, OnlyEightFapsTurnSomething) {
  for (int fap = 1; fap <= kFapCount; ++fap)
    EXPECT_EQ(is_rotation(fap_info(fap)), (fap >= 23 && fap <= 26) || (fap >= 47 && fap <= 50));
}

// 14496-2 annex C, table C-1: the rows that are easiest to get wrong.
TEST(FapTable, SpotRows) {
  EXPECT_EQ(fap_info(3).positive, FapDirection::down);
  EXPECT_FALSE(fap_info(3).bidirectional);
  EXPECT_EQ(fap_info(12).point, (FeaturePoint{2, 4}));
  EXPECT_EQ(fap_info(18).point, (FeaturePoint{2, 10}));
  EXPECT_EQ(fap_info(37).positive, FapDirection::right);
  EXPECT_EQ(fap_info(38).positive, FapDirection::left);
  EXPECT_EQ(coding_limit(fap_info(48)), 316200.0f);
  EXPECT_EQ(direction_vector(FapDirection::left), Vec3(1, 0, 0));
}

}  // namespace
}  // namespace caryatid::face
