#pragma once
// Chooses the encoder's settings for a clip that is known as a whole: what to send, the ranges, and
// the coarsest or finest steps that a rate allows.
#include <span>

#include "core/face/fit.h"
#include "core/stream/fba_encoder.h"

namespace caryatid::stream {

// A clip in memory. Frames of face and body belong together by index; either may be empty.
struct FbaClip {
  std::span<const face::FapFrame> face;
  std::span<const body::BapFrame> body;
  std::size_t intra_every = 0;  // Frames from one intra plane to the next; 0: the first only.
  // By which the player restores what is left out.
  std::span<const face::FitRule> fit = face::default_fit();
  std::size_t size() const { return face.size() > body.size() ? face.size() : body.size(); }
};

// How far one unit of a FAP moves its feature point on an adult face, mm. Distances of adult means
// (mouth-nose 20, mouth 50, eyes-nose 49, eyes 62, iris 11.7 mm); turns act on a lever: the eye's
// 12 mm, the tongue's 10 mm, the 120 mm from the neck's joint to the middle of the face.
float fap_unit_mm(int fap);

// Every parameter that some frame of the clip flags.
void set_masks(const FbaClip& clip, FbaSettings* io_settings);

// Takes FAPs out of the mask that the player restores by itself (clip.fit) to
// within `tolerance_mm` in every frame, or that stay at 0 and would not be filled; marks their
// groups for interpolation. Right sides and outer lips go first. O(66 x frames).
void leave_out_restorable(const FbaClip& clip, float tolerance_mm, FbaSettings* io_settings);

// The smallest ranges that hold every level of the clip under the present masks and quantisers.
void set_ranges(const FbaClip& clip, FbaSettings* io_settings);

// Bits of the clip, start and end codes included; the same as encoding it. out_of_capacity: nodes.
Result<std::size_t> measure_bits(const FbaClip& clip, const FbaSettings& settings,
                                 std::span<ModelNode> nodes);

struct RatePlan {
  double kbit_per_s = 0.0;
  float step_mm = 0.0f;  // Every FAP moves its point in steps of about this.
};

// Face only: sets masks, quantiser, coarseness and ranges for the finest steps that fit into
// `kbit_per_s` on average. All FAPs get about the same step in millimetres, since nobody sees more
// in one than in another. out_of_capacity when even steps of 8 mm do not fit (settings are those),
// or nodes are too few. O(frames x parameters), some ten thousand frames a second.
Status plan_rate(const FbaClip& clip, double kbit_per_s, std::span<ModelNode> nodes,
                 FbaSettings* io_settings, RatePlan* out_plan);

}  // namespace caryatid::stream
