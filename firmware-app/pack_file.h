#pragma once
// The bytes of a pack as they come: from a file, piece by piece, or from the built-in face.
#include <array>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>

#include "core/pack/loader.h"

namespace caryatid::app {

class PackFile {
 public:
  ~PackFile() { close(); }
  // Reads the header. False: `out_error` is one line "FILE: what; cure".
  bool open(const std::string& path, std::string* out_error);
  // The built-in face, compiled in.
  bool open_builtin(std::string* out_error);
  void close();

  const char* name() const { return name_.c_str(); }
  const pack::PackHeader& header() const { return header_; }
  // Feeds up to `bytes` more to the loader; ends it when no more come. Ok when the loader is. No
  // allocation; reads from the file system, so call it between frames.
  Status feed(std::size_t bytes, pack::Loader* loader);
  bool exhausted() const { return exhausted_; }

 private:
  bool take_header(std::string* out_error);
  std::span<const std::byte> next_piece(std::size_t bytes);

  std::string name_;
  std::FILE* file_ = nullptr;
  std::span<const std::byte> memory_;
  std::array<std::byte, 65536> buffer_;
  pack::PackHeader header_{};
  bool exhausted_ = false;
};

// One line for a refusal: "FILE: what; cure".
std::string describe_refusal(const char* file, Status status);

// assets of the built-in face: assets/programme/builtin_face.pack.
std::span<const std::byte> builtin_face_pack();

}  // namespace caryatid::app
