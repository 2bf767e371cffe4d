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
  // Opens what `config` names; what is not there or is refused is logged and looked for again: a
  // kiosk without buttons still shows its person. False: `out_error` is one line.
  bool open(const Config& config, std::string* out_error);
  // Appends presses and releases up to `now_us` (monotonic); long and double presses as those of
  // the buttons that stand for them. Logs once when a device is lost, with the reason, and when it
  // is back. Once a frame; no allocation of ours.
  void poll(std::int64_t now_us, platform::ButtonEvents& out);
  // Edges of all buttons that were bounce. Growing while nobody presses: a bad switch or cable.
  std::uint64_t rejected_edges() const;
  // A device of the configuration is away.
  bool device_lost() const { return gpio_.lost || hid_.lost; }

 private:
  struct Source {
    std::unique_ptr<platform::Buttons> buttons;
    const char* name = "";
    bool lost = false;
    std::uint16_t reason = 0;  // HidFault as logged last; GPIO's is told when it is opened.
  };
  void poll_source(Source& source, std::int64_t now_us);
  void tell(Source& source, Status status);

  Source gpio_, hid_;
  agent::Debouncer debouncer_;
  FixedVector<DerivedButton, kMaxButtons> derived_;
  agent::ButtonSignals signals_;
  platform::ButtonEvents raw_;
};

}  // namespace caryatid::app
