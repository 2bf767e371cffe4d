#pragma once
// The kiosk's desk: the compiled programme, the guide who walks through it, and what is said and
// shown beside the person.
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "core/agent/guide.h"
#include "core/agent/signboard.h"
#include "core/agent/ssml.h"
#include "core/agent/type_case.h"
#include "core/base/arena.h"
#include "core/pack/font.h"
#include "firmware-app/reload.h"
#include "firmware-app/texts/compile.h"
#include "platform/buttons/buttons.h"
#include "platform/render/render.h"

namespace caryatid::app {

class Desk {
 public:
  // Bytes that take_memory() takes from the arena.
  static constexpr std::size_t kArenaBytes = 2 * kMaxProgrammeBytes + 64;

  // Compiles the programme of `config` (empty: the built-in one) and logs what is wrong with it.
  // False: it can't be used at all; open another one. The built-in one is refused by a fault of the
  // build alone.
  bool open(const std::string& config);
  // In place of the programme: a notice that nothing works, out_of_order.toml beside `config` or
  // the built-in one. False: a fault of the build.
  bool open_notice(const std::string& config);
  // Full names of the files that the programme was made of; none for the built-in one.
  const std::vector<std::string>& files_read() const { return files_read_; }
  // The same for --check: false when anything was said.
  static bool check(const std::string& config);
  // Moves the programme into memory of the agent. False: the arena is too small.
  bool take_memory(Arena& arena);

  // Letters and pictures to the GPU. A picture that can't be used is logged once; the page is shown
  // without it. most_side: of the display, pixels.
  void load(platform::Renderer& renderer, std::uint32_t most_side);

  // Takes over changed texts, pages, menus, schedule and what buttons do, between two utterances.
  // Buttons and pictures that are new by name wait for the next start, which is said; a device's
  // wiring and a picture's content, too. Once a frame; never waits; not for replays.
  void reload(std::int64_t now_us, bool speaking);

  // One step of the guide. What it says is in ssml() until the next text begins.
  const agent::Guidance& step(float dt_s, std::span<const ButtonEvent> events,
                              const agent::Moment& now, bool speaking);
  std::string_view ssml() const { return ssml_.text(); }
  // Code of the voice for the text that is said.
  std::string_view voice() const;
  // The voice does not know the language of what is said: that is said in the next one of the
  // programme, as is all that follows. False: there is no other, its captions have to do.
  bool say_in_next_language();
  // Captions of a plain text that another program lets her say; `text` stays where it is until the
  // next text begins.
  void caption(std::string_view text);
  // What is shown beside the person. `frame` brings the picture's size, the head and the voice; the
  // rest is filled in here. First the place for the person, then, when the camera is aimed, the
  // overlay.
  const scene::Box& stage(agent::SignboardInput frame, float dt_s);
  scene::Overlay overlay(agent::SignboardInput frame, float dt_s);
  // Pictures are shown to her right.
  bool mirrored() const { return signboard_.mirrored(); }
  // Of a byte of what the voice was given, in the captions.
  std::int32_t caption_byte(std::uint32_t spoken_byte);
  const agent::Programme& programme() const { return guide_.programme(); }

 private:
  bool compile(ProgrammeFiles files, CompiledProgramme* out);
  void adopt();
  void remember_start();
  void match_buttons(const agent::Programme& next);
  void match_pictures(const agent::Programme& next);
  void complete(agent::SignboardInput* io_frame) const;
  void write_said();

  pack::FontView font_;
  std::vector<agent::TypeLetter> letters_;
  std::vector<std::byte> compiled_;  // Until take_memory().
  std::array<std::span<std::uint32_t>, 2> slots_;
  std::string config_;                                       // Empty: the built-in programme.
  std::array<agent::PictureSize, kMaxPictures> pictures_{};  // By the present programme's index.
  // What devices and GPU got at the start, by name: a later programme may order it otherwise.
  FixedVector<FixedString<31>, kMaxButtons> start_buttons_;
  struct StartPicture {
    FixedString<95> file;
    agent::PictureSize size;
  };
  FixedVector<StartPicture, kMaxPictures> start_pictures_;
  std::array<std::uint16_t, kMaxButtons> button_now_{};     // From 1; 0: gone.
  std::array<std::uint16_t, kMaxPictures> picture_then_{};  // In the GPU, of the present index.
  agent::Moment now_;
  Reload reload_;
  std::vector<std::string> files_read_;
  std::size_t slot_ = 0;       // Of slots_, in use.
  std::size_t new_bytes_ = 0;  // Of the other one, compiled and waiting. 0: none.
  agent::Guide guide_;
  agent::Signboard signboard_;
  agent::Utterable said_;
  agent::Ssml ssml_;
  bool described_ = false;                   // What is said is a description of the page.
  std::array<bool, kMaxLanguages> mute_{};   // Languages that the voice does not know.
  std::string_view plain_;                   // Of caption(); empty: ssml_ is said.
  std::uint32_t set_from_ = 0, set_to_ = 0;  // Bytes of it that stand in said_.
};

}  // namespace caryatid::app
