// A line of the control socket, and the state file: any bytes are a command, a state or refused.
#include <cassert>
#include <cstdint>

#include "firmware-app/command.h"
#include "firmware-app/last_state.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid::app;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Command c = parse_command(text);
  assert(c.strength >= 0.0f && c.strength <= 1.0f);
  assert(c.kind != CommandKind::wrong || !c.text.empty());
  LastState state;
  (void)parse_state(text, &state);
  return 0;
}
