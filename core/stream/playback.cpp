#include "core/stream/playback.h"

#include <algorithm>
#include <cstring>

#include "core/face/fap_fill.h"

namespace caryatid::stream {
namespace {

// A longer gap is a jump of the clock, not a pause that somebody animated.
constexpr double kLongestGap_s = 10.0;

}  // namespace

std::size_t FbaPlayback::push(std::span<const std::byte> bytes) {
  const std::size_t taken = std::min(bytes.size(), buffer_.size() - filled_);
  if (taken > 0) std::memcpy(buffer_.data() + filled_, bytes.data(), taken);
  filled_ += taken;
  return taken;
}

// One plane into next_face_ and next_body_; what was consumed leaves the buffer.
Status FbaPlayback::decode_one() {
  decoder_.refill(buffer_.first(filled_), closed_);
  const Status status = decoder_.next(&plane_, &next_face_, &next_body_);
  const std::size_t consumed = decoder_.consumed_bytes();
  if (consumed > 0) {
    std::memmove(buffer_.data(), buffer_.data() + consumed, filled_ - consumed);
    filled_ -= consumed;
    decoder_.refill(buffer_.first(filled_), closed_);
  }
  return status;
}

void FbaPlayback::schedule(double time_s) {
  const double period_s = 1.0 / decoder_.rate().hertz();
  const double gap_s = decoder_.time_s() - stream_s_;
  stream_s_ = decoder_.time_s();
  due_s_ += gap_s >= 0.0 && gap_s <= kLongestGap_s ? gap_s : period_s;
  if (starved_ && due_s_ < time_s) due_s_ = time_s;
  starved_ = false;
  waiting_ = true;
}

bool FbaPlayback::advance(double time_s) {
  bool changed = false;
  while (!ended_) {
    if (waiting_) {
      if (due_s_ > time_s) return changed;
      waiting_ = false;
      changed = true;
      if (plane_.face) {
        face_ = next_face_;
        const auto held = decoder_.held_faps();
        for (std::size_t fap = 1; fap <= face::kFapCount; ++fap)
          if (held.test(fap)) face_.mask.set(fap);
        face::fill_from_partners(&face_, fit_);
        face::limit_to_coding_range(&face_);
        has_face_ = true;
      }
      if (plane_.body) {
        body_ = next_body_;
        has_body_ = true;
      }
    }
    const Status status = decode_one();
    if (status.ok()) {
      schedule(time_s);
    } else if (status.code != Code::not_ready) {
      last_fault_ = status;
    } else {
      // A plane longer than the whole buffer will never be complete.
      const bool need_more = status.detail == static_cast<std::uint16_t>(FbaFault::need_more);
      ended_ = !need_more || filled_ == buffer_.size();
      starved_ = true;
      return changed;
    }
  }
  return changed;
}

}  // namespace caryatid::stream
