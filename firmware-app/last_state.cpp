#include "firmware-app/last_state.h"

#include <cstdio>
#include <cstring>

#include "core/base/crc.h"

namespace caryatid::app {
namespace {

constexpr const char* kFormat = "caryatid-state 1\nstarts %llu\npresses %llu\nrunning %d\n";
constexpr std::size_t kCrcLineBytes = 13;  // "crc " and eight digits and the newline.

std::uint32_t crc_of(std::string_view text) {
  return crc32c(std::as_bytes(std::span<const char>(text)));
}

void print_crc(std::string_view text, char (&line)[16]) {
  std::snprintf(line, sizeof line, "crc %08x\n", crc_of(text));
}

}  // namespace

std::string_view format_state(const LastState& state, std::span<char> out) {
  const int body =
      std::snprintf(out.data(), out.size(), kFormat, static_cast<unsigned long long>(state.starts),
                    static_cast<unsigned long long>(state.presses), state.running ? 1 : 0);
  if (body < 0 || static_cast<std::size_t>(body) + kCrcLineBytes > out.size()) return {};
  const auto size = static_cast<std::size_t>(body);
  char line[16];
  print_crc({out.data(), size}, line);
  std::memcpy(out.data() + size, line, kCrcLineBytes);
  return {out.data(), size + kCrcLineBytes};
}

bool parse_state(std::string_view text, LastState* out) {
  if (text.size() < kCrcLineBytes || text.size() > kLastStateBytes) return false;
  const std::string_view body = text.substr(0, text.size() - kCrcLineBytes);
  char line[16];
  print_crc(body, line);
  if (text.substr(body.size()) != std::string_view(line, kCrcLineBytes)) return false;
  char copy[kLastStateBytes + 1] = {};
  std::memcpy(copy, body.data(), body.size());
  unsigned long long starts = 0, presses = 0;
  int running = 0;
  if (std::sscanf(copy, "caryatid-state 1 starts %llu presses %llu running %d", &starts, &presses,
                  &running) != 3)
    return false;
  *out = {starts, presses, running != 0};
  return true;
}

}  // namespace caryatid::app
