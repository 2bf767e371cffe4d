#pragma once
// Encoder parameter files (.epf) of the visage encoder: a plane-by-plane script for encoding text.
//
//   FBM m            objects of the next plane (1 face, 2 body, 3 both, 0 none); starts a block
//   ISI 0|1          intra
//   FFR n / BFR n    number of the FAP / BAP frame to take: the first with an index of at least n
//   FRR BRR          rate, sixteenths, 1000/1001 flag
//   TC BTC           hours minutes marker seconds
//   SKN BSK n        frames to skip after the plane
//   FMT / BMT        10 / 24 group types, each 1 (or 2 for FAPs) with the group's mask bits
//   FQU BQU n        quantisers
//   FIX FIN FPX FPN  66 ranges of FAPs 3..68 (intra max, min, inter max, min); BIX ... 296 of BAPs
// One block is one plane; what a block does not say stays, but for time code, skip and the sending
// of ranges. `#` starts a comment.
#include <string>
#include <vector>

#include "assets/bake/stream/clip_files.h"

namespace caryatid::bake {

struct EpfPlane {
  int line = 0;
  bool face = false, body = false, intra = false;
  int face_frame = 0, body_frame = 0;
  bool has_time_code = false;
  stream::FbaTimeCode time_code;
  std::uint32_t skip = 0;
  bool has_rate = false;
  stream::FbaSettings settings;  // In force for this plane.
};

// Throws std::runtime_error "FILE:LINE: what is wrong; cure".
std::vector<EpfPlane> read_epf(const std::string& path);
std::vector<EpfPlane> parse_epf(const std::string& text, const std::string& name);

// The clip's frames as the file says; its frame numbers count the clip's frames from 0. Masks,
// quantisers and ranges that change in a plane that is not intra are refused: a stream cannot say
// them there.
std::vector<std::byte> encode_by_epf(const AnimationClip& clip, const std::vector<EpfPlane>& planes,
                                     const std::string& name);

}  // namespace caryatid::bake
