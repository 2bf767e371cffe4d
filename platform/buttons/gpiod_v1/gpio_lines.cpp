// libgpiod 1.6 (Debian 12, Ubuntu 24.04): one request and one file descriptor for each line.
#include <gpiod.h>
#include <poll.h>

#include <array>
#include <cerrno>

#include "platform/buttons/gpio.h"

namespace caryatid::platform {
namespace {

// The kernel keeps this many events of a line and drops what does not fit without a word
// (drivers/gpio/gpiolib-cdev.c, lineevent_state of uAPI v1).
constexpr std::size_t kKernelQueue = 16;
constexpr Status kGone{Code::device_lost, static_cast<std::uint16_t>(GpioFault::gone)};

// What errno says; `missing` where the thing itself does not exist.
GpioFault fault_of(int error, GpioFault missing) {
  switch (error) {
    case EACCES:
    case EPERM:
      return GpioFault::no_permission;
    case EBUSY:
      return GpioFault::busy;
    case 0:
    case EINVAL:
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return missing;
    default:
      return GpioFault::other;
  }
}

int flags_of(const GpioLine& line) {
  const int low = line.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  switch (line.bias) {
    case GpioBias::disabled:
      return low | GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
    case GpioBias::pull_up:
      return low | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    case GpioBias::pull_down:
      return low | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    case GpioBias::as_is:
      break;
  }
  return low;
}

class GpiodV1 final : public GpioLines {
 public:
  ~GpiodV1() override { close(); }

  Status open(std::span<const GpioLine> lines, ErrorLine& out_error) override {
    close();
    for (const GpioLine& line : lines) {
      const Status status = request(line, out_error);
      if (status.ok()) continue;
      close();
      return status;
    }
    return {};
  }

  void close() override {
    for (const Open& open : open_) {
      gpiod_line_release(open.line);
      gpiod_chip_close(open.chip);
    }
    open_.clear();
  }

  Result<std::size_t> read(std::int64_t now_us, std::span<GpioEdge> out) override {
    std::array<pollfd, kMaxButtons> waiting;
    for (std::size_t i = 0; i < open_.size(); ++i) waiting[i] = {open_[i].fd, POLLIN, 0};
    std::size_t count = 0;
    if (::poll(waiting.data(), open_.size(), 0) <= 0) return {};  // A signal: next frame.
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (waiting[i].revents == 0) continue;
      if ((waiting[i].revents & POLLIN) == 0) return {kGone, count};
      // A whole queue of edges and the one that may correct the level.
      if (out.size() - count < kKernelQueue + 1) return {{Code::not_ready}, count};
      if (!read_line(i, now_us, out, &count)) return {kGone, count};
    }
    return {{}, count};
  }

 private:
  struct Open {
    gpiod_chip* chip = nullptr;
    gpiod_line* line = nullptr;
    int fd = -1;
  };

  Status request(const GpioLine& wanted, ErrorLine& out_error) {
    const char* const name = wanted.line.size() > 0 ? wanted.line.c_str() : wanted.chip.c_str();
    if (wanted.kernel_debounce_us != 0)
      return gpio_error(GpioFault::no_debounce, name, 0, out_error);
    Open open;
    errno = 0;
    if (wanted.chip.size() > 0) {
      open.chip = gpiod_chip_open_lookup(wanted.chip.c_str());
      if (open.chip == nullptr)
        return gpio_error(fault_of(errno, GpioFault::no_chip), wanted.chip.c_str(), errno,
                          out_error);
      open.line = wanted.line.size() > 0 ? gpiod_chip_find_line(open.chip, wanted.line.c_str())
                                         : gpiod_chip_get_line(open.chip, wanted.offset);
    } else {
      open.line = gpiod_line_find(wanted.line.c_str());
      if (open.line != nullptr) open.chip = gpiod_line_get_chip(open.line);
    }
    if (open.line != nullptr) return take(wanted, open, name, out_error);
    const int error = errno;
    if (open.chip != nullptr) gpiod_chip_close(open.chip);
    return gpio_error(fault_of(error, GpioFault::no_line), name, error, out_error);
  }

  Status take(const GpioLine& wanted, Open open, const char* name, ErrorLine& out_error) {
    const gpiod_line_request_config config = {"caryatid", GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES,
                                              flags_of(wanted)};
    if (gpiod_line_request(open.line, &config, 0) != 0) {
      const int error = errno;
      gpiod_chip_close(open.chip);
      // The kernel answers so where the pin controller has no pull resistors.
      const bool bias = (error == EINVAL || error == ENOTSUP) && wanted.bias != GpioBias::as_is;
      return gpio_error(bias ? GpioFault::no_bias : fault_of(error, GpioFault::no_line), name,
                        error, out_error);
    }
    open.fd = gpiod_line_event_get_fd(open.line);
    if (open.fd >= 0 && open_.push(open)) return {};
    const int error = errno;
    gpiod_line_release(open.line);
    gpiod_chip_close(open.chip);
    return gpio_error(GpioFault::other, name, error, out_error);
  }

  // Appends the edges of one line; false when the device is gone.
  bool read_line(std::size_t index, std::int64_t now_us, std::span<GpioEdge> out,
                 std::size_t* count) {
    std::array<gpiod_line_event, kKernelQueue> events;
    const int read =
        gpiod_line_event_read_fd_multiple(open_[index].fd, events.data(), events.size());
    if (read < 0) return errno == EAGAIN || errno == EINTR;
    const auto line = static_cast<std::uint16_t>(index);
    bool active = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(read); ++i) {
      const timespec& ts = events[i].ts;
      active = events[i].event_type == GPIOD_LINE_EVENT_RISING_EDGE;
      out[(*count)++] = {line, active, std::int64_t{ts.tv_sec} * 1'000'000 + ts.tv_nsec / 1000};
    }
    if (static_cast<std::size_t>(read) < kKernelQueue) return true;
    const int level = gpiod_line_get_value(open_[index].line);
    if (level < 0) return false;
    if ((level == 1) != active) out[(*count)++] = {line, level == 1, now_us};
    return true;
  }

  FixedVector<Open, kMaxButtons> open_;
};

}  // namespace

std::unique_ptr<GpioLines> make_gpio_lines() { return std::make_unique<GpiodV1>(); }

}  // namespace caryatid::platform
