#include "core/face/visemes.h"

#include <algorithm>
#include <array>

#include "core/face/fap_fill.h"

namespace caryatid::face {
namespace {

// One row a viseme. The standard names visemes but gives no FAP values; these are set after
// phonetic descriptions (lips: openings of 0-13 mm, spread or rounded; tongue contacts) and by
// looking at the rendered faces. MNS: jaw, upper, lower, push, tongue_*; MW: stretch, thrust.
struct Shape {
  float jaw;            // FAP 3
  float upper;          // FAP 4, negative raises the upper lip
  float lower;          // FAP 5, negative lowers the lower lip
  float stretch;        // FAPs 6, 7
  float push_lower;     // FAP 16
  float push_upper;     // FAP 17
  float tip_up;         // FAP 44
  float tip_forward;    // FAP 45
  float body_up;        // FAP 46
  float corner = 0.0f;  // FAPs 12, 13: an open round mouth takes its corners down to mid-height.
};

constexpr std::array<Shape, kVisemeCount> kShapes = {{
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {40, 60, 60, 0, -40, -20, 0, 0, 0},                    // p b m: lips pressed.
    {90, -210, -60, 10, -220, 40, -60, -40, 0},            // f v: lower lip under the teeth.
    {260, -160, -400, 15, 0, 0, 60, 190, 0},               // T D: tongue between the teeth.
    {110, -70, -200, 20, 0, 0, 270, 20, 80},               // t d: tip behind the upper teeth.
    {230, -70, -260, 10, 0, 0, -60, -60, 260},             // k g: back of the tongue up.
    {130, -150, -240, -90, 260, 260, 120, 0, 120},         // tS dZ S: pushed forward, teeth close.
    {70, -170, -190, 60, 0, 0, 120, 20, 60},               // s z: teeth together, lips spread.
    {130, -70, -230, 20, 0, 0, 290, 20, 60},               // n l
    {170, -50, -220, -70, 140, 140, 160, -60, 100},        // r
    {640, -110, -570, 0, 0, 0, -60, -40, -80},             // A:
    {330, -150, -320, 60, 0, 0, 0, 0, 60},                 // e
    {190, -140, -220, 80, 0, 0, 0, 20, 120},               // I
    {560, -60, -480, -200, 300, 300, -60, -100, 0, -130},  // Q: round and open.
    {190, 30, -250, -220, 330, 330, -40, -60, 120, -60},   // U: round and narrow.
}};

}  // namespace

FapFrame viseme_frame(int viseme) {
  const Shape& shape =
      kShapes[viseme >= 0 && viseme < kVisemeCount ? static_cast<std::size_t>(viseme)
                                                   : std::size_t{0}];
  FapFrame frame;
  frame.set(3, shape.jaw);
  frame.set(4, shape.upper);
  frame.set(5, shape.lower);
  frame.set(6, shape.stretch);
  frame.set(12, shape.corner);
  frame.set(16, shape.push_lower);
  frame.set(17, shape.push_upper);
  frame.set(44, shape.tip_up);
  frame.set(45, shape.tip_forward);
  frame.set(46, shape.body_up);
  fill_from_partners(&frame);
  return frame;
}

FapFrame blend_visemes(const VisemeField& field) {
  if (field.first == 0 && field.second == 0) return {};
  const FapFrame first = viseme_frame(field.first);
  const FapFrame second = viseme_frame(field.second);
  const float w = std::min(1.0f, static_cast<float>(field.blend) / 63.0f);
  FapFrame out;
  for (int fap = 3; fap <= kFapCount; ++fap)
    if (first.has(fap)) out.set(fap, w * first.get(fap) + (1.0f - w) * second.get(fap));
  return out;
}

void expand_viseme(FapFrame& frame) {
  if (!frame.has(kFapViseme)) return;
  const FapFrame shape = blend_visemes(frame.viseme);
  for (int fap = 3; fap <= kFapCount; ++fap)
    if (shape.has(fap) && !frame.has(fap)) frame.set(fap, shape.get(fap));
  frame.mask.set(kFapViseme, false);
}

}  // namespace caryatid::face
