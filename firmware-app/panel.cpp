#include "firmware-app/panel.h"

#include "platform/log/log.h"

namespace caryatid::app {

bool Panel::open(const Config& config, std::string* out_error) {
  platform::ErrorLine error;
  derived_ = config.derived;
  for (std::size_t b = 0; b < config.timings.size(); ++b)
    (void)debouncer_.set_timing(static_cast<std::uint16_t>(b + 1), config.timings[b]);
  gpio_.name = "a GPIO chip";
  hid_.name = "a USB button device";
  Status status;
  if (!config.gpio.empty())
    status = platform::open_gpio_buttons(config.gpio.span(), gpio_.buttons, error);
  if (!status.ok() && gpio_.buttons) {
    platform::log(platform::Event::button_lost, "%s; going on without it", error.c_str());
    gpio_.lost = true;
    status = {};
  }
#ifdef CARYATID_HID_BUTTONS
  if (status.ok() && !config.hid.empty())
    status = platform::open_hid_buttons(config.hid.span(), platform::HidSearch::beside_frames,
                                        hid_.buttons, error);
#else
  if (!config.hid.empty()) {
    *out_error = "buttons: this build has no USB buttons; build it with libhidapi-dev installed";
    return false;
  }
#endif
  if (!status.ok()) *out_error = error.c_str();
  return status.ok();
}

void Panel::tell(Source& source, Status status) {
  const bool lost = status.code == Code::device_lost;
  const std::uint16_t reason = lost && &source == &hid_ ? status.detail : std::uint16_t{0};
  if (lost == source.lost && reason == source.reason) return;
  source.lost = lost;
  source.reason = reason;
  if (!lost) return platform::log(platform::Event::button_found, "%s is there", source.name);
  const bool forbidden = reason == static_cast<std::uint16_t>(platform::HidFault::no_permission);
  platform::log(platform::Event::button_lost,
                forbidden ? "%s may not be opened; add the user to the group input, or a udev rule "
                            "for the device"
                          : "%s is not there; waiting for it",
                source.name);
}

void Panel::poll_source(Source& source, std::int64_t now_us) {
  if (!source.buttons) return;
  raw_.clear();
  tell(source, source.buttons->poll(now_us, raw_));
  for (const ButtonEvent& event : raw_) (void)debouncer_.feed(event, &signals_);
}

void Panel::poll(std::int64_t now_us, platform::ButtonEvents& out) {
  signals_.clear();
  poll_source(gpio_, now_us);
  poll_source(hid_, now_us);
  debouncer_.advance(now_us, &signals_);
  for (const agent::ButtonSignal& signal : signals_) {
    ButtonEvent event;
    if (agent::as_event(signal, &event)) (void)out.push(event);
    for (const DerivedButton& d : derived_) {
      if (d.of != signal.button || d.action != signal.action) continue;
      (void)out.push({d.button, true, signal.time_us});
      (void)out.push({d.button, false, signal.time_us});
    }
  }
}

std::uint64_t Panel::rejected_edges() const {
  std::uint64_t sum = 0;
  for (std::uint16_t b = 1; b <= kMaxButtons; ++b) sum += debouncer_.counts(b).rejected_edges;
  return sum;
}

}  // namespace caryatid::app
