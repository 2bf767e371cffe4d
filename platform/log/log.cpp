#include "platform/log/log.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace caryatid::platform {
namespace {

struct Kind {
  Event event;
  const char* name;
  int priority;  // As syslog: 3 error, 4 warning, 5 notice.
};
constexpr std::array<Kind, 16> kKinds = {{{Event::start_refused, "start-refused", 3},
                                          {Event::pack_refused, "pack-refused", 3},
                                          {Event::pack_damaged, "pack-damaged", 4},
                                          {Event::config_refused, "config-refused", 3},
                                          {Event::screen_lost, "screen-lost", 4},
                                          {Event::screen_found, "screen-found", 5},
                                          {Event::picture_shown, "picture-shown", 5},
                                          {Event::software_gpu, "software-gpu", 4},
                                          {Event::button_lost, "button-lost", 4},
                                          {Event::button_found, "button-found", 5},
                                          {Event::speech_trouble, "speech-trouble", 4},
                                          {Event::unsupervised, "unsupervised", 4},
                                          {Event::file_refused, "file-refused", 4},
                                          {Event::state_refused, "state-refused", 4},
                                          {Event::text_refused, "text-refused", 4},
                                          {Event::text_taken, "text-taken", 5}}};

const Kind& kind_of(Event event) { return kKinds[static_cast<std::size_t>(event)]; }

// The journal's socket where stderr is the journal (systemd sets JOURNAL_STREAM), else -1.
int journal() {
  static const int socket = [] {
    if (std::getenv("JOURNAL_STREAM") == nullptr) return -1;
    const int s = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, "/run/systemd/journal/socket");
    if (s >= 0 && ::connect(s, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
      return s;
    if (s >= 0) ::close(s);
    return -1;
  }();
  return socket;
}

}  // namespace

const char* event_name(Event event) { return kind_of(event).name; }

std::size_t format_journal(Event event, const char* line, char* out, std::size_t out_bytes) {
  const Kind& k = kind_of(event);
  const int n = std::snprintf(
      out, out_bytes, "MESSAGE=%s\nPRIORITY=%d\nSYSLOG_IDENTIFIER=caryatid\nCARYATID_EVENT=%s\n",
      line, k.priority, k.name);
  return n > 0 && static_cast<std::size_t>(n) < out_bytes ? static_cast<std::size_t>(n) : 0;
}

void log(Event event, const char* format, ...) {
  char line[1001];
  std::va_list arguments;
  va_start(arguments, format);
  const int n = std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  if (n < 0) return;
  for (char* c = line; *c != '\0'; ++c)
    if (*c == '\n' || *c == '\r') *c = ' ';
  char text[1200];
  if (const int socket = journal(); socket >= 0) {
    const std::size_t bytes = format_journal(event, line, text, sizeof text);
    if (::send(socket, text, bytes, MSG_NOSIGNAL) == static_cast<ssize_t>(bytes)) return;
  }
  const int size = std::snprintf(text, sizeof text, "caryatid: %s\n", line);
  (void)!::write(STDERR_FILENO, text, static_cast<std::size_t>(size));
}

}  // namespace caryatid::platform
