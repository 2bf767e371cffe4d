#include "core/stream/arithmetic.h"

namespace caryatid::stream {
namespace {

constexpr std::uint32_t kQuarter = 16384;
constexpr std::uint32_t kHalf = 32768;
constexpr std::uint32_t kThreeQuarters = 49152;
constexpr std::uint32_t kTop = 65535;
constexpr std::uint32_t kMaxTotal = 16383;
constexpr int kMaxZeros = 22;  // After so many a 1 is inserted: no start code can arise.

}  // namespace

// Cumulative frequencies run from the highest symbol down, so the highest owns the interval at 0.
Interval ModelPool::find(const AdaptiveModel& model, std::uint32_t symbols,
                         std::uint32_t target) const {
  const std::uint32_t all = total(model, symbols);
  std::uint32_t below = 0;        // Frequencies of all symbols >= above.
  std::uint32_t above = symbols;  // Lowest symbol passed so far.
  for (std::uint32_t at = model.first; at != 0; at = nodes_[at - 1].next) {
    const ModelNode& node = nodes_[at - 1];
    const std::uint32_t gap = above - node.symbol - 1u;
    if (target < below + gap) break;
    below += gap;
    const std::uint32_t frequency = node.extra + 1u;
    if (target < below + frequency) return {node.symbol, below, below + frequency, all};
    below += frequency;
    above = node.symbol;
  }
  return {above - 1 - (target - below), target, target + 1, all};
}

Interval ModelPool::share(const AdaptiveModel& model, std::uint32_t symbols,
                          std::uint32_t symbol) const {
  const std::uint32_t all = total(model, symbols);
  std::uint32_t low = symbols - 1 - symbol;
  for (std::uint32_t at = model.first; at != 0; at = nodes_[at - 1].next) {
    const ModelNode& node = nodes_[at - 1];
    if (node.symbol == symbol) return {symbol, low, low + node.extra + 1u, all};
    if (node.symbol < symbol) break;
    low += node.extra;
  }
  return {symbol, low, low + 1, all};
}

void ModelPool::halve(AdaptiveModel* model) {
  model->extra_sum = 0;
  for (std::uint32_t at = model->first; at != 0; at = nodes_[at - 1].next) {
    ModelNode& node = nodes_[at - 1];
    node.extra = static_cast<std::uint16_t>((node.extra + 2u) / 2u - 1u);
    model->extra_sum += node.extra;
  }
}

void ModelPool::forget(AdaptiveModel* model) {
  std::uint32_t at = model->first;
  while (at != 0) {
    const std::uint32_t next = nodes_[at - 1].next;
    nodes_[at - 1].next = free_;
    free_ = at;
    ++free_count_;
    at = next;
  }
  *model = {};
}

bool ModelPool::count(AdaptiveModel* model, std::uint32_t symbols, std::uint32_t symbol) {
  std::uint32_t* link = &model->first;
  while (*link != 0 && nodes_[*link - 1].symbol > symbol) link = &nodes_[*link - 1].next;
  const bool known = *link != 0 && nodes_[*link - 1].symbol == symbol;
  if (!known && free_ == 0 && used_ == nodes_.size()) return false;
  if (total(*model, symbols) == kMaxTotal) halve(model);
  if (!known) {
    std::uint32_t fresh = free_;
    if (fresh != 0) {
      free_ = nodes_[fresh - 1].next;
      --free_count_;
    } else {
      fresh = static_cast<std::uint32_t>(++used_);
    }
    nodes_[fresh - 1] = {static_cast<std::uint16_t>(symbol), 0, *link};
    *link = fresh;
  }
  ++nodes_[*link - 1].extra;
  ++model->extra_sum;
  return true;
}

ArithmeticDecoder::ArithmeticDecoder(BitReader* bits) : bits_(bits) {
  for (int i = 0; i < 16; ++i) code_ = code_ << 1 | next_bit();
}

// A marker that is absent within the look-ahead is no fault: those zeros belong to what follows the
// segment. finish() decides.
std::uint32_t ArithmeticDecoder::next_bit() {
  begin_[count_ % begin_.size()] = bits_->position();
  std::uint32_t bit = bits_->bit();
  if (zeros_ == kMaxZeros) {
    if (bit == 0) {
      if (missing_marker_ == SIZE_MAX) missing_marker_ = count_;
      zeros_ = 0;
    } else {
      bit = bits_->bit();
      zeros_ = bit == 0 ? 1 : 0;
    }
  } else {
    zeros_ = bit == 0 ? zeros_ + 1 : 0;
  }
  ++count_;
  return bit;
}

std::uint32_t ArithmeticDecoder::target(std::uint32_t total) const {
  const std::uint32_t length = high_ - low_ + 1;
  return ((code_ - low_ + 1) * total - 1) / length;
}

void ArithmeticDecoder::consume(const Interval& share) {
  const std::uint32_t length = high_ - low_ + 1;
  high_ = low_ - 1 + length * share.high / share.total;
  low_ = low_ + length * share.low / share.total;
  while (true) {
    std::uint32_t base = 0;
    if (high_ < kHalf) {
      base = 0;
    } else if (low_ >= kHalf) {
      base = kHalf;
    } else if (low_ >= kQuarter && high_ < kThreeQuarters) {
      base = kQuarter;
    } else {
      return;
    }
    low_ = 2 * (low_ - base);
    high_ = 2 * (high_ - base) + 1;
    code_ = 2 * (code_ - base) + next_bit();
  }
}

bool ArithmeticDecoder::finish() {
  bits_->seek(begin_[(count_ - kLookAhead) % begin_.size()]);
  return missing_marker_ == SIZE_MAX || missing_marker_ >= count_ - kLookAhead;
}

void ArithmeticEncoder::put(std::uint32_t bit) {
  if (zeros_ == kMaxZeros) {
    bits_->bit(1);
    zeros_ = 0;
  }
  bits_->bit(bit);
  zeros_ = bit == 0 ? zeros_ + 1 : 0;
}

void ArithmeticEncoder::out(std::uint32_t bit) {
  put(bit);
  for (; opposite_ > 0; --opposite_) put(bit ^ 1u);
}

void ArithmeticEncoder::encode(const Interval& share) {
  const std::uint32_t length = high_ - low_ + 1;
  high_ = low_ - 1 + length * share.high / share.total;
  low_ = low_ + length * share.low / share.total;
  while (true) {
    std::uint32_t base = 0;
    if (high_ < kHalf) {
      out(0);
    } else if (low_ >= kHalf) {
      out(1);
      base = kHalf;
    } else if (low_ >= kQuarter && high_ < kThreeQuarters) {
      ++opposite_;
      base = kQuarter;
    } else {
      return;
    }
    low_ = 2 * (low_ - base);
    high_ = 2 * (high_ - base) + 1;
  }
}

void ArithmeticEncoder::finish() {
  ++opposite_;
  out(low_ < kQuarter ? 0 : 1);
}

}  // namespace caryatid::stream
