#include "core/stream/fba_encoder.h"

#include <algorithm>
#include <cmath>

namespace caryatid::stream {
namespace {

constexpr std::uint32_t kObjectStart = 0x1BA, kPlaneStart = 0x1BB, kSequenceEnd = 0x1B1;
constexpr int kMarkerSpacing = 4;
// Readers that do not check stuffing take planes of up to 7 bits before a start code for it.
constexpr std::size_t kShortPlaneBits = 7;
constexpr std::uint8_t kLargestQuantiser = 31;
constexpr float kLargestValue = 1e9f;

constexpr Status status_of(Code code, FbaFault fault) {
  return {code, static_cast<std::uint16_t>(fault)};
}

std::int32_t whole(float value) {
  if (value != value) return 0;
  return static_cast<std::int32_t>(std::lround(std::clamp(value, -kLargestValue, kLargestValue)));
}

bool valid(const FbaSettings& settings) {
  bool good = settings.fap_quant <= kLargestQuantiser &&
              settings.bap_quant_index <= kLargestQuantiser && settings.rate.hertz() > 0.0 &&
              settings.rate.sixteenths < 16 && settings.dead_zone >= 0.5f &&
              settings.dead_zone < 1.0f;
  for (const RangeCodes& range : settings.range)
    for (const int code : {range.intra_high, range.intra_low, range.inter_high, range.inter_low})
      good = good && code <= kMaxRangeCode;
  // Deployed decoders take zeros there for ranges that were never set.
  const RangeCodes& probe = settings.range[fap_slot(4)];
  return good && (probe.intra_high != 0 || probe.intra_low != 0);
}

FapMaskType group_type(const FbaSettings& settings, int group) {
  const face::FapGroup faps = face::fap_group(group);
  int listed = 0;
  for (int fap = faps.first; fap <= faps.last; ++fap)
    listed += settings.fap_mask.test(static_cast<std::size_t>(fap)) ? 1 : 0;
  const FapMaskType unlisted = settings.unlisted[static_cast<std::size_t>(group)];
  if (listed == faps.last - faps.first + 1) return FapMaskType::all;
  if (unlisted == FapMaskType::interpolate) return FapMaskType::interpolate;
  return listed == 0 ? FapMaskType::absent : FapMaskType::hold;
}

}  // namespace

std::int32_t choose_level(const FbaSettings& settings, std::size_t slot, std::int32_t difference,
                          int step, float dead_zone) {
  const int every = std::max(1, int{settings.coarseness[slot]});
  const int wide = std::max(1, step) * every;
  const auto distance = static_cast<float>(difference < 0 ? -difference : difference);
  if (dead_zone > 0.5f && distance <= dead_zone * static_cast<float>(wide)) return 0;
  return level_of(difference, wide) * every;
}

FbaEncoder::FbaEncoder(const FbaSettings& settings, std::span<ModelNode> nodes)
    : settings_(settings), pool_(nodes) {
  adopt();
}

// What the stream will know; the objects count as new.
void FbaEncoder::adopt() {
  coding_.fap_mask = settings_.fap_mask;
  coding_.bap_mask = settings_.bap_mask;
  coding_.fap_quant = settings_.fap_quant;
  coding_.bap_quant_index = settings_.bap_quant_index;
  coding_.face_known = coding_.body_known = false;
}

Status FbaEncoder::begin(BitWriter* out) const {
  if (!valid(settings_)) return status_of(Code::invalid_argument, FbaFault::bad_settings);
  out->bits(kObjectStart, 32);
  return out->fits() ? Status{} : status_of(Code::out_of_capacity, FbaFault::output_full);
}

Status FbaEncoder::change(const FbaSettings& settings) {
  if (!valid(settings)) return status_of(Code::invalid_argument, FbaFault::bad_settings);
  settings_ = settings;
  adopt();
  return {};
}

void FbaEncoder::write_code(std::uint32_t code, BitWriter* out) {
  // Planes with nothing in them, until the short one is out of harm's way.
  if (last_plane_bits_ <= kShortPlaneBits)
    for (int i = 0; i < 3; ++i) out->bits(0, 3);
  out->bit(0);
  while (out->position() % 8 != 0) out->bit(1);
  out->bits(code, 32);
  last_plane_bits_ = 64;
}

void FbaEncoder::write_head(const FbaPlaneInput& plane, bool intra, BitWriter* out) const {
  out->bit(intra ? 1 : 0);
  out->bits((plane.face != nullptr ? 1u : 0u) | (plane.body != nullptr ? 2u : 0u), 2);
  if (intra) {
    out->bit(1);
    out->bits(settings_.rate.frame_rate, 8);
    out->bits(settings_.rate.sixteenths, 4);
    out->bit(settings_.rate.by_1001 ? 1 : 0);
    out->bit(plane.has_time_code ? 1 : 0);
    if (plane.has_time_code) {
      out->bits(plane.time_code.hours, 5);
      out->bits(plane.time_code.minutes, 6);
      out->bit(1);
      out->bits(plane.time_code.seconds, 6);
    }
  }
  out->bit(plane.skip > 0 ? 1 : 0);
  if (plane.skip > 0) {
    std::uint32_t rest = plane.skip;
    for (; rest >= 15; rest -= 15) out->bits(15, 4);
    out->bits(rest, 4);
  }
}

// The four lists of ranges, each with its flag's marker pattern; the models' ranges follow them.
void FbaEncoder::write_ranges(bool body, BitWriter* out) const {
  constexpr std::uint8_t RangeCodes::*kLists[] = {&RangeCodes::intra_high, &RangeCodes::intra_low,
                                                  &RangeCodes::inter_high, &RangeCodes::inter_low};
  for (const auto list : kLists) {
    if (body) {
      for (int group = 1; group <= body::kBapGroupCount; ++group) {
        int index = 0;
        for (const std::uint16_t bap : body::bap_group(group)) {
          if (index++ % kMarkerSpacing == 0) out->bit(1);
          if (coding_.bap_mask.test(bap)) out->bits(settings_.range[bap_slot(bap)].*list, 5);
        }
      }
      continue;
    }
    for (int group = 2; group <= face::kFapGroupCount; ++group) {
      const face::FapGroup faps = face::fap_group(group);
      for (int fap = faps.first; fap <= faps.last; ++fap) {
        if ((fap - faps.first) % kMarkerSpacing == 0) out->bit(1);
        if (coding_.fap_mask.test(static_cast<std::size_t>(fap)))
          out->bits(settings_.range[fap_slot(fap)].*list, 5);
      }
    }
  }
}

void FbaEncoder::write_face_setup(BitWriter* out) {
  out->bits(coding_.fap_quant, 5);
  for (int group = 1; group <= face::kFapGroupCount; ++group) {
    out->bit(1);
    const FapMaskType type = group_type(settings_, group);
    out->bits(static_cast<std::uint32_t>(type), 2);
    if (type != FapMaskType::hold && type != FapMaskType::interpolate) continue;
    const face::FapGroup faps = face::fap_group(group);
    for (int fap = faps.first; fap <= faps.last; ++fap)
      out->bit(coding_.fap_mask.test(static_cast<std::size_t>(fap)) ? 1 : 0);
  }
  out->bit(settings_.suggested_gender ? 1 : 0);
  out->bit(0);  // Predictive mode.
  const bool ranges = settings_.repeat_ranges || !coding_.face_known;
  out->bits(ranges ? 15 : 0, 4);
  if (ranges) write_ranges(false, out);
  coding_.set_field_ranges();
  coding_.face_known = true;
}

void FbaEncoder::write_body_setup(BitWriter* out) {
  out->bits(coding_.bap_quant_index, 5);
  for (int group = 1; group <= body::kBapGroupCount; ++group) {
    out->bit(1);
    const auto baps = body::bap_group(group);
    std::size_t listed = 0;
    for (const std::uint16_t bap : baps) listed += coding_.bap_mask.test(bap) ? 1u : 0u;
    out->bits(listed == 0 ? 0u : listed == baps.size() ? 3u : 1u, 2);
    if (listed == 0 || listed == baps.size()) continue;
    for (const std::uint16_t bap : baps) out->bit(coding_.bap_mask.test(bap) ? 1 : 0);
  }
  out->bit(settings_.suggested_gender ? 1 : 0);
  out->bit(0);
  const bool ranges = settings_.repeat_ranges || !coding_.body_known;
  out->bits(ranges ? 15 : 0, 4);
  if (ranges) write_ranges(true, out);
  coding_.body_known = true;
}

// Chooses the level nearest to the target that the range allows, and codes it.
Status FbaEncoder::code_slot(std::size_t slot, std::int32_t target, bool intra,
                             ArithmeticEncoder* coder) {
  const LevelRange range = levels_of(settings_, coding_, slot);
  const int step = step_of(coding_, slot, settings_.quantisers);
  const std::int32_t from = intra ? 0 : value_[slot];
  const std::int32_t difference = target - from;
  const int low = intra ? range.intra_low : range.inter_low;
  const int high = intra ? range.intra_high : range.inter_high;
  std::int32_t level =
      choose_level(settings_, slot, difference, step, intra ? 0.5f : settings_.dead_zone);
  level = std::clamp(level, static_cast<std::int32_t>(low), static_cast<std::int32_t>(high));
  const auto symbols = static_cast<std::uint32_t>(high - low + 1);
  const auto symbol = static_cast<std::uint32_t>(level - low);
  const AdaptiveModel model = intra ? AdaptiveModel{} : model_[slot];
  coder->encode(pool_.share(model, symbols, symbol));
  value_[slot] = from + value_of(level, step);
  if (!intra && !pool_.count(&model_[slot], symbols, symbol))
    return status_of(Code::out_of_capacity, FbaFault::model_pool_full);
  return {};
}

bool FbaEncoder::overflows(std::size_t slot, std::int32_t target) const {
  const int step = step_of(coding_, slot, settings_.quantisers);
  const std::int32_t level =
      choose_level(settings_, slot, target - value_[slot], step, settings_.dead_zone);
  const LevelRange range = levels_of(settings_, coding_, slot);
  const RangeCodes& codes = settings_.range[slot];
  return (level > range.inter_high && codes.inter_high == kMaxRangeCode) ||
         (level < range.inter_low && codes.inter_low == kMaxRangeCode);
}

bool FbaEncoder::overflows(const FbaPlaneInput& plane) const {
  for (int fap = 3; plane.face != nullptr && fap <= face::kFapCount; ++fap)
    if (coding_.fap_mask.test(static_cast<std::size_t>(fap)) && plane.face->has(fap) &&
        overflows(fap_slot(fap), whole(plane.face->get(fap))))
      return true;
  for (int bap = 1; plane.body != nullptr && bap <= body::kBapCountExtended; ++bap)
    if (coding_.bap_mask.test(static_cast<std::size_t>(bap)) && plane.body->has(bap) &&
        overflows(bap_slot(bap), whole(plane.body->get(bap))))
      return true;
  return false;
}

Status FbaEncoder::write_face(const face::FapFrame& frame, bool intra, BitWriter* out) {
  if (coding_.fap_mask.test(face::kFapViseme)) {
    const face::VisemeField& v = frame.viseme;
    ArithmeticEncoder coder(out);
    CARYATID_TRY(code_slot(0, v.first, intra, &coder));
    CARYATID_TRY(code_slot(1, v.second, intra, &coder));
    CARYATID_TRY(code_slot(2, v.blend, intra, &coder));
    coder.finish();
    out->bit(v.viseme_def ? 1 : 0);
  }
  if (coding_.fap_mask.test(face::kFapExpression)) {
    const face::ExpressionField& e = frame.expression;
    ArithmeticEncoder coder(out);
    CARYATID_TRY(code_slot(3, e.first, intra, &coder));
    CARYATID_TRY(code_slot(4, e.first_intensity, intra, &coder));
    CARYATID_TRY(code_slot(5, e.second, intra, &coder));
    CARYATID_TRY(code_slot(6, e.second_intensity, intra, &coder));
    coder.finish();
    out->bit(e.init_face ? 1 : 0);
    out->bit(e.expression_def ? 1 : 0);
  }
  ArithmeticEncoder coder(out);
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    if (!coding_.fap_mask.test(static_cast<std::size_t>(fap))) continue;
    const std::size_t slot = fap_slot(fap);
    const std::int32_t target = frame.has(fap) ? whole(frame.get(fap)) : value_[slot];
    CARYATID_TRY(code_slot(slot, target, intra, &coder));
  }
  coder.finish();
  return {};
}

Status FbaEncoder::write_body(const body::BapFrame& frame, bool intra, BitWriter* out) {
  ArithmeticEncoder coder(out);
  for (int group = 1; group <= body::kBapGroupCount; ++group)
    for (const std::uint16_t bap : body::bap_group(group)) {
      if (!coding_.bap_mask.test(bap)) continue;
      const std::size_t slot = bap_slot(bap);
      const std::int32_t target = frame.has(bap) ? whole(frame.get(bap)) : value_[slot];
      CARYATID_TRY(code_slot(slot, target, intra, &coder));
    }
  coder.finish();
  return {};
}

Status FbaEncoder::encode(const FbaPlaneInput& plane, BitWriter* out) {
  if (plane.face == nullptr && plane.body == nullptr)
    return status_of(Code::invalid_argument, FbaFault::bad_settings);
  const bool intra = plane.intra || (plane.face != nullptr && !coding_.face_known) ||
                     (plane.body != nullptr && !coding_.body_known) || overflows(plane);
  if (intra && any_plane_ && settings_.plane_start_codes) write_code(kPlaneStart, out);
  const std::size_t begin = out->position();
  write_head(plane, intra, out);
  if (plane.face != nullptr) {
    if (intra) {
      write_face_setup(out);
      for (std::size_t slot = 0; slot < kBapSlotBase; ++slot) pool_.forget(&model_[slot]);
    }
    CARYATID_TRY(write_face(*plane.face, intra, out));
  }
  if (plane.body != nullptr) {
    if (intra) {
      write_body_setup(out);
      for (std::size_t slot = kBapSlotBase; slot < kFbaSlots; ++slot) pool_.forget(&model_[slot]);
    }
    CARYATID_TRY(write_body(*plane.body, intra, out));
  }
  last_plane_bits_ = out->position() - begin;
  any_plane_ = true;
  return out->fits() ? Status{} : status_of(Code::out_of_capacity, FbaFault::output_full);
}

Status FbaEncoder::finish(BitWriter* out) {
  write_code(kSequenceEnd, out);
  return out->fits() ? Status{} : status_of(Code::out_of_capacity, FbaFault::output_full);
}

LevelRange levels_of(const FbaSettings& settings, const FbaCoding& coding, std::size_t slot) {
  if (slot < kFieldSlots) return coding.range[slot];
  const int divisor = range_divisor(coding, slot >= kBapSlotBase);
  const RangeCodes& codes = settings.range[slot];
  const auto levels = [divisor](int code) {
    return static_cast<std::int16_t>(code * kRangeStep / divisor);
  };
  return {levels(codes.intra_high), static_cast<std::int16_t>(-levels(codes.intra_low)),
          levels(codes.inter_high), static_cast<std::int16_t>(-levels(codes.inter_low))};
}

}  // namespace caryatid::stream
