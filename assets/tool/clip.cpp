// caryatid-tool clip: a person who speaks, as a moving picture with captions.
#include <cstdio>
#include <filesystem>

#include "assets/tool/animated_png.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/numbers.h"
#include "assets/tool/progress.h"
#include "assets/tool/speech_sheet.h"

namespace caryatid::tool {
namespace {

struct ClipArgs {
  VoiceJob voice;
  std::string pack, emotion, out;
  std::uint32_t size = 320, fps = 15;
};

// The words around the one that is heard, which stands out by its underline.
void draw_caption(const Spoken& spoken, const std::string& text, std::int32_t time_ms,
                  std::uint32_t top, Picture* to) {
  constexpr float kLetters = 26.0f;
  const SpokenEvent* word = nullptr;
  for (const SpokenEvent& e : spoken.events)
    if (e.kind == SpokenEvent::Kind::word && e.time_ms <= time_ms) word = &e;
  if (word == nullptr) return;
  // The sentence that holds it.
  std::size_t begin = text.find_last_of(".!?;", word->begin_byte);
  begin = begin == std::string::npos || word->begin_byte == 0 ? 0 : begin + 1;
  while (begin < text.size() && text[begin] == ' ') ++begin;
  std::size_t end = text.find_first_of(".!?;", word->begin_byte);
  end = end == std::string::npos ? text.size() : end + 1;
  const std::string line = text.substr(begin, end - begin);
  const auto x = (static_cast<float>(to->width) - text_width(line, kLetters)) / 2.0f;
  draw_text(line, static_cast<int>(x), static_cast<int>(top) + 30, kLetters, to);
  const float from = x + text_width(text.substr(begin, word->begin_byte - begin), kLetters);
  const float width =
      text_width(text.substr(word->begin_byte, word->end_byte - word->begin_byte), kLetters);
  fill_box({static_cast<std::uint32_t>(std::max(from, 0.0f)), top + 36,
            static_cast<std::uint32_t>(width), 3},
           235, to);
}

void clip(const ClipArgs& a) {
  constexpr std::uint32_t kCaption = 48;
  check_text("--text", a.voice.text);
  SpeechShot shot;
  if (!a.emotion.empty()) shot.mood = emotion_named(a.emotion);
  Studio studio(a.pack, a.size, a.size);
  const Spoken spoken = speak(a.voice);
  std::vector<Picture> frames;
  Progress progress;
  const double step_ms = 1000.0 / a.fps;
  for (double t = 0.0; t < spoken.end_ms + 300.0; t += step_ms) {
    progress.step("frame", frames.size(),
                  static_cast<std::size_t>((spoken.end_ms + 300.0) / step_ms));
    shot.time_ms = static_cast<std::int32_t>(t);
    Picture frame(a.size, a.size + kCaption, 0);
    paste(speech_picture(spoken, shot, &studio), 0, 0, &frame);
    draw_caption(spoken, a.voice.text, shot.time_ms, a.size, &frame);
    frames.push_back(std::move(frame));
  }
  write_animated_png(frames, static_cast<unsigned>(step_ms + 0.5), a.out);
  std::printf("%s: %zu frames, %.2f MB\n", a.out.c_str(), frames.size(),
              static_cast<double>(std::filesystem::file_size(a.out)) * 1e-6);
}

}  // namespace

void add_clip(CLI::App& app) {
  auto a = std::make_shared<ClipArgs>();
  CLI::App* cmd = app.add_subcommand("clip", "A speaking person as an animated PNG");
  reads(cmd->add_option("--pack", a->pack, "The character")->required());
  cmd->add_option("--text", a->voice.text, "What is said, UTF-8")->required();
  cmd->add_option("--language", a->voice.language, "Its language (default en)");
  cmd->add_option("--emotion", a->emotion, "joy, sadness ... or joy:0.7 (default calm)");
  cmd->add_option("--size", a->size, "Pixels of its width (default 320)")
      ->check(number_from(64, 800));
  cmd->add_option("--fps", a->fps, "Frames a second (default 15)")->check(number_from(5, 30));
  writes(cmd->add_option("-o,--out", a->out, "OUT.png")->required(), {".png"});
  cmd->footer("example: caryatid-tool clip --pack woman.pack --text \"Welcome!\" -o welcome.png");
  on_run(cmd, [a] { clip(*a); });
}

}  // namespace caryatid::tool
