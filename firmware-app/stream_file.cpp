#include "firmware-app/stream_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/base/fixed.h"

namespace caryatid::app {
namespace {

// Half a minute of a stream at 2 kbit/s; a pipe that brings more at once waits.
constexpr std::size_t kBufferBytes = 8192;
static_assert(kBufferBytes >= stream::FbaPlayback::kMinBufferBytes);
// Symbols that the models can remember between intra planes (256 KiB).
constexpr std::size_t kNodes = 32768;

}  // namespace

StreamFile::~StreamFile() { close(); }

bool StreamFile::open(const std::string& path, std::string* out_error) {
  name_ = path;
  descriptor_ =
      path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat status = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    *out_error = path + ": " + std::strerror(errno) + "; name a stream that can be read";
    return false;
  }
  is_file_ = S_ISREG(status.st_mode);
  if (descriptor_ == STDIN_FILENO)
    ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) | O_NONBLOCK);
  reserve();
  restart(0.0);
  if (!is_file_) return true;
  const bool shows = shows_something();
  const Status fault = playback_->last_fault();
  if (!shows)
    *out_error =
        name_ + ": " +
        (fault.ok() ? "no plane in it; give an .fba stream" : stream::describe_fba_fault(fault));
  restart(0.0);
  return shows;
}

void StreamFile::reserve() {
  arrived_.resize(kBufferBytes);
  buffer_.resize(kBufferBytes);
  nodes_.resize(kNodes);
}

bool StreamFile::reopen(std::string_view path, double time_s) {
  FixedString<255> name(path);
  struct stat status = {};
  const int next =
      name.size() == path.size() ? ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC) : -1;
  if (next < 0) return false;
  const int before = std::exchange(descriptor_, next);
  const bool was_file = std::exchange(is_file_, true);
  restart(time_s);
  const bool good = ::fstat(next, &status) == 0 && S_ISREG(status.st_mode) && shows_something();
  if (!good) {  // Back to what played; a pipe goes on at its next intra plane.
    ::close(next);
    descriptor_ = before;
    is_file_ = was_file;
  } else if (before > STDIN_FILENO) {
    ::close(before);
  }
  if (active()) restart(time_s);
  return good;
}

void StreamFile::close() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
  descriptor_ = -1;
}

// A file shows its first frame at once, or there is none in it.
bool StreamFile::shows_something() {
  for (int i = 0; i < 1024 && !playback_->ended(); ++i) {
    read_some();
    if (playback_->advance(0.0)) break;
  }
  return playback_->has_face() || playback_->has_body();
}

void StreamFile::restart(double time_s) {
  if (is_file_) ::lseek(descriptor_, 0, SEEK_SET);
  playback_.emplace(buffer_, nodes_, stream::FbaDecoder::Options{});
  playback_->set_fit(fit_);
  waiting_ = {};
  at_end_ = false;
  start_s_ = time_s;
}

void StreamFile::read_some() {
  if (waiting_.empty() && !at_end_) {
    const ssize_t count = ::read(descriptor_, arrived_.data(), arrived_.size());
    if (count > 0) waiting_ = {arrived_.data(), static_cast<std::size_t>(count)};
    const bool later = count < 0 && (errno == EAGAIN || errno == EINTR);
    // A named pipe without a writer reads as ended; one may come.
    at_end_ = is_file_ ? count == 0 : count < 0 && !later;
  }
  waiting_ = waiting_.subspan(playback_->push(waiting_));
  if (at_end_ && waiting_.empty()) playback_->close();
}

void StreamFile::seek(double time_s) {
  // As long as there is room in the buffer and bytes for it: a late start catches up.
  for (int i = 0; i < 64; ++i) {
    read_some();
    playback_->advance(time_s - start_s_);
    if (waiting_.empty()) break;
  }
  if (playback_->ended() && is_file_ && time_s - start_s_ >= playback_->next_due_s()) {
    restart(time_s);
    read_some();
    playback_->advance(0.0);
  }
}

const face::FapFrame* StreamFile::faps() const {
  return playback_ && playback_->has_face() ? &playback_->face() : nullptr;
}

const body::BapFrame* StreamFile::baps() const {
  return playback_ && playback_->has_body() ? &playback_->body() : nullptr;
}

}  // namespace caryatid::app
