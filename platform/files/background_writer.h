#pragma once
// Small files that are written again and again while the kiosk runs (status, last state), without
// ever making a frame wait for the disk: one thread replaces them whole, by write and rename, so a
// reader or a power cut finds the old file or the new one, never a piece.
#include <pthread.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/status.h"

namespace caryatid::platform {

class BackgroundWriter {
 public:
  static constexpr std::size_t kMaxFiles = 4;
  static constexpr std::size_t kMaxFileBytes = 4096;

  BackgroundWriter() = default;
  // Writes what still waits and ends the thread.
  ~BackgroundWriter() { stop(); }
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  // Before start(). durable: synced to the disk before the rename, for what must survive a power
  // cut. Gives the file's number. out_of_capacity: too many files, or the path is too long.
  Result<std::size_t> add(const char* path, bool durable);
  // Makes the thread. io: the system refuses one.
  Status start();
  void stop();

  // Leaves the file's new content for the thread; what it has not written yet is replaced. Waits
  // for nothing but a copy of 4 KiB. out_of_capacity: too long; io: the last write failed (errno in
  // `detail`), told once.
  Status put(std::size_t file, std::span<const char> content);

 private:
  struct File {
    FixedString<247> path;
    bool durable = false, waiting = false;
    std::uint16_t error = 0;
    std::size_t size = 0;
    std::array<char, kMaxFileBytes> content;
  };
  static void* run(void* self);
  void work();

  FixedVector<File, kMaxFiles> files_;
  std::array<char, kMaxFileBytes> copy_;
  pthread_t thread_{};
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
  pthread_cond_t change_ = PTHREAD_COND_INITIALIZER;
  bool running_ = false, ending_ = false;
};

// Replaces `path` by `content` as above; 0 or errno.
int replace_file(const char* path, std::span<const char> content, bool durable);

}  // namespace caryatid::platform
