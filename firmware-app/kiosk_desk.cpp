// The kiosk's side of its programme: configuration, local time, and what the guide wants.
#include <time.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "firmware-app/builtin.h"
#include "firmware-app/kiosk.h"
#include "platform/buttons/scripted/scripted.h"

namespace caryatid::app {
namespace {

void complain(const std::string& line) { std::fprintf(stderr, "caryatid: %s\n", line.c_str()); }

}  // namespace

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

bool Kiosk::read_config() {
  std::string error;
  if (!load_config(&error)) {
    complain(error + " (the built-in programme stands in)");
    options_.config.clear();
  }
  if (desk_.open(options_.config)) return read_script();
  complain("the built-in programme or its letters are damaged; build again");
  return false;
}

bool Kiosk::read_script() {
  if (options_.script.empty()) return true;
  ProgrammeFiles files(options_.script, {});
  std::string text, error;
  auto script = std::make_unique<platform::ScriptedButtons>();
  const auto number_of = [this](std::string_view name) { return config_.buttons.find(name) + 1; };
  if (!files.read(files.config(), 1u << 20, &text, &error)) {
    complain(options_.script + ": " + error);
    return false;
  }
  if (!script->parse(text, options_.script, number_of, &error)) {
    complain(error);
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
  const agent::Guidance& g = desk_.step(tick.dt_s, events_.span(), local_time(tick), speaking);
  if (g.pressed) agent_->press();
  if (g.feels) agent_->feel(g.feel);
  if (g.gesture != body::GestureKind::none) agent_->gesture(g.gesture);
  agent_->sleep(g.asleep);
  speaker_.set_volume(g.volume);
  if (g.hushes) speaker_.stop();
  if (g.says) speaker_.say(desk_.ssml(), {.language = desk_.voice(), .ssml = true});
}

// Marks of the text that is heard are gestures.
void Kiosk::obey_marks(const SpeechFrame& spoken) {
  for (const auto& mark : spoken.marks)
    for (int k = 1; k <= static_cast<int>(body::GestureKind::beat); ++k)
      if (std::strcmp(mark.c_str(), body::gesture_name(static_cast<body::GestureKind>(k))) == 0)
        agent_->gesture(static_cast<body::GestureKind>(k));
}

}  // namespace caryatid::app
