#pragma once
// Eyes and tongue of the MPEG-4 neutral face (ISO/IEC 14496-2 annex C; thesis 7.1): gaze along +Z,
// pupil a third of the iris, tongue flat, its tip where upper and lower teeth meet. Measured on the
// finished objects as they are drawn, textures included.
#include "assets/bake/model.h"

namespace caryatid::bake {

// An eye as seen from the front.
struct IrisMeasure {
  Vec3 pupil_m{0};  // Middle of the pupil on the surface, from the eyeball's centre.
  float pupil_diameter_m = 0, iris_diameter_m = 0;
};
// Left (0) or right (1) eye. Throws std::runtime_error when there is no dark pupil in a lighter
// iris in a light white.
IrisMeasure measure_iris(const Character& character, int side);

struct TongueMeasure {
  float tip_to_teeth_m = 0;  // From the tip to the nearest tooth.
  float above_bite_m = 0;    // Of the tip, over the line where the rows of teeth meet.
  float incline_rad = 0;     // Of the line from its broadest place to the tip, + tip up.
  float roll_rad = 0;        // Left border over right border.
};
// Needs objects "tongue", "upper_teeth" and "lower_teeth".
TongueMeasure measure_tongue(const Character& character);

// Turns both eyes, corneas included, so that they look straight ahead.
void settle_gaze(Character& character);
// Brings the tip of the tongue to where the teeth meet; its root stays.
void settle_tongue(Character& character);

}  // namespace caryatid::bake
