#include "core/face/move_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/base/random.h"
#include "platform/cpu.h"

namespace caryatid::face {
namespace {

constexpr int kChannels = 40;

std::vector<pack::Move> random_moves(Random& random, std::size_t count) {
  std::vector<pack::Move> moves(count);
  for (pack::Move& move : moves) {
    // Also channels that are not there, as in a damaged file.
    move.channel = static_cast<std::uint16_t>(random.next() % (kChannels + 2));
    for (auto& d : move.d) d = static_cast<std::int16_t>(random.next());
    for (auto& n : move.normal) n = static_cast<std::int8_t>(random.next());
    move.reserved = static_cast<std::int8_t>(random.next());
  }
  return moves;
}

// Some rest, and some so small that their products would be denormal.
std::array<float, kChannels> random_weights(Random& random) {
  std::array<float, kChannels> weights{};
  for (float& w : weights) {
    w = 2.0f * random.unit() - 1.0f;
    if (random.next() % 4 == 0) w = 0.0f;
    if (random.next() % 4 == 0) w *= 1e-42f;
  }
  return weights;
}

TEST(MoveSum, IsTheWeightedSum) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    const auto moves = random_moves(random, random.next() % 30);
    const auto weights = random_weights(random);
    double d[3] = {}, normal[3] = {};
    for (const pack::Move& move : moves)
      for (int i = 0; i < 3 && move.channel < kChannels; ++i) {
        d[i] += double{weights[move.channel]} * move.d[i];
        normal[i] += double{weights[move.channel]} * move.normal[i];
      }
    const MoveSum sum = sum_moves(moves, weights);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(sum.d[i], d[i], 0.2);  // Of up to a million.
      EXPECT_NEAR(sum.normal[i], normal[i], 1e-3);
    }
  }
}

TEST(MoveSum, NeonHasTheSameBits) {
  if (!platform::has_neon()) GTEST_SKIP() << "this CPU has no NEON";
  const SumMoves neon = sum_moves_for(true);
  ASSERT_NE(neon, &sum_moves);
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    const auto moves = random_moves(random, random.next() % 30);
    const auto weights = random_weights(random);
    const MoveSum one = sum_moves(moves, weights), other = neon(moves, weights);
    ASSERT_EQ(std::memcmp(&one, &other, sizeof one), 0) << "round " << round;
  }
}

TEST(MoveSum, WithoutNeonThereIsTheOther) { EXPECT_EQ(sum_moves_for(false), &sum_moves); }

}  // namespace
}  // namespace caryatid::face
