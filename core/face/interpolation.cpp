#include "core/face/interpolation.h"

#include <cstdint>

namespace caryatid::face {
namespace {

struct Rule {
  std::uint8_t target;
  std::uint8_t source;  // Must be present.
  float weight;
  std::uint8_t other;  // Taken as 0 when absent; 0: none.
  float other_weight;
};

// A parted lip is an arc: at half its width an ellipse keeps 0.87 of the height, a parabola 0.75;
// measured lips lie between.
constexpr float kQuarter = 0.8f;
constexpr float kCorner = 0.25f;

constexpr Rule kRules[] = {
    // The other side of the face.
    {6, 7, 1, 0, 0},
    {7, 6, 1, 0, 0},
    {8, 9, 1, 0, 0},
    {9, 8, 1, 0, 0},
    {10, 11, 1, 0, 0},
    {11, 10, 1, 0, 0},
    {12, 13, 1, 0, 0},
    {13, 12, 1, 0, 0},
    {19, 20, 1, 0, 0},
    {20, 19, 1, 0, 0},
    {21, 22, 1, 0, 0},
    {22, 21, 1, 0, 0},
    {23, 24, 1, 0, 0},
    {24, 23, 1, 0, 0},
    {25, 26, 1, 0, 0},
    {26, 25, 1, 0, 0},
    {27, 28, 1, 0, 0},
    {28, 27, 1, 0, 0},
    {29, 30, 1, 0, 0},
    {30, 29, 1, 0, 0},
    {31, 32, 1, 0, 0},
    {32, 31, 1, 0, 0},
    {33, 34, 1, 0, 0},
    {34, 33, 1, 0, 0},
    {35, 36, 1, 0, 0},
    {36, 35, 1, 0, 0},
    {37, 38, 1, 0, 0},
    {38, 37, 1, 0, 0},
    {39, 40, 1, 0, 0},
    {40, 39, 1, 0, 0},
    {41, 42, 1, 0, 0},
    {42, 41, 1, 0, 0},
    {53, 54, 1, 0, 0},
    {54, 53, 1, 0, 0},
    {55, 56, 1, 0, 0},
    {56, 55, 1, 0, 0},
    {57, 58, 1, 0, 0},
    {58, 57, 1, 0, 0},
    {59, 60, 1, 0, 0},
    {60, 59, 1, 0, 0},
    {61, 62, 1, 0, 0},
    {62, 61, 1, 0, 0},
    {65, 66, 1, 0, 0},
    {66, 65, 1, 0, 0},
    {67, 68, 1, 0, 0},
    {68, 67, 1, 0, 0},
    // Outer and inner contour of the lips.
    {51, 4, 1, 0, 0},
    {4, 51, 1, 0, 0},
    {52, 5, 1, 0, 0},
    {5, 52, 1, 0, 0},
    {53, 6, 1, 0, 0},
    {6, 53, 1, 0, 0},
    {54, 7, 1, 0, 0},
    {7, 54, 1, 0, 0},
    {55, 8, 1, 0, 0},
    {8, 55, 1, 0, 0},
    {56, 9, 1, 0, 0},
    {9, 56, 1, 0, 0},
    {57, 10, 1, 0, 0},
    {10, 57, 1, 0, 0},
    {58, 11, 1, 0, 0},
    {11, 58, 1, 0, 0},
    {59, 12, 1, 0, 0},
    {12, 59, 1, 0, 0},
    {60, 13, 1, 0, 0},
    {13, 60, 1, 0, 0},
    // Quarter points: upper lip FAPs are positive downwards, corners upwards.
    {8, 4, kQuarter, 12, -kCorner},
    {9, 4, kQuarter, 13, -kCorner},
    {10, 5, kQuarter, 12, kCorner},
    {11, 5, kQuarter, 13, kCorner},
    {55, 51, kQuarter, 59, -kCorner},
    {56, 51, kQuarter, 60, -kCorner},
    {57, 52, kQuarter, 59, kCorner},
    {58, 52, kQuarter, 60, kCorner},
    {4, 8, 1 / kQuarter, 12, kCorner / kQuarter},
    {5, 10, 1 / kQuarter, 12, -kCorner / kQuarter},
    {8, 12, -kCorner, 0, 0},
    {9, 13, -kCorner, 0, 0},
    {10, 12, kCorner, 0, 0},
    {11, 13, kCorner, 0, 0},
    // Brow middle from its ends, ends from the middle.
    {33, 31, 0.5f, 35, 0.5f},
    {34, 32, 0.5f, 36, 0.5f},
    {33, 35, 0.5f, 31, 0.5f},
    {34, 36, 0.5f, 32, 0.5f},
    // Of 39/40 (cheeks puffed) and 16/17 (lips pushed) nothing can be guessed.
};

bool apply(const Rule& rule, FapFrame& frame) {
  if (frame.has(rule.target) || !frame.has(rule.source)) return false;
  float value = rule.weight * frame.get(rule.source);
  if (rule.other != 0 && frame.has(rule.other)) value += rule.other_weight * frame.get(rule.other);
  frame.set(rule.target, value);
  return true;
}

}  // namespace

void fill_missing(FapFrame& frame) {
  // Every pass fills at least one FAP or is the last; in practice three passes reach everything.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Rule& rule : kRules) changed |= apply(rule, frame);
  }
}

}  // namespace caryatid::face
