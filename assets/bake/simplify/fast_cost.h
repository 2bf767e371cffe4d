#pragma once
// The cost of many edges at once, in float, for the order of the queue. Where a collapse really
// happens its position is computed by placement.h in double.
//
// Every vertex keeps N = sum n and A = sum n n^T over its triangles (n = twice the area vector). A
// triangle's plane passes through its own vertices, so in a frame at the vertex its offset is 0:
// 9 numbers are the whole quadric, nothing cancels, and an edge is the sum of its ends less the two
// triangles that they share. So an edge costs O(1) instead of O(valence).
#include <array>
#include <cstdint>

namespace caryatid::bake {

struct VertexQuadric {
  std::array<float, 3> n{};
  std::array<float, 6> a{};  // xx xy xz yy yz zz

  void add(float x, float y, float z, float sign) {
    n[0] += sign * x;
    n[1] += sign * y;
    n[2] += sign * z;
    a[0] += sign * (x * x);
    a[1] += sign * (x * y);
    a[2] += sign * (x * z);
    a[3] += sign * (y * y);
    a[4] += sign * (y * z);
    a[5] += sign * (z * z);
  }
};

// Four edges side by side. Lengths should be about 1: powers up to the sixth must fit a float.
struct EdgeBatch {
  static constexpr std::uint32_t kWidth = 4;
  using Lanes = float[kWidth];

  alignas(16) Lanes half[3];       // Half of the edge vector, first end to second.
  alignas(16) Lanes a0[6], a1[6];  // Quadrics of the ends.
  alignas(16) Lanes n0[3], n1[3];
  alignas(16) Lanes left[3], right[3];  // n of the two triangles on the edge.
  alignas(16) Lanes cost;

  void set_ends(std::uint32_t lane, const VertexQuadric& q0, const VertexQuadric& q1) {
    for (int i = 0; i < 6; ++i) a0[i][lane] = q0.a[static_cast<std::size_t>(i)];
    for (int i = 0; i < 6; ++i) a1[i][lane] = q1.a[static_cast<std::size_t>(i)];
    for (int i = 0; i < 3; ++i) n0[i][lane] = q0.n[static_cast<std::size_t>(i)];
    for (int i = 0; i < 3; ++i) n1[i][lane] = q1.n[static_cast<std::size_t>(i)];
  }
  // f_V at the position that placement.h would choose, but that the middle of the edge stands for
  // the centre of the ring. A term below the noise of float lets short edges go first on the flat.
  void evaluate();
};

}  // namespace caryatid::bake
