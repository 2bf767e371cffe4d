#include "firmware-app/pack_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace caryatid::app {

std::string describe_refusal(const char* file, Status status) {
  return std::string(file) + ": " + pack::refusal_text(static_cast<pack::Refusal>(status.detail));
}

bool PackFile::open(const std::string& path, std::string* out_error) {
  close();
  name_ = path;
  file_ = std::fopen(path.c_str(), "rb");
  if (file_ == nullptr) {
    *out_error = path + ": " + std::strerror(errno) +
                 (errno == ENOENT ? "; bake one with caryatid-tool bake character"
                                  : "; let the kiosk's user read it");
    return false;
  }
  std::setvbuf(file_, nullptr, _IONBF, 0);  // next_piece() reads in large pieces itself.
  return take_header(out_error);
}

bool PackFile::open_builtin(std::string* out_error) {
  close();
  name_ = "built-in face";
  memory_ = builtin_face_pack();
  return take_header(out_error);
}

void PackFile::close() {
  if (file_ != nullptr) std::fclose(file_);
  file_ = nullptr;
  memory_ = {};
  exhausted_ = false;
}

bool PackFile::take_header(std::string* out_error) {
  const Result<pack::PackHeader> header = pack::read_header(next_piece(sizeof(pack::PackHeader)));
  if (!header.ok()) {
    *out_error = describe_refusal(name_.c_str(), header.status);
    return false;
  }
  header_ = header.value;
  return true;
}

std::span<const std::byte> PackFile::next_piece(std::size_t bytes) {
  if (file_ == nullptr) {
    const auto piece = memory_.first(std::min(bytes, memory_.size()));
    memory_ = memory_.subspan(piece.size());
    return piece;
  }
  const std::size_t got = std::fread(buffer_.data(), 1, std::min(bytes, buffer_.size()), file_);
  return {buffer_.data(), got};
}

Status PackFile::feed(std::size_t bytes, pack::Loader* loader) {
  while (bytes > 0 && !exhausted_) {
    const std::span<const std::byte> piece = next_piece(std::min(bytes, buffer_.size()));
    if (piece.empty()) {
      exhausted_ = true;
      return loader->end();
    }
    CARYATID_TRY(loader->feed(piece));
    bytes -= piece.size();
  }
  return {};
}

}  // namespace caryatid::app
