// The .fap and .bap readers: any bytes, whole and in pieces, give the same frames and faults.
#include <cstdlib>
#include <vector>

#include "core/stream/bap_text.h"
#include "core/stream/fap_text.h"

namespace {

using namespace caryatid;

template <class Reader, class Frame>
std::size_t read_all(Reader reader, std::span<const char> text, std::size_t piece) {
  std::size_t begin = 0, end = piece == 0 ? text.size() : 0, frames = 0;
  reader.refill(text.subspan(begin, end - begin), end == text.size());
  Frame frame;
  while (true) {
    const Status status = reader.next(&frame);
    if (status.ok()) {
      if (++frames > 4 * text.size()) std::abort();  // Each frame takes bytes.
      continue;
    }
    if (status.detail != static_cast<std::uint16_t>(stream::TextFault::need_more))
      return frames * 1000 + status.detail;
    if (end == text.size()) std::abort();  // Asked for more than there is.
    begin += reader.consumed_bytes();
    end = std::min(end + piece, text.size());
    reader.refill(text.subspan(begin, end - begin), end == text.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 65536) return 0;
  const std::size_t piece = data[0] + 1u;
  const std::vector<char> text(data + 1, data + size);
  using stream::BapTextReader;
  using stream::FapTextReader;
  if (read_all<FapTextReader, face::FapFrame>(FapTextReader({}, false), text, 0) !=
      read_all<FapTextReader, face::FapFrame>(FapTextReader({}, false), text, piece))
    std::abort();
  if (read_all<BapTextReader, body::BapFrame>(BapTextReader({}, false), text, 0) !=
      read_all<BapTextReader, body::BapFrame>(BapTextReader({}, false), text, piece))
    std::abort();
  return 0;
}
