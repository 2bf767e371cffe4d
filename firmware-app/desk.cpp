#include "firmware-app/desk.h"

#include <cstdio>
#include <cstring>

#include "firmware-app/builtin.h"

namespace caryatid::app {
namespace {

void print(const Messages& messages) {
  for (const Message& m : messages.all()) std::fprintf(stderr, "caryatid: %s\n", m.line.c_str());
}

}  // namespace

bool Desk::compile(const std::string& config, CompiledProgramme* out) {
  const Result<pack::FontView> font = pack::read_font(builtin_font());
  if (!font.ok()) return false;
  font_ = font.value;
  ProgrammeFiles files(config, builtin_programme());
  *out = compile_programme(files, font_);
  return !out->block.empty();
}

bool Desk::open(const std::string& config) {
  CompiledProgramme compiled;
  bool good = compile(config, &compiled);
  print(compiled.messages);
  if (!good && !config.empty()) {
    std::fputs("caryatid: the built-in programme stands in\n", stderr);
    good = compile("", &compiled);
  }
  compiled_ = std::move(compiled.block);
  return good;
}

bool Desk::check(const std::string& config) {
  Desk desk;
  CompiledProgramme compiled;
  const bool good = desk.compile(config, &compiled);
  print(compiled.messages);
  return good && compiled.messages.all().empty();
}

bool Desk::take_memory(Arena& arena) {
  for (auto& slot : slots_)
    slot = arena.take<std::uint32_t>(kMaxProgrammeBytes / sizeof(std::uint32_t));
  if (slots_[1].empty()) return false;
  std::memcpy(slots_[0].data(), compiled_.data(), compiled_.size());
  const auto programme = agent::read_programme(std::as_bytes(slots_[0]).first(compiled_.size()),
                                               font_.header->crc, font_.glyphs.size());
  compiled_ = {};
  if (programme.ok()) guide_.take(programme.value);
  return programme.ok();
}

const agent::Guidance& Desk::step(float dt_s, std::span<const ButtonEvent> events,
                                  const agent::Moment& now, bool speaking) {
  const agent::Guidance& g = guide_.step(dt_s, events, now, speaking);
  if (g.says) {
    const agent::Line* line = programme().line(g.say, g.language);
    if (line != nullptr) {
      agent::expand(programme(), *line, now, &said_);
      ssml_.write(programme(), said_);
    }
  }
  return g;
}

std::string_view Desk::voice() const {
  return programme().text(programme().languages[said_.language].voice);
}

}  // namespace caryatid::app
