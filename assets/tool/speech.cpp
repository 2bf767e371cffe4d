// caryatid-tool speech: voices made ahead of time.
#include <cstdio>
#include <stdexcept>

#include "assets/tool/commands.h"
#include "assets/tool/spoken.h"
#include "assets/tool/text_file.h"

namespace caryatid::tool {
namespace {

struct SpeechArgs {
  VoiceJob job;
  std::string recording, phones, out;
};

std::string without_suffix(const std::string& path, const std::string& suffix) {
  return path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
}

void bake(const SpeechArgs& a) {
  const std::string name = without_suffix(a.out, ".wav");
  const Spoken spoken = speak(a.job);
  write_wav(spoken, name + ".wav");
  write_text(name + ".timing", timing_text(spoken));
  std::printf("%s.wav and %s.timing: %.2f s, %zu events\n", name.c_str(), name.c_str(),
              spoken.end_ms * 1e-3, spoken.events.size());
}

void add_voice_options(CLI::App* cmd, SpeechArgs* a) {
  cmd->add_option("--language", a->job.language, "Language tag: en, el, de ... (default en)");
  cmd->add_flag("--ssml", a->job.ssml, "The text is SSML");
  cmd->add_option("--rate", a->job.rate, "Of the voice's own pace (default 1)")
      ->check(CLI::Range(0.5, 2.0));
  cmd->add_option("--voice", a->job.program, "caryatid-voice (default: beside this program)");
}

}  // namespace

void add_speech(CLI::App& app) {
  CLI::App* speech = app.add_subcommand("speech", "Voices made ahead of time");
  speech->require_subcommand(1);
  auto b = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("bake", "Synthesise a text: NAME.wav and NAME.timing");
  cmd->add_option("text", b->job.text, "What is said, UTF-8")->required();
  add_voice_options(cmd, b.get());
  cmd->add_option("-o,--out", b->out, "NAME, with or without .wav")->required();
  cmd->footer("example: caryatid-tool speech bake \"Press five for maps.\" -o voice/maps");
  cmd->callback([b] { bake(*b); });
}

}  // namespace caryatid::tool
