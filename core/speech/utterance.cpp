#include "core/speech/utterance.h"

#include <algorithm>

namespace caryatid::speech {
namespace {

// Removes the first `count` elements of a fixed vector.
template <class Vector>
void drop_front(Vector& v, std::size_t count) {
  if (count == 0) return;
  const std::size_t left = v.size() - count;
  std::move(v.begin() + count, v.end(), v.begin());
  while (v.size() > left) v.pop();
}

}  // namespace

std::int32_t Utterance::in_order(std::int32_t time_ms) {
  const std::int32_t own_ms = base_ms_ + std::max(time_ms, 0);
  end_ms_ = std::max(end_ms_, own_ms);
  return own_ms;
}

Status Utterance::add_phone(std::int32_t start_ms, const Phoneme& phoneme) {
  const std::int32_t least = phones_.empty() ? 0 : phones_[phones_.size() - 1].start_ms;
  const std::int32_t start = std::max(in_order(start_ms), least);
  if (!phones_.push({start, phoneme})) return {Code::out_of_capacity, 0};
  if (words_.empty()) return {};
  Word& word = words_[words_.size() - 1];
  if (phoneme.begins.silent()) {
    if (word.end_ms < 0) word.end_ms = start;
  } else if (phoneme.stressed && word.end_ms < 0 && word.stress_ms < 0) {
    word.stress_ms = start;
  }
  return {};
}

void Utterance::add_word(std::int32_t start_ms, std::uint32_t begin_byte, std::uint32_t end_byte) {
  const std::int32_t least = words_.empty() ? 0 : words_[words_.size() - 1].start_ms;
  const std::int32_t start = std::max(in_order(start_ms), least);
  if (!words_.empty() && words_[words_.size() - 1].end_ms < 0)
    words_[words_.size() - 1].end_ms = start;
  const Word word{base_byte_ + begin_byte, base_byte_ + std::max(begin_byte, end_byte), start, -1,
                  -1};
  if (!words_.push(word)) ++dropped_;
}

void Utterance::add_mark(std::int32_t time_ms, std::span<const char> name) {
  const std::int32_t least = marks_.empty() ? 0 : marks_[marks_.size() - 1].time_ms;
  Mark mark{FixedString<23>(name), std::max(in_order(time_ms), least)};
  if (!marks_.push(mark)) ++dropped_;
}

void Utterance::add_sentence(std::int32_t start_ms) {
  const std::int32_t start = in_order(start_ms);
  // The oldest one that waits is heard first; a later breath is dispensable.
  (void)sentences_.push(start);
}

void Utterance::finish(std::int32_t end_ms) {
  end_ms_ = std::max(end_ms_, base_ms_ + end_ms);
  if (!words_.empty() && words_[words_.size() - 1].end_ms < 0)
    words_[words_.size() - 1].end_ms = end_ms_;
  finished_ = true;
}

void Utterance::continue_at(std::int32_t base_ms, std::uint32_t base_byte) {
  end_ms_ = std::max(end_ms_, base_ms);
  finish(0);
  base_ms_ = std::max(base_ms, 0);
  base_byte_ = base_byte;
  finished_ = false;
}

void Utterance::forget_before(std::int32_t heard_ms) {
  std::size_t phones = 0;
  while (phones + 1 < phones_.size() && phones_[phones + 1].start_ms <= heard_ms) ++phones;
  drop_front(phones_, phones);
  std::size_t sentences = 0;
  while (sentences < sentences_.size() && sentences_[sentences] <= heard_ms) ++sentences;
  drop_front(sentences_, sentences);
}

int Utterance::word_at(std::int32_t now_ms) const {
  const Word* after =
      std::upper_bound(words_.begin(), words_.end(), now_ms,
                       [](std::int32_t t, const Word& w) { return t < w.start_ms; });
  return static_cast<int>(after - words_.begin()) - 1;
}

}  // namespace caryatid::speech
