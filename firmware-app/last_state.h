#pragma once
// What the kiosk remembers over restarts and power cuts: a few lines of text with a CRC, replaced
// whole (platform/files). A file that is cut or altered counts as none.
#include <cstdint>
#include <span>
#include <string_view>

namespace caryatid::app {

struct LastState {
  std::uint64_t starts = 0;   // Of the program, this one not counted.
  std::uint64_t presses = 0;  // Since the board was set up.
  bool running = false;       // Written by a run that has not said goodbye.
};

inline constexpr std::size_t kLastStateBytes = 256;

// Gives the part of `out` that was written; `out` is kLastStateBytes long or more.
std::string_view format_state(const LastState& state, std::span<char> out);
// False: not a whole state file; `out` is as it was.
bool parse_state(std::string_view text, LastState* out);

}  // namespace caryatid::app
