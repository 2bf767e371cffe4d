#include "core/face/mixer.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace caryatid::face {
namespace {

constexpr float kClosed = 1024.0f;  // FAP 19 + FAP 21 of shut lids: the opening is IRISD0 at rest.
constexpr float kEmotionWhileSpeaking = 0.4f;  // emotions.md 3.4.
constexpr float kAngleUnit_rad = 1e-5f;
// Lids ride on the bulge of the cornea. Becker and Fuchs 1988: the upper lid turns with the eye
// almost degree for degree, the lower by about half. An eyeball's radius is 1.03 iris diameters.
constexpr float kUpperLidPerRad = 0.75f * 1.03f * kClosed;
constexpr float kLowerLidPerRad = 0.4f * 1.03f * kClosed;

bool is_mouth(int fap) { return (fap >= 3 && fap <= 18) || (fap >= 51 && fap <= 60); }
bool is_tongue(int fap) { return fap >= 43 && fap <= 47; }
bool is_lid(int fap) { return fap >= 19 && fap <= 22; }

// FAPs in which a viseme shows: contacts of lips and teeth, jaw, tongue.
bool is_articulator(int fap) {
  const bool corner = fap == 6 || fap == 7 || fap == 12 || fap == 13 || fap == 53 || fap == 54 ||
                      fap == 59 || fap == 60 || fap == 18;
  return (is_mouth(fap) && !corner) || is_tongue(fap);
}

float value_in(const FapFrame* frame, int fap) {
  return frame != nullptr && frame->has(fap) ? frame->get(fap) : 0.0f;
}

float mix_one(const MixJob& job, int fap) {
  if (job.stream != nullptr && job.stream->has(fap)) return job.stream->get(fap);
  const float feeling = value_in(job.emotion, fap);
  const float calm = value_in(job.rest, fap) + feeling;
  if (!is_mouth(fap) && !is_tongue(fap)) return calm + value_in(job.speech, fap);
  if (job.speech == nullptr) return calm;
  const float s = std::clamp(job.speech_strength, 0.0f, 1.0f);
  const float spoken = value_in(job.speech, fap);
  if (is_articulator(fap)) return calm + s * (spoken - calm);
  return calm + s * (spoken - (1.0f - kEmotionWhileSpeaking) * feeling);
}

void add_idle(const FapFrame& idle, FapFrame& frame) {
  for (int fap = 3; fap <= kFapCount; ++fap)
    if (idle.has(fap) && !is_lid(fap)) frame.set(fap, frame.get(fap) + idle.get(fap));
}

// Blinks close the lid from wherever it is, so that a wide-eyed face shuts its eyes too. The upper
// lid comes down; the lower one shifts by a small part of the opening (Evinger 1991).
void add_blink(const FapFrame& idle, FapFrame& frame) {
  constexpr float kLowerShare = 0.08f;
  for (int side = 0; side < 2; ++side) {
    const float closure = std::clamp(value_in(&idle, 19 + side) / kClosed, 0.0f, 1.0f);
    const float top = frame.get(19 + side), low = frame.get(21 + side);
    const float raised = low + closure * kLowerShare * std::max(kClosed - top - low, 0.0f);
    frame.set(21 + side, raised);
    frame.set(19 + side, top + closure * (kClosed - raised - top));
  }
}

void lids_follow_gaze(const FapFrame* stream, FapFrame& frame) {
  for (int side = 0; side < 2; ++side) {
    const float down_rad = frame.get(25 + side) * kAngleUnit_rad;
    const bool upper_given = stream != nullptr && stream->has(19 + side);
    const bool lower_given = stream != nullptr && stream->has(21 + side);
    // A lid that is nearly shut has little left to follow with.
    const float open =
        std::clamp(1.0f - (frame.get(19 + side) + frame.get(21 + side)) / kClosed, 0.0f, 1.0f);
    if (!upper_given)
      frame.set(19 + side, frame.get(19 + side) + open * kUpperLidPerRad * down_rad);
    if (!lower_given)
      frame.set(21 + side, frame.get(21 + side) - open * kLowerLidPerRad * down_rad);
  }
}

void seal_pair(FapFrame& frame, int upper, int lower, int upper_outer, int lower_outer) {
  const float overlap = frame.get(upper) + frame.get(lower);
  if (!(overlap > 0.0f)) return;
  const float half = 0.5f * overlap;
  frame.set(upper, frame.get(upper) - half);
  frame.set(lower, frame.get(lower) - half);
  // Lips that press keep part of the push in the red, which gets narrower.
  constexpr float kPress = 0.5f;
  frame.set(upper_outer, frame.get(upper_outer) - half * kPress);
  frame.set(lower_outer, frame.get(lower_outer) - half * kPress);
}

// Two FAPs of neighbouring points and how far apart they may be, in their common unit; sign -1
// where they count in opposite directions (upper lip down, corner up).
struct Tie {
  std::uint8_t a, b;
  float sign;
  float slack;
};
// Slack of 180 MNS is 3 mm: a fifth of how far a lower lip opens. Set by looking for notches and
// folds.
constexpr Tie kTies[] = {
    // Along the inner contour, from it to the outer one, along that; then the brows.
    {5, 10, 1, 180},   {5, 11, 1, 180},  {10, 12, 1, 560}, {11, 13, 1, 560}, {4, 8, 1, 150},
    {4, 9, 1, 150},    {8, 12, -1, 350}, {9, 13, -1, 350}, {5, 52, 1, 80},   {10, 57, 1, 80},
    {11, 58, 1, 80},   {4, 51, 1, 130},  {8, 55, 1, 130},  {9, 56, 1, 130},  {12, 59, 1, 150},
    {13, 60, 1, 150},  {6, 53, 1, 60},   {7, 54, 1, 60},   {52, 57, 1, 180}, {52, 58, 1, 180},
    {57, 59, 1, 560},  {58, 60, 1, 560}, {51, 55, 1, 150}, {51, 56, 1, 150}, {55, 59, -1, 350},
    {56, 60, -1, 350}, {31, 33, 1, 170}, {32, 34, 1, 170}, {33, 35, 1, 140}, {34, 36, 1, 140},
};

void pull(const Tie& tie, FapFrame& frame) {
  const float a = frame.get(tie.a), b = tie.sign * frame.get(tie.b);
  const float apart = a - b;
  const float excess =
      apart > 0.0f ? std::max(apart - tie.slack, 0.0f) : std::min(apart + tie.slack, 0.0f);
  if (excess == 0.0f) return;
  // What has moved less is taken along by what has moved more.
  if (a * a >= b * b)
    frame.set(tie.b, tie.sign * (b + excess));
  else
    frame.set(tie.a, a - excess);
}

// A brow bends down in its middle by no more than this below its ends' mean (ENS; the deepest of
// the six emotions, anger, takes 105 of it): beyond, middle and ends meet half-way.
void keep_brow_arched(int inner, int middle, int outer, FapFrame& frame) {
  constexpr float kSag = 110.0f;
  const float sag = 0.5f * (frame.get(inner) + frame.get(outer)) - frame.get(middle);
  const float half = 0.5f * std::max(sag - kSag, 0.0f);
  if (half == 0.0f) return;
  for (const int end : {inner, outer}) frame.set(end, frame.get(end) - half);
  frame.set(middle, frame.get(middle) + half);
}

}  // namespace

void seal_lips(FapFrame& frame) {
  seal_pair(frame, 4, 5, 51, 52);
  seal_pair(frame, 8, 10, 55, 57);
  seal_pair(frame, 9, 11, 56, 58);
}

void keep_flesh_whole(FapFrame& frame) {
  for (int side = 0; side < 2; ++side) keep_brow_arched(31 + side, 33 + side, 35 + side, frame);
  // Twice: what an outer contour pulls along must reach the far end of the inner one.
  for (int pass = 0; pass < 2; ++pass)
    for (const Tie& tie : kTies) pull(tie, frame);
}

void part_lips(FapFrame& frame) {
  constexpr float kStretch = 600.0f;  // MNS; 10 mm.
  const float lowest = kStretch - std::max(frame.get(3), kStretch);
  for (const int fap : {5, 10, 11, 52, 57, 58}) frame.set(fap, std::min(frame.get(fap), lowest));
}

void pucker_corners(FapFrame& frame) {
  constexpr float kPuckered = -220.0f, kHeld = 0.6f, kRaised = 380.0f, kLowered = -300.0f;
  for (int side = 0; side < 2; ++side)
    for (const auto& [stretch, raise] : {std::pair{6, 12}, {53, 59}}) {
      const float free = 1.0f - kHeld * ramp(frame.get(stretch + side), 0.0f, kPuckered);
      frame.set(raise + side,
                std::clamp(frame.get(raise + side), free * kLowered, free * kRaised * kReach));
    }
}

void keep_lips_before_teeth(FapFrame& frame) {
  // MNS. Two millimetres are what lips give, pressed against teeth; the rest of a tuck goes in
  // between the edges, which asks for an open jaw.
  constexpr float kGive = 120.0f, kTuckPerOpening = 1.2f;
  const float least = -kGive - kTuckPerOpening * std::max(frame.get(3), 0.0f);
  for (const int fap : {16, 17}) frame.set(fap, std::max(frame.get(fap), least));
}

void keep_tongue_in(FapFrame& frame) {
  // FAP 45 counts in MW, openings in MNS: three times as short. The tip rests at the teeth; it is
  // flat enough to come out by twice the opening.
  constexpr float kBehindTeeth = 15.0f, kOutPerOpening = 0.7f;
  const float lips = -frame.get(4) - frame.get(5);
  const float open = std::max(std::min(frame.get(3), lips), 0.0f);
  frame.set(45, std::min(frame.get(45), kBehindTeeth + kOutPerOpening * open));
}

void seal_lids(FapFrame& frame) {
  for (int side = 0; side < 2; ++side) {
    const float overlap = frame.get(19 + side) + frame.get(21 + side) - kClosed;
    if (overlap > 0.0f) frame.set(19 + side, frame.get(19 + side) - overlap);
  }
}

FapFrame MixJob::run() const {
  assert(limits != nullptr);
  FapFrame out;
  for (int fap = 3; fap <= kFapCount; ++fap) out.set(fap, mix_one(*this, fap));
  if (idle != nullptr) add_idle(*idle, out);
  lids_follow_gaze(stream, out);
  if (idle != nullptr) add_blink(*idle, out);
  for (int fap = 3; fap <= kFapCount; ++fap) {
    const auto i = static_cast<std::size_t>(fap);
    out.set(fap, soften(out.get(fap), limits->low[i], limits->high[i]));
  }
  part_lips(out);
  pucker_corners(out);
  keep_flesh_whole(out);
  seal_lips(out);
  keep_lips_before_teeth(out);
  keep_tongue_in(out);
  seal_lids(out);
  for (int fap = 3; fap <= kFapCount; ++fap) {
    const auto i = static_cast<std::size_t>(fap);
    out.value[i] = std::clamp(out.value[i], limits->low[i], limits->high[i]);
  }
  return out;
}

}  // namespace caryatid::face
