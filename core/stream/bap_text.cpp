#include "core/stream/bap_text.h"

namespace caryatid::stream {
namespace {

// 187 and 297: files of a tool that counts one slot too many; the last flag is never used.
constexpr TextLayout kBapLayout = {{186, 187, 296, 297}, false};

}  // namespace

BapTextReader::BapTextReader(std::span<const char> text, bool complete)
    : reader_(kBapLayout, text, complete) {}

Status BapTextReader::next(body::BapFrame* io_frame) {
  CARYATID_TRY(reader_.next(&frame_));
  io_frame->mask.clear();
  const std::size_t last =
      frame_.columns >= body::kBapCountExtended ? body::kBapCountExtended : body::kBapCount;
  std::size_t used = 0;
  for (std::size_t bap = 1; bap <= last; ++bap) {
    if (!frame_.mask.test(bap)) continue;
    io_frame->mask.set(bap);
    io_frame->value[bap] = frame_.values[used++];
  }
  return {};
}

Result<std::size_t> write_bap_text(std::int32_t index, const body::BapFrame& frame,
                                   std::span<char> out) {
  std::size_t last = body::kBapCount;
  for (std::size_t bap = body::kBapCount + 1; bap <= body::kBapCountExtended; ++bap)
    if (frame.mask.test(bap)) last = body::kBapCountExtended;
  TextSink sink(out);
  for (std::size_t bap = 1; bap <= last; ++bap) {
    if (bap > 1) sink.put(' ');
    sink.put(frame.mask.test(bap) ? '1' : '0');
  }
  sink.put('\n');
  sink.put_integer(index);
  for (std::size_t bap = 1; bap <= last; ++bap) {
    if (!frame.mask.test(bap)) continue;
    sink.put(' ');
    sink.put_number(frame.value[bap]);
  }
  sink.put('\n');
  if (!sink.ok())
    return {{Code::out_of_capacity, static_cast<std::uint16_t>(TextFault::out_of_room)}, 0};
  return {{}, sink.size()};
}

}  // namespace caryatid::stream
