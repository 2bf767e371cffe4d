// FBA streams: any bytes, arriving in pieces of any size, end within bounded work, and no face ever
// gets a value outside the range of its FAP.
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/stream/playback.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid;
  if (size < 2 || size > 65536) return 0;
  const std::size_t piece = data[0] * 16u + 1u;
  const std::size_t node_count = 1u << (data[1] % 16);
  std::vector<std::byte> bytes(size - 2);
  for (std::size_t i = 2; i < size; ++i) bytes[i - 2] = static_cast<std::byte>(data[i]);
  std::vector<std::byte> buffer(stream::FbaPlayback::kMinBufferBytes);
  std::vector<stream::ModelNode> nodes(node_count);
  stream::FbaPlayback playback(buffer, nodes, {});
  std::size_t sent = 0;
  double time_s = 0.0;
  for (std::size_t round = 0; !playback.ended(); ++round) {
    if (round > 1000000) std::abort();
    const std::size_t count = std::min(piece, bytes.size() - sent);
    sent += playback.push(std::span(bytes).subspan(sent, count));
    if (sent == bytes.size()) playback.close();
    playback.advance(time_s += 11.0);
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const float limit = face::coding_limit(face::fap_info(fap));
      if (!(std::abs(playback.face().get(fap)) <= limit)) std::abort();
    }
    const face::FapFrame& face = playback.face();
    if (face.viseme.first > 14 || face.viseme.second > 14 || face.viseme.blend > 63 ||
        face.expression.first > 6 || face.expression.first_intensity > 63 ||
        face.expression.second > 6 || face.expression.second_intensity > 63)
      std::abort();
  }
  return 0;
}
