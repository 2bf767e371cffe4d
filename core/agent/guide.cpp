#include "core/agent/guide.h"

#include <algorithm>

namespace caryatid::agent {
namespace {

constexpr float kVolumeStep = 0.15f;

float per_cent(std::uint8_t value) { return static_cast<float>(value) * 0.01f; }

}  // namespace

void Guide::take(const Programme& programme) {
  std::uint16_t page = programme.header->start_page, language = 0;
  if (programme_.header != nullptr) {
    const auto page_name = programme_.text(programme_.pages[out_.page].name);
    const auto code = programme_.text(programme_.languages[out_.language].code);
    for (std::size_t p = 0; p < programme.pages.size(); ++p)
      if (programme.text(programme.pages[p].name) == page_name)
        page = static_cast<std::uint16_t>(p);
    for (std::size_t l = 0; l < programme.languages.size(); ++l)
      if (programme.text(programme.languages[l].code) == code)
        language = static_cast<std::uint16_t>(l);
  }
  programme_ = programme;
  out_.page = page;
  out_.language = language;
  out_.picture = programme_.pages[page].enter.picture;
  out_.say = kNone;
  before_.clear();
}

const Action& Guide::action_of(std::uint16_t button) const {
  const Page& page = programme_.pages[out_.page];
  for (const Choice& c : programme_.choices.subspan(page.first_choice, page.choice_count))
    if (c.button == button) return c.action;
  return programme_.buttons[button - 1u].action;
}

void Guide::go(std::uint16_t page) {
  if (page != out_.page && !before_.push(out_.page)) {
    std::copy(before_.begin() + 1, before_.end(), before_.begin());
    before_[before_.size() - 1] = out_.page;
  }
  out_.page = page;
  out_.picture = kNone;
  act(programme_.pages[page].enter);
}

void Guide::go_back() {
  if (before_.empty()) return;
  const std::uint16_t page = before_[before_.size() - 1];
  before_.pop();
  out_.page = page;
  out_.picture = kNone;
  act(programme_.pages[page].enter);
}

void Guide::command(Command what) {
  switch (what) {
    case Command::none:
      break;
    case Command::next_language:
      out_.language =
          static_cast<std::uint16_t>((out_.language + 1u) % programme_.languages.size());
      break;
    case Command::large_text:
      out_.large_text = !out_.large_text;
      break;
    case Command::high_contrast:
      out_.high_contrast = !out_.high_contrast;
      break;
    case Command::captions:
      out_.captions = !out_.captions;
      break;
    case Command::louder:
      louder_ = std::min(louder_ + kVolumeStep, 0.6f);
      break;
    case Command::softer:
      louder_ = std::max(louder_ - kVolumeStep, -0.6f);
      break;
    case Command::repeat:
      out_.says = out_.say != kNone;
      break;
    case Command::back:
      go_back();
      break;
    case Command::hush:
      out_.hushes = true;
      break;
    case Command::describe:
      out_.describes = true;
      break;
  }
}

// The page's own entrance comes first, so that what the button says or feels has the last word.
void Guide::act(const Action& action) {
  if (action.language != kNone) out_.language = action.language;
  command(static_cast<Command>(action.command));
  if (action.page != kNone) go(action.page);
  if (action.picture != kNone) out_.picture = action.picture;
  if (action.feel != 0xFF) {
    out_.feels = true;
    out_.feel = static_cast<emotion::Emotion>(action.feel);
  }
  if (action.gesture != 0) out_.gesture = static_cast<body::GestureKind>(action.gesture);
  if (action.say != kNone) {
    out_.says = true;
    out_.hushes = false;
    out_.say = action.say;
  }
}

void Guide::press(std::uint16_t button) {
  out_.pressed = true;
  since_visit_s_ = 0.0f;
  since_sign_s_ = 0.0f;
  const Action action = action_of(button);
  const bool turns = action.page != kNone || action.language != kNone ||
                     action.command == static_cast<std::uint8_t>(Command::next_language);
  act(action);
  // What is being said belongs to the page and language that was left.
  if (turns && !out_.says) out_.hushes = true;
}

// The next visitor finds the kiosk as the first one did.
void Guide::forget_visitor() {
  out_.page = programme_.header->start_page;
  out_.picture = programme_.pages[out_.page].enter.picture;
  out_.language = 0;
  out_.large_text = out_.high_contrast = false;
  out_.captions = true;
  out_.say = kNone;
  louder_ = 0.0f;
  before_.clear();
}

const Guidance& Guide::step(float dt_s, std::span<const ButtonEvent> events, const Moment& now,
                            bool speaking) {
  const float dt = dt_s > 0.0f ? std::min(dt_s, 0.25f) : 0.0f;
  out_.pressed = out_.feels = out_.says = out_.hushes = out_.describes = false;
  out_.gesture = body::GestureKind::none;
  if (programme_.header == nullptr) return out_;
  const Attract& attract = programme_.header->attract;
  const Schedule& schedule = programme_.header->schedule;
  const auto after_s = static_cast<float>(attract.after_s);
  if (!speaking) {
    const bool was_there = since_visit_s_ < after_s;
    since_visit_s_ += dt;
    since_sign_s_ += dt;
    if (was_there && since_visit_s_ >= after_s) forget_visitor();
  }
  for (const ButtonEvent& e : events)
    if (e.pressed && e.button >= 1 && e.button <= programme_.buttons.size()) press(e.button);
  out_.visited = since_visit_s_ < after_s || programme_.header->always_shown != 0;
  out_.asleep = schedule.sleeps != 0 && !is_open(schedule, now) && !out_.visited;
  const bool sign = attract.every_s > 0 && since_sign_s_ >= static_cast<float>(attract.every_s);
  if (!out_.visited && !out_.asleep && !speaking && sign) {
    since_sign_s_ = 0.0f;
    act(attract.action);
  }
  const bool night = is_night(schedule, now);
  const std::uint8_t set = night ? schedule.night_volume : schedule.volume;
  out_.volume = std::clamp(per_cent(set) + louder_, 0.0f, 1.0f);
  return out_;
}

}  // namespace caryatid::agent
