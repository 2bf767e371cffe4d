#pragma once
// The tables of kiosk.toml: what buttons and pages bring about, when the kiosk is open.
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "firmware-app/texts/builder.h"
#include "firmware-app/texts/messages.h"

namespace caryatid::app {

// Texts that pages and buttons refer to, numbered in the order of their first use.
struct TextUse {
  std::string key;
  std::size_t line = 0;   // Of kiosk.toml.
  bool optional = false;  // By convention only ("PAGE.title"): no fault where it is missing.
};

// Reads kiosk.toml into a builder. The languages must be in the builder already.
class ProgrammeReader {
 public:
  ProgrammeReader(const std::string& file, ProgrammeBuilder* builder, Messages* messages)
      : file_(file), builder_(*builder), messages_(*messages) {}

  void read(const toml::table& root);
  const std::vector<TextUse>& texts() const { return texts_; }
  const std::map<std::string, std::string>& constants() const { return constants_; }
  // Opening hours of each day as they are shown; empty: closed.
  const std::array<std::string, 7>& hours() const { return hours_; }
  // Codes and files of pictures, for those that load them.
  static std::vector<std::string> language_codes(const toml::table& root);

 private:
  void wrong(const toml::node& node, const std::string& what);
  bool known_keys(const toml::table& table, const char* const* first, const char* const* last);
  std::uint16_t text(const std::string& key, const toml::node* where, bool optional);
  void check_kinds(const toml::table& root);
  void check_twice(const toml::table& root, const char* key);
  void read_names(const toml::table& root);
  void read_button(const toml::table& table);
  void read_page(const toml::table& table, std::size_t index);
  void read_choice(const std::string& button, const toml::node& node, agent::Page* page);
  void read_picture(const toml::table& table);
  agent::Action read_action(const toml::table& table);
  void read_schedule(const toml::table& root);
  void read_hours(const toml::table& table);
  void read_night(const toml::table& table);
  void read_attract(const toml::table& table);
  bool minutes(const toml::node& node, std::string_view text, std::uint16_t* out);
  int find(const std::vector<std::string>& names, const toml::node& node, const char* kind);

  std::string file_;
  ProgrammeBuilder& builder_;
  Messages& messages_;
  std::vector<TextUse> texts_;
  std::map<std::string, std::uint16_t> text_numbers_;
  std::map<std::string, std::string> constants_;
  std::vector<std::string> button_names_, page_names_, picture_names_, codes_;
  std::array<std::string, 7> hours_{};
};

}  // namespace caryatid::app
