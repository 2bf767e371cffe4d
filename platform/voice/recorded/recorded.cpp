#include "platform/voice/recorded/recorded.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <new>

#include "platform/audio/wav.h"

namespace caryatid::platform {
namespace {

constexpr std::int32_t kMostTime_ms = 3'600'000;
constexpr std::size_t kLongestLine = 160;

// Takes the next word of a line off its front.
std::span<const char> take_word(std::span<const char>* io) {
  std::size_t begin = 0;
  while (begin < io->size() && (*io)[begin] == ' ') ++begin;
  std::size_t end = begin;
  while (end < io->size() && (*io)[end] != ' ') ++end;
  const auto word = io->subspan(begin, end - begin);
  *io = io->subspan(end);
  return word;
}

template <class Number>
bool take_number(std::span<const char>* io, Number* out) {
  const auto word = take_word(io);
  const char* end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, *out);
  return !word.empty() && error == std::errc() && at == end;
}

// A file that is read from front to back through a small buffer.
class Lines {
 public:
  ~Lines() { close_file(); }
  bool open_file(const char* path) {
    close_file();
    file_ = open(path, O_RDONLY | O_CLOEXEC);
    rewind();
    return file_ >= 0;
  }
  void close_file() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }
  void rewind() {
    (void)lseek(file_, 0, SEEK_SET);
    filled_ = begin_ = 0;
  }
  // The next line without its end; false at the end of the file or before a line that is too long.
  bool next(std::span<const char>* out) {
    for (;;) {
      const char* from = bytes_.data() + begin_;
      const void* end = std::memchr(from, '\n', filled_ - begin_);
      if (end != nullptr) {
        const auto size = static_cast<std::size_t>(static_cast<const char*>(end) - from);
        *out = {from, size > 0 && from[size - 1] == '\r' ? size - 1 : size};
        begin_ += size + 1;
        return true;
      }
      if (!read_more()) return false;
    }
  }

 private:
  bool read_more() {
    std::memmove(bytes_.data(), bytes_.data() + begin_, filled_ - begin_);
    filled_ -= begin_;
    begin_ = 0;
    if (filled_ > kLongestLine) return false;
    const ssize_t n = read(file_, bytes_.data() + filled_, bytes_.size() - filled_);
    if (n > 0) filled_ += static_cast<std::size_t>(n);
    return n > 0;
  }

  std::array<char, 1024> bytes_{};
  std::size_t begin_ = 0, filled_ = 0;
  int file_ = -1;
};

class Recorded final : public Voice {
 public:
  ~Recorded() override { close_sound(); }

  Status say(const SayJob& job, std::int64_t) override;
  void cancel() override { saying_ = false; }
  Status pump(std::int64_t, std::span<std::int16_t> out_pcm, std::size_t* out_count,
              speech::Utterance* io) override;
  std::uint32_t rate_hz() const override { return format_.rate_hz; }
  bool ready() const override { return true; }
  int descriptor() const override { return -1; }
  const char* trouble() const override { return why_.data(); }

 private:
  Status open_sound(const char* path);
  Status check_timing(const char* path);
  void close_sound();
  Status complain(Code code, const char* path, const char* what, const char* cure);
  bool read_events(std::int64_t until_ms, speech::Utterance* io);
  std::size_t read_sound(std::span<std::int16_t> out);

  std::array<char, 640> why_{};
  WavFormat format_{.rate_hz = 22050, .channels = 1};
  Lines timing_;
  TimingLine next_;
  std::array<char, kLongestLine> next_text_{};
  int sound_ = -1;
  std::uint64_t read_frames_ = 0;
  bool saying_ = false, waiting_ = false, ended_ = false;
};

void Recorded::close_sound() {
  if (sound_ >= 0) close(sound_);
  sound_ = -1;
}

Status Recorded::complain(Code code, const char* path, const char* what, const char* cure) {
  std::snprintf(why_.data(), why_.size(), "%s %s; %s", path, what, cure);
  return {code, static_cast<std::uint16_t>(VoiceTrouble::bad_recording)};
}

Status Recorded::open_sound(const char* path) {
  close_sound();
  sound_ = open(path, O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (sound_ < 0 || fstat(sound_, &about) != 0)
    return complain(Code::io, path, std::strerror(errno), "put it beside its timing");
  std::array<std::byte, 4096> start{};
  const ssize_t n = pread(sound_, start.data(), start.size(), 0);
  const Status status = parse_wav({start.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))},
                                  static_cast<std::uint64_t>(about.st_size), &format_);
  if (status.ok()) return {};
  return complain(status.code, path, wav_refusal_text(static_cast<WavRefusal>(status.detail)),
                  "save it again as 16-bit WAV");
}

Status Recorded::check_timing(const char* path) {
  constexpr const char* kCure = "make it with caryatid-tool speech";
  if (!timing_.open_file(path)) return complain(Code::io, path, std::strerror(errno), kCure);
  std::span<const char> text;
  TimingLine line;
  std::int32_t latest_ms = 0;
  int number = 1;
  bool good = timing_.next(&text) && text.size() == kTimingHead.size() &&
              std::memcmp(text.data(), kTimingHead.data(), text.size()) == 0;
  while (good && line.kind != TimingLine::Kind::end) {
    ++number;
    good = timing_.next(&text) && parse_timing_line(text, &line) &&
           (line.kind == TimingLine::Kind::none || line.time_ms >= latest_ms);
    if (line.kind != TimingLine::Kind::none) latest_ms = line.time_ms;
  }
  if (good) return {};
  char what[64];
  std::snprintf(what, sizeof what, "line %d is no line of a timing file in its order", number);
  return complain(Code::corrupt_data, path, what, kCure);
}

Status Recorded::say(const SayJob& job, std::int64_t) {
  saying_ = false;
  char path[256];
  const auto name = job.recording;
  if (name.size() + 8 > sizeof path)
    return complain(Code::invalid_argument, "recording", "has a name that is too long",
                    "shorten it");
  std::snprintf(path, sizeof path, "%.*s.wav", static_cast<int>(name.size()), name.data());
  CARYATID_TRY(open_sound(path));
  std::snprintf(path, sizeof path, "%.*s.timing", static_cast<int>(name.size()), name.data());
  CARYATID_TRY(check_timing(path));
  timing_.rewind();
  std::span<const char> head;
  if (!timing_.next(&head))
    return complain(Code::io, path, "can't be read again", "check the card");
  read_frames_ = 0;
  saying_ = true;
  waiting_ = ended_ = false;
  return {};
}

// Events up to `until_ms`. False: the file broke off, or changed since it was checked.
bool Recorded::read_events(std::int64_t until_ms, speech::Utterance* io) {
  while (!ended_) {
    if (!waiting_) {
      std::span<const char> line;
      if (!timing_.next(&line) || !parse_timing_line(line, &next_)) return false;
      const std::size_t size = std::min(next_.text.size(), next_text_.size());
      if (size > 0) std::memcpy(next_text_.data(), next_.text.data(), size);
      next_.text = {next_text_.data(), size};
      waiting_ = true;
    }
    if (next_.time_ms > until_ms && next_.kind != TimingLine::Kind::none) return true;
    switch (next_.kind) {
      case TimingLine::Kind::phone:
        if (!io->add_phone(next_.time_ms, speech::phoneme_of(next_.text)).ok()) return true;
        break;
      case TimingLine::Kind::word:
        io->add_word(next_.time_ms, next_.begin_byte, next_.end_byte);
        break;
      case TimingLine::Kind::mark:
        io->add_mark(next_.time_ms, next_.text);
        break;
      case TimingLine::Kind::sentence:
        io->add_sentence(next_.time_ms);
        break;
      case TimingLine::Kind::end:
        ended_ = true;
        break;
      case TimingLine::Kind::none:
        break;
    }
    waiting_ = false;
  }
  return true;
}

std::size_t Recorded::read_sound(std::span<std::int16_t> out) {
  std::array<std::int16_t, 2048> piece{};
  const std::size_t channels = format_.channels;
  std::size_t done = 0;
  while (done < out.size() && read_frames_ < format_.frames) {
    const std::size_t want = std::min({out.size() - done, piece.size() / channels,
                                       static_cast<std::size_t>(format_.frames - read_frames_)});
    const ssize_t n = pread(sound_, piece.data(), want * channels * 2,
                            static_cast<off_t>(format_.data_offset + read_frames_ * channels * 2));
    const std::size_t got = n > 0 ? static_cast<std::size_t>(n) / (2 * channels) : 0;
    if (got == 0) {
      read_frames_ = format_.frames;  // Torn off while it played: the rest is silence.
      break;
    }
    for (std::size_t i = 0; i < got; ++i)
      out[done + i] = channels == 1
                          ? piece[i]
                          : static_cast<std::int16_t>((piece[2 * i] + piece[2 * i + 1]) / 2);
    done += got;
    read_frames_ += got;
  }
  return done;
}

Status Recorded::pump(std::int64_t, std::span<std::int16_t> out_pcm, std::size_t* out_count,
                      speech::Utterance* io) {
  *out_count = 0;
  if (!saying_) return {};
  // Events are ahead of the sound by more than the mouth looks ahead.
  constexpr std::int64_t kAhead_ms = 1000;
  const auto read_ms =
      static_cast<std::int64_t>((read_frames_ + out_pcm.size()) * 1000 / format_.rate_hz);
  if (!read_events(read_ms + kAhead_ms, io)) {
    saying_ = false;
    return complain(Code::io, "recording", "broke off while it was played", "check the card");
  }
  *out_count = read_sound(out_pcm);
  if (read_frames_ == format_.frames && ended_) {
    io->finish(static_cast<std::int32_t>(format_.frames * 1000 / format_.rate_hz));
    saying_ = false;
  }
  return {};
}

}  // namespace

bool parse_timing_line(std::span<const char> line, TimingLine* out) {
  using Kind = TimingLine::Kind;
  *out = {};
  if (line.size() > kLongestLine) return false;
  const auto first = take_word(&line);
  const std::string_view name(first.data(), first.size());
  if (name.empty() || name.front() == '#') return true;
  if (name == "phone") out->kind = Kind::phone;
  if (name == "word") out->kind = Kind::word;
  if (name == "mark") out->kind = Kind::mark;
  if (name == "sentence") out->kind = Kind::sentence;
  if (name == "end") out->kind = Kind::end;
  if (out->kind == Kind::none || !take_number(&line, &out->time_ms) || out->time_ms < 0 ||
      out->time_ms > kMostTime_ms)
    return false;
  if (out->kind == Kind::word &&
      (!take_number(&line, &out->begin_byte) || !take_number(&line, &out->end_byte) ||
       out->begin_byte >= out->end_byte || out->end_byte > kMaxSpeechBytes))
    return false;
  if (out->kind == Kind::phone || out->kind == Kind::mark) out->text = take_word(&line);
  return take_word(&line).empty() && (out->kind != Kind::mark || !out->text.empty());
}

std::unique_ptr<Voice> make_recorded() {
  return std::unique_ptr<Voice>(new (std::nothrow) Recorded);
}

}  // namespace caryatid::platform
