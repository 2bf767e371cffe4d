// A voice program for tests that speaks, or misbehaves, as its name says (the part behind the last
// dash): good, crash, hang, garbage, huge, lies, late, mute. It says 100 samples a byte of text.
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "platform/voice/wire.h"

namespace {

namespace wire = caryatid::platform::wire;
using wire::Type;

void put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = send(0, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n <= 0) std::_Exit(0);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void record(Type type, std::uint32_t utterance, std::string_view payload) {
  std::byte head[wire::kHeadBytes];
  wire::put_head(type, utterance, payload.size(), head);
  put({reinterpret_cast<const char*>(head), sizeof head});
  put(payload);
}

std::string number(std::uint32_t value) {
  std::byte bytes[4];
  wire::put_u32(value, bytes);
  return {reinterpret_cast<const char*>(bytes), 4};
}

void speak(std::uint32_t utterance, std::size_t text_bytes) {
  record(Type::sentence, utterance, number(0));
  record(Type::word, utterance,
         number(0) + number(0) + number(static_cast<std::uint32_t>(text_bytes)));
  record(Type::phone, utterance, number(0) + "\u02C8a");
  record(Type::mark, utterance, number(1) + "here");
  for (std::size_t i = 0; i < text_bytes; ++i) record(Type::pcm, utterance, std::string(200, '\1'));
  record(Type::end, utterance, number(static_cast<std::uint32_t>(text_bytes * 100 / 22)));
}

// What goes wrong in the middle of an utterance. True: nothing did.
bool behave(std::string_view how, std::uint32_t utterance, std::string_view text) {
  // Those that misbehave do so on this word only, so that one program shows recovery too.
  const bool now = text.find("bad") != std::string_view::npos;
  if (how == "good" || !now) return true;
  record(Type::pcm, utterance, std::string(200, '\1'));
  if (how == "crash") std::abort();
  if (how == "hang") pause();
  if (how == "garbage") put(std::string(64, '\xEE'));
  if (how == "huge") put(std::string("\x02\x00\xFF\xFF\x01\x00\x00\x00", 8));
  if (how == "lies") record(Type::word, utterance, number(0) + number(5) + number(1'000'000));
  if (how == "late") record(Type::phone, utterance, number(0xF0000000u) + "a");
  if (how == "mute") record(Type::refused, utterance, std::string(1, '\2'));
  return how == "mute";
}

}  // namespace

int main(int, char** arguments) {
  const std::string_view name = arguments[0];
  const std::string_view how = name.substr(name.rfind('-') + 1);
  if (how == "dies") return 1;
  record(Type::hello, 0, number(wire::kVersion) + number(22050));
  static wire::Reader reader;
  for (;;) {
    wire::Record request;
    const caryatid::Status status = reader.next(&request);
    if (status.code == caryatid::Code::not_ready) {
      const auto room = reader.room();
      const ssize_t n = read(0, room.data(), room.size());
      if (n <= 0) return 0;
      reader.took(static_cast<std::size_t>(n));
      continue;
    }
    if (!status.ok()) return 2;
    if (request.type != Type::say) continue;
    const auto rest = request.text(wire::kSayBytes);
    const auto language = std::to_integer<std::size_t>(request.payload[1]);
    const std::string_view text(rest.data() + language, rest.size() - language);
    if (behave(how, request.utterance, text)) speak(request.utterance, text.size());
  }
}
