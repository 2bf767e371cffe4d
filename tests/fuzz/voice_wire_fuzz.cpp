// What a voice program may send: records of any kind, cut anywhere. Everything that the reader lets
// through is used as the kiosk uses it.
#include <algorithm>
#include <memory>
#include <span>

#include "core/speech/mouth.h"
#include "platform/voice/wire.h"

namespace wire = caryatid::platform::wire;
namespace speech = caryatid::speech;

static void use(const wire::Record& record, speech::Utterance* io) {
  switch (record.type) {
    case wire::Type::phone:
      if (!io->add_phone(record.time_ms(), speech::phoneme_of(record.text(4))).ok())
        io->forget_before(record.time_ms());
      return;
    case wire::Type::word:
      return io->add_word(record.time_ms(), record.u32(4), record.u32(8));
    case wire::Type::mark:
      return io->add_mark(record.time_ms(), record.text(4));
    case wire::Type::sentence:
      return io->add_sentence(record.time_ms());
    case wire::Type::end:
      return io->finish(record.time_ms());
    default:
      return;
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const speech::Mouth mouth;
  auto reader = std::make_unique<wire::Reader>();
  auto utterance = std::make_unique<speech::Utterance>();
  std::span<const std::uint8_t> left(data, size);
  for (;;) {
    wire::Record record;
    const caryatid::Status status = reader->next(&record);
    if (status.ok()) {
      use(record, utterance.get());
      continue;
    }
    if (status.code != caryatid::Code::not_ready || left.empty()) break;
    const auto room = reader->room();
    if (room.empty()) __builtin_trap();  // It promised room when it asked for more.
    const std::size_t n = std::min({left.size(), room.size(), std::size_t{1} + left[0] % 64});
    std::copy_n(reinterpret_cast<const std::byte*>(left.data()), n, room.begin());
    reader->took(n);
    left = left.subspan(n);
  }
  for (const float t : {0.0f, 100.0f, 5000.0f, 3.6e6f}) {
    const speech::MouthShape m = mouth.at(*utterance, t, 33.0f);
    for (const float v : m.faps.value)
      if (!(v > -5000.0f && v < 5000.0f)) __builtin_trap();
  }
  return 0;
}
