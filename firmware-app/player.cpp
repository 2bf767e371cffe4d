#include "firmware-app/player.h"

#include <sys/stat.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/emotion/profiles.h"
#include "core/face/fap_fill.h"
#include "core/face/visemes.h"

namespace caryatid::app {
namespace {

constexpr long kMaxFileBytes = 64l << 20;

bool ends_with(const std::string& text, const char* end) {
  const std::size_t n = std::strlen(end);
  return text.size() >= n && text.compare(text.size() - n, n, end) == 0;
}

bool is_pipe(const std::string& path) {
  struct stat status = {};
  return ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

}  // namespace

bool Player::open(const std::string& path, std::string* out_error) {
  if (path == "-" || ends_with(path, ".fba") || is_pipe(path)) return stream_.open(path, out_error);
  name_ = path;
  is_body_ = ends_with(path, ".bap");
  if (!is_body_ && !ends_with(path, ".fap")) {
    *out_error = path + ": not a .fap, .bap or .fba; convert it with caryatid-tool fba";
    return false;
  }
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    *out_error = path + ": " + std::strerror(errno) + "; name a file that can be read";
    return false;
  }
  std::fseek(file, 0, SEEK_END);
  const long bytes = std::ftell(file);
  std::rewind(file);
  const bool fits = bytes > 0 && bytes <= kMaxFileBytes;
  if (fits) {
    text_ = std::make_unique<char[]>(static_cast<std::size_t>(bytes));
    size_ = std::fread(text_.get(), 1, static_cast<std::size_t>(bytes), file);
  }
  std::fclose(file);
  if (!fits || size_ == 0) {
    *out_error = path + ": empty or longer than 64 MiB; cut it into pieces";
    return false;
  }
  const bool ok = is_body_ ? check(stream::BapTextReader(text()), body::BapFrame{}, out_error)
                           : check(stream::FapTextReader(text()), face::FapFrame{}, out_error);
  if (!ok) size_ = 0;
  return ok;
}

template <class Reader, class Frame>
bool Player::check(Reader reader, Frame frame, std::string* out_error) {
  Status status = reader.read_header();
  if (status.ok()) fps_ = static_cast<double>(reader.header().frames_per_second);
  while (status.ok()) {
    status = reader.next(&frame);
    if (status.ok()) ++frame_count_;
  }
  const bool at_end =
      static_cast<stream::TextFault>(status.detail) == stream::TextFault::end_of_text;
  if (at_end && frame_count_ > 0) return true;
  *out_error =
      name_ + ":" + std::to_string(reader.line()) + ": " +
      (at_end ? "no frame in it; write at least one" : stream::describe_text_fault(status));
  return false;
}

template <class Reader, class Frame>
void Player::advance(std::uint32_t frame, Reader* reader, Frame* out) {
  if (next_frame_ == 0 || frame + 1 < next_frame_) {
    *reader = Reader(text());
    *out = Frame{};
    next_frame_ = 0;
  }
  while (next_frame_ <= frame && reader->next(out).ok()) ++next_frame_;
}

// Fields of FAPs 1 and 2 become low-level FAPs.
void Player::expand(const face::FapFrame& raw) {
  faps_ = raw;
  face::expand_viseme(faps_);
  emotion::expand_expression(faps_);
  has_face_ = true;
}

void Player::seek(double time_s) {
  if (stream_.active()) {
    stream_.seek(time_s);
    if (stream_.faps() != nullptr) expand(*stream_.faps());
    return;
  }
  const double position = std::floor(time_s * fps_ + 1e-6);
  const auto frame = static_cast<std::uint32_t>(std::fmod(position, frame_count_));
  if (is_body_) return advance(frame, &bap_reader_, &baps_);
  advance(frame, &fap_reader_, &raw_faps_);
  expand(raw_faps_);
  face::fill_from_partners(&faps_, fit_);
  face::limit_to_coding_range(&faps_);
}

}  // namespace caryatid::app
