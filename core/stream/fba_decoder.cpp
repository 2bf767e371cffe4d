#include "core/stream/fba_decoder.h"

#include <algorithm>
#include <cassert>

namespace caryatid::stream {
namespace {

// Last byte of the start codes 00 00 01 xx, with the numbers of an old draft beside the final ones.
constexpr std::uint32_t kObjectStart = 0x1BA, kObjectStartDraft = 0x101;
constexpr std::uint32_t kPlaneStart = 0x1BB, kPlaneStartDraft = 0x103;
constexpr std::uint32_t kSequenceEnd = 0x1B1;
constexpr int kMarkerSpacing = 4;  // In lists of ranges a marker stands before every fourth one.
// The longest head of an intra plane: time fields, then masks and four lists of 5-bit ranges with
// their markers, for all FAPs and BAPs; rounded up.
constexpr std::size_t kMaxIntraHeadBits = 9000;
// Far beyond any parameter; keeps sums of differences from hostile streams within 32 bits.
constexpr std::int32_t kValueLimit = 1000000000;

constexpr bool is_object_start(std::uint32_t code) {
  return code == kObjectStart || code == kObjectStartDraft;
}
constexpr bool is_plane_start(std::uint32_t code) {
  return code == kPlaneStart || code == kPlaneStartDraft;
}

// Stuffing before a start code: a 0, then ones up to the byte; a whole byte when aligned.
bool read_stuffing(BitReader* bits) {
  const std::size_t count = 8 - bits->position() % 8;
  if (bits->bit() != 0) return false;
  for (std::size_t i = 1; i < count; ++i)
    if (bits->bit() != 1) return false;
  return true;
}

std::uint8_t to_field(std::int32_t value, int largest) {
  return static_cast<std::uint8_t>(std::clamp(value, 0, largest));
}

}  // namespace

void FbaDecoder::refill(std::span<const std::byte> bytes, bool complete) {
  before_ += position_ / 8;
  position_ %= 8;
  bytes_ = bytes;
  complete_ = complete;
}

BitSet<face::kFapCount + 1> FbaDecoder::held_faps() const {
  BitSet<face::kFapCount + 1> held;
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    const auto n = static_cast<std::size_t>(fap);
    const std::size_t group = face::fap_info(fap).group;
    if (coding_.fap_mask_type[group] == FapMaskType::hold && fap_seen_.test(n)) held.set(n);
  }
  return held;
}

// Skips whatever stands before the object (a visual sequence header, or bytes of another stream).
Status FbaDecoder::find_start() {
  for (std::size_t byte = (position_ + 7) / 8; byte + 4 <= bytes_.size(); ++byte) {
    BitReader bits(bytes_, byte * 8);
    position_ = byte * 8;
    if (!is_object_start(bits.bits(32))) continue;
    position_ += 32;
    started_ = true;
    return {};
  }
  if (!complete_) return fault(Code::not_ready, FbaFault::need_more);
  ended_ = true;
  return fault(Code::corrupt_data, FbaFault::no_object_start);
}

// Passes start codes between planes; *out_ended at the end code or when only stuffing is left.
Status FbaDecoder::pass_codes(bool* out_ended) {
  while (true) {
    BitReader bits(bytes_, position_);
    const bool stuffed = read_stuffing(&bits);
    const std::uint32_t code = stuffed ? bits.bits(32) : 0;
    if (stuffed && bits.ran_over()) {
      if (!complete_) return fault(Code::not_ready, FbaFault::need_more);
      *out_ended = (position_ + 7) / 8 >= bytes_.size();
      return {};
    }
    if (code == kSequenceEnd) *out_ended = true;
    if (!is_object_start(code) && !is_plane_start(code)) return {};
    position_ = bits.position();
  }
}

Status FbaDecoder::next(FbaPlane* plane, face::FapFrame* io_face, body::BapFrame* io_body) {
  if (ended_) return fault(Code::not_ready, FbaFault::end_of_stream);
  if (!started_) CARYATID_TRY(find_start());
  if (searching_) CARYATID_TRY(search_intra());
  bool ended = false;
  CARYATID_TRY(pass_codes(&ended));
  if (ended || position_ >= bytes_.size() * 8) {
    if (!ended && !complete_) return fault(Code::not_ready, FbaFault::need_more);
    ended_ = true;
    return fault(Code::not_ready, FbaFault::end_of_stream);
  }
  BitReader bits(bytes_, position_);
  FbaPlane read;
  Status status = decode_plane(&bits, &read);
  if (bits.ran_over() && !complete_) return fault(Code::not_ready, FbaFault::need_more);
  if (status.ok() && bits.position() > bits.size()) {
    ended_ = true;
    return fault(Code::corrupt_data, FbaFault::truncated);
  }
  if (status.ok()) status = commit(read);
  if (!status.ok()) {
    ++damaged_planes_;
    searching_ = true;
    ++position_;
    return status;
  }
  position_ = bits.position();
  *plane = read;
  deliver(read, io_face, io_body);
  return {};
}

// Quick refusal of what cannot be the masks of a face, or a body: nearly every bit position.
bool FbaDecoder::plausible_masks(BitReader bits, bool face) const {
  const std::uint32_t quantiser = bits.bits(5);
  const bool known = face ? coding_.face_known : coding_.body_known;
  if (known && quantiser != (face ? coding_.fap_quant : coding_.bap_quant_index)) return false;
  const int groups = face ? face::kFapGroupCount : body::kBapGroupCount;
  for (int group = 1; group <= groups; ++group) {
    if (bits.bit() != 1) return false;
    const std::uint32_t type = bits.bits(2);
    if (!face && type == 2) return false;
    const face::FapGroup faps = face ? face::fap_group(group) : face::FapGroup{};
    const int size =
        face ? faps.last - faps.first + 1 : static_cast<int>(body::bap_group(group).size());
    if (type == 1 || type == 2) bits.bits(size);
  }
  return true;
}

// After damage nothing tells where planes begin. A start code does; else a bit position counts when
// a whole intra head with all its markers can be read there and it says what is known already, or
// brings all four sets of ranges (72 more markers).
bool FbaDecoder::plausible_intra(std::size_t position) {
  BitReader bits(bytes_, position);
  FbaPlane plane;
  if (bits.bit() != 1) return false;
  bits.seek(position);
  if (!read_head(&bits, &plane).ok() || !(plane.face || plane.body)) return false;
  if (!plausible_masks(bits, plane.face)) return false;
  pending_ = coding_;
  pending_changed_ = true;
  if (plane.face) {
    if (!read_face_setup(&bits).ok()) return false;
    if (!pending_.fap_mask.any()) return false;
    if (coding_.face_known &&
        (pending_.fap_quant != coding_.fap_quant ||
         pending_.fap_mask_type != coding_.fap_mask_type || pending_.fap_mask != coding_.fap_mask))
      return false;
  }
  if (plane.body && !plane.face) {
    if (!read_body_setup(&bits).ok() || !pending_.bap_mask.any()) return false;
    if (coding_.body_known && (pending_.bap_quant_index != coding_.bap_quant_index ||
                               pending_.bap_mask != coding_.bap_mask))
      return false;
  }
  return bits.position() <= bits.size();
}

Status FbaDecoder::search_intra() {
  for (; position_ < bytes_.size() * 8; ++position_) {
    BitReader bits(bytes_, position_);
    if (position_ % 8 == 0) {
      const std::uint32_t code = bits.bits(32);
      if (code == kSequenceEnd && !bits.ran_over()) {
        ended_ = true;
        return fault(Code::not_ready, FbaFault::end_of_stream);
      }
      if ((is_plane_start(code) || is_object_start(code)) && plausible_intra(position_ + 32)) {
        position_ += 32;
        searching_ = false;
        return {};
      }
    }
    if (plausible_intra(position_)) {
      searching_ = false;
      return {};
    }
    // Too near to the end to tell: the rest of a head may be still to come.
    if (!complete_ && position_ + kMaxIntraHeadBits > bytes_.size() * 8) break;
  }
  if (!complete_) return fault(Code::not_ready, FbaFault::need_more);
  ended_ = true;
  return fault(Code::not_ready, FbaFault::end_of_stream);
}

Status FbaDecoder::read_head(BitReader* bits, FbaPlane* plane) const {
  *plane = {};
  plane->intra = bits->bit() == 1;
  const std::uint32_t objects = bits->bits(2);
  plane->face = (objects & 1u) != 0;
  plane->body = (objects & 2u) != 0;
  if (objects == 0) return {};
  if (plane->intra) {
    plane->has_rate = bits->bit() == 1;
    if (plane->has_rate) {
      plane->rate.frame_rate = static_cast<std::uint8_t>(bits->bits(8));
      plane->rate.sixteenths = static_cast<std::uint8_t>(bits->bits(4));
      plane->rate.by_1001 = bits->bit() == 1;
    }
    plane->has_time_code = bits->bit() == 1;
    if (plane->has_time_code) {
      plane->time_code.hours = static_cast<std::uint8_t>(bits->bits(5));
      plane->time_code.minutes = static_cast<std::uint8_t>(bits->bits(6));
      if (bits->bit() != 1) return fault(Code::corrupt_data, FbaFault::marker_missing);
      plane->time_code.seconds = static_cast<std::uint8_t>(bits->bits(6));
    }
  }
  if (bits->bit() == 1) {
    std::uint32_t part = 15;
    while (part == 15 && !bits->ran_over()) plane->skip += part = bits->bits(4);
  }
  return {};
}

Status FbaDecoder::read_fap_range(BitReader* bits, std::int16_t LevelRange::*limit, int sign) {
  const int divisor = range_divisor(pending_, false);
  for (int group = 2; group <= face::kFapGroupCount; ++group) {
    const face::FapGroup faps = face::fap_group(group);
    for (int fap = faps.first; fap <= faps.last; ++fap) {
      if ((fap - faps.first) % kMarkerSpacing == 0 && bits->bit() != 1)
        return fault(Code::corrupt_data, FbaFault::marker_missing);
      if (!pending_.fap_mask.test(static_cast<std::size_t>(fap))) continue;
      const int code = static_cast<int>(bits->bits(5));
      pending_.range[fap_slot(fap)].*limit =
          static_cast<std::int16_t>(sign * (code * kRangeStep / divisor));
    }
  }
  return {};
}

Status FbaDecoder::read_bap_range(BitReader* bits, std::int16_t LevelRange::*limit, int sign) {
  const int divisor = range_divisor(pending_, true);
  for (int group = 1; group <= body::kBapGroupCount; ++group) {
    int index = 0;
    for (const std::uint16_t bap : body::bap_group(group)) {
      if (index++ % kMarkerSpacing == 0 && bits->bit() != 1)
        return fault(Code::corrupt_data, FbaFault::marker_missing);
      if (!pending_.bap_mask.test(bap)) continue;
      const int code = static_cast<int>(bits->bits(5));
      pending_.range[bap_slot(bap)].*limit =
          static_cast<std::int16_t>(sign * (code * kRangeStep / divisor));
    }
  }
  return {};
}

Status FbaDecoder::read_face_setup(BitReader* bits) {
  pending_.fap_quant = static_cast<std::uint8_t>(bits->bits(5));
  // The codec takes zeros at FAP 4 for "never set", and so do its streams.
  const LevelRange& probe = pending_.range[fap_slot(4)];
  if (probe.intra_high == 0 && probe.intra_low == 0) pending_.set_default_fap_ranges();
  pending_.set_field_ranges();
  pending_.fap_mask.clear();
  for (int group = 1; group <= face::kFapGroupCount; ++group) {
    if (bits->bit() != 1) return fault(Code::corrupt_data, FbaFault::marker_missing);
    const auto type = static_cast<FapMaskType>(bits->bits(2));
    pending_.fap_mask_type[static_cast<std::size_t>(group)] = type;
    const face::FapGroup faps = face::fap_group(group);
    for (int fap = faps.first; fap <= faps.last; ++fap) {
      const bool listed = type == FapMaskType::hold || type == FapMaskType::interpolate;
      const bool on = listed ? bits->bit() == 1 : type == FapMaskType::all;
      pending_.fap_mask.set(static_cast<std::size_t>(fap), on);
    }
  }
  pending_.suggested_gender = bits->bit() == 1;
  if (bits->bit() == 1) return fault(Code::unsupported, FbaFault::dct_coding);
  const std::uint32_t flags = bits->bits(4);
  if ((flags & 8u) != 0) CARYATID_TRY(read_fap_range(bits, &LevelRange::intra_high, 1));
  if ((flags & 4u) != 0) CARYATID_TRY(read_fap_range(bits, &LevelRange::intra_low, -1));
  if ((flags & 2u) != 0) CARYATID_TRY(read_fap_range(bits, &LevelRange::inter_high, 1));
  if ((flags & 1u) != 0) CARYATID_TRY(read_fap_range(bits, &LevelRange::inter_low, -1));
  pending_.face_known = true;
  return {};
}

Status FbaDecoder::read_body_setup(BitReader* bits) {
  pending_.bap_quant_index = static_cast<std::uint8_t>(bits->bits(5));
  if (!pending_.body_known) pending_.set_default_bap_ranges();
  pending_.bap_mask.clear();
  for (int group = 1; group <= body::kBapGroupCount; ++group) {
    if (bits->bit() != 1) return fault(Code::corrupt_data, FbaFault::marker_missing);
    const std::uint32_t type = bits->bits(2);
    if (type == 2) return fault(Code::corrupt_data, FbaFault::body_mask_type);
    for (const std::uint16_t bap : body::bap_group(group))
      pending_.bap_mask.set(bap, type == 1 ? bits->bit() == 1 : type == 3);
  }
  pending_.suggested_gender = bits->bit() == 1;
  if (bits->bit() == 1) return fault(Code::unsupported, FbaFault::dct_coding);
  const std::uint32_t flags = bits->bits(4);
  if ((flags & 8u) != 0) CARYATID_TRY(read_bap_range(bits, &LevelRange::intra_high, 1));
  if ((flags & 4u) != 0) CARYATID_TRY(read_bap_range(bits, &LevelRange::intra_low, -1));
  if ((flags & 2u) != 0) CARYATID_TRY(read_bap_range(bits, &LevelRange::inter_high, 1));
  if ((flags & 1u) != 0) CARYATID_TRY(read_bap_range(bits, &LevelRange::inter_low, -1));
  pending_.body_known = true;
  return {};
}

// One arithmetic segment with the slots pending_slot_[first...].
Status FbaDecoder::read_segment(BitReader* bits, bool intra, std::size_t first) {
  ArithmeticDecoder decoder(bits);
  for (std::size_t i = first; i < pending_slot_.size(); ++i) {
    const std::size_t slot = pending_slot_[i];
    const LevelRange& range = pending_.range[slot];
    const int low = intra ? range.intra_low : range.inter_low;
    const int high = intra ? range.intra_high : range.inter_high;
    const auto symbols = static_cast<std::uint32_t>(high - low + 1);
    // Intra models are used once and start uniform.
    const AdaptiveModel model = intra ? AdaptiveModel{} : model_[slot];
    const std::uint32_t target = decoder.target(ModelPool::total(model, symbols));
    const Interval share = pool_.find(model, symbols, target);
    decoder.consume(share);
    pending_symbol_[slot] = static_cast<std::uint16_t>(share.symbol);
  }
  if (!decoder.finish()) return fault(Code::corrupt_data, FbaFault::zero_run);
  return {};
}

Status FbaDecoder::read_face_values(BitReader* bits, bool intra) {
  const auto push = [this](std::size_t slot) {
    return pending_slot_.push(static_cast<std::uint16_t>(slot));
  };
  bool room = true;
  if (pending_.fap_mask.test(face::kFapViseme)) {
    const std::size_t first = pending_slot_.size();
    for (const std::size_t slot : {0u, 1u, 2u}) room = push(slot) && room;
    CARYATID_TRY(read_segment(bits, intra, first));
    pending_flags_.viseme_def = bits->bit() == 1;
  }
  if (pending_.fap_mask.test(face::kFapExpression)) {
    const std::size_t first = pending_slot_.size();
    for (const std::size_t slot : {3u, 4u, 5u, 6u}) room = push(slot) && room;
    CARYATID_TRY(read_segment(bits, intra, first));
    pending_flags_.init_face = bits->bit() == 1;
    pending_flags_.expression_def = bits->bit() == 1;
  }
  const std::size_t first = pending_slot_.size();
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    if (pending_.fap_mask.test(static_cast<std::size_t>(fap))) room = push(fap_slot(fap)) && room;
  assert(room);
  return read_segment(bits, intra, first);
}

Status FbaDecoder::read_body_values(BitReader* bits, bool intra) {
  const std::size_t first = pending_slot_.size();
  for (int group = 1; group <= body::kBapGroupCount; ++group)
    for (const std::uint16_t bap : body::bap_group(group))
      if (pending_.bap_mask.test(bap)) {
        const bool room = pending_slot_.push(static_cast<std::uint16_t>(bap_slot(bap)));
        assert(room);
        static_cast<void>(room);
      }
  return read_segment(bits, intra, first);
}

Status FbaDecoder::decode_plane(BitReader* bits, FbaPlane* plane) {
  pending_slot_.clear();
  pending_flags_ = flags_;
  CARYATID_TRY(read_head(bits, plane));
  if (plane->intra || pending_changed_) pending_ = coding_;
  pending_changed_ = plane->intra;
  if (plane->face) {
    if (plane->intra) CARYATID_TRY(read_face_setup(bits));
    if (!pending_.face_known) return fault(Code::corrupt_data, FbaFault::before_first_intra);
    CARYATID_TRY(read_face_values(bits, plane->intra));
  }
  if (plane->body) {
    if (plane->intra) CARYATID_TRY(read_body_setup(bits));
    if (!pending_.body_known) return fault(Code::corrupt_data, FbaFault::before_first_intra);
    CARYATID_TRY(read_body_values(bits, plane->intra));
  }
  return {};
}

// Makes the plane count: models, values, time.
Status FbaDecoder::commit(const FbaPlane& plane) {
  if (plane.intra && plane.face)
    for (std::size_t slot = 0; slot < kBapSlotBase; ++slot) pool_.forget(&model_[slot]);
  if (plane.intra && plane.body)
    for (std::size_t slot = kBapSlotBase; slot < kFbaSlots; ++slot) pool_.forget(&model_[slot]);
  for (const std::uint16_t slot : pending_slot_.span()) {
    const LevelRange& range = pending_.range[slot];
    const std::uint16_t symbol = pending_symbol_[slot];
    const int step = step_of(pending_, slot, options_.quantisers);
    if (plane.intra) {
      value_[slot] = value_of(symbol + range.intra_low, step);
      continue;
    }
    const auto symbols = static_cast<std::uint32_t>(range.inter_high - range.inter_low + 1);
    if (!pool_.count(&model_[slot], symbols, symbol))
      return fault(Code::out_of_capacity, FbaFault::model_pool_full);
    value_[slot] = std::clamp(value_[slot] + value_of(symbol + range.inter_low, step), -kValueLimit,
                              kValueLimit);
  }
  if (plane.intra) coding_ = pending_;
  flags_ = pending_flags_;
  if (plane.has_rate && plane.rate.hertz() > 0.0) rate_ = plane.rate;
  if (plane.has_time_code) next_time_s_ = plane.time_code.in_seconds();
  time_s_ = next_time_s_;
  next_time_s_ += (1.0 + plane.skip) / rate_.hertz();
  if (plane.face)
    for (std::size_t fap = 1; fap <= face::kFapCount; ++fap)
      if (coding_.fap_mask.test(fap)) fap_seen_.set(fap);
  return {};
}

void FbaDecoder::deliver(const FbaPlane& plane, face::FapFrame* face, body::BapFrame* body) const {
  if (plane.face) {
    face->mask = coding_.fap_mask;
    for (int fap = 3; fap <= face::kFapCount; ++fap)
      if (face->has(fap)) face->set(fap, static_cast<float>(value_[fap_slot(fap)]));
    if (face->has(face::kFapViseme))
      face->viseme = {to_field(value_[0], 14), to_field(value_[1], 14), to_field(value_[2], 63),
                      flags_.viseme_def};
    if (face->has(face::kFapExpression))
      face->expression = {to_field(value_[3], 6),  to_field(value_[4], 63), to_field(value_[5], 6),
                          to_field(value_[6], 63), flags_.init_face,        flags_.expression_def};
  }
  if (plane.body) {
    body->mask = coding_.bap_mask;
    for (int bap = 1; bap <= body::kBapCountExtended; ++bap)
      if (body->has(bap)) body->set(bap, static_cast<float>(value_[bap_slot(bap)]));
  }
}

}  // namespace caryatid::stream
