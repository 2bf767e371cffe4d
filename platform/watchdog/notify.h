#pragma once
// Tells systemd that the kiosk is ready and alive (sd_notify(3), sd_watchdog_enabled(3)) without
// libsystemd: the protocol is one datagram a message to the socket that $NOTIFY_SOCKET names.
#include <sys/socket.h>
#include <sys/un.h>

#include <cstdint>

#include "core/base/status.h"

namespace caryatid::platform {

// What must have happened since the last heartbeat, so that it is no mere timer: a process whose
// screen stands still or whose buttons are dead must be restarted.
struct Vitals {
  bool flipped = false;     // A page flip completed, or it is known that there is no display.
  bool input_ran = false;   // The input loop looked at every device.
  bool audio_moved = true;  // The played position advanced, or nothing is being said.
};

// Where nobody supervises (NOTIFY_SOCKET unset), every call does nothing and returns ok.
// No allocation after open(). One thread.
class Notifier {
 public:
  Notifier() = default;
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  // Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID. invalid_argument: a socket name that is
  // neither a path nor abstract, or is too long. io: no socket.
  Status open();
  bool supervised() const { return socket_ >= 0; }
  // How often a heartbeat is sent: half of what systemd waits; 0 where it does not watch.
  std::int64_t period_us() const { return period_us_; }

  // Once, after the first frame with a sound pack was shown.
  Status ready() { return send("READY=1\nSTATUS=running"); }
  // Once, on the way out, so that systemd does not take the end for a fault.
  Status stopping() { return send("STOPPING=1"); }
  // Each frame. Sends when the period is over and every vital sign was seen since the last one.
  Status beat(std::int64_t now_us, const Vitals& seen);
  // True when the heartbeat is overdue by half its period: for the status file and the log.
  bool withheld(std::int64_t now_us) const;

 private:
  Status send(const char* text);

  int socket_ = -1;
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
  std::int64_t period_us_ = 0;
  std::int64_t last_us_ = 0;
  bool began_ = false;
  Vitals seen_{false, false, false};
};

}  // namespace caryatid::platform
