#pragma once
// Parts that a foreign head lacks and a talking face needs: eyeballs, teeth, tongue. Plain shapes,
// placed by the feature points.
#include "assets/bake/head/openings.h"

namespace caryatid::bake::foreign {

// A ball seen from outside; uv: the iris' middle is at 0.5, 0.5, and the distance from it in uv is
// half of the angle from +Z over 90 degrees.
Mesh ball_mesh(Vec3 center_m, float radius_m);
// The same uv for any eyeball of the OBJ.
Vec2 eyeball_uv(Vec3 position_m, Vec3 center_m);

// The front of an eyeball of few triangles gets more, on the same facets: the pupil has to grow
// between them. Up to `radius_m` from the line of sight no edge stays longer than a millimetre.
LoosePart finer_iris(LoosePart ball, Vec3 center_m, float radius_m);

// Rows of teeth along the lips' arch; they touch at the line of the lips. uv: u along the arch, v
// 0 at the gum, 1 at the edge.
Mesh teeth_mesh(const PlacedHead& head, bool upper);
// Lies flat behind the lower teeth, its tip at them.
Mesh tongue_mesh(const PlacedHead& head);

}  // namespace caryatid::bake::foreign
