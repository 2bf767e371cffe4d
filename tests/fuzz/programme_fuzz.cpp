// Compiled programmes: any bytes are refused, or can be walked through, spoken and laid out without
// reading a byte outside of their block.
#include <cstring>
#include <memory>
#include <vector>

#include "core/agent/guide.h"
#include "core/agent/ssml.h"
#include "core/base/crc.h"
#include "core/scene/text.h"

namespace {

// Seals what a fuzzer changed: without a true CRC nothing behind the first check would be reached.
void seal(std::span<std::byte> block) {
  using namespace caryatid::agent;
  ProgrammeHeader h;
  if (block.size() < sizeof h) return;
  std::memcpy(&h, block.data(), sizeof h);
  std::memcpy(h.magic, kProgrammeMagic, sizeof h.magic);
  h.version = kProgrammeVersion;
  h.bytes = static_cast<std::uint32_t>(block.size());
  h.font_crc = 0;
  std::memcpy(block.data(), &h, sizeof h);
  h.crc = caryatid::crc32c(block.subspan(kProgrammeCrcStart));
  std::memcpy(block.data(), &h, sizeof h);
}

void walk(const caryatid::agent::Programme& programme) {
  using namespace caryatid;
  const auto guide = std::make_unique<agent::Guide>();
  const auto said = std::make_unique<agent::Utterable>();
  const auto ssml = std::make_unique<agent::Ssml>();
  guide->take(programme);
  const agent::Moment now{6, 31, 12, 1439};
  for (std::uint16_t b = 0; b <= kMaxButtons; ++b) {
    const ButtonEvent event{b, true, 0};
    (void)guide->step(0.2f, {&event, 1}, now, false);
  }
  for (const agent::Line& line : programme.lines) {
    if (line.is_there == 0) continue;
    agent::expand(programme, line, now, said.get());
    ssml->write(programme, *said);
    (void)ssml->plain_byte(77);
    scene::TextLines lines;
    scene::break_lines(said->runs.span(), 20000, &lines);
    std::vector<std::uint16_t> order(kMaxRuns);
    for (const scene::TextLine& l : lines)
      scene::visual_order(said->runs.span().subspan(l.first_run, l.run_count), order);
    for (const scene::Run& r : said->runs)
      for (const scene::ShapedGlyph& g : r.glyphs)
        if (g.glyph >= 64) __builtin_trap();
  }
  guide->take(programme);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid;
  if (size < 5 || size > (1u << 16)) return 0;
  std::vector<std::uint32_t> words((size - 1) / 4);
  const auto block = std::as_writable_bytes(std::span(words));
  std::memcpy(block.data(), data + 1, block.size());
  if ((data[0] & 1) != 0) seal(block);
  const auto programme = agent::read_programme(block, 0, 64);
  if (programme.ok()) walk(programme.value);
  return 0;
}
