#pragma once
// Joins what the agent feels, says and does with its face into the one frame that is shown:
// calm face + emotion, beneath speech, beneath a stream; idle life on top; then combinations that
// collide are resolved and every FAP is brought into what this face can do.
#include "core/face/fap.h"
#include "core/face/fat.h"

namespace caryatid::face {

// All frames are optional (nullptr: absent) and borrowed for the call. Every frame should have been
// through fill_from_partners(); FAPs 1 and 2 must have been expanded (visemes.h,
// core/emotion/profiles.h).
struct MixJob {
  const FapFrame* rest = nullptr;  // The calm face of the pack; the MPEG-4 neutral looks startled.
  const FapFrame* emotion = nullptr;  // Added to `rest`.
  // Visemes. `speech_strength` 0..1 fades them in and out; at 1 they own the vertical lip FAPs and
  // the jaw, emotion keeps 40 % of its other mouth FAPs (emotions.md 3.4) and all of the rest.
  const FapFrame* speech = nullptr;
  float speech_strength = 0.0f;
  // FAPs present here replace everything above: MPEG-4 streams are absolute.
  const FapFrame* stream = nullptr;
  // Added on top: gaze, head sway, breath. Its FAPs 19 and 20 are blinks: 0 leaves the lids, 1024
  // shuts the eye from wherever they are; 21 and 22 are not looked at.
  const FapFrame* idle = nullptr;
  const FapLimits* limits = nullptr;  // Required.

  // A frame with every FAP 3..68 present and finite, within the limits. Lids that no stream moves
  // follow the vertical gaze. O(68).
  FapFrame run() const;
};

// Moves inner lips that would pass through each other to where they meet, each by half of the
// overlap; the outer contour goes along. FAPs 4, 5, 8-11 and 51, 52, 55-58 change.
void seal_lips(FapFrame& frame);

// Flesh hangs together: a point of lips or brows that leaves its neighbours farther behind than
// skin stretches takes them along. Single points of a stream then bend the lip instead of tearing a
// notch into it; frames with all points given (or filled) pass unchanged. Lip FAPs and 31-36
// change.
void keep_flesh_whole(FapFrame& frame);

// Skin between lower lip and chin stretches only so far: a jaw that opens wider takes the lower lip
// along. FAPs 5, 10, 11, 52, 57, 58 change.
void part_lips(FapFrame& frame);

// Rounded lips hold their corners: orbicularis oris shut to an O leaves zygomaticus and depressor
// anguli less than half of their way. FAPs 12, 13, 59, 60 change.
void pucker_corners(FapFrame& frame);

// Lips are tucked in between the teeth, not through them: how far depends on the jaw's opening.
// FAPs 16, 17 change.
void keep_lips_before_teeth(FapFrame& frame);

// A tongue comes out only where teeth and lips leave room: the thrust of its tip ends there.
// FAP 45 changes.
void keep_tongue_in(FapFrame& frame);

// Lids that would pass through each other meet: the upper lid gives way. FAPs 19, 20 change.
void seal_lids(FapFrame& frame);

}  // namespace caryatid::face
