#pragma once
// Smooth functions on a skin: the biharmonic function that takes given values at some vertices and
// bends as little as possible between them (Botsch and Kobbelt 2004). It runs along the surface, so
// lips that touch but are not joined stay independent. Linear: a displacement field is three such
// functions.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "assets/bake/face/skin.h"

namespace caryatid::bake::fat {

class SmoothFields {
 public:
  // Vertices whose values are given; all others are solved for. Factorises once (about 50 ms for
  // 4000 free vertices). `stiffness` 2 is biharmonic, 1 harmonic (no overshoot, but a crease at
  // the given vertices). Throws std::runtime_error when a free part of the skin touches no given
  // vertex.
  SmoothFields(const Skin& skin, std::span<const std::uint32_t> given, int stiffness = 2);
  ~SmoothFields();
  SmoothFields(const SmoothFields&) = delete;
  SmoothFields& operator=(const SmoothFields&) = delete;

  // Values at `given`, in its order -> values at every vertex of the skin.
  std::vector<Vec3> solve(std::span<const Vec3> values) const;
  std::vector<float> solve(std::span<const float> values) const;

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace caryatid::bake::fat
