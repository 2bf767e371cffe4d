#include "platform/watchdog/notify.h"

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace caryatid::platform {
namespace {

// WATCHDOG_USEC, where it is meant for this process; 0 otherwise.
std::int64_t watched_us() {
  const char* usec = std::getenv("WATCHDOG_USEC");
  const char* pid = std::getenv("WATCHDOG_PID");
  if (usec == nullptr) return 0;
  if (pid != nullptr && std::strtoll(pid, nullptr, 10) != ::getpid()) return 0;
  const long long value = std::strtoll(usec, nullptr, 10);
  return value > 0 ? value : 0;
}

}  // namespace

Notifier::~Notifier() {
  if (socket_ >= 0) ::close(socket_);
}

Status Notifier::open() {
  const char* name = std::getenv("NOTIFY_SOCKET");
  if (name == nullptr || name[0] == '\0') return {};
  const std::size_t size = std::strlen(name);
  if ((name[0] != '/' && name[0] != '@') || size >= sizeof address_.sun_path)
    return {Code::invalid_argument};
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, name, size);
  if (name[0] == '@') address_.sun_path[0] = '\0';  // Abstract socket.
  address_bytes_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + size);
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0) return {Code::io};
  period_us_ = watched_us() / 2;
  return {};
}

Status Notifier::send(const char* text) {
  if (socket_ < 0) return {};
  const auto* address = reinterpret_cast<const sockaddr*>(&address_);
  const std::size_t size = std::strlen(text);
  const ssize_t sent = ::sendto(socket_, text, size, MSG_NOSIGNAL, address, address_bytes_);
  return sent == static_cast<ssize_t>(size) ? Status{} : Status{Code::io};
}

Status Notifier::beat(std::int64_t now_us, const Vitals& seen) {
  if (!began_) last_us_ = now_us;
  began_ = true;
  seen_.flipped = seen_.flipped || seen.flipped;
  seen_.input_ran = seen_.input_ran || seen.input_ran;
  seen_.audio_moved = seen_.audio_moved || seen.audio_moved;
  if (period_us_ == 0 || now_us - last_us_ < period_us_) return {};
  if (!seen_.flipped || !seen_.input_ran || !seen_.audio_moved) return {Code::not_ready};
  last_us_ = now_us;
  seen_ = {false, false, false};
  return send("WATCHDOG=1");
}

bool Notifier::withheld(std::int64_t now_us) const {
  // A beat comes with the first frame behind its time.
  return period_us_ > 0 && began_ && now_us - last_us_ > period_us_ + period_us_ / 2;
}

}  // namespace caryatid::platform
