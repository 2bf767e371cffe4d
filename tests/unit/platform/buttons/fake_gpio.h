#pragma once
// A board without a board: the functions of libgpiod that a backend calls, linked in place of the
// library, over this small world. One file for each API: fake_gpiod_v1.cpp, fake_gpiod_v2.cpp.
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace caryatid::platform::testing {

// As it travels through a line's pipe, which stands for the kernel's queue.
struct FakeEvent {
  std::uint64_t time_ns = 0;
  unsigned long seqno = 0;
  bool rising = false;
};

struct FakeLine {
  std::string name;
  int request_errno = 0;  // What a request fails with.
  int read_errno = 0;     // What reading events fails with.
  int level = 0;          // What the line reads, active-low already applied; -1: error.
  // What the backend asked for.
  bool requested = false, active_low = false;
  int bias = 0;  // -1 disabled, 0 as is, 1 up, 2 down.
  unsigned long debounce_us = 0;
  int read_end = -1, write_end = -1;
  unsigned long next_seqno = 1;

  void open_pipe() {
    int ends[2];
    if (pipe2(ends, O_NONBLOCK) != 0) return;
    read_end = ends[0];
    write_end = ends[1];
    requested = true;
    next_seqno = 1;
  }
  void close_pipe() {
    if (read_end >= 0) ::close(read_end);
    if (write_end >= 0) ::close(write_end);
    read_end = write_end = -1;
    requested = false;
  }
  void edge(bool rising, std::int64_t time_us) {
    const FakeEvent event{static_cast<std::uint64_t>(time_us) * 1000, next_seqno++, rising};
    [[maybe_unused]] const ssize_t size = ::write(write_end, &event, sizeof event);
    level = rising ? 1 : 0;
  }
  // The kernel's queue was full: the edge is lost, but the level has changed.
  void lose_edge(bool rising) {
    ++next_seqno;
    level = rising ? 1 : 0;
  }
};

struct FakeChip {
  std::string path, name, label;
  int open_errno = 0;
  std::vector<FakeLine> lines;
  int open_count = 0;
};

struct FakeWorld {
  std::list<FakeChip> chips;
  FakeChip* chip_at(const std::string& path) {
    for (FakeChip& chip : chips)
      if (chip.path == path) return &chip;
    return nullptr;
  }
};

inline FakeWorld world;

}  // namespace caryatid::platform::testing
