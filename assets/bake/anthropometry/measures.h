#pragma once
// The five kinds of measurement of anthropometry, taken on a head, with norms of adults beside
// them.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/bake/anthropometry/landmarks.h"

namespace caryatid::bake::anthropometry {

enum class Kind {
  straight,     // Shortest distance between two landmarks, mm.
  axial,        // Distance along one axis of the head in the Frankfurt position, mm.
  tangential,   // Along the skin over all landmarks in turn, mm.
  inclination,  // Of the line from the first to the second landmark to the vertical in the
                // Frankfurt position, seen from the side; positive: the second lies before the
                // first. Degrees.
  angle         // At the middle one of three landmarks, degrees.
};
const char* name_of(Kind kind);

struct Norm {
  float mean = 0, deviation = 0;  // deviation 0: not known.
};
struct Measurement {
  std::string name;
  Kind kind = Kind::straight;
  float value = 0;                 // mm or degrees.
  std::optional<Norm> men, women;  // Of the same unit.
  const char* source = "";         // Of the norms.
};

// Everything in the table whose landmarks the head has; paired measurements are the mean of both
// sides. O(seconds / 10), for the ways along the skin.
std::vector<Measurement> measure(const MeasuredHead& head);

// Values of single measurements, for tests and tools. Degrees and metres.
float inclination_degrees(Vec3 from_m, Vec3 to_m);
float angle_degrees(Vec3 a_m, Vec3 vertex_m, Vec3 b_m);

std::string as_table(std::span<const Measurement> measurements);
// Measurements and landmarks, in metres and degrees.
std::string as_json(const MeasuredHead& head, std::span<const Measurement> measurements);

}  // namespace caryatid::bake::anthropometry
