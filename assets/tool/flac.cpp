#include "assets/tool/flac.h"

#include <FLAC/stream_decoder.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace caryatid::tool {
namespace {

constexpr std::size_t kMostSamples = 600u * 96000u;  // Ten minutes; a file may promise anything.

struct Decoding {
  Spoken spoken;
  bool bad = false;
};

FLAC__StreamDecoderWriteStatus take(const FLAC__StreamDecoder*, const FLAC__Frame* frame,
                                    const FLAC__int32* const channels[], void* to) {
  auto& d = *static_cast<Decoding*>(to);
  const auto& h = frame->header;
  if (h.channels < 1 || h.channels > 2 || h.bits_per_sample < 8 || h.bits_per_sample > 24 ||
      d.spoken.samples.size() + h.blocksize > kMostSamples) {
    d.bad = true;
    return FLAC__STREAM_DECODER_WRITE_STATUS_ABORT;
  }
  d.spoken.rate_hz = h.sample_rate;
  for (unsigned i = 0; i < h.blocksize; ++i) {
    double sum = 0.0;
    for (unsigned c = 0; c < h.channels; ++c) sum += channels[c][i];
    const double full = static_cast<double>(1 << (h.bits_per_sample - 1));
    d.spoken.samples.push_back(
        static_cast<std::int16_t>(std::floor(sum / h.channels / full * 32768.0)));
  }
  return FLAC__STREAM_DECODER_WRITE_STATUS_CONTINUE;
}

void complain(const FLAC__StreamDecoder*, FLAC__StreamDecoderErrorStatus, void* to) {
  static_cast<Decoding*>(to)->bad = true;
}

}  // namespace

Spoken read_flac(const std::string& path) {
  const std::unique_ptr<FLAC__StreamDecoder, decltype(&FLAC__stream_decoder_delete)> decoder(
      FLAC__stream_decoder_new(), FLAC__stream_decoder_delete);
  Decoding d;
  const bool opened = decoder && FLAC__stream_decoder_init_file(decoder.get(), path.c_str(), take,
                                                                nullptr, complain, &d) ==
                                     FLAC__STREAM_DECODER_INIT_STATUS_OK;
  const bool whole =
      opened && FLAC__stream_decoder_process_until_end_of_stream(decoder.get()) &&
      FLAC__stream_decoder_get_state(decoder.get()) == FLAC__STREAM_DECODER_END_OF_STREAM;
  if (!whole || d.bad || d.spoken.samples.empty() || d.spoken.rate_hz < 8000)
    throw std::runtime_error(path +
                             ": no whole FLAC of 1 or 2 channels and at most ten minutes; "
                             "save it again");
  d.spoken.end_ms = static_cast<std::int32_t>(d.spoken.samples.size() * 1000 / d.spoken.rate_hz);
  return d.spoken;
}

}  // namespace caryatid::tool
