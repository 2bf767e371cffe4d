#pragma once
// The plane x = 0 as a mirror, and what of a person is looked at.
#include <cstdint>
#include <span>
#include <vector>

#include "assets/bake/model.h"
#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake {

inline Vec3d mirrored(const Vec3d& p) { return {-p.x, p.y, p.z}; }

// The point that lies where the mirror shows each one, within `tolerance`; itself where it is that
// near to the plane; kNone where there is none, or where less than three quarters have one: then
// the whole is not symmetric. O(n log n) on usual meshes.
std::vector<std::uint32_t> mirror_points(std::span<const Vec3d> points, double tolerance);

// What each vertex counts for somebody who stands before the figure (+z): 1 for what faces him and
// for the silhouette, falling to `behind` for what faces away.
std::vector<float> importance_from_front(const Mesh& mesh, float behind = 0.25f);

// The same for the skin of a head among its parts: skin that brows and lashes lie on counts twice,
// or they would sink into what is left of it.
std::vector<float> importance_of_head(const Character& character, std::uint32_t head);

}  // namespace caryatid::bake
