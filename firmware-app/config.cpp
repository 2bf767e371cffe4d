#include "firmware-app/config.h"

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <algorithm>

#include "firmware-app/config_devices.h"
#include "firmware-app/config_screen.h"

namespace caryatid::app {
namespace {

class Reader {
 public:
  Reader(std::string_view name, std::string* error) : name_(name), error_(error) {}

  bool read(const toml::table& root, Config* out) {
    DeviceRefusal refusal;
    if (!read_hid_devices(root, out, &refusal) || !read_screen(root, out, &refusal))
      return refuse(*refusal.where, refusal.what, refusal.cure);
    const toml::array* buttons = root["button"].as_array();
    if (buttons == nullptr || buttons->empty())
      return refuse(root, "there are no buttons", "add a [[button]] with a name");
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
    constexpr const char* kKnown[] = {
        "name", "badge", "feel", "say", "go",   "show",   "do",      "gesture",   "language",
        "gpio", "key",   "code", "bit", "long", "double", "long_ms", "double_ms", "lockout_ms"};
    for (const auto& [key, value] : *table)
      if (std::find(std::begin(kKnown), std::end(kKnown), key.str()) == std::end(kKnown))
        return refuse(value, "unknown key '" + std::string(key.str()) + "'",
                      "known here: name, badge, feel, say, go, show, do, gesture, language, gpio, "
                      "key, code, bit, long, double, long_ms, double_ms, lockout_ms");
    const std::string name = (*table)["name"].value_or(std::string());
    if (name.empty() || name.size() > 31 || name.find(' ') != std::string::npos)
      return refuse(node, "a button needs a name", "1 to 31 letters without a blank");
    if (out->buttons.find(name) >= 0)
      return refuse(node, "button '" + name + "' is there twice", "give it another name");
    if (!out->buttons.names.push(FixedString<31>(name)))
      return refuse(node, "too many buttons", "at most " + std::to_string(kMaxButtons));
    DeviceRefusal refusal;
    const auto number = static_cast<std::uint16_t>(out->buttons.names.size());
    if (!read_button_devices(*table, number, out, &refusal) ||
        !read_button_timing(*table, number, out, &refusal))
      return refuse(*refusal.where, refusal.what, refusal.cure);
    return true;
  }

  std::string_view name_;
  std::string* error_;
};

}  // namespace

int ButtonNames::find(std::string_view name) const {
  for (std::size_t b = 0; b < names.size(); ++b)
    if (name == names[b].c_str()) return static_cast<int>(b);
  return -1;
}

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
