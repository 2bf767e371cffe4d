#pragma once
// A compiled programme written by hand: pages welcome and maps, two languages, five buttons.
#include <cstring>
#include <string>
#include <vector>

#include "core/agent/programme.h"
#include "core/base/crc.h"

namespace caryatid::agent {

class SmallProgramme {
 public:
  enum Pages : std::uint16_t { kWelcome, kMaps };
  enum Buttons : std::uint16_t { kGoMaps = 1, kLanguage, kLarge, kContrast, kBack };

  SmallProgramme() {
    ProgrammeHeader h{};
    std::memcpy(h.magic, kProgrammeMagic, sizeof h.magic);
    h.version = kProgrammeVersion;
    h.text_count = 1;
    for (auto& day : h.schedule.open) day[0] = 9 * 60, day[1] = 18 * 60;
    h.schedule.night_from = 22 * 60;
    h.schedule.night_to = 6 * 60;
    h.schedule.night_volume = 30;
    h.schedule.sleeps = 1;
    h.attract = {10, 20, {}};
    h.attract.action.say = 0;
    words_.resize(sizeof h / 4);
    add(&h, ProgrammeSection::bytes, std::vector<char>{'w', 'm', 'e', 'l', 'h', 'i', ' ', 'x'});
    add(&h, ProgrammeSection::languages,
        std::vector<Language>{{{2, 1}, {2, 1}, {2, 1}}, {{3, 1}, {3, 1}, {3, 1}}});
    add(&h, ProgrammeSection::buttons, buttons());
    add(&h, ProgrammeSection::pages, pages());
    Choice again;
    again.button = kGoMaps;
    again.action.feel = 1;
    add(&h, ProgrammeSection::choices, std::vector<Choice>{again});
    add(&h, ProgrammeSection::pictures, std::vector<PictureRecord>{{{0, 1}, 0, 0}});
    const Line line{{4, 4}, {0, 3}, {0, 1}, 0, 1};
    add(&h, ProgrammeSection::lines, std::vector<Line>{line, line});
    std::vector<Segment> segments(3);
    segments[0] = {0, 2, 0, 2, 0, 0, 1000, 0, {}};
    segments[1] = {0, 0, 2, 3, 0, kBlank | kBreakAfter, 300, 0, {}};
    segments[2] = {2, 1, 3, 4, 0, 0, 500, 0, {}};
    add(&h, ProgrammeSection::segments, segments);
    add(&h, ProgrammeSection::glyphs,
        std::vector<scene::ShapedGlyph>{{1, 500, 0, 0}, {2, 500, 0, 0}, {3, 500, 0, 0}});
    add(&h, ProgrammeSection::cues, std::vector<Cue>{{2, CueKind::pause, 0, 300}});
    add(&h, ProgrammeSection::values, std::vector<Value>(2 * kValueCount));
    h.bytes = static_cast<std::uint32_t>(words_.size() * 4);
    std::memcpy(words_.data(), &h, sizeof h);
    seal(&words_);
  }

  static void seal(std::vector<std::uint32_t>* words) {
    const auto block = std::as_writable_bytes(std::span(*words));
    const std::uint32_t crc = crc32c(block.subspan(kProgrammeCrcStart));
    std::memcpy(block.data() + offsetof(ProgrammeHeader, crc), &crc, sizeof crc);
  }
  const std::vector<std::uint32_t>& words() const { return words_; }
  Programme programme() const {
    return read_programme(std::as_bytes(std::span(words_)), 0, 10).value;
  }

 private:
  template <class T>
  void add(ProgrammeHeader* h, ProgrammeSection id, const std::vector<T>& items) {
    h->section[static_cast<std::size_t>(id)] = {static_cast<std::uint32_t>(words_.size() * 4),
                                                static_cast<std::uint32_t>(items.size())};
    const std::size_t at = words_.size(), bytes = items.size() * sizeof(T);
    words_.resize(at + (bytes + 3) / 4);
    std::memcpy(words_.data() + at, items.data(), bytes);
  }
  static std::vector<ButtonRecord> buttons() {
    std::vector<ButtonRecord> out(5);
    out[0].action.page = kMaps;
    const Command commands[] = {Command::next_language, Command::large_text, Command::high_contrast,
                                Command::back};
    for (std::size_t i = 0; i < 4; ++i)
      out[i + 1].action.command = static_cast<std::uint8_t>(commands[i]);
    return out;
  }
  static std::vector<Page> pages() {
    std::vector<Page> out(2);
    out[kWelcome].name = {0, 1};
    out[kMaps].name = {1, 1};
    out[kMaps].enter.say = 0;
    out[kMaps].enter.picture = 0;
    out[kMaps].enter.feel = static_cast<std::uint8_t>(6);
    out[kMaps].choice_count = 1;
    return out;
  }

  std::vector<std::uint32_t> words_;
};

}  // namespace caryatid::agent
