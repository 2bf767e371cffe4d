#pragma once
// How a foot rolls over the floor without slipping: heel edge, flat sole, ball with flat toes, toe
// edge. Everything lies in the sagittal plane of the foot, (z forward, y up), metres, measured from
// the point of the floor beneath the ankle while the foot stands flat.
#include "core/body/hanim.h"

namespace caryatid::body {

struct FootShape {
  Vec2 ankle{0};               // (0, height of the ankle).
  Vec2 metatarsal{0};          // Joint about which the toes bend.
  Vec2 heel_back{0}, heel{0};  // As Sole.
  Vec2 ball{0};
  Vec2 toe{0}, toe_tip{0};
};
FootShape foot_shape(const Skeleton& skeleton, bool left);

struct FootRoll {
  Vec2 ankle{0};                   // Where the ankle is.
  float toe_extension_rad = 0.0f;  // Toes bent upwards against the foot.
};
// The foot on the floor with the given pitch (toe up positive). Toe up, it stands on the heel edge;
// toe down, on its toes, which stay flat until they are bent by about `toe_bend_rad` and then roll
// over their front edge.
FootRoll roll_foot(const FootShape& shape, float pitch_rad, float toe_bend_rad);

// Lowest point of a foot whose ankle is at `ankle`, anywhere in the air.
float lowest_point(const FootShape& shape, Vec2 ankle, float pitch_rad, float toe_extension_rad);

}  // namespace caryatid::body
