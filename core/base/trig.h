#pragma once
// Trigonometry whose bits are the same on every machine: IEEE add, multiply, divide and square root
// only, no libm, no contraction (-ffp-contract=off). Used wherever a result is hashed or replayed.
namespace caryatid {

inline constexpr float kPi = 3.14159265358979f;

struct SinCos {
  float sin = 0.0f;
  float cos = 1.0f;
};

// Sine and cosine. |angle_rad| up to 1e4; absolute error below 3e-7 for |angle_rad| <= 2 pi,
// growing with the spacing of floats beyond.
SinCos sin_cos(float angle_rad);
inline float sin_of(float angle_rad) { return sin_cos(angle_rad).sin; }
inline float cos_of(float angle_rad) { return sin_cos(angle_rad).cos; }

// Angle of the vector (x, y) in (-pi, pi]; 0 for the zero vector. Absolute error below 1e-6.
float atan2_of(float y, float x);

// Inverse cosine and sine; the argument is clamped to [-1, 1]. Absolute error below 1e-6.
float acos_of(float x);
float asin_of(float x);

// e to the x; x is clamped to [-80, 80]. Relative error below 1e-6.
float exp_of(float x);

}  // namespace caryatid
