// What speech adds to a frame: the mouth of a moment, brows and head, and the mixing of a mouth
// over a mood. A minute of English-like phones, 12 a second.
#include <memory>

#include "core/base/crc.h"
#include "core/base/random.h"
#include "core/speech/liveliness.h"
#include "core/speech/mouth.h"
#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

constexpr const char* kPhones[] = {"w", "ˈɛ", "l", "k", "ʌ", "m", "p",   "ɹ", "s", "f", "ˈaɪ",
                                   "v", "ɔː", "t", "ð", "ə", "n", "ˈiː", "b", "ʊ", "ʃ", ""};
constexpr float kFrame_ms = 1000.0f / 30.0f;

std::unique_ptr<speech::Utterance> minute() {
  auto out = std::make_unique<speech::Utterance>();
  Random random(3);
  std::int32_t t = 0;
  for (std::uint32_t i = 0; out->has_room(); ++i) {
    const char* ipa = kPhones[random.next() % std::size(kPhones)];
    if (i % 5 == 0) out->add_word(t, 6 * i, 6 * i + 5);
    (void)out->add_phone(t, speech::phoneme_of({ipa, std::char_traits<char>::length(ipa)}));
    t += 40 + static_cast<std::int32_t>(random.next() % 90);
  }
  out->finish(t);
  return out;
}

void mouth(benchmark::State& state) {
  const auto utterance = minute();
  const auto shapes = std::make_unique<speech::Mouth>();
  float t = 0.0f, sum = 0.0f;
  for ([[maybe_unused]] auto _ : state) {
    const speech::MouthShape m = shapes->at(*utterance, t, kFrame_ms);
    sum += m.faps.get(3);
    t += kFrame_ms;
    if (t > static_cast<float>(utterance->end_ms())) t = 0.0f;
  }
  benchmark::DoNotOptimize(sum);
  const speech::MouthShape m = shapes->at(*utterance, 5000.0f, kFrame_ms);
  state.SetLabel(label_of(hash_of(std::span<const float>(m.faps.value))));
}
BENCHMARK(mouth)->Name("speech/mouth");

void life(benchmark::State& state) {
  const auto utterance = minute();
  speech::Liveliness life(1);
  life.begin(1.0f);
  float t = 0.0f;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(life.step(*utterance, t, kFrame_ms * 1e-3f, true));
    t += kFrame_ms;
    if (t < static_cast<float>(utterance->end_ms())) continue;
    t = 0.0f;
    life.begin(1.0f);
  }
}
BENCHMARK(life)->Name("speech/life");

void phoneme(benchmark::State& state) {
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const char* ipa = kPhones[i++ % std::size(kPhones)];
    benchmark::DoNotOptimize(speech::phoneme_of({ipa, std::char_traits<char>::length(ipa)}));
  }
}
BENCHMARK(phoneme)->Name("speech/phoneme");

}  // namespace
}  // namespace caryatid::bench
