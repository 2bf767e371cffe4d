#include "core/base/trig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace caryatid {
namespace {

TEST(Trig, SinCosStaysCloseToLibm) {
  for (double a = -6.3; a < 6.3; a += 0.0007) {
    const SinCos sc = sin_cos(static_cast<float>(a));
    const double exact = static_cast<double>(static_cast<float>(a));
    EXPECT_NEAR(sc.sin, std::sin(exact), 3e-7);
    EXPECT_NEAR(sc.cos, std::cos(exact), 3e-7);
  }
}

TEST(Trig, Atan2CoversAllQuadrants) {
  for (double a = -3.14; a < 3.14; a += 0.001)
    EXPECT_NEAR(atan2_of(static_cast<float>(std::sin(a) * 5), static_cast<float>(std::cos(a) * 5)),
                a, 1e-6);
  EXPECT_EQ(atan2_of(0.0f, 0.0f), 0.0f);
}

TEST(Trig, AcosClampsItsArgument) {
  EXPECT_EQ(acos_of(1.5f), 0.0f);
  EXPECT_NEAR(acos_of(-1.5f), kPi, 1e-6);
  for (float x = -1.0f; x <= 1.0f; x += 0.001f) EXPECT_NEAR(acos_of(x), std::acos(x), 2e-6);
}

TEST(Trig, HostileNumbersStayFinite) {
  for (const float x : {1e30f, -1e30f, HUGE_VALF, -HUGE_VALF, std::nanf("")}) {
    EXPECT_EQ(sin_of(x), 0.0f);
    EXPECT_EQ(cos_of(x), 1.0f);
    EXPECT_TRUE(std::isfinite(exp_of(x)));
  }
}

TEST(Trig, ExpIsRelativelyExact) {
  for (double x = -20; x < 20; x += 0.013)
    EXPECT_NEAR(
        exp_of(static_cast<float>(x)) / std::exp(static_cast<double>(static_cast<float>(x))), 1.0,
        1e-6);
}

}  // namespace
}  // namespace caryatid
