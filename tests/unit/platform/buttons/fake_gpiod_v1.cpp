#include <gpiod.h>

#include <cerrno>
#include <iterator>

#include "tests/unit/platform/buttons/fake_gpio.h"

using caryatid::platform::testing::FakeChip;
using caryatid::platform::testing::FakeEvent;
using caryatid::platform::testing::FakeLine;
using caryatid::platform::testing::world;

// The handles that libgpiod 1.6 keeps opaque.
struct gpiod_line {
  gpiod_chip* chip;
  FakeLine* line;
};
struct gpiod_chip {
  FakeChip* chip;
  std::list<gpiod_line> lines;
};

namespace {

gpiod_chip* open_chip(FakeChip& chip) {
  if (chip.open_errno != 0) {
    errno = chip.open_errno;
    return nullptr;
  }
  ++chip.open_count;
  auto* handle = new gpiod_chip{&chip, {}};
  for (FakeLine& line : chip.lines) handle->lines.push_back({handle, &line});
  return handle;
}

}  // namespace

extern "C" {

gpiod_chip* gpiod_chip_open_lookup(const char* descr) {
  for (FakeChip& chip : world.chips)
    if (chip.name == descr || chip.label == descr || chip.path == descr) return open_chip(chip);
  errno = ENOENT;
  return nullptr;
}

void gpiod_chip_close(gpiod_chip* chip) {
  --chip->chip->open_count;
  delete chip;
}

gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned int offset) {
  if (offset < chip->lines.size()) return &*std::next(chip->lines.begin(), offset);
  errno = EINVAL;
  return nullptr;
}

gpiod_line* gpiod_chip_find_line(gpiod_chip* chip, const char* name) {
  for (gpiod_line& line : chip->lines)
    if (line.line->name == name) return &line;
  errno = ENOENT;
  return nullptr;
}

gpiod_line* gpiod_line_find(const char* name) {
  for (FakeChip& chip : world.chips) {
    gpiod_chip* const handle = open_chip(chip);
    if (handle == nullptr) return nullptr;
    if (gpiod_line* const line = gpiod_chip_find_line(handle, name)) return line;
    gpiod_chip_close(handle);
  }
  errno = ENOENT;
  return nullptr;
}

gpiod_chip* gpiod_line_get_chip(gpiod_line* line) { return line->chip; }

int gpiod_line_request(gpiod_line* line, const gpiod_line_request_config* config, int) {
  if (line->line->request_errno != 0) {
    errno = line->line->request_errno;
    return -1;
  }
  if (config->request_type != GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES) return -1;
  const int flags = config->flags;
  line->line->open_pipe();
  line->line->active_low = (flags & GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) != 0;
  line->line->bias = (flags & GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE) != 0     ? -1
                     : (flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP) != 0   ? 1
                     : (flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN) != 0 ? 2
                                                                             : 0;
  return 0;
}

void gpiod_line_release(gpiod_line* line) { line->line->close_pipe(); }

int gpiod_line_event_get_fd(gpiod_line* line) { return line->line->read_end; }

int gpiod_line_get_value(gpiod_line* line) {
  if (line->line->level < 0) errno = ENODEV;
  return line->line->level;
}

int gpiod_line_event_read_fd_multiple(int fd, gpiod_line_event* events, unsigned int most) {
  for (FakeChip& chip : world.chips)
    for (FakeLine& line : chip.lines)
      if (line.read_end == fd && line.read_errno != 0) {
        errno = line.read_errno;
        return -1;
      }
  int count = 0;
  for (FakeEvent event; count < static_cast<int>(most) &&
                        ::read(fd, &event, sizeof event) == static_cast<ssize_t>(sizeof event);
       ++count) {
    events[count].ts = {static_cast<time_t>(event.time_ns / 1'000'000'000),
                        static_cast<long>(event.time_ns % 1'000'000'000)};
    events[count].event_type =
        event.rising ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
  }
  return count;
}

}  // extern "C"
