#pragma once
// The agent's one block of memory: mapped and touched at start, locked where the system lets us.
#include <sys/mman.h>

#include <cstddef>
#include <span>

#include "core/base/arena.h"

namespace caryatid::app {

class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { release(); }

  // Maps `bytes`; anything mapped before is given back. False when the system has not so much.
  bool map(std::size_t bytes) {
    release();
    void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
    if (at == MAP_FAILED) return false;
    (void)mlock(at, bytes);  // Best effort: RLIMIT_MEMLOCK may forbid it.
    block_ = {static_cast<std::byte*>(at), bytes};
    new (&arena_) Arena(block_);
    return true;
  }
  Arena& arena() { return arena_; }

 private:
  void release() {
    if (!block_.empty()) munmap(block_.data(), block_.size());
    block_ = {};
  }

  std::span<std::byte> block_;
  Arena arena_{{}};
};

}  // namespace caryatid::app
