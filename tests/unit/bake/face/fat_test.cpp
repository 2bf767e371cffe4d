// The face animation tables of the two characters. Skipped when the base human is not there.
#include "assets/bake/face/fat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/bake/face/movement.h"
#include "assets/bake/simplify/animation_error.h"
#include "core/face/fap_table.h"
#include "core/face/fat.h"
#include "tests/unit/bake/face/baked.h"

namespace caryatid::bake {
namespace {

using caryatid::face::FapFrame;

class Fat : public OnBothFaces {
 protected:
  std::vector<float> weights(const FapFrame& frame) const {
    std::vector<float> w(character().channels.size());
    EXPECT_TRUE(face::evaluate_channels(character().channels, frame, w).ok());
    return w;
  }
  // Displacement of one vertex of an object.
  Vec3 displacement(const std::vector<float>& weight, std::uint32_t object,
                    std::uint32_t vertex) const {
    Vec3 d{0};
    for (std::size_t c = 0; c < weight.size(); ++c) {
      if (weight[c] == 0.0f) continue;
      for (const Move& m : character().objects[object].moves[c])
        if (m.vertex == vertex) d += weight[c] * m.displacement_m;
    }
    return d;
  }
  const FeaturePoint& point(int group, int index) const {
    for (const FeaturePoint& p : character().feature_points)
      if (p.group == group && p.index == index) return p;
    throw std::runtime_error("no such point");
  }
  Vec3 displacement_at(const FapFrame& frame, int group, int index) const {
    const FeaturePoint& p = point(group, index);
    return displacement(weights(frame), p.object, p.vertex);
  }
  static bool is_displacement(int fap) {
    const face::FapInfo& info = face::fap_info(fap);
    return info.unit != face::FapUnit::au && face::direction_vector(info.positive) != Vec3(0) &&
           fap != 27 && fap != 28;  // Eyeballs are shifted as joints.
  }
};

TEST_P(Fat, EveryFapMovesItsPointByItsAmount) {
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    if (!is_displacement(fap)) continue;
    const auto i = static_cast<std::size_t>(fap);
    const face::FapInfo& info = face::fap_info(fap);
    for (const float nominal : {0.5f * ranges().low[i], 0.5f * ranges().high[i]}) {
      if (nominal == 0.0f) continue;
      FapFrame frame;
      frame.set(fap, nominal);
      const Vec3 d = displacement_at(frame, info.point.group, info.point.index);
      const float moved =
          glm::dot(d, face::direction_vector(info.positive)) / fat::metres_per_unit(head(), fap);
      EXPECT_NEAR(moved, nominal, std::max(2.0f, 0.02f * std::abs(nominal)))
          << "FAP " << fap << " " << info.name;
    }
  }
}

TEST_P(Fat, NothingOutsideItsRegionMoves) {
  // Farthest that a FAP of each group reaches from its point, metres; the jaw takes half the face.
  const float reach[] = {0, 0, 0.11f, 0.05f, 0.09f, 0.06f, 0.085f, 0, 0.085f, 0.06f, 0.075f};
  for (std::size_t c = 0; c < character().channels.size(); ++c) {
    const int fap = character().channels[c].fap;
    const face::FapInfo& info = face::fap_info(fap);
    if (fap == 3 || fap == 14 || fap == 15 || info.point.group == 0) continue;
    const Vec3 center = point(info.point.group, info.point.index).position_m;
    for (const Object& object : character().objects)
      for (const Move& m : object.moves[c])
        EXPECT_LT(glm::length(object.mesh.position_m[m.vertex] - center), reach[info.group])
            << info.name << " moves " << object.name;
  }
}

TEST_P(Fat, LipsAreIndependent) {
  FapFrame upper, lower, jaw;
  upper.set(4, -200.0f);
  lower.set(5, -200.0f);
  jaw.set(3, 600.0f);
  EXPECT_EQ(displacement_at(upper, 2, 3), Vec3(0));
  EXPECT_EQ(displacement_at(lower, 2, 2), Vec3(0));
  for (const auto& [group, index] : {std::pair{2, 2}, {2, 3}, {2, 4}, {8, 1}, {8, 2}, {8, 3}})
    EXPECT_LT(glm::length(displacement_at(jaw, group, index)), 1e-4f)
        << "FAP 3 moves no lips: " << group << "." << index;
}

TEST_P(Fat, LeftAndRightAreIndependent) {
  FapFrame left;
  for (const int fap : {6, 12, 19, 21, 31, 33, 35, 39, 41, 53, 59, 61, 65})
    left.set(fap, 0.5f * ranges().high[static_cast<std::size_t>(fap)]);
  for (const auto& [group, index] :
       {std::pair{2, 5}, {3, 2}, {3, 4}, {4, 4}, {4, 6}, {5, 2}, {5, 4}, {8, 4}, {9, 2}, {10, 2}})
    EXPECT_LT(glm::length(displacement_at(left, group, index)), 1e-4f) << group << "." << index;
}

TEST_P(Fat, ShutLidsMeetWhateverTheLowerOneDoes) {
  for (const float lower : {0.0f, 150.0f, 300.0f}) {
    FapFrame shut;
    for (const int side : {0, 1}) {
      shut.set(19 + side, 1024.0f - lower);
      shut.set(21 + side, lower);
    }
    for (const int side : {0, 1}) {
      const Vec3 top = point(3, 1 + side).position_m + displacement_at(shut, 3, 1 + side);
      const Vec3 bottom = point(3, 3 + side).position_m + displacement_at(shut, 3, 3 + side);
      EXPECT_LT(std::abs(top.y - bottom.y), 3e-4f) << lower;
      EXPECT_LT(std::abs(top.z - bottom.z), 8e-4f) << lower;
    }
  }
}

TEST_P(Fat, LidsNeverEnterTheEyeball) {
  for (int side = 0; side < fat::kSides; ++side) {
    const Vec3 center = head().eye[static_cast<std::size_t>(side)].center_m;
    const auto radius = [&](float value) {
      FapFrame frame;
      frame.set(19 + side, value);
      return glm::length(point(3, 1 + side).position_m + displacement_at(frame, 3, 1 + side) -
                         center);
    };
    const float least = std::min(radius(0.0f), radius(1024.0f));
    for (float value = -300.0f; value <= 1024.0f; value += 66.2f)
      EXPECT_GT(radius(value), least - 2e-4f) << value;
  }
}

TEST_P(Fat, ChannelsTellTheLimitsOfEveryFap) {
  const face::FapLimits limits = face::limits_of(character().channels);
  for (std::size_t fap = 3; fap <= face::kFapCount; ++fap) {
    EXPECT_NEAR(limits.low[fap], ranges().low[fap] * face::kReach, 0.5f) << fap;
    EXPECT_NEAR(limits.high[fap], ranges().high[fap] * face::kReach, 0.5f) << fap;
  }
}

TEST_P(Fat, MovesAreSparseFiniteAndFitThePack) {
  std::size_t count = 0;
  for (const Object& object : character().objects) {
    ASSERT_EQ(object.moves.size(), character().channels.size());
    for (const std::vector<Move>& moves : object.moves) {
      count += moves.size();
      for (std::size_t i = 0; i < moves.size(); ++i) {
        if (i > 0) {
          ASSERT_LT(moves[i - 1].vertex, moves[i].vertex);
        }
        ASSERT_LT(glm::length(moves[i].displacement_m), 0.065f);
        ASSERT_LE(glm::length(moves[i].normal_change), 2.01f);
      }
    }
  }
  EXPECT_LT(count, 150000u);
  EXPECT_GT(count, 10000u);
}

// A coarser head moves its feature points as the full one does, at the levels of thesis figure 3-6.
TEST_P(Fat, FeaturePointsMoveAlikeAtEveryLevel) {
  for (std::uint32_t o = 0; o < character().objects.size(); ++o) {
    Object skin = character().objects[o];
    if (skin.role != pack::ObjectRole::head) continue;
    const ObjectOptions options{.base_triangles = 640, .pose_weight = 10.0};
    // Without locks the same measure must see a difference, else it measures nothing.
    skin.locked.clear();
    const ObjectHistory loose = simplify_object(skin, options);
    for (const FeaturePoint& p : character().feature_points)
      if (p.object == o) skin.locked.push_back(p.vertex);
    const ObjectHistory held = simplify_object(skin, options);
    float moved_fapu = 0, loose_fapu = 0;
    std::uint32_t lost = 0;
    for (const std::uint32_t level : {2141u, 1929u, 1307u, 680u})
      for (const AnimationError& e : animation_error(character(), o, held, level)) {
        EXPECT_EQ(e.worst_fapu, 0.0f) << "FAP " << e.fap << " at " << level;
        EXPECT_EQ(e.lost_points, 0u) << "FAP " << e.fap << " at " << level;
        moved_fapu = std::max(moved_fapu, e.moved_fapu);
      }
    for (const AnimationError& e : animation_error(character(), o, loose, 680)) {
      loose_fapu = std::max(loose_fapu, e.worst_fapu);
      lost = std::max(lost, e.lost_points);
    }
    EXPECT_GT(moved_fapu, 100.0f);
    EXPECT_GT(loose_fapu + static_cast<float>(lost), 1.0f);
  }
}

INSTANTIATE_TEST_SUITE_P(Characters, Fat, testing::Values(std::size_t{0}, std::size_t{1}),
                         character_name);

}  // namespace
}  // namespace caryatid::bake
