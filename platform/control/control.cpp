#include "platform/control/control.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace caryatid::platform {
namespace {

constexpr int kFlags = SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK;

template <class... Values>
Status refuse(Code code, ErrorLine& out, const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  out.assign({text, std::strlen(text)});
  return {code};
}

sockaddr_un address_of(const char* path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
  return address;
}

// True when a socket file stands there and nobody answers: left by a kiosk that was killed.
bool is_stale(const char* path, const sockaddr_un& address) {
  struct stat status = {};
  if (::lstat(path, &status) != 0 || !S_ISSOCK(status.st_mode)) return false;
  const int probe = ::socket(AF_UNIX, kFlags, 0);
  if (probe < 0) return false;
  const int rc = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const bool stale = rc != 0 && errno == ECONNREFUSED;
  ::close(probe);
  return stale;
}

}  // namespace

Control::~Control() {
  for (const Client& c : clients_)
    if (c.descriptor >= 0) ::close(c.descriptor);
  if (listener_ < 0) return;
  ::close(listener_);
  (void)::unlink(path_.c_str());
}

Status Control::open(const char* path, ErrorLine& out_error) {
  path_.assign({path, std::strlen(path)});
  if (path_.size() != std::strlen(path))
    return refuse(Code::invalid_argument, out_error,
                  "control socket: the path is longer than %zu bytes; name a shorter one",
                  path_.size());
  const sockaddr_un address = address_of(path);
  if (is_stale(path, address)) (void)::unlink(path);
  const int s = ::socket(AF_UNIX, kFlags, 0);
  if (s < 0) return refuse(Code::io, out_error, "%s: %s", path, std::strerror(errno));
  const mode_t before = ::umask(0117);
  const bool bound = ::bind(s, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  (void)::umask(before);
  if (bound && ::listen(s, kMaxClients) == 0) {
    listener_ = s;
    return {};
  }
  ::close(s);
  if (error == EADDRINUSE)
    return refuse(Code::io, out_error,
                  "%.120s: something is there already; name another path or end the other caryatid",
                  path);
  return refuse(Code::io, out_error, "%.120s: %s; name a socket in a folder that can be written",
                path, std::strerror(error));
}

void Control::accept_new() {
  for (std::size_t i = 0; i < kMaxClients; ++i) {  // No flood of them takes a frame.
    const int s = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (s < 0) return;
    Client* place = &clients_[0];
    for (Client& c : clients_)
      if (c.descriptor < 0 || (place->descriptor >= 0 && c.heard < place->heard)) place = &c;
    if (place->descriptor >= 0) {
      constexpr char kAway[] = "error: silent the longest while another wants to speak; goodbye\n";
      (void)!::send(place->descriptor, kAway, sizeof kAway - 1, MSG_NOSIGNAL);
      ::close(place->descriptor);
    }
    place->descriptor = s;
    place->size = 0;
    place->skipping = false;
    place->heard = polls_;
  }
}

bool Control::answer(Client& client, const ControlReply& reply) {
  char line[1100];
  std::memcpy(line, reply.c_str(), reply.size());
  line[reply.size()] = '\n';
  const ssize_t want = static_cast<ssize_t>(reply.size() + 1);
  // A client that does not read its answers is let go.
  return ::send(client.descriptor, line, static_cast<std::size_t>(want), MSG_NOSIGNAL) == want;
}

bool Control::take_lines(Client& client, void* receiver, Handler handle, int* lines_left) {
  for (;;) {
    const auto end = client.line.begin() + static_cast<std::ptrdiff_t>(client.size);
    const auto newline = std::find(client.line.begin(), end, '\n');
    if (newline == end || *lines_left == 0) return true;
    auto last = newline;
    if (last != client.line.begin() && *(last - 1) == '\r') --last;
    --*lines_left;
    ControlReply reply;
    const std::span<const char> line(client.line.begin(), last);
    if (client.skipping) {
      constexpr char kLong[] = "error: the line is too long; at most 1023 bytes";
      reply.assign({kLong, sizeof kLong - 1});
    } else if (!line.empty()) {
      handle(receiver, line, reply);
    }
    const bool silent = line.empty() && !client.skipping;
    client.skipping = false;
    client.size = static_cast<std::size_t>(end - (newline + 1));
    std::copy(newline + 1, end, client.line.begin());
    if (!silent && !answer(client, reply)) return false;
  }
}

// False: the client is to be let go.
bool Control::read(Client& client, void* receiver, Handler handle, int* lines_left) {
  while (*lines_left > 0) {
    if (client.size == client.line.size()) {
      client.skipping = true;
      client.size = 0;
    }
    const ssize_t n = ::recv(client.descriptor, client.line.data() + client.size,
                             client.line.size() - client.size, 0);
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    if (n == 0) return false;
    client.size += static_cast<std::size_t>(n);
    client.heard = polls_;
    if (!take_lines(client, receiver, handle, lines_left)) return false;
  }
  return true;
}

void Control::poll(void* receiver, Handler handle) {
  if (listener_ < 0) return;
  ++polls_;
  accept_new();
  int lines_left = kMaxLinesPerPoll;
  for (Client& c : clients_) {
    if (c.descriptor < 0) continue;
    if (take_lines(c, receiver, handle, &lines_left) && read(c, receiver, handle, &lines_left))
      continue;
    ::close(c.descriptor);
    c.descriptor = -1;
  }
}

}  // namespace caryatid::platform
