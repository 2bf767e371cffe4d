#pragma once
// Compiles a programme from texts in memory, with the real font.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "firmware-app/texts/compile.h"

namespace caryatid::app {

inline const std::string kSource = CARYATID_SOURCE_DIR;

inline std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline const pack::FontView& test_font() {
  static const std::string bytes = file_text(kSource + "/firmware-app/builtin_font.pack");
  static const pack::FontView font =
      pack::read_font(std::as_bytes(std::span(bytes.data(), bytes.size()))).value;
  return font;
}

// Files by name; "kiosk.toml" is the configuration.
struct DeskOf {
  explicit DeskOf(std::vector<BuiltinFile> files_in) {
    ProgrammeFiles files("", std::move(files_in));
    compiled = compile_programme(files, test_font());
    if (compiled.block.empty()) return;
    words.resize((compiled.block.size() + 3) / 4);
    std::memcpy(words.data(), compiled.block.data(), compiled.block.size());
    const auto read =
        agent::read_programme(std::as_bytes(std::span(words)).first(compiled.block.size()),
                              test_font().header->crc, test_font().glyphs.size());
    EXPECT_TRUE(read.ok()) << agent::refusal_text(
        static_cast<agent::ProgrammeRefusal>(read.status.detail));
    programme = read.value;
  }
  std::string messages() const {
    std::string all;
    for (const Message& m : compiled.messages.all()) all += m.line + "\n";
    return all;
  }
  // Text of a page's `say`, variables filled in.
  std::string said(std::uint16_t page, std::uint16_t language, const agent::Moment& now = {}) {
    const agent::Line* line = programme.line(programme.pages[page].enter.say, language);
    if (line == nullptr) return "(none)";
    agent::expand(programme, *line, now, &expanded);
    return {expanded.text.begin(), expanded.text.end()};
  }

  CompiledProgramme compiled;
  std::vector<std::uint32_t> words;
  agent::Programme programme;
  agent::Utterable expanded;
};

}  // namespace caryatid::app
