#pragma once
// The adaptive arithmetic coder of FBA streams (ISO/IEC 14496-2; the family of H.263 annex E):
// 16-bit registers, frequencies of at most 16383 in sum, one model for every parameter.
#include <array>
#include <cstdint>
#include <span>

#include "core/stream/bits.h"

namespace caryatid::stream {

// A symbol's share of a model: [low, high) of total.
struct Interval {
  std::uint32_t symbol = 0;
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t total = 0;
};

// One symbol that a model has seen.
struct ModelNode {
  std::uint16_t symbol = 0;
  std::uint16_t extra = 0;  // Frequency - 1.
  std::uint32_t next = 0;   // Index + 1 of the next lower symbol; 0 ends the list.
};

// Frequencies of the symbols 0..symbols-1. All start at 1 and halving keeps 1 at 1, so only symbols
// that were seen need memory: a list in falling order, in a pool that all models share. A face
// stream of minutes needs some thousand nodes; the worst case is one for every symbol.
struct AdaptiveModel {
  std::uint32_t first = 0;  // Index + 1 of the highest symbol seen.
  std::uint32_t extra_sum = 0;
};

class ModelPool {
 public:
  explicit ModelPool(std::span<ModelNode> nodes) : nodes_(nodes) {}
  // Nodes in use.
  std::size_t used() const { return used_ - free_count_; }
  // Back to equal frequencies; the nodes may be used again.
  void forget(AdaptiveModel* model);

  static std::uint32_t total(const AdaptiveModel& model, std::uint32_t symbols) {
    return symbols + model.extra_sum;
  }
  // The symbol that owns `target` (0..total-1). O(symbols seen).
  Interval find(const AdaptiveModel& model, std::uint32_t symbols, std::uint32_t target) const;
  // The share of a symbol. O(symbols seen).
  Interval share(const AdaptiveModel& model, std::uint32_t symbols, std::uint32_t symbol) const;
  // Counts a symbol, halving all frequencies first when their sum is 16383. False when the pool is
  // full; the model is then unchanged.
  [[nodiscard]] bool count(AdaptiveModel* model, std::uint32_t symbols, std::uint32_t symbol);

 private:
  void halve(AdaptiveModel* model);

  std::span<ModelNode> nodes_;
  std::size_t used_ = 0;    // Nodes that have ever been used.
  std::uint32_t free_ = 0;  // Index + 1 of the first node given back.
  std::size_t free_count_ = 0;
};

// Decodes one segment; start it where the segment starts, end it with finish().
class ArithmeticDecoder {
 public:
  explicit ArithmeticDecoder(BitReader* bits);
  // Where the next symbol lies, 0..total-1.
  std::uint32_t target(std::uint32_t total) const;
  void consume(const Interval& share);
  // Puts the reader behind the segment. False: a marker that must follow 22 zeros is missing.
  [[nodiscard]] bool finish();

 private:
  std::uint32_t next_bit();

  // The decoder is 16 bits ahead, of which the encoder's flush wrote two.
  static constexpr std::size_t kLookAhead = 14;
  BitReader* bits_;
  std::uint32_t low_ = 0;
  std::uint32_t high_ = 65535;
  std::uint32_t code_ = 0;
  int zeros_ = 0;
  std::size_t count_ = 0;
  std::size_t missing_marker_ = SIZE_MAX;  // Code bit at which a marker was first missing.
  std::array<std::size_t, 16> begin_{};    // Raw positions of the last 16 code bits.
};

// Encodes one segment.
class ArithmeticEncoder {
 public:
  explicit ArithmeticEncoder(BitWriter* bits) : bits_(bits) {}
  void encode(const Interval& share);
  void finish();

 private:
  void put(std::uint32_t bit);
  void out(std::uint32_t bit);

  BitWriter* bits_;
  std::uint32_t low_ = 0;
  std::uint32_t high_ = 65535;
  std::uint32_t opposite_ = 0;
  int zeros_ = 0;
};

}  // namespace caryatid::stream
