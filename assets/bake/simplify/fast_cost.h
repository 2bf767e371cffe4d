#pragma once
// The cost of many edges at once, in float, for the order of the queue. Where a collapse really
// happens its position is computed by placement.h in double.
//
// Every vertex keeps N = sum n and A = sum w n n^T over its triangles (n = twice the area vector, w
// a weight of its length). A triangle's plane passes through its own vertices, so in a frame at the
// vertex its offset is 0: 9 numbers are the whole quadric, nothing cancels, and an edge is the sum
// of its ends less the two triangles that they share. So an edge costs O(1) in place of O(valence).
#include <array>
#include <bit>
#include <cstdint>

namespace caryatid::bake {

// The weight of a triangle's squared volume: about |n|^-1/8, from its n.n. With weight 1 a vertex
// is placed by the few large triangles around it alone; towards |n|^-1 (squared distance by area)
// the largest errors fall but the mean grows. From the exponent bits: good to 7 %, and the same
// bits on every machine; a weight need not be exact, only the same whenever the triangle is.
inline float area_weight(float n2) {
  return std::bit_cast<float>(0x3F800000u + 0x03F80000u - (std::bit_cast<std::uint32_t>(n2) >> 4));
}
// What one triangle adds to the quadric of each of its corners.
struct TriangleTerm {
  std::array<float, 9> v;  // n, then w n n^T: xx xy xz yy yz zz.

  TriangleTerm(float x, float y, float z) {
    const float w = area_weight(x * x + y * y + z * z);
    const float wx = w * x, wy = w * y, wz = w * z;
    v = {x, y, z, wx * x, wx * y, wx * z, wy * y, wy * z, wz * z};
  }
};

struct VertexQuadric {
  std::array<float, 9> v{};

  void add(const TriangleTerm& t) {
    for (std::size_t i = 0; i < 9; ++i) v[i] += t.v[i];
  }
  void remove(const TriangleTerm& t) {
    for (std::size_t i = 0; i < 9; ++i) v[i] -= t.v[i];
  }
};

// What makes short edges go first on the flat, in parts of the trace: float holds 6e-8.
inline constexpr float kFlatFirst = 1e-7f;

// Four edges side by side. Lengths should be about 1: powers up to the sixth must fit a float.
struct EdgeBatch {
  static constexpr std::uint32_t kWidth = 4;
  using Lanes = float[kWidth];

  alignas(16) Lanes half[3];            // Half of the edge vector, first end to second.
  alignas(16) Lanes q0[9], q1[9];       // Quadrics of the ends.
  alignas(16) Lanes left[3], right[3];  // n of the two triangles on the edge.
  alignas(16) Lanes cost;

  void set_ends(std::uint32_t lane, const VertexQuadric& first, const VertexQuadric& second) {
    for (std::size_t i = 0; i < 9; ++i) q0[i][lane] = first.v[i];
    for (std::size_t i = 0; i < 9; ++i) q1[i][lane] = second.v[i];
  }
  // f_V at the position that placement.h would choose, but that the middle of the edge stands for
  // the centre of the ring. A term below the noise of float lets short edges go first on the flat.
  void evaluate();
};

}  // namespace caryatid::bake
