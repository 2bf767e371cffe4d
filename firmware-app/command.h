#pragma once
// A line of --control as a command. Words are separated by blanks; what stands behind the last
// word that a command knows is its text. Pure: no memory, no devices.
//   press NAME | release NAME      a button of kiosk.toml goes down, up
//   feel EMOTION [STRENGTH]        as the emotion's button would, at a strength 0..1
//   say TEXT                       speaks the text
//   play FILE.fba | play           plays a stream in place of the programme; stops it
//   status                         one line of JSON
//   help                           these
#include <span>
#include <string_view>

#include "core/emotion/emotion.h"

namespace caryatid::app {

enum class CommandKind { press, release, feel, say, play, status, help, wrong };

struct Command {
  CommandKind kind = CommandKind::wrong;
  std::string_view text;  // NAME, TEXT or FILE; for `wrong`, what is wrong and what to do.
  emotion::Emotion emotion = emotion::Emotion::calm;
  float strength = 1.0f;
};

inline constexpr std::string_view kCommands =
    "press NAME, release NAME, feel EMOTION [0..1], say TEXT, play FILE.fba, play, status, help";

// The result borrows from `line`.
Command parse_command(std::string_view line);

}  // namespace caryatid::app
