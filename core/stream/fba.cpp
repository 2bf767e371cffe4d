#include "core/stream/fba.h"

#include <algorithm>
#include <cassert>

namespace caryatid::stream {
namespace {

constexpr std::uint8_t kBapScale[32] = {0,  1,  2,  3,  5,  7,   9,   11,  14,  17, 20,
                                        23, 27, 31, 35, 39, 43,  47,  52,  57,  62, 67,
                                        72, 77, 82, 88, 94, 100, 106, 113, 120, 127};
constexpr int kFullBlend = 63;
constexpr std::int16_t kLastViseme = 14;
constexpr std::int16_t kLastExpression = 6;

constexpr std::int16_t narrow(int value) { return static_cast<std::int16_t>(value); }

constexpr LevelRange from_zero(int high) { return {narrow(high), 0, narrow(high), narrow(-high)}; }

}  // namespace

const char* describe(FbaFault fault) {
  switch (fault) {
    case FbaFault::none:
      return "nothing is wrong";
    case FbaFault::end_of_stream:
      return "the stream has ended";
    case FbaFault::need_more:
      return "the stream goes on; read more of it first";
    case FbaFault::no_object_start:
      return "no FBA object start code (000001BA); give an .fba stream";
    case FbaFault::marker_missing:
      return "damaged: a marker bit is missing; playing goes on at the next intra plane";
    case FbaFault::body_mask_type:
      return "damaged: body mask type 2 does not exist; playing goes on at the next intra plane";
    case FbaFault::before_first_intra:
      return "an inter plane before the first intra plane; playing starts at the next one";
    case FbaFault::zero_run:
      return "damaged: too many zeros in a row; playing goes on at the next intra plane";
    case FbaFault::truncated:
      return "the stream is cut off within a plane; fetch it again";
    case FbaFault::dct_coding:
      return "coded in DCT mode, which is not supported; encode it in predictive mode";
    case FbaFault::model_pool_full:
      return "more symbols than the decoder's memory holds; send intra planes more often";
    case FbaFault::output_full:
      return "the output buffer is full; give a larger one";
    case FbaFault::rate_too_low:
      return "does not fit into that rate even with the coarsest steps; allow more kbit/s";
    case FbaFault::bad_settings:
      return "a setting is out of range; see FbaSettings";
  }
  return "unknown fault";
}

int bap_scale(int index) {
  assert(index >= 0 && index < 32);
  return kBapScale[index];
}

int range_divisor(const FbaCoding& coding, bool body) {
  return std::max(1, body ? bap_scale(coding.bap_quant_index) : int{coding.fap_quant});
}

int step_of(const FbaCoding& coding, std::size_t slot, body::BapQuantisers quantisers) {
  if (slot >= kBapSlotBase) {
    const int bap = static_cast<int>(slot - kBapSlotBase) + 1;
    return body::bap_info(bap).quantiser(quantisers) * bap_scale(coding.bap_quant_index);
  }
  if (slot >= kFieldSlots)
    return face::fap_info(static_cast<int>(slot - kFieldSlots) + 3).quantiser * coding.fap_quant;
  const bool blended = slot == 2 || slot == 4 || slot == 6;
  return blended ? coding.fap_quant : 0;
}

void FbaCoding::set_default_fap_ranges() {
  const int divisor = range_divisor(*this, false);
  const auto rounded = [divisor](int steps) {
    return narrow((steps + kRangeStep - 1) / kRangeStep * kRangeStep / divisor);
  };
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    const face::FapInfo& info = face::fap_info(fap);
    const std::int16_t intra = rounded(info.intra_max), inter = rounded(info.inter_max);
    range[fap_slot(fap)] = {intra, narrow(-intra), inter, narrow(-inter)};
  }
}

void FbaCoding::set_default_bap_ranges() {
  const std::int16_t widest = narrow(kMaxRangeCode * kRangeStep / range_divisor(*this, true));
  for (std::size_t slot = kBapSlotBase; slot < kFbaSlots; ++slot)
    range[slot] = {widest, narrow(-widest), widest, narrow(-widest)};
}

void FbaCoding::set_field_ranges() {
  // With quantiser 0 the limit keeps what it was (the codec's behaviour).
  if (fap_quant > 0)
    blend_limit = static_cast<std::uint8_t>((kFullBlend + fap_quant / 2) / fap_quant);
  for (const std::size_t slot : {0u, 1u}) range[slot] = from_zero(kLastViseme);
  for (const std::size_t slot : {3u, 5u}) range[slot] = from_zero(kLastExpression);
  for (const std::size_t slot : {2u, 4u, 6u}) range[slot] = from_zero(blend_limit);
}

}  // namespace caryatid::stream
