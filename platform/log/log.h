#pragma once
// What the kiosk says to the people who run it. Each line has an event's name, so that a filter
// finds it whatever the wording: `journalctl CARYATID_EVENT=button-lost`. Under systemd lines go to
// the journal with their fields (its native protocol, one datagram a line), elsewhere to stderr as
// "caryatid: TEXT". No allocation, no lock; a journal that is full or gone costs the line.
#include <cstddef>
#include <cstdint>

namespace caryatid::platform {

enum class Event : std::uint8_t {
  start_refused,   // The program ends: what was asked for can't be had.
  pack_refused,    // The built-in face stands in.
  pack_damaged,    // A refinement; shown as far as it is whole.
  config_refused,  // An older configuration stands in.
  screen_lost,     // It, or the GPU, is being opened again.
  screen_found,    // Or opened at start.
  picture_shown,   // The first of the built-in picture, and of the person.
  software_gpu,    // No driver of a GPU is in use.
  button_lost,     // A device of buttons is away,
  button_found,    // or back.
  speech_trouble,  // Captions go on.
  unsupervised,    // systemd's socket can't be used.
  file_refused,    // Status, state, metrics or pictures can't be written.
  state_refused,   // The remembered state is damaged.
  text_refused,    // A text or picture of the programme; what stands in for it is said.
  text_taken,      // A changed one is used from now on.
};

// The name as it stands in CARYATID_EVENT, "pack-damaged".
const char* event_name(Event event);

// printf-like; a line is cut at 1000 bytes, and line ends in it become blanks.
__attribute__((format(printf, 2, 3))) void log(Event event, const char* format, ...);

// The bytes of the journal's datagram for a line, for tests; 0 where `out` is too short.
std::size_t format_journal(Event event, const char* line, char* out, std::size_t out_bytes);

}  // namespace caryatid::platform
