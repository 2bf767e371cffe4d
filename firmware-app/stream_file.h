#pragma once
// --play with an .fba stream: a file, a named pipe, or "-" for standard input, played while it
// arrives. A file starts over at its end; a pipe holds its last face.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stream/playback.h"

namespace caryatid::app {

class StreamFile {
 public:
  StreamFile() = default;
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  // Takes all memory that playing needs. False: one line "FILE: what; cure". A regular file must
  // hold at least one plane; what comes through a pipe is seen when it comes.
  bool open(const std::string& path, std::string* out_error);
  bool active() const { return descriptor_ >= 0; }
  // The rules of the face that plays; borrowed.
  void set_fit(std::span<const face::FitRule> fit) {
    fit_ = fit;
    if (playback_) playback_->set_fit(fit);
  }
  // Takes the memory for reopen() now.
  void reserve();
  // Plays another regular file from `time_s` on, without allocating. False: what played goes on.
  bool reopen(std::string_view path, double time_s);
  void close();

  // Reads what has come and shows what is due at `time_s` since the start. Never waits, allocates
  // nothing.
  void seek(double time_s);
  // Null until the stream has brought one.
  const face::FapFrame* faps() const;
  const body::BapFrame* baps() const;

 private:
  bool shows_something();
  void restart(double time_s);
  void read_some();

  std::string name_;
  int descriptor_ = -1;
  bool is_file_ = false;
  double start_s_ = 0.0;
  std::vector<std::byte> arrived_;  // Read, but not taken by the playback yet.
  std::span<const std::byte> waiting_;
  bool at_end_ = false;
  std::vector<std::byte> buffer_;
  std::vector<stream::ModelNode> nodes_;
  std::span<const face::FitRule> fit_ = face::default_fit();
  std::optional<stream::FbaPlayback> playback_;
};

}  // namespace caryatid::app
