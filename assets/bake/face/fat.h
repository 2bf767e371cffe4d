#pragma once
// Builds the face animation tables of a character: for every FAP the piecewise-linear movement of
// every vertex that it takes along, on skin, brows, lashes and tongue. Eyeballs, jaw (lower teeth)
// and head are turned as joints instead (core/face/transforms.h).
#include "assets/bake/face/head.h"
#include "assets/bake/face/working_ranges.h"

namespace caryatid::bake {

// Fills Character::channels and Object::moves. Needs the head object's base vertices, the feature
// points, FAPU and joints. Every FAP 3..68 gets at least one channel each way it can go, so that
// limits can be read off the channels; their ends lie at kReach times the working range.
// Throws std::runtime_error (one line) when the character lacks what the tables need. 2-4 s.
void build_fat(Character& character, const BaseHuman& base, const fat::WorkingRanges& ranges);
// The same for a head that someone else has understood (assets/bake/head). Character's head object
// names the skin's vertices in Mesh::base_vertex.
void build_fat(Character& character, const fat::Head& head, const fat::WorkingRanges& ranges);

}  // namespace caryatid::bake
