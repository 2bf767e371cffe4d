#include "firmware-app/config.h"

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <algorithm>

#include "firmware-app/config_devices.h"

namespace caryatid::app {
namespace {

class Reader {
 public:
  Reader(std::string_view name, std::string* error) : name_(name), error_(error) {}

  bool read(const toml::table& root, Config* out) {
    for (const auto& [key, node] : root) {
      if (key.str() == "button" || key.str() == "hid") continue;
      return refuse(node, "unknown key '" + std::string(key.str()) + "'",
                    "known here: [[button]], [[hid]]");
    }
    DeviceRefusal refusal;
    if (!read_hid_devices(root, out, &refusal))
      return refuse(*refusal.where, refusal.what, refusal.cure);
    const toml::array* buttons = root["button"].as_array();
    if (buttons == nullptr || buttons->empty())
      return refuse(root, "there are no buttons", "add a [[button]] with name and feel");
    for (const toml::node& node : *buttons)
      if (!read_button(node, out)) return false;
    return true;
  }

 private:
  bool refuse(const toml::node& where, const std::string& what, const std::string& cure) {
    *error_ = std::string(name_) + ":" + std::to_string(where.source().begin.line) + ": " + what +
              "; " + cure;
    return false;
  }

  bool read_button(const toml::node& node, Config* out) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return refuse(node, "a button is not a table", "write [[button]]");
    constexpr const char* kKnown[] = {"name", "feel", "gpio", "key", "code", "bit"};
    for (const auto& [key, value] : *table)
      if (std::find(std::begin(kKnown), std::end(kKnown), key.str()) == std::end(kKnown))
        return refuse(value, "unknown key '" + std::string(key.str()) + "'",
                      "known here: name, feel, gpio, key, code, bit");
    const std::string name = (*table)["name"].value_or(std::string());
    if (name.empty() || name.size() > 31 || name.find(' ') != std::string::npos)
      return refuse(node, "a button needs a name", "1 to 31 letters without a blank");
    if (out->programme.find(name) >= 0)
      return refuse(node, "button '" + name + "' is there twice", "give it another name");
    agent::Button button{FixedString<31>(name), emotion::Emotion::calm};
    const std::string feel = (*table)["feel"].value_or(std::string());
    const auto& names = emotion::kEmotionNames;
    const auto found = std::find(names.begin(), names.end(), feel);
    if (found == names.end()) {
      std::string known;
      for (const std::string_view n : names) known += (known.empty() ? "" : ", ") + std::string(n);
      return refuse(node, "button '" + name + "' feels '" + feel + "'", "one of " + known);
    }
    button.feel = static_cast<emotion::Emotion>(found - names.begin());
    if (!out->programme.buttons.push(button))
      return refuse(node, "too many buttons", "at most " + std::to_string(kMaxButtons));
    DeviceRefusal refusal;
    const auto number = static_cast<std::uint16_t>(out->programme.buttons.size());
    if (!read_button_devices(*table, number, out, &refusal))
      return refuse(*refusal.where, refusal.what, refusal.cure);
    return true;
  }

  std::string_view name_;
  std::string* error_;
};

}  // namespace

bool parse_config(std::string_view text, std::string_view name, Config* out,
                  std::string* out_error) {
  *out = Config{};
  const toml::parse_result result = toml::parse(text, name);
  if (!result) {
    const toml::parse_error& e = result.error();
    *out_error = std::string(name) + ":" + std::to_string(e.source().begin.line) + ": " +
                 std::string(e.description()) + "; mend the line";
    std::replace(out_error->begin(), out_error->end(), '\n', ' ');
    return false;
  }
  return Reader(name, out_error).read(result.table(), out);
}

}  // namespace caryatid::app
