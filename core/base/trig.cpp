#include "core/base/trig.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace caryatid {
namespace {

// Minimax-fitted on [-pi/4, pi/4] (Cephes single-precision coefficients, public domain).
float sin_kernel(float x) {
  const float z = x * x;
  return ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * x + x;
}

float cos_kernel(float x) {
  const float z = x * x;
  return ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z -
         0.5f * z + 1.0f;
}

// Arc tangent on [0, 1], Cephes: reduced once at tan(pi/8).
float atan_unit(float x) {
  float base = 0.0f;
  if (x > 0.4142135623730950f) {
    base = kPi / 4.0f;
    x = (x - 1.0f) / (x + 1.0f);
  }
  const float z = x * x;
  return base + ((((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z -
                  3.33329491539e-1f) *
                     z * x +
                 x);
}

// Beyond this a float no longer says where in the turn it is; NaN neither.
constexpr float kMostAngle_rad = 1e6f;

}  // namespace

SinCos sin_cos(float angle_rad) {
  if (!(angle_rad >= -kMostAngle_rad && angle_rad <= kMostAngle_rad)) return {};
  // Cody-Waite: pi/2 in three parts, so that the reduction keeps its bits.
  const float turns = angle_rad * 0.636619772f;
  const auto quadrant = static_cast<std::int32_t>(turns + (turns >= 0.0f ? 0.5f : -0.5f));
  const auto q = static_cast<float>(quadrant);
  const float x =
      ((angle_rad - q * 1.5703125f) - q * 4.837512969970703125e-4f) - q * 7.549789948768648e-8f;
  const float s = sin_kernel(x);
  const float c = cos_kernel(x);
  switch (quadrant & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

float atan2_of(float y, float x) {
  const float ax = x < 0.0f ? -x : x;
  const float ay = y < 0.0f ? -y : y;
  if (ax == 0.0f && ay == 0.0f) return 0.0f;
  float angle = ax >= ay ? atan_unit(ay / ax) : kPi / 2.0f - atan_unit(ax / ay);
  if (x < 0.0f) angle = kPi - angle;
  return y < 0.0f ? -angle : angle;
}

float acos_of(float x) {
  const float c = x < -1.0f ? -1.0f : (x > 1.0f ? 1.0f : x);
  return atan2_of(std::sqrt((1.0f - c) * (1.0f + c)), c);
}

float asin_of(float x) {
  const float s = x < -1.0f ? -1.0f : (x > 1.0f ? 1.0f : x);
  return atan2_of(s, std::sqrt((1.0f - s) * (1.0f + s)));
}

float exp_of(float x) {
  const float clamped = !(x > -80.0f) ? -80.0f : (x > 80.0f ? 80.0f : x);  // NaN: -80.
  const float scaled = clamped * 1.44269504089f;
  const auto power = static_cast<std::int32_t>(scaled + (scaled >= 0.0f ? 0.5f : -0.5f));
  const auto p = static_cast<float>(power);
  const float r = (clamped - p * 0.693359375f) + p * 2.12194440e-4f;
  const float e = (((((1.9875691500e-4f * r + 1.3981999507e-3f) * r + 8.3334519073e-3f) * r +
                     4.1665795894e-2f) *
                        r +
                    1.6666665459e-1f) *
                       r +
                   5.0000001201e-1f) *
                      r * r +
                  r + 1.0f;
  return e * std::bit_cast<float>(static_cast<std::uint32_t>(power + 127) << 23);
}

}  // namespace caryatid
