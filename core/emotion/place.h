#pragma once
// Where feelings lie on the plane of activation (asleep -1 .. excited 1) and evaluation (bad -1 ..
// good 1), after Whissell's dictionary as the thesis scales its words. Body and voice are coloured
// by the place, not by the name of an emotion.
#include "core/emotion/emotion.h"

namespace caryatid::emotion {

struct Place {
  float activation = 0.0f, evaluation = 0.0f;
};

// The places of all emotions by their weights, summed and cut to -1..1. Calm is the origin.
Place place_of(const Weights& weights);

}  // namespace caryatid::emotion
