#include "firmware-app/texts/files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace caryatid::app {
namespace {

// Bytes of the UTF-8 character at `at`, or 0 when there is none (RFC 3629: no overlong forms, no
// surrogates, at most U+10FFFF).
std::size_t length_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  if (first >= 0xC2 && first <= 0xDF) return tail(at + 1) ? 2 : 0;
  const unsigned second = byte(at + 1);
  if (first >= 0xE0 && first <= 0xEF) {
    const bool sound =
        tail(at + 1) && !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second >= 0xA0);
    return sound && tail(at + 2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool sound =
        tail(at + 1) && !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second >= 0x90);
    return sound && tail(at + 2) && tail(at + 3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::size_t mend_utf8(std::string* io_text) {
  std::size_t line = 1, bad_line = 0;
  std::string mended;
  for (std::size_t at = 0; at < io_text->size();) {
    const std::size_t length = length_at(*io_text, at);
    if ((*io_text)[at] == '\n') ++line;
    if (length == 0) {
      if (bad_line == 0) bad_line = line;
      mended += "\xEF\xBF\xBD";
      ++at;
      continue;
    }
    mended.append(*io_text, at, length);
    at += length;
  }
  if (bad_line != 0) *io_text = mended;
  return bad_line;
}

ProgrammeFiles::ProgrammeFiles(const std::string& config, std::vector<BuiltinFile> builtin,
                               const std::string& builtin_config)
    : config_(config), builtin_used_(config.empty()), builtin_(std::move(builtin)) {
  if (builtin_used_) {
    config_ = builtin_config;
    return;
  }
  const std::size_t slash = config_.rfind('/');
  if (slash == std::string::npos) return;
  folder_ = config_.substr(0, slash + 1);
  config_ = config_.substr(slash + 1);
}

bool ProgrammeFiles::exists(const std::string& name) const {
  if (builtin_used_)
    return std::any_of(builtin_.begin(), builtin_.end(),
                       [&](const BuiltinFile& f) { return f.name == name; });
  return access(full_name(name).c_str(), R_OK) == 0;
}

bool ProgrammeFiles::read(const std::string& name, std::size_t most_bytes, std::string* out,
                          std::string* out_error) {
  out->clear();
  if (builtin_used_) {
    for (const BuiltinFile& f : builtin_)
      if (f.name == name) {
        out->assign(f.bytes);
        return true;
      }
    *out_error = "is not built in; name a folder with it by --config";
    return false;
  }
  read_.push_back(full_name(name));
  std::FILE* file = std::fopen(full_name(name).c_str(), "rb");
  if (file == nullptr) {
    *out_error = std::string(std::strerror(errno)) + "; put it there or name another";
    return false;
  }
  char piece[16384];
  for (std::size_t n; out->size() <= most_bytes && (n = std::fread(piece, 1, sizeof piece, file));)
    out->append(piece, n);
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) *out_error = "can't be read; look at the disk";
  if (out->size() > most_bytes)
    *out_error = "is larger than " + std::to_string(most_bytes / 1024) + " KiB; make it smaller";
  return !failed && out->size() <= most_bytes;
}

}  // namespace caryatid::app
