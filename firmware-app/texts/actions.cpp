#include "firmware-app/texts/actions.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/body/gesture.h"
#include "core/emotion/emotion.h"

namespace caryatid::app {
namespace {

constexpr std::array kDays = {"monday", "tuesday",  "wednesday", "thursday",
                              "friday", "saturday", "sunday"};
constexpr std::array kRootKeys = {"languages", "start",   "volume",  "sleep",       "hours",
                                  "night",     "attract", "picture", "variables",   "page",
                                  "button",    "hid",     "screen",  "always_shown"};
// Of these keys the kind is checked here; the others' readers do it.
constexpr struct {
  const char* key;
  toml::node_type kind;
  const char* wanted;
} kRootKinds[] = {{"sleep", toml::node_type::boolean, "true or false"},
                  {"always_shown", toml::node_type::boolean, "true or false"},
                  {"languages", toml::node_type::array, "a list, as [\"en\", \"el\"]"},
                  {"hours", toml::node_type::table, "a table; write [hours]"},
                  {"night", toml::node_type::table, "a table; write [night]"},
                  {"attract", toml::node_type::table, "a table; write [attract]"},
                  {"variables", toml::node_type::table, "a table; write [variables]"},
                  {"picture", toml::node_type::array, "a list; write [[picture]]"},
                  {"page", toml::node_type::array, "a list; write [[page]]"}};
constexpr std::array kPageKeys = {"name",    "title", "body", "say",     "show",
                                  "gesture", "feel",  "on",   "language"};

std::vector<std::string> names_of(const toml::table& root, const char* key) {
  std::vector<std::string> out;
  if (const toml::array* array = root[key].as_array())
    for (const toml::node& node : *array) {
      const toml::table* table = node.as_table();
      out.push_back(table ? (*table)["name"].value_or(std::string()) : std::string());
    }
  return out;
}

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

std::vector<std::string> ProgrammeReader::language_codes(const toml::table& root) {
  std::vector<std::string> out;
  if (const toml::array* array = root["languages"].as_array())
    for (const toml::node& node : *array)
      if (node.is_string()) out.push_back(node.as_string()->get());
  return out;
}

void ProgrammeReader::wrong(const toml::node& node, const std::string& what) {
  messages_.wrong(file_, node.source().begin.line, what);
}

bool ProgrammeReader::known_keys(const toml::table& table, const char* const* first,
                                 const char* const* last) {
  bool all = true;
  for (const auto& [key, node] : table) {
    if (std::any_of(first, last, [&](const char* k) { return key.str() == k; })) continue;
    std::string known;
    for (const char* const* k = first; k != last; ++k)
      known += (k == first ? "" : ", ") + std::string(*k);
    wrong(node, "unknown key '" + std::string(key.str()) + "'; known here: " + known);
    all = false;
  }
  return all;
}

std::uint16_t ProgrammeReader::text(const std::string& key, const toml::node* where,
                                    bool optional) {
  const auto found = text_numbers_.find(key);
  if (found != text_numbers_.end()) {
    texts_[found->second].optional = texts_[found->second].optional && optional;
    return found->second;
  }
  const auto number = static_cast<std::uint16_t>(texts_.size());
  texts_.push_back({key, where ? where->source().begin.line : 0, optional});
  text_numbers_[key] = number;
  return number;
}

int ProgrammeReader::find(const std::vector<std::string>& names, const toml::node& node,
                          const char* kind) {
  const std::string name = node.is_string() ? node.as_string()->get() : std::string();
  const auto found = std::find(names.begin(), names.end(), name);
  if (!name.empty() && found != names.end()) return static_cast<int>(found - names.begin());
  if (!node.is_string()) {
    wrong(node, std::string(kind) + ": its name is wanted, in quotation marks");
    return -1;
  }
  std::string known;
  for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
  wrong(node, "there is no " + std::string(kind) + " '" + name + "'" +
                  (known.empty() ? "; add it" : "; there are " + known));
  return -1;
}

agent::Action ProgrammeReader::read_action(const toml::table& table) {
  agent::Action a;
  const auto index = [&](const char* key, const std::vector<std::string>& names, const char* kind) {
    const toml::node* node = table.get(key);
    return node ? static_cast<std::uint16_t>(find(names, *node, kind)) : agent::kNone;
  };
  if (const toml::node* node = table.get("feel")) {
    std::vector<std::string> names(emotion::kEmotionNames.begin(), emotion::kEmotionNames.end());
    a.feel = static_cast<std::uint8_t>(find(names, *node, "feeling"));
  }
  if (const toml::node* node = table.get("gesture")) {
    std::vector<std::string> names;
    for (int k = 0; k <= static_cast<int>(body::GestureKind::beat); ++k)
      names.push_back(body::gesture_name(static_cast<body::GestureKind>(k)));
    a.gesture = static_cast<std::uint8_t>(std::max(find(names, *node, "gesture"), 0));
  }
  if (const toml::node* node = table.get("do")) {
    const std::vector<std::string> names(agent::kCommandNames.begin(), agent::kCommandNames.end());
    a.command = static_cast<std::uint8_t>(std::max(find(names, *node, "command"), 0));
  }
  if (const toml::node* node = table.get("say")) {
    if (node->is_string())
      a.say = text(node->as_string()->get(), node, false);
    else
      wrong(*node, "say is not the name of a text; write say = \"page.say\"");
  }
  a.page = index("go", page_names_, "page");
  a.picture = index("show", picture_names_, "picture");
  a.language = index("language", codes_, "language");
  return a;
}

void ProgrammeReader::read_button(const toml::table& table) {
  const std::string name = table["name"].value_or(std::string());
  agent::ButtonRecord b;
  b.name = builder_.bytes(name);
  b.badge = builder_.bytes(table["badge"].value_or(letters(name) <= 2 ? name : std::string()));
  b.action = read_action(table);
  builder_.buttons.push_back(b);
}

void ProgrammeReader::read_choice(const std::string& button, const toml::node& node,
                                  agent::Page* page) {
  static constexpr std::array kKeys = {"feel",    "say",      "go", "show",
                                       "gesture", "language", "do", "label"};
  const toml::table* table = node.as_table();
  const auto found = std::find(button_names_.begin(), button_names_.end(), button);
  if (table == nullptr || found == button_names_.end())
    return wrong(node, table == nullptr
                           ? "a choice is no table; write \"" + button + "\" = { go = \"page\" }"
                           : "there is no button '" + button + "'; add it as [[button]]");
  known_keys(*table, kKeys.begin(), kKeys.end());
  agent::Choice c;
  c.button = static_cast<std::uint16_t>(found - button_names_.begin() + 1);
  c.action = read_action(*table);
  if (const toml::node* label = table->get("label")) {
    if (label->is_string()) c.label = text(label->as_string()->get(), label, false);
  } else if (c.action.page != agent::kNone) {
    c.label = text(page_names_[c.action.page] + ".title", &node, true);
  }
  builder_.choices.push_back(c);
  ++page->choice_count;
}

void ProgrammeReader::read_page(const toml::table& table, std::size_t index) {
  known_keys(table, kPageKeys.begin(), kPageKeys.end());
  const std::string& name = page_names_[index];
  agent::Page page;
  page.name = builder_.bytes(name);
  page.enter = read_action(table);
  page.enter.page = agent::kNone;
  const auto named = [&](const char* key) {
    const toml::node* node = table.get(key);
    const bool given = node != nullptr && node->is_string();
    return given ? text(node->as_string()->get(), node, false)
                 : text(name + "." + key, &table, true);
  };
  page.title = named("title");
  page.body = named("body");
  if (page.enter.say == agent::kNone) page.enter.say = text(name + ".say", &table, true);
  page.first_choice = static_cast<std::uint16_t>(builder_.choices.size());
  if (const toml::node* on = table.get("on")) {
    if (const toml::table* choices = on->as_table()) {
      // In the order of the buttons, as they stand on the panel.
      for (const std::string& button : button_names_)
        if (const toml::node* choice = choices->get(button)) read_choice(button, *choice, &page);
      for (const auto& [key, node] : *choices)
        if (std::find(button_names_.begin(), button_names_.end(), key.str()) == button_names_.end())
          read_choice(std::string(key.str()), node, &page);
    } else {
      wrong(*on, "on is no table; write [page.on]");
    }
  }
  builder_.pages.push_back(page);
}

void ProgrammeReader::read_picture(const toml::table& table) {
  static constexpr std::array kKeys = {"name", "file"};
  known_keys(table, kKeys.begin(), kKeys.end());
  agent::PictureRecord p;
  p.file = builder_.bytes(table["file"].value_or(std::string()));
  const std::string name = table["name"].value_or(std::string());
  if (p.file.count == 0 || name.empty())
    wrong(table, "a picture needs a name and a file; write both");
  p.alternative = text("picture." + name, &table, false);
  builder_.pictures.push_back(p);
}

bool ProgrammeReader::minutes(const toml::node& node, std::string_view text, std::uint16_t* out) {
  unsigned h = 0, m = 0;
  const char* end = text.data() + text.size();
  const auto [colon, why] = std::from_chars(text.data(), end, h);
  bool good = why == std::errc() && colon != end && *colon == ':' && end - colon == 3;
  good = good && std::from_chars(colon + 1, end, m).ptr == end && m < 60 && h * 60 + m <= 24 * 60;
  if (good)
    *out = static_cast<std::uint16_t>(h * 60 + m);
  else
    wrong(node, "'" + std::string(text) + "' is no time of the day; write 9:00 or 17:30");
  return good;
}

void ProgrammeReader::read_hours(const toml::table& table) {
  known_keys(table, kDays.begin(), kDays.end());
  for (std::size_t day = 0; day < kDays.size(); ++day) {
    const toml::node* node = table.get(kDays[day]);
    const std::string text = node && node->is_string() ? node->as_string()->get() : "closed";
    if (text == "closed") continue;
    const std::size_t dash = text.find('-');
    std::uint16_t from = 0, to = 0;
    if (dash == std::string::npos) {
      wrong(*node, "'" + text + "' are no hours; write \"10:00-18:00\" or \"closed\"");
      continue;
    }
    if (!minutes(*node, std::string_view(text).substr(0, dash), &from) ||
        !minutes(*node, std::string_view(text).substr(dash + 1), &to))
      continue;
    if (to <= from) {
      wrong(*node, "it closes before it opens; write the earlier time first");
      continue;
    }
    builder_.schedule.open[day][0] = from;
    builder_.schedule.open[day][1] = to;
    hours_[day] = text.substr(0, dash) + "\xE2\x80\x93" + text.substr(dash + 1);
  }
}

void ProgrammeReader::read_night(const toml::table& table) {
  static constexpr std::array kKeys = {"from", "to", "volume"};
  known_keys(table, kKeys.begin(), kKeys.end());
  agent::Schedule& s = builder_.schedule;
  for (const auto& [key, out] : {std::pair{"from", &s.night_from}, std::pair{"to", &s.night_to}})
    if (const toml::node* node = table.get(key)) {
      if (!node->is_string())
        wrong(*node, "no time of the day; write \"20:00\"");
      else if (minutes(*node, node->as_string()->get(), out))
        *out = static_cast<std::uint16_t>(*out % (24 * 60));
    }
}

void ProgrammeReader::read_attract(const toml::table& table) {
  static constexpr std::array kKeys = {"after_s", "every_s", "say", "feel",
                                       "gesture", "go",      "show"};
  known_keys(table, kKeys.begin(), kKeys.end());
  agent::Attract& a = builder_.attract;
  for (const auto& [key, out] :
       {std::pair{"after_s", &a.after_s}, std::pair{"every_s", &a.every_s}})
    if (const toml::node* node = table.get(key)) {
      const auto seconds = node->value<std::int64_t>();
      if (!seconds || *seconds < 0 || *seconds > 36000)
        wrong(*node, std::string(key) + " is no number of seconds; write 0 to 36000");
      else
        *out = static_cast<std::uint16_t>(*seconds);
    }
  a.action = read_action(table);
}

void ProgrammeReader::read_schedule(const toml::table& root) {
  const auto volume = [this](const toml::node& node, std::uint8_t* out) {
    const auto value = node.value<double>();
    if (!value || !(*value >= 0.0) || *value > 1.0)
      return wrong(node, "a volume is a number from 0 to 1");
    *out = static_cast<std::uint8_t>(*value * 100.0 + 0.5);
  };
  agent::Schedule& s = builder_.schedule;
  if (const toml::node* node = root.get("volume")) volume(*node, &s.volume);
  s.night_volume = s.volume;
  for (auto& day : s.open) day[1] = 24 * 60;
  if (const toml::table* hours = root["hours"].as_table()) {
    for (auto& day : s.open) day[0] = day[1] = 0;
    read_hours(*hours);
  }
  if (const toml::table* night = root["night"].as_table()) {
    read_night(*night);
    if (const toml::node* node = night->get("volume")) volume(*node, &s.night_volume);
  }
  s.sleeps = root["sleep"].value_or(false) ? 1 : 0;
  if (const toml::table* attract = root["attract"].as_table())
    read_attract(*attract);
  else
    builder_.attract.every_s = 0;
}

void ProgrammeReader::check_kinds(const toml::table& root) {
  for (const auto& each : kRootKinds)
    if (const toml::node* node = root.get(each.key); node != nullptr && node->type() != each.kind)
      wrong(*node, std::string(each.key) + " is " + each.wanted);
  const toml::array* languages = root["languages"].as_array();
  if (languages == nullptr) return;
  if (languages->empty()) wrong(*languages, "languages is empty; name at least one, as \"en\"");
  std::vector<std::string> before;
  for (const toml::node& node : *languages) {
    const std::string code = node.value_or(std::string());
    if (code.empty()) wrong(node, "a language is a code in quotation marks, as \"en\"");
    if (std::find(before.begin(), before.end(), code) != before.end())
      wrong(node, "language '" + code + "' is there twice; take one away");
    before.push_back(code);
  }
}

void ProgrammeReader::check_twice(const toml::table& root, const char* key) {
  const std::vector<std::string> names = names_of(root, key);
  const toml::array* array = root[key].as_array();
  for (std::size_t i = 1; i < names.size(); ++i)
    if (const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
        !names[i].empty() && std::find(names.begin(), here, names[i]) != here)
      wrong((*array)[i],
            std::string(key) + " '" + names[i] + "' is there twice; give it another name");
}

void ProgrammeReader::read_names(const toml::table& root) {
  known_keys(root, kRootKeys.begin(), kRootKeys.end());
  check_kinds(root);
  check_twice(root, "page");
  check_twice(root, "picture");
  button_names_ = names_of(root, "button");
  page_names_ = names_of(root, "page");
  picture_names_ = names_of(root, "picture");
  codes_ = language_codes(root);
  if (const toml::table* variables = root["variables"].as_table())
    for (const auto& [key, node] : *variables) {
      if (node.is_string())
        constants_[std::string(key.str())] = node.as_string()->get();
      else
        wrong(node, "a variable is a text; put it in quotation marks");
    }
}

void ProgrammeReader::read(const toml::table& root) {
  read_names(root);
  const auto each = [&](const char* key, std::size_t most, auto read) {
    const toml::array* array = root[key].as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const toml::table* table = (*array)[i].as_table();
      if (table != nullptr && i < most) read(*table, i);
      if (i == most) wrong((*array)[i], "at most " + std::to_string(most) + " of these; cut them");
    }
  };
  each("picture", kMaxPictures, [this](const auto& t, std::size_t) { read_picture(t); });
  each("page", kMaxPages, [this](const auto& t, std::size_t i) { read_page(t, i); });
  each("button", kMaxButtons, [this](const auto& t, std::size_t) { read_button(t); });
  if (builder_.pages.empty()) builder_.pages.push_back({});
  if (const toml::node* start = root.get("start"))
    builder_.start_page =
        static_cast<std::uint16_t>(std::max(find(page_names_, *start, "page"), 0));
  builder_.always_shown = root["always_shown"].value_or(false);
  read_schedule(root);
}

}  // namespace caryatid::app
