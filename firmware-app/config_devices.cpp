#include "firmware-app/config_devices.h"

#include <algorithm>
#include <optional>

namespace caryatid::app {
namespace {

using platform::GpioBias;
using platform::GpioLine;
using platform::HidDevice;
using platform::HidKey;
using platform::HidKind;

bool refuse(const toml::node& where, std::string what, std::string cure, DeviceRefusal* out) {
  *out = {&where, std::move(what), std::move(cure)};
  return false;
}

// The first key of `table` that is not among `known`, or nullptr.
const toml::node* unknown_key(const toml::table& table, std::initializer_list<const char*> known,
                              std::string* out_name) {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    *out_name = key.str();
    return &value;
  }
  return nullptr;
}

// An integer of the table from 0 to `most`; nothing when it is absent or out of range.
std::optional<std::int64_t> number_of(const toml::table& table, const char* key,
                                      std::int64_t most) {
  const std::optional<std::int64_t> value = table[key].value<std::int64_t>();
  if (!value || *value < 0 || *value > most) return std::nullopt;
  return value;
}

bool read_gpio_table(const toml::table& table, GpioLine* line, DeviceRefusal* out_refusal) {
  std::string name;
  if (const toml::node* node = unknown_key(
          table, {"chip", "line", "offset", "bias", "active_low", "debounce_us"}, &name))
    return refuse(*node, "unknown key '" + name + "' of gpio",
                  "known here: chip, line, offset, bias, active_low, debounce_us", out_refusal);
  line->chip.assign(table["chip"].value_or(std::string()));
  line->line.assign(table["line"].value_or(std::string()));
  const auto offset = number_of(table, "offset", 4095);
  if (line->line.size() == 0 && (line->chip.size() == 0 || !offset))
    return refuse(table, "gpio names no line", "write line = \"NAME\", or chip and offset",
                  out_refusal);
  line->offset = static_cast<std::uint32_t>(offset.value_or(0));
  line->active_low = table["active_low"].value_or(true);
  if (table.contains("debounce_us")) {
    const auto debounce_us = number_of(table, "debounce_us", 1'000'000);
    if (!debounce_us)
      return refuse(table, "debounce_us is no time", "0 to 1000000; 0 is best", out_refusal);
    line->kernel_debounce_us = static_cast<std::uint32_t>(*debounce_us);
  }
  constexpr const char* kBiases[] = {"as-is", "disabled", "pull-up", "pull-down"};
  const std::string bias = table["bias"].value_or(std::string("pull-up"));
  const auto found = std::find(std::begin(kBiases), std::end(kBiases), bias);
  if (found == std::end(kBiases))
    return refuse(table, "bias '" + bias + "'", "one of as-is, disabled, pull-up, pull-down",
                  out_refusal);
  line->bias = static_cast<GpioBias>(found - std::begin(kBiases));
  return true;
}

bool read_gpio(const toml::node& node, std::uint16_t button, Config* out,
               DeviceRefusal* out_refusal) {
  GpioLine line;
  line.button = button;
  if (const auto name = node.value<std::string>()) {
    line.line.assign(*name);
    if (name->empty())
      return refuse(node, "gpio names no line", "write the line's name", out_refusal);
  } else if (const toml::table* table = node.as_table()) {
    if (!read_gpio_table(*table, &line, out_refusal)) return false;
  } else {
    return refuse(node, "gpio is neither a name nor a table",
                  "write gpio = \"NAME\" or gpio = { chip = \"gpiochip0\", offset = 17 }",
                  out_refusal);
  }
  if (!out->gpio.push(line))
    return refuse(node, "too many GPIO lines", "at most " + std::to_string(kMaxButtons),
                  out_refusal);
  return true;
}

// Keyboard page of the HID Usage Tables 1.12, section 10: letters from 4, 1..9 from 30, 0 is 39.
std::uint8_t usage_of(const std::string& key) {
  if (key.size() == 1 && key[0] >= 'a' && key[0] <= 'z')
    return static_cast<std::uint8_t>(4 + (key[0] - 'a'));
  if (key.size() == 1 && key[0] >= '1' && key[0] <= '9')
    return static_cast<std::uint8_t>(30 + (key[0] - '1'));
  if (key == "0") return 39;
  if (key == "enter") return 40;
  if (key == "space") return 44;
  return 0;
}

// Gives `key` to every listed device of this kind.
bool add_key(const toml::node& node, const HidKey& key, HidKind kind, Config* out,
             DeviceRefusal* out_refusal) {
  bool given = false;
  for (HidDevice& device : out->hid) {
    if (device.kind != kind) continue;
    if (!device.keys.push(key))
      return refuse(node, "too many keys", "at most " + std::to_string(kMaxButtons), out_refusal);
    given = true;
  }
  if (given) return true;
  return refuse(node, "no [[hid]] device has such keys", "add a [[hid]] of the fitting kind",
                out_refusal);
}

}  // namespace

bool read_hid_devices(const toml::table& root, Config* out, DeviceRefusal* out_refusal) {
  const toml::node* node = root.get("hid");
  if (node == nullptr) return true;
  const toml::array* devices = node->as_array();
  if (devices == nullptr) return refuse(*node, "hid is not a table", "write [[hid]]", out_refusal);
  for (const toml::node& entry : *devices) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) return refuse(entry, "hid is not a table", "write [[hid]]", out_refusal);
    std::string name;
    if (const toml::node* unknown = unknown_key(
            *table, {"vendor", "product", "kind", "usage_page", "usage", "report"}, &name))
      return refuse(*unknown, "unknown key '" + name + "' of hid",
                    "known here: vendor, product, kind, usage_page, usage, report", out_refusal);
    const auto vendor = number_of(*table, "vendor", 0xffff);
    const auto product = number_of(*table, "product", 0xffff);
    if (!vendor || !product || *vendor == 0 || *product == 0)
      return refuse(entry, "hid needs vendor and product",
                    "write them as lsusb shows them: vendor = 0x1234", out_refusal);
    constexpr const char* kKinds[] = {"keyboard", "reader", "box"};
    const std::string kind = (*table)["kind"].value_or(std::string("keyboard"));
    const auto found = std::find(std::begin(kKinds), std::end(kKinds), kind);
    if (found == std::end(kKinds))
      return refuse(entry, "hid kind '" + kind + "'", "one of keyboard, reader, box", out_refusal);
    HidDevice device;
    device.vendor_id = static_cast<std::uint16_t>(*vendor);
    device.product_id = static_cast<std::uint16_t>(*product);
    device.kind = static_cast<HidKind>(found - std::begin(kKinds));
    device.usage_page =
        static_cast<std::uint16_t>(number_of(*table, "usage_page", 0xffff).value_or(0));
    device.usage = static_cast<std::uint16_t>(number_of(*table, "usage", 0xffff).value_or(0));
    device.report_id = static_cast<std::uint8_t>(number_of(*table, "report", 0xff).value_or(0));
    if (!out->hid.push(device))
      return refuse(entry, "too many HID devices",
                    "at most " + std::to_string(platform::kMaxHidDevices), out_refusal);
  }
  return true;
}

bool read_button_devices(const toml::table& button, std::uint16_t number, Config* out,
                         DeviceRefusal* out_refusal) {
  if (const toml::node* node = button.get("gpio"))
    if (!read_gpio(*node, number, out, out_refusal)) return false;
  if (const toml::node* node = button.get("key")) {
    HidKey key;
    key.button = number;
    const auto usage = node->value<std::int64_t>();
    key.usage = usage && *usage > 3 && *usage < 256 ? static_cast<std::uint8_t>(*usage)
                                                    : usage_of(node->value_or(std::string()));
    if (key.usage == 0)
      return refuse(*node, "key is no key of a keyboard",
                    "a letter, a digit, \"enter\", \"space\" or a HID usage from 4 to 255",
                    out_refusal);
    if (!add_key(*node, key, HidKind::keyboard, out, out_refusal)) return false;
  }
  if (const toml::node* node = button.get("code")) {
    HidKey key;
    key.button = number;
    const std::string code = node->value_or(std::string());
    const bool fits =
        !code.empty() && code.size() <= 31 && std::all_of(code.begin(), code.end(), [](char c) {
          return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        });
    if (!fits)
      return refuse(*node, "code is no code", "1 to 31 digits and lower-case letters in quotes",
                    out_refusal);
    key.code.assign(code);
    if (!add_key(*node, key, HidKind::wedge, out, out_refusal)) return false;
  }
  if (const toml::node* node = button.get("bit")) {
    HidKey key;
    key.button = number;
    const auto bit = node->value<std::int64_t>();
    if (!bit || *bit < 0 || *bit >= 64 * 8)
      return refuse(*node, "bit is no place in a report", "0 to 511, counted from byte 0 bit 0",
                    out_refusal);
    key.byte = static_cast<std::uint8_t>(*bit / 8);
    key.bit = static_cast<std::uint8_t>(*bit % 8);
    if (!add_key(*node, key, HidKind::bits, out, out_refusal)) return false;
  }
  return true;
}

namespace {

bool read_ms(const toml::table& button, const char* key, std::int64_t* io_us,
             DeviceRefusal* out_refusal) {
  const toml::node* node = button.get(key);
  if (node == nullptr) return true;
  const auto ms = number_of(button, key, 10'000);
  if (!ms)
    return refuse(*node, std::string(key) + " is no time", "0 to 10000 milliseconds", out_refusal);
  *io_us = *ms * 1000;
  return true;
}

bool read_derived(const toml::table& button, const char* key, DerivedButton derived, Config* out,
                  DeviceRefusal* out_refusal) {
  const toml::node* node = button.get(key);
  if (node == nullptr) return true;
  const int of = out->buttons.find(node->value_or(std::string()));
  if (of < 0 || of + 1 == derived.button)
    return refuse(*node, std::string(key) + " names no button that stands above",
                  "write the name of an earlier [[button]]", out_refusal);
  derived.of = static_cast<std::uint16_t>(of + 1);
  return out->derived.push(derived) ||
         refuse(*node, "too many long and double presses", "at most " + std::to_string(kMaxButtons),
                out_refusal);
}

}  // namespace

bool read_button_timing(const toml::table& button, std::uint16_t number, Config* out,
                        DeviceRefusal* out_refusal) {
  agent::ButtonTiming& timing = out->timings[number - 1u];
  return read_ms(button, "lockout_ms", &timing.lockout_us, out_refusal) &&
         read_ms(button, "long_ms", &timing.long_press_us, out_refusal) &&
         read_ms(button, "double_ms", &timing.double_press_us, out_refusal) &&
         read_derived(button, "long", {number, 0, agent::ButtonAction::held}, out, out_refusal) &&
         read_derived(button, "double", {number, 0, agent::ButtonAction::pressed_twice}, out,
                      out_refusal);
}

}  // namespace caryatid::app
