// The kiosk's side of its programme: configuration, local time, and what the guide wants.
#include <time.h>

#include <algorithm>
#include <cstring>

#include "firmware-app/builtin.h"
#include "firmware-app/kiosk.h"
#include "firmware-app/last_good.h"
#include "platform/buttons/scripted/scripted.h"
#include "platform/clock/clock.h"
#include "platform/log/log.h"

namespace caryatid::app {

// False: one line in out_error; the built-in configuration is in place then.
bool Kiosk::load_config(std::string* out_error) {
  ProgrammeFiles files(options_.config, builtin_programme());
  const std::string name = options_.config.empty() ? "default kiosk.toml" : options_.config;
  std::string text, why;
  if (!files.read(files.config(), kMostConfigBytes, &text, &why))
    *out_error = name + ": " + why;
  else if (parse_config(text, name, &config_, out_error))
    return true;
  ProgrammeFiles builtin("", builtin_programme());
  std::string ignored;
  if (builtin.read(builtin.config(), kMostConfigBytes, &text, &why))
    (void)parse_config(text, "default kiosk.toml", &config_, &ignored);
  return false;
}

bool Kiosk::use_config(const std::string& config) {
  options_.config = config;
  std::string error;
  const bool good = load_config(&error);
  if (!good) platform::log(platform::Event::config_refused, "%s", error.c_str());
  return good && desk_.open(config);
}

// What was asked for, else what worked last, else what is built in.
bool Kiosk::read_config() {
  const LastGood last(options_.virtual_clock ? std::string() : options_.state);
  if (!options_.config.empty()) {
    const std::string wanted = options_.config;
    if (use_config(wanted)) {
      if (!last.keep(wanted, desk_.files_read()))
        platform::log(platform::Event::file_refused,
                      "%s: the configuration can't be kept; make room", options_.state.c_str());
      return read_script();
    }
    config_refused_ = true;
    const std::string kept = last.config();
    const bool stands_in = !kept.empty() && use_config(kept);
    platform::log(platform::Event::config_refused, "%s: not used; %s stands in", wanted.c_str(),
                  stands_in ? "the configuration that worked last" : "the built-in programme");
    if (stands_in) return read_script();
  }
  if (use_config("")) return read_script();
  platform::log(platform::Event::start_refused,
                "the built-in programme or its letters are damaged; build again");
  return false;
}

bool Kiosk::read_script() {
  if (options_.script.empty()) return true;
  ProgrammeFiles files(options_.script, {});
  std::string text, error;
  auto script = std::make_unique<platform::ScriptedButtons>();
  const auto number_of = [this](std::string_view name) { return config_.buttons.find(name) + 1; };
  if (!files.read(files.config(), 1u << 20, &text, &error)) {
    platform::log(platform::Event::start_refused, "%s: %s", options_.script.c_str(), error.c_str());
    return false;
  }
  if (!script->parse(text, options_.script, number_of, &error)) {
    platform::log(platform::Event::start_refused, "%s", error.c_str());
    return false;
  }
  script_ = std::move(script);
  return true;
}

agent::Moment Kiosk::local_time(const Tick& tick) const {
  tm t{};
  if (options_.virtual_clock) {
    const time_t now = static_cast<time_t>(options_.now_s) + static_cast<time_t>(tick.time_s);
    gmtime_r(&now, &t);
  } else {
    const time_t now = time(nullptr);
    localtime_r(&now, &t);
  }
  agent::Moment m;
  m.weekday = static_cast<std::uint8_t>((t.tm_wday + 6) % 7);
  m.day = static_cast<std::uint8_t>(t.tm_mday);
  m.month = static_cast<std::uint8_t>(t.tm_mon + 1);
  m.minute = static_cast<std::uint16_t>(t.tm_hour * 60 + t.tm_min);
  return m;
}

// What the buttons bring about goes to the mood, the body and the voice.
void Kiosk::follow_programme(const Tick& tick) {
  const bool speaking = speaker_.frame().speaking;
  if (!options_.virtual_clock) desk_.reload(platform::monotonic_us(), speaking);
  const agent::Guidance& g = desk_.step(tick.dt_s, events_.span(), local_time(tick), speaking);
  if (g.pressed) agent_->press();
  if (g.feels) agent_->feel(g.feel);
  if (g.gesture != body::GestureKind::none) agent_->gesture(g.gesture, desk_.mirrored());
  agent_->sleep(g.asleep);
  speaker_.set_volume(g.volume);
  if (g.hushes) speaker_.stop();
  if (g.says || g.describes) say_programme();
}

// Marks of the text that is heard are gestures.
void Kiosk::obey_marks(const SpeechFrame& spoken) {
  for (const auto& mark : spoken.marks)
    for (int k = 1; k <= static_cast<int>(body::GestureKind::beat); ++k)
      if (std::strcmp(mark.c_str(), body::gesture_name(static_cast<body::GestureKind>(k))) == 0)
        agent_->gesture(static_cast<body::GestureKind>(k), desk_.mirrored());
}

// The picture as the visitor sees it.
agent::SignboardInput Kiosk::screen() const {
  agent::SignboardInput seen;
  seen.width = static_cast<float>(renderer_->width());
  seen.height = static_cast<float>(renderer_->height());
  seen.turn_degrees = options_.rotate_degrees;
  if (seen.turn_degrees % 180 != 0) std::swap(seen.width, seen.height);
  return seen;
}

// Around the feature points of the skull: crown, chin, ears, and a margin for hair.
scene::Box Kiosk::head_box() const {
  constexpr int kPoints[][2] = {{11, 4}, {11, 1}, {11, 6}, {2, 1}, {10, 9}, {10, 10}, {2, 10}};
  constexpr float kMargin = 0.08f;
  const agent::SignboardInput seen = screen();
  scene::Box box{1e9f, 1e9f, -1e9f, -1e9f};
  for (const auto& [group, index] : kPoints) {
    if (pack::find_feature_point(person_.view(), group, index) == nullptr) continue;
    const Vec3 at = scene::seen_at(list_.camera, person_.feature_point_m(group, index), seen.width,
                                   seen.height, seen.turn_degrees);
    if (at.z <= 0.0f) continue;
    box = {std::min(box.x0, at.x), std::min(box.y0, at.y), std::max(box.x1, at.x),
           std::max(box.y1, at.y)};
  }
  if (box.empty()) return {};
  const float margin = kMargin * box.height();
  return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

void Kiosk::show_overlay(const Tick& tick) {
  list_.overlay = {};
  // A stream has the screen to itself, and so has the dark.
  if (player_.active() || !care_.screen_on()) return;
  agent::SignboardInput seen = screen();
  seen.head = head_box();
  const SpeechFrame& spoken = speaker_.frame();
  seen.speaking = spoken.speaking;
  const auto words = speaker_.words();
  if (spoken.word >= 0 && static_cast<std::size_t>(spoken.word) < words.size())
    seen.word_byte = desk_.caption_byte(words[static_cast<std::size_t>(spoken.word)].begin_byte);
  list_.overlay = desk_.overlay(seen, tick.dt_s);
}

}  // namespace caryatid::app
