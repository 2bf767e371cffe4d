#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include "platform/clock/clock.h"
#include "platform/retry.h"
#include "platform/voice/voice.h"
#include "platform/voice/wire.h"

extern char** environ;

namespace caryatid::platform {
namespace {

using wire::Type;

constexpr std::int64_t kHung_us = 2'000'000;   // A voice that is asked answers within milliseconds.
constexpr std::int64_t kStart_us = 5'000'000;  // Reading its data from a slow card takes seconds.

class EspeakProcess final : public Voice {
 public:
  explicit EspeakProcess(const char* path) : path_(path) {}
  ~EspeakProcess() override;

  // False: there is no such program.
  bool start(std::int64_t now_us);

  Status say(const SayJob& job, std::int64_t now_us) override;
  void cancel() override;
  Status pump(std::int64_t now_us, std::span<std::int16_t> out_pcm, std::size_t* out_count,
              speech::Utterance* io) override;
  std::uint32_t rate_hz() const override { return rate_hz_; }
  bool ready() const override { return state_ == State::idle || state_ == State::saying; }
  int descriptor() const override { return socket_; }
  const char* trouble() const override { return voice_trouble_text(trouble_); }

 private:
  enum class State : std::uint8_t { down, starting, idle, saying };

  Status give_up(VoiceTrouble why);
  void end_program();
  bool is_gone();
  Status lose(VoiceTrouble why, std::int64_t now_us);
  bool flush();
  Status receive(std::int64_t now_us, bool* out_any);
  Status take(const wire::Record& record, speech::Utterance* io);
  Status pump_records(std::int64_t now_us, std::span<std::int16_t> out_pcm, std::size_t* out_count,
                      speech::Utterance* io);
  std::size_t take_pcm(std::span<std::int16_t> out_pcm);

  std::string path_;
  State state_ = State::down;
  VoiceTrouble trouble_ = VoiceTrouble::no_program;
  Retry retry_;
  pid_t pid_ = -1;
  pid_t dying_ = -1;  // Killed, not yet gone: a process that waits for a disk takes its time.
  int socket_ = -1;
  wire::Reader reader_;
  std::array<std::byte, wire::kHeadBytes + wire::kMostBytes> request_{};
  std::size_t request_bytes_ = 0, request_sent_ = 0;
  std::array<std::byte, wire::kHeadBytes> cancel_{};
  std::array<std::int16_t, wire::kMostPcmBytes / 2> pcm_{};  // Of the record that did not fit.
  std::size_t pcm_count_ = 0, pcm_taken_ = 0;
  wire::Record held_{};  // An event that has to wait for room in the utterance.
  bool holding_ = false;
  std::uint32_t utterance_ = 0;
  std::uint32_t text_bytes_ = 0;
  std::uint32_t rate_hz_ = 22050;
  std::int64_t heard_from_us_ = 0;
};

Status EspeakProcess::give_up(VoiceTrouble why) {
  trouble_ = why;
  const bool refused = why == VoiceTrouble::no_language || why == VoiceTrouble::refused_text;
  return {refused ? Code::unsupported : Code::io, static_cast<std::uint16_t>(why)};
}

EspeakProcess::~EspeakProcess() {
  end_program();
  if (dying_ > 0) (void)waitpid(dying_, nullptr, 0);
}

bool EspeakProcess::start(std::int64_t now_us) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return false;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);  // No device of ours.
  char* arguments[] = {path_.data(), nullptr};
  const int error = posix_spawn(&pid_, path_.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    pid_ = -1;
    retry_.start(now_us);
    return false;
  }
  socket_ = ends[0];
  (void)fcntl(socket_, F_SETFL, O_NONBLOCK);
  reader_.reset();
  request_bytes_ = request_sent_ = pcm_count_ = pcm_taken_ = 0;
  holding_ = false;
  state_ = State::starting;
  heard_from_us_ = now_us;
  return true;
}

void EspeakProcess::end_program() {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
  if (pid_ > 0) kill(pid_, SIGKILL);
  if (pid_ > 0) dying_ = pid_;
  pid_ = -1;
  (void)is_gone();
}

// The program that was killed last has ended.
bool EspeakProcess::is_gone() {
  if (dying_ > 0 && waitpid(dying_, nullptr, WNOHANG) != 0) dying_ = -1;
  return dying_ < 0;
}

// The program is lost, and with it what it was saying.
Status EspeakProcess::lose(VoiceTrouble why, std::int64_t now_us) {
  end_program();
  const bool was_saying = state_ == State::saying;
  // One that worked is tried soon; one that fails at once, ever more slowly.
  if (state_ == State::starting)
    retry_.failed(now_us);
  else
    retry_.start(now_us);
  state_ = State::down;
  return was_saying ? give_up(why) : Status{};
}

Status EspeakProcess::say(const SayJob& job, std::int64_t now_us) {
  if (!ready()) return {Code::not_ready, static_cast<std::uint16_t>(trouble_)};
  if (job.text.size() > kMaxSpeechBytes || job.language.size() > 31)
    return {Code::invalid_argument, static_cast<std::uint16_t>(VoiceTrouble::refused_text)};
  if (request_sent_ < request_bytes_)  // An earlier request is stuck in a full socket.
    return lose(VoiceTrouble::hung, now_us);
  const auto percent = [](float x) {
    return static_cast<std::uint16_t>(std::clamp(x, 0.5f, 2.0f) * 100.0f + 0.5f);
  };
  const std::size_t payload = wire::kSayBytes + job.language.size() + job.text.size();
  ++utterance_;
  text_bytes_ = static_cast<std::uint32_t>(job.text.size());
  std::byte* at = request_.data();
  wire::put_head(Type::say, utterance_, payload, std::span(request_).first<wire::kHeadBytes>());
  at += wire::kHeadBytes;
  at[0] = std::byte{job.ssml};
  at[1] = static_cast<std::byte>(job.language.size());
  wire::put_u16(percent(job.rate), at + 2);
  wire::put_u16(percent(job.pitch), at + 4);
  wire::put_u16(percent(job.range), at + 6);
  at += wire::kSayBytes;
  std::memcpy(at, job.language.data(), job.language.size());
  std::memcpy(at + job.language.size(), job.text.data(), job.text.size());
  request_bytes_ = wire::kHeadBytes + payload;
  request_sent_ = 0;
  pcm_count_ = pcm_taken_ = 0;
  holding_ = false;
  state_ = State::saying;
  heard_from_us_ = now_us;
  return flush() ? Status{} : lose(VoiceTrouble::crashed, now_us);
}

void EspeakProcess::cancel() {
  if (state_ != State::saying) return;
  state_ = State::idle;
  pcm_count_ = pcm_taken_ = 0;
  holding_ = false;
  // Any record interrupts it; this one asks for nothing.
  if (request_sent_ < request_bytes_) return;
  wire::put_head(Type::cancel, utterance_, 0, cancel_);
  std::memcpy(request_.data(), cancel_.data(), cancel_.size());
  request_bytes_ = cancel_.size();
  request_sent_ = 0;
  (void)flush();
}

// False: the program does not listen any more.
bool EspeakProcess::flush() {
  while (request_sent_ < request_bytes_) {
    const ssize_t n = send(socket_, request_.data() + request_sent_, request_bytes_ - request_sent_,
                           MSG_NOSIGNAL);
    if (n > 0) {
      request_sent_ += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return true;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

// Fills the reader once. Not ok: the program has ended.
Status EspeakProcess::receive(std::int64_t now_us, bool* out_any) {
  *out_any = false;
  const auto room = reader_.room();
  if (room.empty()) return {};
  const ssize_t n = recv(socket_, room.data(), room.size(), 0);
  if (n > 0) {
    reader_.took(static_cast<std::size_t>(n));
    heard_from_us_ = now_us;
    *out_any = true;
    return {};
  }
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return {};
  return {Code::device_lost, 0};
}

std::size_t EspeakProcess::take_pcm(std::span<std::int16_t> out_pcm) {
  const std::size_t n = std::min(out_pcm.size(), pcm_count_ - pcm_taken_);
  std::copy_n(pcm_.begin() + static_cast<std::ptrdiff_t>(pcm_taken_), n, out_pcm.begin());
  pcm_taken_ += n;
  return n;
}

// An event. out_of_capacity: it must wait until earlier ones have been heard.
Status EspeakProcess::take(const wire::Record& record, speech::Utterance* io) {
  switch (record.type) {
    case Type::phone:
      return io->add_phone(record.time_ms(), speech::phoneme_of(record.text(4)));
    case Type::word:
      if (record.u32(8) > text_bytes_ || record.u32(4) >= record.u32(8))
        return give_up(VoiceTrouble::broken_protocol);
      io->add_word(record.time_ms(), record.u32(4), record.u32(8));
      return {};
    case Type::mark:
      io->add_mark(record.time_ms(), record.text(4));
      return {};
    case Type::sentence:
      io->add_sentence(record.time_ms());
      return {};
    case Type::end:
      io->finish(record.time_ms());
      state_ = State::idle;
      return {};
    case Type::refused:
      state_ = State::idle;
      return give_up(record.payload[0] == std::byte{static_cast<int>(VoiceTrouble::no_language)}
                         ? VoiceTrouble::no_language
                         : VoiceTrouble::refused_text);
    default:
      return give_up(VoiceTrouble::broken_protocol);
  }
}

Status EspeakProcess::pump_records(std::int64_t now_us, std::span<std::int16_t> out_pcm,
                                   std::size_t* out_count, speech::Utterance* io) {
  for (;;) {
    *out_count += take_pcm(out_pcm.subspan(*out_count));
    if (pcm_taken_ < pcm_count_) return {};  // Full: the rest waits in the socket.
    if (holding_) {
      const Status taken = take(held_, io);
      if (taken.code == Code::out_of_capacity) return {};
      holding_ = false;
      CARYATID_TRY(taken);
      if (state_ != State::saying) return {};
    }
    wire::Record record;
    const Status next = reader_.next(&record);
    if (next.code == Code::not_ready) {
      bool any = false;
      CARYATID_TRY(receive(now_us, &any));
      if (!any) return {};
      continue;
    }
    CARYATID_TRY(next);
    if (record.type == Type::hello) {
      rate_hz_ = record.u32(4);
      if (record.u32(0) != wire::kVersion || rate_hz_ < 8000 || rate_hz_ > 96000)
        return give_up(VoiceTrouble::broken_protocol);
      if (state_ == State::starting) state_ = State::idle;
      continue;
    }
    if (state_ != State::saying || record.utterance != utterance_) continue;  // Of a cancelled one.
    if (record.type == Type::pcm) {
      pcm_count_ = record.payload.size() / 2;
      std::memcpy(pcm_.data(), record.payload.data(), record.payload.size());
      pcm_taken_ = 0;
      continue;
    }
    held_ = record;
    holding_ = true;
  }
}

Status EspeakProcess::pump(std::int64_t now_us, std::span<std::int16_t> out_pcm,
                           std::size_t* out_count, speech::Utterance* io) {
  *out_count = 0;
  if (state_ == State::down) {
    if (is_gone() && retry_.due(now_us) && !start(now_us)) retry_.failed(now_us);
    return {};
  }
  if (!flush()) return lose(VoiceTrouble::crashed, now_us);
  const Status status = pump_records(now_us, out_pcm, out_count, io);
  if (status.code == Code::device_lost) return lose(VoiceTrouble::crashed, now_us);
  if (status.code == Code::corrupt_data ||
      status.detail == static_cast<std::uint16_t>(VoiceTrouble::broken_protocol))
    return lose(VoiceTrouble::broken_protocol, now_us);
  if (!status.ok()) return status;
  // Only one that has been asked and has room to answer can be late.
  const bool waiting = state_ == State::saying && *out_count < out_pcm.size() && !holding_;
  if (!waiting && state_ != State::starting) heard_from_us_ = now_us;
  const std::int64_t patience_us = state_ == State::starting ? kStart_us : kHung_us;
  if (now_us - heard_from_us_ > patience_us) return lose(VoiceTrouble::hung, now_us);
  return {};
}

}  // namespace

const char* voice_trouble_text(VoiceTrouble trouble) {
  constexpr const char* kTexts[] = {
      "nothing is wrong",
      "the voice's program is not there or not ready; install caryatid-voice and espeak-ng-data",
      "the voice does not know this language; give a language that espeak-ng --voices lists",
      "the voice's program crashed; it is started again",
      "the voice's program hung; it is started again",
      "the voice's program sent what no voice sends; it is started again",
      "the voice can't speak this text",
      "the recording can't be played"};
  const auto i = static_cast<std::size_t>(trouble);
  return kTexts[i < std::size(kTexts) ? i : 0];
}

Status open_espeak_process(const char* path, std::unique_ptr<Voice>& out, ErrorLine& out_error) {
  std::unique_ptr<EspeakProcess> voice(new (std::nothrow) EspeakProcess(path));
  if (access(path, X_OK) != 0 || voice == nullptr || !voice->start(monotonic_us())) {
    const std::string line = std::string(path) + ": " + std::strerror(errno) +
                             "; build or install caryatid-voice, or name it with --voice";
    out_error = ErrorLine(line);
    return {Code::io, static_cast<std::uint16_t>(VoiceTrouble::no_program)};
  }
  out = std::move(voice);
  return {};
}

}  // namespace caryatid::platform
