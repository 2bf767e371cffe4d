#pragma once
// The looks of a foreign head, which comes without any: a skin texture drawn from its feature
// points (lips, brows, lid rims, hair line), eyes, teeth, tongue.
#include "assets/bake/head/openings.h"

namespace caryatid::bake::foreign {

// Where a skin vertex takes its colour from. Face: the direction from the middle of the head, laid
// out around the front, with its only seam at the back of the skull. Mouth and sockets have corners
// of the texture of their own.
Vec2 skin_uv(const PlacedHead& head, Zone zone, Vec3 position_m);

// Gives the skin its mesh: uv laid out, vertices doubled where zones meet and at the pole behind.
// Mesh::base_vertex is the skin's vertex.
Mesh skin_mesh(const PlacedHead& head, const Openings& openings, std::span<const Vec3> normal);

Image paint_skin(const PlacedHead& head, const Openings& openings, const Mesh& mesh);
// For ball_mesh() and eyeball_uv(); the pupil is a third of the iris.
Image paint_eye(float iris_diameter_m, float ball_radius_m);
Image paint_teeth();
Image plain_image(const char* name, Vec3 srgb);

}  // namespace caryatid::bake::foreign
