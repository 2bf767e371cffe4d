// caryatid-tool speech: voices made ahead of time, recordings timed, mouths measured.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "assets/bake/speech/align.h"
#include "assets/bake/speech/contacts.h"
#include "assets/bake/speech/sync.h"
#include "assets/bake/stream/clip_files.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/numbers.h"
#include "assets/tool/spoken.h"
#include "assets/tool/studio.h"
#include "assets/tool/text_file.h"
#include "core/speech/mouth.h"
#include "core/speech/text.h"

namespace caryatid::tool {
namespace {

struct SpeechArgs {
  VoiceJob job;
  std::string recording, phones, out, metrics, pack, emotion;
  std::size_t worst = 0;
};

using Kind = SpokenEvent::Kind;

std::string without_suffix(const std::string& path, const std::string& suffix) {
  return path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
}

// NAME of an output: what stands there, or for a folder ("voices/") the name that the kiosk looks
// for.
std::string output_name(const SpeechArgs& a) {
  if (a.out.ends_with('/'))
    return a.out + speech::recording_name(a.job.text, a.job.language).c_str();
  return without_suffix(without_suffix(a.out, ".wav"), ".timing");
}

void write_pair(const Spoken& spoken, const std::string& name) {
  write_wav(spoken, name + ".wav");
  write_text(name + ".timing", timing_text(spoken));
  std::printf("%s.wav and %s.timing: %.2f s, %zu events\n", name.c_str(), name.c_str(),
              spoken.end_ms * 1e-3, spoken.events.size());
}

void claim_pair(const SpeechArgs& a) {
  const std::string name = output_name(a);
  std::vector<std::string> inputs;
  for (const std::string& in : {a.recording, a.phones})
    if (!in.empty()) inputs.push_back(in);
  // A recording may be timed in place: its WAV is written as it was.
  if (inputs.empty() || name + ".wav" != inputs.front()) claim(inputs, {name + ".wav"});
  claim(inputs, {name + ".timing"});
}

void bake_voice(const SpeechArgs& a) {
  check_text("TEXT", a.job.text);
  claim_pair(a);
  write_pair(speak(a.job), output_name(a));
}

// The mouth as FAP 1 and nothing else, 25 frames a second, for streams of other players.
void write_visemes(const SpeechArgs& a) {
  check_text("TEXT", a.job.text);
  constexpr double kFps = 25.0;
  const Spoken spoken = speak(a.job);
  const speech::Mouth mouth;
  auto utterance = std::make_unique<speech::Utterance>();
  bake::AnimationClip clip;
  clip.frames_per_second = kFps;
  for (double t = 0.0; t < spoken.end_ms; t += 1000.0 / kFps) {
    fill_utterance(spoken, static_cast<std::int32_t>(t), utterance.get());
    face::FapFrame frame;
    frame.viseme = mouth.at(*utterance, static_cast<float>(t), 1000.0f / kFps).viseme;
    frame.mask.set(face::kFapViseme);
    clip.face.push_back(frame);
  }
  bake::write_fap(clip, a.out);
  std::printf("%s: %zu frames\n", a.out.c_str(), clip.face.size());
}

// Phonemes in order, by blanks; "_" is a pause. Each gets its share of the recording by what it
// would last in a voice: nothing more is known.
Spoken voice_of_phones(const std::string& path) {
  std::istringstream lines(read_text(path));
  Spoken out;
  std::string line, ipa;
  // What unknown symbols become; a voice may have some, a file written by hand should not.
  const speech::Sound unknown = speech::phoneme_of(std::string_view("?")).begins;
  for (int number = 1; std::getline(lines, line); ++number)
    for (std::istringstream words(line); words >> ipa;) {
      const speech::Phoneme p = speech::phoneme_of(ipa);
      const bool word = ipa.size() <= 24 && printable(ipa) == ipa;
      if (!word || (p.begins == unknown && p.ends == unknown))
        throw std::runtime_error(path + ":" + std::to_string(number) + ": '" + ipa +
                                 "' is no phoneme; write IPA by blanks: p a _ t a");
      out.events.push_back({Kind::phone, out.end_ms, 0, 0, ipa == "_" ? "" : ipa});
      out.end_ms += p.begins.silent() ? 150 : (p.begins.vowel ? 110 : 70);
    }
  if (out.events.empty()) throw std::runtime_error(path + ": holds no phonemes; write p a _ t a");
  return out;
}

// The part of a recording that is not silence at its ends, in milliseconds.
std::pair<double, double> sounding_ms(const Spoken& recording) {
  int loudest = 1;
  for (const std::int16_t s : recording.samples) loudest = std::max(loudest, std::abs(int{s}));
  std::size_t first = recording.samples.size(), last = 0;
  for (std::size_t i = 0; i < recording.samples.size(); ++i)
    if (std::abs(int{recording.samples[i]}) > loudest / 20) {
      first = std::min(first, i);
      last = i;
    }
  return {static_cast<double>(first) * 1000.0 / recording.rate_hz,
          static_cast<double>(last) * 1000.0 / recording.rate_hz};
}

void time_recording(const SpeechArgs& a) {
  if (a.phones.empty()) check_text("--text", a.job.text);
  claim_pair(a);
  Spoken recording = read_recording(a.recording);
  Spoken timing = a.phones.empty() ? speak(a.job) : voice_of_phones(a.phones);
  std::int32_t before_ms = 0;
  const auto move = [&](auto map) {
    for (SpokenEvent& e : timing.events) {
      e.time_ms =
          std::clamp(static_cast<std::int32_t>(map(e.time_ms)), before_ms, recording.end_ms);
      before_ms = e.time_ms;
    }
  };
  if (a.phones.empty()) {
    const bake::TimeMap map =
        bake::align({timing.samples, timing.rate_hz}, {recording.samples, recording.rate_hz});
    move([&map](int ms) { return 1000.0 * map(ms * 1e-3); });
  } else {
    const auto [from, to] = sounding_ms(recording);
    move([&, f = from, t = to](int ms) { return f + (t - f) * ms / timing.end_ms; });
  }
  recording.events = std::move(timing.events);
  write_pair(recording, output_name(a));
}

std::vector<bake::TimedPhone> phones_of(const Spoken& spoken) {
  std::vector<bake::TimedPhone> out;
  for (const SpokenEvent& e : spoken.events)
    if (e.kind == Kind::phone) out.push_back({e.time_ms * 1e-3, e.text});
  return out;
}

std::vector<bake::MouthFrame> read_metrics(const std::string& path) {
  std::vector<bake::MouthFrame> out;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto j = nlohmann::json::parse(line, nullptr, false);
    if (j.is_discarded())
      throw std::runtime_error(path + ":" + std::to_string(number) +
                               ": no JSON; run caryatid with"
                               " --metrics again");
    if (!j.contains("speech")) continue;
    const auto& s = j["speech"];
    out.push_back({j["time_s"], s["jaw"], s["upper_lip"], s["lower_lip"], s["corner"],
                   s["lower_thrust"], s["upper_thrust"]});
  }
  return out;
}

// Times of the phones as they are heard in the file: where pieces of the voice's sound are found.
// Throws when none of them is there.
std::vector<bake::TimedPhone> heard_phones(const Spoken& spoken, const Spoken& file,
                                           const std::string& path, double* out_offset_spread_s) {
  constexpr std::size_t kPart = 2048;
  constexpr std::int64_t kReach = 4410;  // 0.2 s either way.
  const auto first_sound = [](const Spoken& s) {
    std::int64_t i = 0;
    while (i < static_cast<std::int64_t>(s.samples.size()) &&
           std::abs(int{s.samples[std::size_t(i)]}) < 30)
      ++i;
    return i;
  };
  std::int64_t offset = first_sound(file) - first_sound(spoken);
  std::int64_t least = offset, most = offset;
  std::vector<bake::TimedPhone> out = phones_of(spoken);
  double looked_s = -10.0;
  bool looked = false, heard = false;
  for (bake::TimedPhone& p : out) {
    const auto at = static_cast<std::int64_t>(p.start_s * spoken.rate_hz);
    const bool room =
        at + static_cast<std::int64_t>(kPart) < static_cast<std::int64_t>(spoken.samples.size());
    if (p.start_s - looked_s > 2.0 && !p.ipa.empty() && room) {
      looked = true;
      const std::span part(spoken.samples.data() + at, kPart);
      if (const auto found = bake::find_sound(file.samples, part, at + offset, kReach);
          found >= 0) {
        heard = true;
        offset = found - at;
        least = std::min(least, offset);
        most = std::max(most, offset);
        looked_s = p.start_s;
      }
    }
    p.start_s += static_cast<double>(offset) / spoken.rate_hz;
  }
  if (looked && !heard)
    throw std::runtime_error(path +
                             ": does not hold the sound of that text; give the text and "
                             "language of the run");
  *out_offset_spread_s = static_cast<double>(most - least) / spoken.rate_hz;
  return out;
}

// The sounds whose mouth is farthest from the middle of what people accept, with their neighbours.
void print_worst(const bake::SyncReport& r, const std::vector<bake::TimedPhone>& phones,
                 std::size_t count) {
  std::vector<std::size_t> order(r.late_s.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto off = [&r](std::size_t i) { return std::abs(r.late_s[i] + 0.015); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return off(a) > off(b); });
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) {
    const double at_s = r.at_s[order[k]];
    std::printf("%8.3f s %4.0f ms  ", at_s, 1000.0 * r.late_s[order[k]]);
    for (const bake::TimedPhone& p : phones)
      if (std::abs(p.start_s - at_s) < 0.3)
        std::printf(" %s%s", p.start_s == at_s ? ">" : "", p.ipa.empty() ? "_" : p.ipa.c_str());
    std::printf("\n");
  }
}

void sync(const SpeechArgs& a) {
  check_text("--text", a.job.text);
  const Spoken spoken = speak(a.job), file = read_wav(a.recording);
  double spread_s = 0.0;
  const auto phones = heard_phones(spoken, file, a.recording, &spread_s);
  const bake::SyncReport r = bake::measure_sync(read_metrics(a.metrics), phones);
  if (r.late_s.empty())
    throw std::runtime_error(
        a.metrics +
        ": nothing to measure: no sound of the text moves the "
        "mouth there; give the files and the --text of one run, of two words or more");
  const auto ms = [](double s) { return 1000.0 * s; };
  std::printf("%.1f s of sound; its place in the file wanders by %.2f ms\n", spoken.end_ms * 1e-3,
              ms(spread_s));
  const auto print = [&ms](const char* what, std::span<const double> late_s) {
    std::printf(
        "%s, %zu of them, ms after the sound: p0.5 %.0f, p5 %.0f, p50 %.0f, p95 %.0f, p99.5"
        " %.0f; sound leads by at most 15 and lags by at most 45: %.2f %%\n",
        what, late_s.size(), ms(bake::percentile(late_s, 0.5)), ms(bake::percentile(late_s, 5)),
        ms(bake::percentile(late_s, 50)), ms(bake::percentile(late_s, 95)),
        ms(bake::percentile(late_s, 99.5)), 100.0 * bake::share_within(late_s, -0.045, 0.015));
  };
  print("visemes", r.late_s);
  print("first frames of contacts", r.contact_late_s);
  std::printf("drift: %.2f ms a minute\n", 60.0 * ms(bake::drift_s_per_s(r)));
  std::printf("lips shut on p b m: %zu of %zu; lower lip at the teeth on f v: %zu of %zu\n", r.shut,
              r.bilabials, r.touching, r.labiodentals);
  print_worst(r, phones, a.worst);
}

void contacts(const SpeechArgs& a) {
  check_text("--text", a.job.text);
  const face::FapFrame mood = a.emotion.empty() ? face::FapFrame{} : emotion_named(a.emotion);
  Studio studio(a.pack, 64, 64);
  const Spoken spoken = speak(a.job);
  const bake::ContactReport r =
      bake::measure_contacts(phones_of(spoken), spoken.end_ms * 1e-3, mood, &studio.person());
  std::printf("lips shut on p b m: %zu of %zu, widest gap %.2f mm\n", r.shut, r.bilabials,
              static_cast<double>(r.widest_gap_m) * 1e3);
  std::printf("lower lip at the teeth on f v: %zu of %zu, farthest %.2f mm\n", r.touching,
              r.labiodentals, static_cast<double>(r.farthest_teeth_m) * 1e3);
}

void add_voice_options(CLI::App* cmd, SpeechArgs* a) {
  cmd->add_option("--language", a->job.language, "Language tag: en, el, de ... (default en)");
  cmd->add_flag("--ssml", a->job.ssml, "The text is SSML");
  cmd->add_option("--rate", a->job.rate, "Of the voice's own pace (default 1)")
      ->check(number_from(0.5, 2.0));
  cmd->add_option("--voice", a->job.program, "caryatid-voice (default: beside this program)");
}

void add_speech_bake(CLI::App* speech) {
  auto a = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("bake", "Synthesise a text: NAME.wav and NAME.timing");
  cmd->add_option("text", a->job.text, "What is said, UTF-8")->required();
  add_voice_options(cmd, a.get());
  cmd->add_option("-o,--out", a->out, "NAME, or FOLDER/ for caryatid --recordings")->required();
  cmd->footer("example: caryatid-tool speech bake \"Press five for maps.\" -o maps");
  on_run(cmd, [a] { bake_voice(*a); });
}

void add_speech_time(CLI::App* speech) {
  auto a = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("time", "The timing of a recorded voice");
  reads(cmd->add_option("recording", a->recording, "RECORDING.wav or .flac")->required());
  CLI::Option* text = cmd->add_option("--text", a->job.text, "What is said in it, UTF-8");
  reads(cmd->add_option("--phones", a->phones,
                        "A file of its phonemes in IPA instead, by blanks; _ is a pause"))
      ->excludes(text);
  add_voice_options(cmd, a.get());
  cmd->add_option("-o,--out", a->out, "OUT.timing (and OUT.wav), or FOLDER/")->required();
  cmd->footer("example: caryatid-tool speech time maps.wav --text \"Press five.\" -o maps.timing");
  on_run(cmd, [a] {
    if (a->job.text.empty() && a->phones.empty())
      throw UsageError("give --text TEXT or --phones FILE");
    time_recording(*a);
  });
}

void add_speech_visemes(CLI::App* speech) {
  auto a = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("visemes", "The mouth of a text as FAP 1, for streams");
  cmd->add_option("text", a->job.text, "What is said, UTF-8")->required();
  add_voice_options(cmd, a.get());
  writes(cmd->add_option("-o,--out", a->out, "OUT.fap")->required(), {".fap"});
  cmd->footer("example: caryatid-tool speech visemes \"Hello.\" -o hello.fap; then fba encode");
  on_run(cmd, [a] { write_visemes(*a); });
}

void add_speech_sync(CLI::App* speech) {
  auto a = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("sync", "Mouth against sound, from what a kiosk left");
  reads(cmd->add_option("--audio", a->recording, "The file of caryatid --audio file:FILE")
            ->required());
  reads(
      cmd->add_option("--metrics", a->metrics, "The file of caryatid --metrics FILE")->required());
  cmd->add_option("--text", a->job.text, "The text of caryatid --say TEXT")->required();
  cmd->add_option("--worst", a->worst, "Lists so many of the sounds that are farthest off");
  add_voice_options(cmd, a.get());
  cmd->footer(
      "example: caryatid --say \"Press five for maps.\" --display none --virtual-clock \\\n"
      "           --duration 6 --audio file:a.wav --metrics m.jsonl\n"
      "         caryatid-tool speech sync --audio a.wav --metrics m.jsonl \\\n"
      "           --text \"Press five for maps.\"");
  on_run(cmd, [a] { sync(*a); });
}

void add_speech_contacts(CLI::App* speech) {
  auto a = std::make_shared<SpeechArgs>();
  CLI::App* cmd = speech->add_subcommand("contacts", "Lips and teeth of a spoken text on the mesh");
  reads(cmd->add_option("--pack", a->pack, "The character")->required());
  cmd->add_option("--text", a->job.text, "What is said, UTF-8")->required();
  cmd->add_option("--emotion", a->emotion, "joy, sadness ... or joy:0.7 (default calm)");
  add_voice_options(cmd, a.get());
  cmd->footer("example: caryatid-tool speech contacts --pack woman.pack --text \"Five maps.\"");
  on_run(cmd, [a] { contacts(*a); });
}

}  // namespace

void add_speech(CLI::App& app) {
  CLI::App* speech = app.add_subcommand("speech", "Voices made ahead of time; mouths measured");
  speech->require_subcommand(1);
  add_speech_bake(speech);
  add_speech_time(speech);
  add_speech_visemes(speech);
  add_speech_sync(speech);
  add_speech_contacts(speech);
}

}  // namespace caryatid::tool
