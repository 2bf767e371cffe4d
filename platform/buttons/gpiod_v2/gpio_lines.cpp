// libgpiod 2.x (Debian 13): a request for each line, settings in objects, numbered events.
#include <gpiod.h>
#include <poll.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "platform/buttons/gpio.h"

namespace caryatid::platform {
namespace {

// Events that one read takes, and the kernel's queue that we ask for.
constexpr std::size_t kQueue = 16;
// Chips are numbered from 0 without large gaps; the largest boards have about a dozen.
constexpr unsigned kMostChips = 64;
constexpr Status kGone{Code::device_lost, static_cast<std::uint16_t>(GpioFault::gone)};

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Freed<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, Freed<gpiod_chip_info_free>>;
using Settings = std::unique_ptr<gpiod_line_settings, Freed<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Freed<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Freed<gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, Freed<gpiod_line_request_release>>;
using EventBuffer = std::unique_ptr<gpiod_edge_event_buffer, Freed<gpiod_edge_event_buffer_free>>;

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

gpiod_line_bias bias_of(GpioBias bias) {
  switch (bias) {
    case GpioBias::disabled:
      return GPIOD_LINE_BIAS_DISABLED;
    case GpioBias::pull_up:
      return GPIOD_LINE_BIAS_PULL_UP;
    case GpioBias::pull_down:
      return GPIOD_LINE_BIAS_PULL_DOWN;
    case GpioBias::as_is:
      break;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

bool is_called(gpiod_chip* chip, const char* path, const char* name) {
  if (std::strcmp(path, name) == 0) return true;
  const ChipInfo info(gpiod_chip_get_info(chip));
  return info && (std::strcmp(gpiod_chip_info_get_name(info.get()), name) == 0 ||
                  std::strcmp(gpiod_chip_info_get_label(info.get()), name) == 0);
}

// Where a configured line is, or why it was not found.
struct Place {
  Chip chip;
  unsigned offset = 0;
  GpioFault fault = GpioFault::none;
  int error = 0;
};

Place find(const GpioLine& wanted) {
  Place place;
  place.fault = wanted.chip.size() > 0 ? GpioFault::no_chip : GpioFault::no_line;
  for (unsigned number = 0; number < kMostChips; ++number) {
    char path[32];
    std::snprintf(path, sizeof path, "/dev/gpiochip%u", number);
    if (!gpiod_is_gpiochip_device(path)) continue;
    Chip chip(gpiod_chip_open(path));
    if (!chip) {
      place.error = errno;
      place.fault = fault_of(errno, place.fault);
      continue;
    }
    if (wanted.chip.size() > 0 && !is_called(chip.get(), path, wanted.chip.c_str())) continue;
    const int offset = wanted.line.size() > 0
                           ? gpiod_chip_get_line_offset_from_name(chip.get(), wanted.line.c_str())
                           : static_cast<int>(wanted.offset);
    if (offset >= 0) return {std::move(chip), static_cast<unsigned>(offset), GpioFault::none, 0};
    if (wanted.chip.size() > 0) return {{}, 0, GpioFault::no_line, 0};
  }
  return place;
}

class GpiodV2 final : public GpioLines {
 public:
  Status open(std::span<const GpioLine> lines, ErrorLine& out_error) override {
    close();
    if (!buffer_) buffer_.reset(gpiod_edge_event_buffer_new(kQueue));
    if (!buffer_) return gpio_error(GpioFault::other, "GPIO", errno, out_error);
    for (const GpioLine& line : lines) {
      const Status status = request(line, out_error);
      if (status.ok()) continue;
      close();
      return status;
    }
    return {};
  }

  void close() override {
    for (Open& open : std::span(open_).first(count_)) open = {};
    count_ = 0;
  }

  Result<std::size_t> read(std::int64_t now_us, std::span<GpioEdge> out) override {
    std::array<pollfd, kMaxButtons> waiting;
    for (std::size_t i = 0; i < count_; ++i)
      waiting[i] = {gpiod_line_request_get_fd(open_[i].request.get()), POLLIN, 0};
    std::size_t count = 0;
    if (::poll(waiting.data(), count_, 0) <= 0) return {};  // A signal: next frame.
    for (std::size_t i = 0; i < count_; ++i) {
      if (waiting[i].revents == 0) continue;
      if ((waiting[i].revents & POLLIN) == 0) return {kGone, count};
      // A whole buffer of edges and the one that may correct the level.
      if (out.size() - count < kQueue + 1) return {{Code::not_ready}, count};
      if (!read_line(i, now_us, out, &count)) return {kGone, count};
    }
    return {{}, count};
  }

 private:
  struct Open {
    Request request;
    unsigned offset = 0;
    unsigned long next_seqno = 1;  // The kernel counts each line's events from 1.
  };

  Status request(const GpioLine& wanted, ErrorLine& out_error) {
    const char* const name = wanted.line.size() > 0 ? wanted.line.c_str() : wanted.chip.c_str();
    const Place place = find(wanted);
    if (!place.chip)
      return gpio_error(place.fault, place.fault == GpioFault::no_chip ? wanted.chip.c_str() : name,
                        place.error, out_error);
    const Settings settings(gpiod_line_settings_new());
    const LineConfig line_config(gpiod_line_config_new());
    const RequestConfig request_config(gpiod_request_config_new());
    if (!settings || !line_config || !request_config || count_ == open_.size())
      return gpio_error(GpioFault::other, name, ENOMEM, out_error);
    gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT);
    gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH);
    gpiod_line_settings_set_bias(settings.get(), bias_of(wanted.bias));
    gpiod_line_settings_set_active_low(settings.get(), wanted.active_low);
    gpiod_line_settings_set_debounce_period_us(settings.get(), wanted.kernel_debounce_us);
    gpiod_line_settings_set_event_clock(settings.get(), GPIOD_LINE_CLOCK_MONOTONIC);
    gpiod_line_config_add_line_settings(line_config.get(), &place.offset, 1, settings.get());
    gpiod_request_config_set_consumer(request_config.get(), "caryatid");
    gpiod_request_config_set_event_buffer_size(request_config.get(), kQueue);
    Request request(
        gpiod_chip_request_lines(place.chip.get(), request_config.get(), line_config.get()));
    if (!request) {
      const int error = errno;
      // The kernel answers so where the pin controller has no pull resistors.
      const bool bias = (error == EINVAL || error == ENOTSUP) && wanted.bias != GpioBias::as_is;
      return gpio_error(bias ? GpioFault::no_bias : fault_of(error, GpioFault::no_line), name,
                        error, out_error);
    }
    open_[count_++] = {std::move(request), place.offset};
    return {};
  }

  // Appends the edges of one line; false when the device is gone.
  bool read_line(std::size_t index, std::int64_t now_us, std::span<GpioEdge> out,
                 std::size_t* count) {
    Open& open = open_[index];
    const int read = gpiod_line_request_read_edge_events(open.request.get(), buffer_.get(), kQueue);
    if (read < 0) return errno == EAGAIN || errno == EINTR;
    const auto line = static_cast<std::uint16_t>(index);
    bool active = false, lost = false;
    for (int i = 0; i < read; ++i) {
      gpiod_edge_event* const event =
          gpiod_edge_event_buffer_get_event(buffer_.get(), static_cast<unsigned long>(i));
      const unsigned long seqno = gpiod_edge_event_get_line_seqno(event);
      lost = lost || seqno != open.next_seqno;
      open.next_seqno = seqno + 1;
      active = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
      out[(*count)++] = {
          line, active, static_cast<std::int64_t>(gpiod_edge_event_get_timestamp_ns(event) / 1000)};
    }
    if (!lost) return true;
    const gpiod_line_value level = gpiod_line_request_get_value(open.request.get(), open.offset);
    if (level == GPIOD_LINE_VALUE_ERROR) return false;
    const bool now_active = level == GPIOD_LINE_VALUE_ACTIVE;
    if (now_active != active) out[(*count)++] = {line, now_active, now_us};
    return true;
  }

  std::array<Open, kMaxButtons> open_;
  std::size_t count_ = 0;
  EventBuffer buffer_;
};

}  // namespace

std::unique_ptr<GpioLines> make_gpio_lines() { return std::make_unique<GpiodV2>(); }

}  // namespace caryatid::platform
