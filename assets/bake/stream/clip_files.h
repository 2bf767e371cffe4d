#pragma once
// Clips of face and body animation in memory, from and to the files that tools exchange.
#include <string>
#include <vector>

#include "core/stream/fba_decoder.h"
#include "core/stream/fba_plan.h"

namespace caryatid::bake {

// Frames in which every parameter that the clip has flagged so far is present: parameters that
// leave a mask keep their value, as the files mean it.
struct AnimationClip {
  std::vector<face::FapFrame> face;
  std::vector<body::BapFrame> body;
  double frames_per_second = 25.0;

  std::vector<face::FitRule> fit;  // Of the player; empty: face::default_fit().

  stream::FbaClip view(std::size_t intra_every) const {
    return {face, body, intra_every, face::fit_or_default(fit)};
  }
  std::size_t size() const { return std::max(face.size(), body.size()); }
};

// All of these throw std::runtime_error "FILE:LINE: what is wrong; cure" (no line for bytes).

// Reads .fap or .bap by its ending and adds it to the clip. A second text with another rate is
// resampled to the clip's, each frame holding until the next. out_notes gets a line "FILE:LINE:
// ..." for a header or numbers of frames that do not fit the frames, which count.
void read_text(const std::string& path, AnimationClip* io_clip,
               std::vector<std::string>* out_notes = nullptr);
void write_fap(const AnimationClip& clip, const std::string& path);
void write_bap(const AnimationClip& clip, const std::string& path);

// Each frame holds until the next.
void resample(double frames_per_second, AnimationClip* io_clip);

// What a decoder found in a stream beside the frames.
struct FbaReport {
  std::size_t bytes = 0, planes = 0, intra_planes = 0, damaged_planes = 0;
  double seconds = 0.0;
  stream::FbaRate rate;
  stream::FbaCoding coding;
  std::vector<std::string> faults;
};
AnimationClip read_fba(const std::string& path, const stream::FbaDecoder::Options& options,
                       FbaReport* out_report);

// The clip as a stream.
std::vector<std::byte> encode_fba(const AnimationClip& clip, std::size_t intra_every,
                                  const stream::FbaSettings& settings);

// The rate fields for a number of frames per second: sixteenths, or 1000/1001 where that is nearer.
stream::FbaRate rate_of(double frames_per_second);

// How far a decoded clip is from its original at the feature points, estimated on an adult face
// (stream::fap_unit_mm): for each point of a frame, the displacements that its FAPs lack, and the
// head's turn. Partners are filled in both clips.
struct PointError {
  double mean_mm = 0.0, p99_mm = 0.0, largest_mm = 0.0;
};
PointError summary_of(std::vector<double> errors_mm);
PointError point_error(const std::vector<face::FapFrame>& original,
                       const std::vector<face::FapFrame>& decoded);

}  // namespace caryatid::bake
