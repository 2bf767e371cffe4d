#pragma once
// The deployer's buttons: GPIO lines and USB devices of kiosk.toml, debounced, as one stream.
#include <memory>
#include <string>

#include "core/agent/debounce.h"
#include "firmware-app/config.h"
#include "platform/buttons/buttons.h"

namespace caryatid::app {

class Panel {
 public:
  // Opens what `config` names. False: `out_error` is one line; a GPIO line that is not there at
  // start is an error of the configuration, an unplugged USB device is not.
  bool open(const Config& config, std::string* out_error);
  // Appends presses and releases up to `now_us` (monotonic). Says once on stderr when a device is
  // lost and when it is back. Once a frame; no allocation of ours.
  void poll(std::int64_t now_us, platform::ButtonEvents& out);
  const agent::Debouncer& debouncer() const { return debouncer_; }

 private:
  struct Source {
    std::unique_ptr<platform::Buttons> buttons;
    const char* name = "";
    bool lost = false;
  };
  void poll_source(Source& source, std::int64_t now_us);

  Source gpio_, hid_;
  agent::Debouncer debouncer_;
  agent::ButtonSignals signals_;
  platform::ButtonEvents raw_;
};

}  // namespace caryatid::app
