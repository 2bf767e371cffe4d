#include "assets/bake/files/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace caryatid::bake {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": " + why);
}

bool written(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return !out.fail();
}

std::string cannot_be_written() {
  return std::string("cannot be written") +
         (errno != 0 ? std::string(", ") + std::strerror(errno) : "") +
         "; check the place and its room";
}

}  // namespace

std::string why_unreadable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path.empty()) return "an empty name; name a file";
  if (!fs::exists(status)) return "there is no such file; check the name";
  if (fs::is_directory(status)) return "is a folder; name a file";
  if (access(path.c_str(), R_OK) != 0)
    return std::string("cannot be read, ") + std::strerror(errno) + "; change that or the name";
  return {};
}

std::string why_unwritable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path.empty()) return "an empty name; name a file to write";
  if (fs::is_directory(status) || !path.has_filename())
    return "names a folder; name a file to write";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    return "there is no folder " + folder.string() + "; make it first";
  if (fs::exists(status) && access(path.c_str(), W_OK) != 0)
    return std::string("cannot be written, ") + std::strerror(errno) + "; name another file";
  // What is written is a new file that takes the old one's place; devices are written themselves.
  if ((!fs::exists(status) || fs::is_regular_file(status)) && access(folder.c_str(), W_OK) != 0)
    return "cannot be written to folder " + folder.string() + ", " + std::strerror(errno) +
           "; name another";
  return {};
}

std::string read_file(const fs::path& path) {
  if (const std::string why = why_unreadable(path); !why.empty()) fail(path, why);
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) fail(path, "cannot be read; check the file and its disk");
  return bytes;
}

void write_file(const fs::path& path, std::string_view bytes) {
  if (const std::string why = why_unwritable(path); !why.empty()) fail(path, why);
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    if (!written(path, bytes)) fail(path, cannot_be_written());
    return;
  }
  const fs::path file = fs::is_symlink(path, error) ? fs::weakly_canonical(path) : path;
  const fs::path beside = file.string() + ".part";
  bool whole = written(beside, bytes);
  std::string why = whole ? "" : cannot_be_written();
  if (whole) {
    fs::rename(beside, file, error);
    if (error) whole = false, why = "cannot be written, " + error.message();
  }
  if (whole) return;
  fs::remove(beside, error);
  fail(path, why);
}

}  // namespace caryatid::bake
