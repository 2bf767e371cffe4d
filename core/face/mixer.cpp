#include "core/face/mixer.h"

#include <algorithm>
#include <cassert>

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

// Blinks close the lid from wherever it is, so that a wide-eyed face shuts its eyes too.
void add_blink(const FapFrame& idle, FapFrame& frame) {
  for (int side = 0; side < 2; ++side) {
    const float upper = std::clamp(value_in(&idle, 19 + side) / kClosed, 0.0f, 1.0f);
    const float lower = std::clamp(value_in(&idle, 21 + side) / kClosed, 0.0f, 1.0f);
    const float low = frame.get(21 + side);
    const float raised = low + lower * (kClosed - low);
    const float top = frame.get(19 + side);
    frame.set(21 + side, raised);
    frame.set(19 + side, top + upper * (kClosed - raised - top));
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

}  // namespace

void seal_lips(FapFrame& frame) {
  seal_pair(frame, 4, 5, 51, 52);
  seal_pair(frame, 8, 10, 55, 57);
  seal_pair(frame, 9, 11, 56, 58);
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
  seal_lips(out);
  seal_lids(out);
  return out;
}

}  // namespace caryatid::face
