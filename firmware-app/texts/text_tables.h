#pragma once
// The texts of one language: texts/CODE.toml beside kiosk.toml, as "page.key" -> text.
#include <map>
#include <string>
#include <vector>

#include "firmware-app/texts/files.h"

namespace caryatid::app {

struct TextEntry {
  std::string text;
  std::size_t line = 0;  // Of the file, on which the text begins.
};

struct TextTable {
  std::string code;  // "el"
  std::string file;  // For messages.
  std::string name = {}, voice = {};
  std::map<std::string, TextEntry> texts;
  std::vector<std::string> weekdays, months;  // From Monday, from January; whole or empty.
  std::string closed, open;
  bool loaded = false;
};

// Reads texts/CODE.toml. A file that is not there or no TOML leaves an empty table and a message;
// needed: whether it is wrong of the file to be away.
TextTable load_texts(const std::string& code, bool needed, ProgrammeFiles& files,
                     Messages* messages);

// Largest text file that is read.
inline constexpr std::size_t kMostTextFileBytes = 512 * 1024;

}  // namespace caryatid::app
