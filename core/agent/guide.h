#pragma once
// The guide: walks through the compiled programme as buttons are pressed and time passes, and says
// what there is to show, say and feel. Pure function of (state, time step, events, local time).
#include "core/agent/programme.h"
#include "core/base/button.h"
#include "core/body/gesture.h"
#include "core/emotion/emotion.h"

namespace caryatid::agent {

// What the kiosk is to do in this frame (upper half), and how things stand (lower half).
struct Guidance {
  bool pressed = false;  // A known button went down.
  bool feels = false;    // The person shall feel `feel`.
  emotion::Emotion feel = emotion::Emotion::calm;
  body::GestureKind gesture = body::GestureKind::none;
  bool describes = false;  // What is shown is to be said.
  bool says = false;       // Text `say` begins, in place of what is being said.
  bool hushes = false;     // What is being said ends.

  std::uint16_t say = kNone;  // Text that was said last.
  std::uint16_t page = 0, language = 0, picture = kNone;
  bool visited =
      false;  // Somebody is at the kiosk, or the programme is a notice: the page is shown.
  bool asleep = false;  // Closed, and nobody there: dark, she is away.
  bool large_text = false, high_contrast = false, captions = true;
  float volume = 0.8f;  // 0..1: setting, night and the visitor's wish.
};

class Guide {
 public:
  // Starts with, or goes over to, a programme, which must outlive its use. Going over keeps page
  // and language where the new programme has them by name, and the modes.
  void take(const Programme& programme);

  // dt_s: clamped to 0..0.25. speaking: something is being said (no attraction, no time-out then).
  // O(events + choices of the page).
  const Guidance& step(float dt_s, std::span<const ButtonEvent> events, const Moment& now,
                       bool speaking);

  const Programme& programme() const { return programme_; }
  const Guidance& guidance() const { return out_; }
  // The action of a button as things stand.
  const Action& action_of(std::uint16_t button) const;

 private:
  void press(std::uint16_t button);
  void act(const Action& action);
  void go(std::uint16_t page);
  void go_back();
  void command(Command what);
  void forget_visitor();

  Programme programme_;
  Guidance out_;
  FixedVector<std::uint16_t, 8> before_;  // Pages to go back to, the latest last.
  float since_visit_s_ = 1e6f, since_sign_s_ = 0.0f;
  float louder_ = 0.0f;  // The visitor's wish, added to the volume.
};

}  // namespace caryatid::agent
