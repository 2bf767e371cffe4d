#include "assets/tool/spoken.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "assets/tool/flac.h"
#include "assets/tool/text_file.h"
#include "platform/audio/wav.h"
#include "platform/voice/recorded/recorded.h"
#include "platform/voice/wire.h"

extern char** environ;

namespace caryatid::tool {
namespace {

namespace wire = platform::wire;
using Kind = SpokenEvent::Kind;

std::string program_path(const VoiceJob& job) {
  if (!job.program.empty()) return job.program;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return (self.parent_path() / "caryatid-voice").string();
}

// The voice program at the other end of a socket; ends with this object.
class Program {
 public:
  explicit Program(const std::string& path) : path_(path) {
    int ends[2];
    if (access(path.c_str(), X_OK) != 0 ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error(path + ": no such program; build or install caryatid-voice");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    // Nothing of it goes between the tool's own lines.
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    char* arguments[] = {path_.data(), nullptr};
    const int error = posix_spawn(&pid_, path.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    socket_ = ends[0];
    if (error != 0) throw std::runtime_error(path + ": " + std::strerror(error));
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    close(socket_);  // A voice ends with that; another program may not.
    if (pid_ > 0 && silent_) kill(pid_, SIGKILL);
    if (pid_ > 0) waitpid(pid_, nullptr, 0);
  }

  void send_all(const std::string& bytes) const {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t n = send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) throw std::runtime_error("caryatid-voice ended; is espeak-ng-data installed?");
      sent += static_cast<std::size_t>(n);
    }
  }
  // The next record, which has to begin to come within `wait_s`.
  wire::Record next(int wait_s) {
    wire::Record record;
    const timeval wait{wait_s, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
    for (;;) {
      const Status status = reader_->next(&record);
      if (status.ok()) return record;
      if (status.code != Code::not_ready)
        throw std::runtime_error("caryatid-voice sent what no voice sends; build it again");
      const auto room = reader_->room();
      const ssize_t n = recv(socket_, room.data(), room.size(), 0);
      silent_ = n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
      if (silent_)
        throw std::runtime_error(path_ + ": said nothing for " + std::to_string(wait_s) +
                                 " s; is it caryatid-voice?");
      if (n <= 0) throw std::runtime_error("caryatid-voice ended; is espeak-ng-data installed?");
      reader_->took(static_cast<std::size_t>(n));
    }
  }

 private:
  std::string path_;
  pid_t pid_ = -1;
  int socket_ = -1;
  bool silent_ = false;
  std::unique_ptr<wire::Reader> reader_ = std::make_unique<wire::Reader>();
};

std::string request(const VoiceJob& job) {
  const std::size_t payload = wire::kSayBytes + job.language.size() + job.text.size();
  std::array<std::byte, wire::kHeadBytes + wire::kSayBytes> head{};
  wire::put_head(wire::Type::say, 1, payload, std::span(head).first<wire::kHeadBytes>());
  head[wire::kHeadBytes] = std::byte{job.ssml};
  head[wire::kHeadBytes + 1] = static_cast<std::byte>(job.language.size());
  const auto percent = [](double x) {
    return static_cast<std::uint16_t>(std::clamp(x, 0.5, 2.0) * 100.0 + 0.5);
  };
  wire::put_u16(percent(job.rate), &head[wire::kHeadBytes + 2]);
  wire::put_u16(percent(job.pitch), &head[wire::kHeadBytes + 4]);
  wire::put_u16(percent(job.range), &head[wire::kHeadBytes + 6]);
  return std::string(reinterpret_cast<const char*>(head.data()), head.size()) + job.language +
         job.text;
}

// False when this was the last record.
bool take(const wire::Record& record, const VoiceJob& job, Spoken* out) {
  const auto text = [&record] {
    const auto t = record.text(4);
    return std::string(t.data(), t.size());
  };
  switch (record.type) {
    case wire::Type::hello:
      out->rate_hz = record.u32(4);
      return true;
    case wire::Type::pcm: {
      const std::size_t at = out->samples.size();
      out->samples.resize(at + record.payload.size() / 2);
      std::memcpy(&out->samples[at], record.payload.data(), record.payload.size());
      return true;
    }
    case wire::Type::phone:
      out->events.push_back({Kind::phone, record.time_ms(), 0, 0, text()});
      return true;
    case wire::Type::word:
      out->events.push_back({Kind::word, record.time_ms(), record.u32(4), record.u32(8), ""});
      return true;
    case wire::Type::mark:
      out->events.push_back({Kind::mark, record.time_ms(), 0, 0, text()});
      return true;
    case wire::Type::sentence:
      out->events.push_back({Kind::sentence, record.time_ms(), 0, 0, ""});
      return true;
    case wire::Type::end:
      out->end_ms = record.time_ms();
      return false;
    case wire::Type::refused:
      throw std::runtime_error(job.language + ": " +
                               platform::voice_trouble_text(platform::VoiceTrouble{
                                   std::to_integer<std::uint8_t>(record.payload[0])}));
    default:
      throw std::runtime_error("caryatid-voice sent what no voice sends; build it again");
  }
}

const char* name_of(Kind kind) {
  constexpr const char* kNames[] = {"phone", "word", "mark", "sentence"};
  return kNames[static_cast<int>(kind)];
}

}  // namespace

Spoken speak(const VoiceJob& job) {
  if (job.text.size() > kMaxSpeechBytes || job.language.size() > 31)
    throw std::runtime_error("the text is longer than " + std::to_string(kMaxSpeechBytes) +
                             " bytes; split it");
  Program program(program_path(job));
  program.send_all(request(job));
  Spoken out;
  // It says hello at once; then it may have to think about a long sentence.
  constexpr int kHello_s = 8, kSentence_s = 60;
  for (int wait_s = kHello_s; take(program.next(wait_s), job, &out);) wait_s = kSentence_s;
  std::stable_sort(out.events.begin(), out.events.end(),
                   [](const auto& a, const auto& b) { return a.time_ms < b.time_ms; });
  return out;
}

void fill_utterance(const Spoken& spoken, std::int32_t now_ms, speech::Utterance* out) {
  constexpr std::int32_t kNear_ms = 3000;
  out->clear();
  for (const SpokenEvent& e : spoken.events) {
    if (e.time_ms < now_ms - kNear_ms || e.time_ms > now_ms + kNear_ms) continue;
    if (e.kind == Kind::phone) (void)out->add_phone(e.time_ms, speech::phoneme_of(e.text));
    if (e.kind == Kind::word) out->add_word(e.time_ms, e.begin_byte, e.end_byte);
    if (e.kind == Kind::mark) out->add_mark(e.time_ms, e.text);
    if (e.kind == Kind::sentence) out->add_sentence(e.time_ms);
  }
  if (spoken.end_ms <= now_ms + kNear_ms) out->finish(spoken.end_ms);
}

void write_wav(const Spoken& spoken, const std::string& path) {
  const auto head =
      platform::wav_head(spoken.rate_hz, static_cast<std::uint32_t>(spoken.samples.size()));
  std::string bytes(reinterpret_cast<const char*>(head.data()), head.size());
  bytes.append(reinterpret_cast<const char*>(spoken.samples.data()), 2 * spoken.samples.size());
  write_text(path, bytes);
}

Spoken read_wav(const std::string& path) {
  const std::string bytes = read_text(path);
  platform::WavFormat format;
  const Status status = platform::parse_wav(std::as_bytes(std::span(bytes)), bytes.size(), &format);
  if (!status.ok())
    throw std::runtime_error(path + ": " +
                             platform::wav_refusal_text(platform::WavRefusal(status.detail)) +
                             "; save it again as 16-bit WAV");
  Spoken out;
  out.rate_hz = format.rate_hz;
  out.end_ms = static_cast<std::int32_t>(format.frames * 1000 / format.rate_hz);
  for (std::uint64_t f = 0; f < format.frames; ++f) {
    int sum = 0;
    for (std::uint64_t c = 0; c < format.channels; ++c) {
      std::int16_t sample = 0;
      const std::uint64_t at = format.data_offset + 2 * (f * format.channels + c);
      std::memcpy(&sample, &bytes[static_cast<std::size_t>(at)], 2);
      sum += sample;
    }
    out.samples.push_back(static_cast<std::int16_t>(sum / format.channels));
  }
  return out;
}

Spoken read_recording(const std::string& path) {
  char start[4] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  const bool flac = std::memcmp(start, "fLaC", 4) == 0;
  if (!flac && path.ends_with(".flac"))
    throw std::runtime_error(path + ": is no FLAC file; save it again");
  return flac ? read_flac(path) : read_wav(path);
}

std::string timing_text(const Spoken& spoken) {
  std::string out = std::string(platform::kTimingHead) + "\n";
  for (const SpokenEvent& e : spoken.events) {
    out += std::string(name_of(e.kind)) + " " + std::to_string(e.time_ms);
    if (e.kind == Kind::word)
      out += " " + std::to_string(e.begin_byte) + " " + std::to_string(e.end_byte);
    if (!e.text.empty()) out += " " + e.text;
    out += "\n";
  }
  return out + "end " + std::to_string(spoken.end_ms) + "\n";
}

void read_timing(const std::string& path, Spoken* io) {
  std::istringstream lines(read_text(path));
  std::string line;
  int number = 1;
  const auto refuse = [&] {
    throw std::runtime_error(path + ":" + std::to_string(number) +
                             ": no line of a timing file; make it with caryatid-tool speech");
  };
  if (!std::getline(lines, line) || line != platform::kTimingHead) refuse();
  using LineKind = platform::TimingLine::Kind;
  while (std::getline(lines, line)) {
    ++number;
    platform::TimingLine t;
    if (!platform::parse_timing_line(line, &t)) refuse();
    if (t.kind == LineKind::none) continue;
    if (t.kind == LineKind::end) {
      io->end_ms = t.time_ms;
      return;
    }
    // The kinds stand in the same order, `none` before them.
    io->events.push_back({static_cast<Kind>(static_cast<int>(t.kind) - 1), t.time_ms, t.begin_byte,
                          t.end_byte, std::string(t.text.begin(), t.text.end())});
  }
  refuse();
}

}  // namespace caryatid::tool
