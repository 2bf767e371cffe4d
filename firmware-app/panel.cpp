#include "firmware-app/panel.h"

#include "platform/log/log.h"

namespace caryatid::app {

bool Panel::open(const Config& config, std::string* out_error) {
  platform::ErrorLine error;
  gpio_.name = "a GPIO chip";
  hid_.name = "a USB button device";
  Status status;
  if (!config.gpio.empty())
    status = platform::open_gpio_buttons(config.gpio.span(), gpio_.buttons, error);
#ifdef CARYATID_HID_BUTTONS
  if (status.ok() && !config.hid.empty())
    status = platform::open_hid_buttons(config.hid.span(), hid_.buttons, error);
#else
  if (!config.hid.empty()) {
    *out_error = "buttons: this build has no USB buttons; build it with libhidapi-dev installed";
    return false;
  }
#endif
  if (!status.ok()) *out_error = error.c_str();
  return status.ok();
}

void Panel::poll_source(Source& source, std::int64_t now_us) {
  if (!source.buttons) return;
  raw_.clear();
  const bool lost = source.buttons->poll(now_us, raw_).code == Code::device_lost;
  if (lost != source.lost)
    platform::log(lost ? platform::Event::button_lost : platform::Event::button_found, "%s is %s",
                  source.name, lost ? "not there; waiting for it" : "there");
  source.lost = lost;
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
  }
}

}  // namespace caryatid::app
