#include "firmware-app/config_screen.h"

namespace caryatid::app {
namespace {

struct Key {
  const char* name;
  float ScreenCareConfig::*member;
  double most;
  const char* range;
};
constexpr Key kKeys[] = {
    {"dim_after_s", &ScreenCareConfig::dim_after_s, 1e6, "seconds; 0 for never"},
    {"off_after_s", &ScreenCareConfig::off_after_s, 1e6, "seconds; 0 for never"},
    {"dim_to", &ScreenCareConfig::dim_to, 1.0, "a share of the light, 0 to 1"},
    {"wander", &ScreenCareConfig::wander, 0.05, "a share of the picture's height, 0 to 0.05"},
};

bool refuse(const toml::node& where, std::string what, std::string cure, DeviceRefusal* out) {
  *out = {&where, std::move(what), std::move(cure)};
  return false;
}

}  // namespace

bool read_screen(const toml::table& root, Config* out, DeviceRefusal* out_refusal) {
  const toml::node* node = root.get("screen");
  if (node == nullptr) return true;
  const toml::table* table = node->as_table();
  if (table == nullptr)
    return refuse(*node, "screen is not a table", "write [screen]", out_refusal);
  for (const auto& [key, value] : *table) {
    const Key* known = nullptr;
    for (const Key& k : kKeys)
      if (key.str() == k.name) known = &k;
    if (known == nullptr)
      return refuse(value, "unknown key '" + std::string(key.str()) + "' of screen",
                    "known here: dim_after_s, off_after_s, dim_to, wander", out_refusal);
    const auto number = value.value<double>();
    if (!number || !(*number >= 0.0) || *number > known->most)
      return refuse(value, std::string(known->name) + " is out of range", known->range,
                    out_refusal);
    out->screen.*(known->member) = static_cast<float>(*number);
  }
  return true;
}

}  // namespace caryatid::app
