#pragma once
// Encodes FBA elementary streams in predictive mode, face and body, plane by plane.
#include <array>
#include <span>

#include "core/body/bap.h"
#include "core/face/fap.h"
#include "core/stream/fba.h"

namespace caryatid::stream {

// Ranges as they travel: 0..31 in units of 60 base steps, by slot; those of the seven fields of
// FAPs 1 and 2 are fixed by the syntax and ignored here. Levels beyond a range are clamped, and the
// next planes make up for it. Small ranges code better: a model starts with all its symbols alike.
struct RangeCodes {
  std::uint8_t intra_high = kMaxRangeCode;
  std::uint8_t intra_low = kMaxRangeCode;
  std::uint8_t inter_high = kMaxRangeCode;
  std::uint8_t inter_low = kMaxRangeCode;
};

struct FbaSettings {
  FbaRate rate{25, 0, false};
  std::uint8_t fap_quant = 1;        // 0..31; a step is the FAP's base step times this.
  std::uint8_t bap_quant_index = 1;  // 0..31, see bap_scale().
  body::BapQuantisers quantisers = body::BapQuantisers::visage;
  BitSet<face::kFapCount + 1> fap_mask;          // What the stream carries; the rest of a frame
  BitSet<body::kBapCountExtended + 1> bap_mask;  // is not coded.
  // What decoders do with the FAPs that are not carried, by group: hold or interpolate.
  std::array<FapMaskType, face::kFapGroupCount + 1> unlisted{};
  std::array<RangeCodes, kFbaSlots> range{};
  // Every intra plane brings the ranges, so that a stream can be joined anywhere; else the first
  // one only, which saves some hundred bits each time.
  bool repeat_ranges = true;
  // A start code before every intra plane but the first: where decoders find their way back after
  // damage. 40 bits each.
  bool plane_start_codes = true;
  // Differences up to this part of a step are left to a later plane; 0.5 is plain rounding. More
  // keeps slow parameters from flickering between two levels and saves bits.
  float dead_zone = 0.5f;
  // Slots that need less than the common quantiser gives use every n-th level only; the model soon
  // knows. 0 and 1: all levels.
  std::array<std::uint8_t, kFbaSlots> coarseness{};
  bool suggested_gender = false;  // True: female.
};

// The level for a difference of an inter plane (or the value of an intra plane, with dead_zone
// 0.5).
std::int32_t choose_level(const FbaSettings& settings, std::size_t slot, std::int32_t difference,
                          int step, float dead_zone);

// The levels that the settings let a slot take, with the fixed ranges of the fields from `coding`.
LevelRange levels_of(const FbaSettings& settings, const FbaCoding& coding, std::size_t slot);

struct FbaPlaneInput {
  const face::FapFrame* face =
      nullptr;  // Null: the plane has no face. Absent FAPs of the mask keep
  const body::BapFrame* body = nullptr;  // the value of the plane before. The same for bodies.
  bool intra = false;
  std::uint32_t skip = 0;  // Frames without a plane after this one.
  bool has_time_code = false;
  FbaTimeCode time_code;
};

// Writes one object: begin(), encode() for every plane, finish(). Planes are not byte-aligned; the
// caller keeps one BitWriter for all of them and may take whole bytes from it at any time.
// Memory: the object (about 12 KB) and the caller's nodes, as FbaDecoder. No global state.
class FbaEncoder {
 public:
  // Borrows `nodes`; copies the settings.
  FbaEncoder(const FbaSettings& settings, std::span<ModelNode> nodes);
  FbaEncoder(const FbaEncoder&) = delete;
  FbaEncoder& operator=(const FbaEncoder&) = delete;

  // Writes the start code. invalid_argument: bad_settings.
  Status begin(BitWriter* out) const;
  // Other settings from the next plane on, which becomes intra for every object it has. Errors: as
  // begin(), and nothing changes.
  Status change(const FbaSettings& settings);
  // One plane. It is made intra whatever the input says when it is the first one of an object
  // (face, body), or when a parameter jumps farther than the widest inter range reaches.
  // invalid_argument: no object. out_of_capacity: model_pool_full, the next plane must be intra;
  // output_full.
  Status encode(const FbaPlaneInput& plane, BitWriter* out);
  // Stuffing and the end code.
  Status finish(BitWriter* out);

  // What a decoder has after the last plane.
  std::int32_t slot_value(std::size_t slot) const { return value_[slot]; }

 private:
  void adopt();
  void write_code(std::uint32_t code, BitWriter* out);
  void write_head(const FbaPlaneInput& plane, bool intra, BitWriter* out) const;
  void write_face_setup(BitWriter* out);
  void write_body_setup(BitWriter* out);
  void write_ranges(bool body, BitWriter* out) const;
  bool overflows(std::size_t slot, std::int32_t target) const;
  bool overflows(const FbaPlaneInput& plane) const;
  Status write_face(const face::FapFrame& frame, bool intra, BitWriter* out);
  Status write_body(const body::BapFrame& frame, bool intra, BitWriter* out);
  Status code_slot(std::size_t slot, std::int32_t target, bool intra, ArithmeticEncoder* coder);

  FbaSettings settings_;
  FbaCoding coding_;
  ModelPool pool_;
  std::array<AdaptiveModel, kFbaSlots> model_{};
  std::array<std::int32_t, kFbaSlots> value_{};
  std::size_t last_plane_bits_ = 64;  // A short plane must not stand before a start code.
  bool any_plane_ = false;
};

}  // namespace caryatid::stream
