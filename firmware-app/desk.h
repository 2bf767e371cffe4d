#pragma once
// The kiosk's desk: the compiled programme, the guide who walks through it, and what is said and
// shown beside the person.
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "core/agent/guide.h"
#include "core/agent/ssml.h"
#include "core/base/arena.h"
#include "core/pack/font.h"
#include "firmware-app/texts/compile.h"

namespace caryatid::app {

class Desk {
 public:
  // Bytes that take_memory() takes from the arena.
  static constexpr std::size_t kArenaBytes = 2 * kMaxProgrammeBytes + 64;

  // Compiles the programme of `config` (empty: the built-in one) and says on stderr what is wrong
  // with it. A kiosk.toml that can't be used is replaced by the built-in programme.
  // False: even that is unusable, which is a fault of the build.
  bool open(const std::string& config);
  // The same for --check: false when anything was said.
  static bool check(const std::string& config);
  // Moves the programme into memory of the agent. False: the arena is too small.
  bool take_memory(Arena& arena);

  // One step of the guide. What it says is in ssml() until the next text begins.
  const agent::Guidance& step(float dt_s, std::span<const ButtonEvent> events,
                              const agent::Moment& now, bool speaking);
  std::string_view ssml() const { return ssml_.text(); }
  // Code of the voice for the text that is said.
  std::string_view voice() const;
  const agent::Programme& programme() const { return guide_.programme(); }

 private:
  bool compile(const std::string& config, CompiledProgramme* out);

  pack::FontView font_;
  std::vector<std::byte> compiled_;  // Until take_memory().
  std::array<std::span<std::uint32_t>, 2> slots_;
  agent::Guide guide_;
  agent::Utterable said_;
  agent::Ssml ssml_;
};

}  // namespace caryatid::app
