#include <cstdio>
#include <cstring>

#include "platform/buttons/gpio.h"
#include "platform/retry.h"

namespace caryatid::platform {
namespace {

class GpioButtons final : public Buttons {
 public:
  explicit GpioButtons(std::unique_ptr<GpioLines> device) : device_(std::move(device)) {}

  Status open(std::span<const GpioLine> lines, ErrorLine& out_error) {
    for (const GpioLine& line : lines) {
      const bool fits = line.button >= 1 && line.button <= kMaxButtons;
      if (!fits || (line.line.size() == 0 && line.chip.size() == 0) || !lines_.push(line))
        return gpio_error(GpioFault::bad_config, line.line.c_str(), 0, out_error);
    }
    const Status status = device_->open(lines_.span(), out_error);
    lost_ = !status.ok();
    return status;
  }

  Status poll(std::int64_t now_us, ButtonEvents& out) override {
    if (lost_) {
      if (!retry_.due(now_us)) return {Code::device_lost, kGone};
      ErrorLine ignored;  // Told once, when it was lost.
      if (!device_->open(lines_.span(), ignored).ok()) {
        retry_.failed(now_us);
        return {Code::device_lost, kGone};
      }
      lost_ = false;
    }
    std::array<GpioEdge, 32> edges;
    const Result<std::size_t> read = device_->read(now_us, edges);
    for (const GpioEdge& edge : std::span(edges).first(read.value)) {
      pressed_.set(edge.line, edge.active);
      // A full list is bounce: the level is kept, and the next edge or release corrects it.
      (void)out.push({lines_[edge.line].button, edge.active, edge.time_us});
    }
    if (read.status.code != Code::device_lost) return {};
    lose(now_us, out);
    return read.status;
  }

 private:
  static constexpr std::uint16_t kGone = static_cast<std::uint16_t>(GpioFault::gone);

  void lose(std::int64_t now_us, ButtonEvents& out) {
    device_->close();
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (pressed_.test(i)) (void)out.push({lines_[i].button, false, now_us});
    pressed_.clear();
    lost_ = true;
    retry_.start(now_us);
  }

  std::unique_ptr<GpioLines> device_;
  FixedVector<GpioLine, kMaxButtons> lines_;
  BitSet<kMaxButtons> pressed_;
  Retry retry_;
  bool lost_ = false;
};

const char* advice(GpioFault fault) {
  switch (fault) {
    case GpioFault::no_chip:
      return "no such GPIO chip; 'caryatid --list-hardware' shows what there is";
    case GpioFault::no_line:
      return "no such GPIO line; 'caryatid --list-hardware' shows what there is";
    case GpioFault::busy:
      return "the GPIO line is in use by another program or driver; free it or take another";
    case GpioFault::no_permission:
      return "no permission for the GPIO chip; add the user to the group gpio";
    case GpioFault::no_debounce:
      return "libgpiod 1.6 has no kernel debounce; set it to 0, the program debounces by itself";
    case GpioFault::no_bias:
      return "the GPIO chip has no such pull resistor; set bias to 'as-is' and wire one";
    case GpioFault::not_built:
      return "this build has no GPIO buttons; build it with libgpiod-dev installed";
    case GpioFault::bad_config:
      return "a GPIO button needs a number from 1 to 16 and a line name, or a chip and an offset";
    case GpioFault::gone:
      return "the GPIO chip is gone; waiting for it";
    case GpioFault::none:
    case GpioFault::other:
      break;
  }
  return "the GPIO line was refused";
}

}  // namespace

Status gpio_error(GpioFault fault, const char* what, int error, ErrorLine& out_error) {
  char text[256];
  const int length = error != 0
                         ? std::snprintf(text, sizeof text, "buttons: %s: %s (%s)", what,
                                         advice(fault), std::strerror(error))
                         : std::snprintf(text, sizeof text, "buttons: %s: %s", what, advice(fault));
  const auto size = std::min(static_cast<std::size_t>(length > 0 ? length : 0), sizeof text - 1);
  out_error.assign({text, size});
  const bool wrong_call = fault == GpioFault::bad_config;
  const bool lacks = fault == GpioFault::no_debounce || fault == GpioFault::no_bias ||
                     fault == GpioFault::not_built;
  const Code code = wrong_call                 ? Code::invalid_argument
                    : lacks                    ? Code::unsupported
                    : fault == GpioFault::gone ? Code::device_lost
                                               : Code::io;
  return {code, static_cast<std::uint16_t>(fault)};
}

Status open_gpio_buttons(std::span<const GpioLine> lines, std::unique_ptr<GpioLines> device,
                         std::unique_ptr<Buttons>& out, ErrorLine& out_error) {
  auto buttons = std::make_unique<GpioButtons>(std::move(device));
  const Status status = buttons->open(lines, out_error);
  if (status.code != Code::invalid_argument) out = std::move(buttons);
  return status;
}

Status open_gpio_buttons(std::span<const GpioLine> lines, std::unique_ptr<Buttons>& out,
                         ErrorLine& out_error) {
  return open_gpio_buttons(lines, make_gpio_lines(), out, out_error);
}

}  // namespace caryatid::platform
