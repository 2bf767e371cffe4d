#pragma once
// Words that decoder and encoder of FBA elementary streams share (ISO/IEC 14496-2, face and body
// animation object; where the standard's text was not at hand, a deployed codec decides: visage).
//
//   fba_object: start code, planes, end code. Planes follow each other bit by bit, unaligned; a
//   start code is preceded by stuffing (a 0, then ones up to the byte). plane: intra (carries
//   masks, quantisers, ranges and absolute values) or inter (differences).
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/fixed.h"
#include "core/base/status.h"
#include "core/body/bap_table.h"
#include "core/face/fap_table.h"
#include "core/stream/arithmetic.h"

namespace caryatid::stream {

// Detail of a Status from the FBA decoder and encoder. describe() has the words.
enum class FbaFault : std::uint16_t {
  none,
  end_of_stream,       // not_ready: the end code, or no bits are left.
  need_more,           // not_ready: refill() first.
  no_object_start,     // corrupt_data, as all that follow up to truncated.
  marker_missing,      // A bit that must be 1 is 0.
  body_mask_type,      // Type 2 does not exist for bodies.
  before_first_intra,  // Differences to something that was never sent.
  zero_run,            // More zeros in a segment than a coder writes.
  truncated,           // The bytes end within a plane.
  dct_coding,          // unsupported: the DCT mode.
  model_pool_full,     // out_of_capacity: give the coder more ModelNodes.
  output_full,         // out_of_capacity: the encoder's bytes are too few.
  rate_too_low,        // out_of_capacity: the clip does not fit even with the coarsest steps.
  bad_settings,        // invalid_argument: a field of the settings is out of range.
};

// One line: what is wrong, and what to do about it. Static storage.
const char* describe(FbaFault fault);
inline const char* describe_fba_fault(Status status) {
  return describe(static_cast<FbaFault>(status.detail));
}

// frame_rate + sixteenths/16 Hz, times 1000/1001 if so said.
struct FbaRate {
  std::uint8_t frame_rate = 30;
  std::uint8_t sixteenths = 0;  // 0..15
  bool by_1001 = false;
  double hertz() const {
    return (frame_rate + sixteenths / 16.0) * (by_1001 ? 1000.0 / 1001.0 : 1.0);
  }
  friend bool operator==(const FbaRate&, const FbaRate&) = default;
};

struct FbaTimeCode {
  std::uint8_t hours = 0;    // 0..31
  std::uint8_t minutes = 0;  // 0..63
  std::uint8_t seconds = 0;  // 0..63
  double in_seconds() const { return hours * 3600.0 + minutes * 60.0 + seconds; }
  friend bool operator==(const FbaTimeCode&, const FbaTimeCode&) = default;
};

// Head of a plane.
struct FbaPlane {
  bool intra = false;
  bool face = false;
  bool body = false;
  bool has_rate = false;
  bool has_time_code = false;
  FbaRate rate;            // Meaningful when has_rate.
  FbaTimeCode time_code;   // Meaningful when has_time_code.
  std::uint32_t skip = 0;  // Frames without a plane after this one.
};

// What becomes of the FAPs of a group that are not in the stream.
enum class FapMaskType : std::uint8_t {
  absent = 0,       // No FAP of the group is in the stream.
  hold = 1,         // Unlisted FAPs keep the value they had.
  interpolate = 2,  // Unlisted FAPs are interpolated from the others (face/fit.h).
  all = 3,
};

// Every number that a plane can carry has a slot: the fields of FAPs 1 and 2, then FAPs 3..68, then
// BAPs 1..296.
inline constexpr std::size_t kFieldSlots = 7;  // select1, select2, blend; select1, intensity1, ...2
inline constexpr std::size_t kBapSlotBase = kFieldSlots + 66;
inline constexpr std::size_t kFbaSlots = kBapSlotBase + body::kBapCountExtended;
constexpr std::size_t fap_slot(int fap) { return kFieldSlots + static_cast<std::size_t>(fap) - 3; }
constexpr std::size_t bap_slot(int bap) { return kBapSlotBase + static_cast<std::size_t>(bap) - 1; }

// Ranges travel as 0..31 and mean that many times 60 base steps, divided by the quantiser.
inline constexpr int kRangeStep = 60;
inline constexpr int kMaxRangeCode = 31;

// Levels that a slot can take: intra low..high, inter low..high.
struct LevelRange {
  std::int16_t intra_high = 0;
  std::int16_t intra_low = 0;
  std::int16_t inter_high = 0;
  std::int16_t inter_low = 0;
};

// What intra planes set and what then holds for the planes that follow.
struct FbaCoding {
  bool face_known = false;  // A face intra plane has come.
  bool body_known = false;
  std::uint8_t fap_quant = 0;        // 0..31; step = base step * fap_quant, 0: levels are values.
  std::uint8_t bap_quant_index = 0;  // 0..31, see bap_scale().
  bool suggested_gender = false;
  std::uint8_t blend_limit = 63;  // Largest level of blend and intensities.
  std::array<FapMaskType, face::kFapGroupCount + 1> fap_mask_type{};
  BitSet<face::kFapCount + 1> fap_mask;
  BitSet<body::kBapCountExtended + 1> bap_mask;
  std::array<LevelRange, kFbaSlots> range{};

  // Ranges of FAPs that a stream never sets, by the table, for the present quantiser.
  void set_default_fap_ranges();
  // The same for BAPs: the codec has none, its interface begins with the widest.
  void set_default_bap_ranges();
  // blend_limit and the ranges of the seven fields, for the present quantiser.
  void set_field_ranges();
};

// Body quantiser steps by index, 14496-2.
int bap_scale(int index);
// Base step times quantiser of a slot; 0 when levels are values.
int step_of(const FbaCoding& coding, std::size_t slot, body::BapQuantisers quantisers);
// level * step, or the level itself for step 0.
constexpr std::int32_t value_of(std::int32_t level, int step) {
  return step == 0 ? level : level * step;
}
// Nearest level; halves of even steps go to zero first, as the codec's integer division has it.
constexpr std::int32_t level_of(std::int32_t value, int step) {
  if (step == 0) return value;
  const std::int32_t magnitude = value < 0 ? -value : value;
  if (magnitude <= step / 2) return 0;
  const std::int32_t level = (magnitude + step / 2) / step;
  return value < 0 ? -level : level;
}
// The division of ranges: the quantiser, or 1 for quantiser 0.
int range_divisor(const FbaCoding& coding, bool body);

}  // namespace caryatid::stream
