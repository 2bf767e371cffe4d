#pragma once
// Live reload of texts within fixed memory: when a file of the programme changes, a short-lived
// child process (this program with --compile-programme) parses and shapes it and writes the
// compiled block into a pipe; the kiosk reads it into memory that it has had since its start.
#include <sys/types.h>
#include <time.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/fixed.h"

namespace caryatid::app {

class Reload {
 public:
  Reload() = default;
  Reload(const Reload&) = delete;
  Reload& operator=(const Reload&) = delete;
  ~Reload();

  // Begins to watch. config: as --config; files: all that a compilation reads, config included.
  // Allocates; the rest does not.
  void watch(const std::string& config, const std::vector<std::string>& files);

  enum class State { quiet, ready, failed };
  // Once a frame; never waits. slot: where a new block goes; it must stay the same until `ready`
  // or `failed`. ready: `*out_bytes` of it are a block (not yet checked). failed: the child said
  // on stderr why.
  State poll(std::int64_t now_us, std::span<std::byte> slot, std::size_t* out_bytes);

 private:
  static constexpr std::int64_t kLook_us = 1'000'000;    // Between two looks at the files.
  static constexpr std::int64_t kLimit_us = 20'000'000;  // For a compilation.

  struct File {
    FixedString<255> name;
    timespec changed{};
    off_t bytes = 0;
    bool operator==(const File& other) const {
      return changed.tv_sec == other.changed.tv_sec && changed.tv_nsec == other.changed.tv_nsec &&
             bytes == other.bytes;
    }
  };
  static void look_at(File* file);
  bool look();
  void spawn(std::int64_t now_us);
  State read(std::int64_t now_us, std::span<std::byte> slot, std::size_t* out_bytes);
  State finish(bool good);

  FixedString<255> config_;
  FixedVector<File, 16> files_;
  bool changed_ = false;  // Seen at the last look: wait until the author has written it all.
  std::int64_t next_look_us_ = 0, limit_us_ = 0;
  pid_t child_ = -1;
  int pipe_ = -1;
  std::size_t bytes_ = 0;
};

// What the child does. The exit code: 0 and a block on stdout, or 1 and lines on stderr.
int compile_to_stdout(const std::string& config);

}  // namespace caryatid::app
