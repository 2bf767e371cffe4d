#pragma once
// How long a visitor looks at nothing, measured from the start of the process (not of main(): the
// loading of libraries counts) to the flip of the first pictures.
#include <cstdint>

namespace caryatid::app {

// Seconds since the kernel made this process, rounded up to its clock tick (10 ms); 0 where /proc
// is not there.
double process_age_s();

// Negative: not shown yet.
struct StartTimes {
  double picture_s = -1.0;  // The built-in picture; stays negative where there is no screen.
  double person_s = -1.0;   // The first frame of the pack.
};

}  // namespace caryatid::app
