// What texts and captions cost a frame: filling in variables, and the overlay when it is made anew
// (a word further) and when nothing changed.
#include <benchmark/benchmark.h>

#include <memory>

#include "core/agent/signboard.h"
#include "core/base/crc.h"
#include "tests/unit/core/agent/small_programme.h"

namespace caryatid {
namespace {

struct Signs {
  Signs() {
    header.em_px = 30;
    header.spread_px = 4;
    header.atlas_width = header.atlas_height = 256;
    header.box_glyph = 9;
    for (std::uint16_t g = 0; g < 10; ++g) glyphs[g] = {g, g, 0, 20, 30, 0, 1800, 0};
    font.header = &header;
    font.glyphs = glyphs;
    guide.take(small.programme());
    const ButtonEvent press{agent::SmallProgramme::kGoMaps, true, 0};
    (void)guide.step(0.03f, {&press, 1}, {}, false);
    agent::expand(small.programme(), *small.programme().line(0, 0), {}, said.get());
    board->start(font);
    input.programme = &guide.programme();
    input.guidance = &guide.guidance();
    input.said = said.get();
    input.speaking = true;
    for (int i = 0; i < 200; ++i) show(0);
  }
  scene::Overlay show(std::int32_t word) {
    input.word_byte = word;
    (void)board->stage(input, 0.03f);
    return board->overlay(input, 0.03f);
  }

  pack::FontHeader header{};
  std::array<pack::FontGlyph, 10> glyphs{};
  pack::FontView font;
  agent::SmallProgramme small;
  agent::Guide guide;
  std::unique_ptr<agent::Utterable> said = std::make_unique<agent::Utterable>();
  std::unique_ptr<agent::Signboard> board = std::make_unique<agent::Signboard>();
  agent::SignboardInput input;
};

void unchanged(benchmark::State& state) {
  Signs signs;
  for (auto _ : state) benchmark::DoNotOptimize(signs.show(0));
}
BENCHMARK(unchanged)->Name("signs/unchanged")->Unit(benchmark::kMicrosecond);

void next_word(benchmark::State& state) {
  Signs signs;
  std::int32_t word = 0;
  for (auto _ : state) benchmark::DoNotOptimize(signs.show(word = 3 - word));
}
BENCHMARK(next_word)->Name("signs/next_word")->Unit(benchmark::kMicrosecond);

void guide_step(benchmark::State& state) {
  Signs signs;
  for (auto _ : state) benchmark::DoNotOptimize(signs.guide.step(0.03f, {}, {}, false));
}
BENCHMARK(guide_step)->Name("signs/guide_step")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace caryatid
