// FBA streams: microseconds a frame, for a talking face of a minute and for a whole body. Budgets
// (README): decoding 20, encoding 100 on a PC.
#include <cmath>
#include <vector>

#include "assets/bake/stream/talking_track.h"
#include "core/base/crc.h"
#include "core/stream/fap_text.h"
#include "core/stream/fba_decoder.h"
#include "core/stream/fba_plan.h"
#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

using namespace stream;

struct Case {
  std::vector<face::FapFrame> face;
  std::vector<body::BapFrame> body;
  FbaSettings settings;
  std::vector<std::byte> bytes;
  std::vector<ModelNode> nodes = std::vector<ModelNode>(1 << 18);

  FbaClip clip() const { return {face, body, 0}; }
  void encode() {
    BitWriter writer(bytes);
    FbaEncoder encoder(settings, nodes);
    Status status = encoder.begin(&writer);
    for (std::size_t i = 0; i < clip().size() && status.ok(); ++i) {
      FbaPlaneInput plane;
      if (i < face.size()) plane.face = &face[i];
      if (i < body.size()) plane.body = &body[i];
      status = encoder.encode(plane, &writer);
    }
    if (status.ok()) status = encoder.finish(&writer);
    if (!status.ok()) std::abort();
    bytes.resize(writer.size_bytes());
  }
};

// All 66 FAPs with the smallest steps: no stream of a face costs more.
Case full_face() {
  Case c;
  c.face.resize(1500);
  for (std::size_t i = 0; i < c.face.size(); ++i)
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const double t = static_cast<double>(i) * 0.07 * (1.0 + 0.01 * fap);
      const float reach = face::coding_limit(face::fap_info(fap)) * 0.25f;
      c.face[i].set(fap, reach * static_cast<float>(std::sin(t)));
    }
  set_masks(c.clip(), &c.settings);
  set_ranges(c.clip(), &c.settings);
  c.bytes.resize(1 << 20);
  c.encode();
  return c;
}

Case talking(double kbit_per_s) {
  Case c;
  c.face = bake::make_talking_track(60.0, 25.0, 1);
  RatePlan plan;
  c.settings.repeat_ranges = false;
  if (!plan_rate(c.clip(), kbit_per_s, c.nodes, &c.settings, &plan).ok()) std::abort();
  c.bytes.resize(1 << 20);
  c.encode();
  return c;
}

Case full_body() {
  Case c;
  c.body.resize(500);
  for (std::size_t i = 0; i < c.body.size(); ++i)
    for (int bap = 1; bap <= body::kBapCount; ++bap)
      c.body[i].set(bap,
                    20000.0f * static_cast<float>(std::sin(static_cast<double>(i) * 0.05 + bap)));
  for (int bap = 181; bap <= 183; ++bap)
    for (body::BapFrame& frame : c.body) frame.set(bap, 10.0f);
  set_masks(c.clip(), &c.settings);
  set_ranges(c.clip(), &c.settings);
  c.bytes.resize(1 << 21);
  c.encode();
  return c;
}

void report(benchmark::State& state, const Case& c, std::uint64_t hash) {
  const auto frames = static_cast<double>(c.clip().size());
  state.counters["us_per_frame"] =
      benchmark::Counter(frames * static_cast<double>(state.iterations()) * 1e-6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["kbit_per_s"] =
      static_cast<double>(c.bytes.size()) * 8e-3 * c.settings.rate.hertz() / frames;
  state.SetLabel(label_of(hash));
}

void decode(benchmark::State& state, Case (*make)()) {
  Case c = make();
  std::uint64_t hash = 0;
  for ([[maybe_unused]] auto _ : state) {
    FbaDecoder decoder(c.nodes, {});
    decoder.refill(c.bytes, true);
    FbaPlane plane;
    face::FapFrame face;
    body::BapFrame body;
    hash = kHashSeed;
    std::size_t planes = 0;
    while (decoder.next(&plane, &face, &body).ok()) ++planes;
    if (planes != c.clip().size()) std::abort();
    hash = hash_of(std::span<const float>(face.value), hash);
    hash = hash_of(std::span<const float>(body.value), hash);
  }
  report(state, c, hash);
}

void encode(benchmark::State& state, Case (*make)()) {
  Case c = make();
  for ([[maybe_unused]] auto _ : state) {
    c.bytes.resize(1 << 21);
    c.encode();
  }
  report(state, c, hash_bytes(c.bytes));
}

Case talking_2kbit() { return talking(2.0); }

void read_text(benchmark::State& state) {
  const auto frames = bake::make_talking_track(60.0, 25.0, 1);
  std::vector<char> text(64 + frames.size() * kMaxFapTextFrameBytes);
  TextHeader header;
  header.version.assign(std::string("2.1"));
  header.name.assign(std::string("talk"));
  std::size_t size = write_text_header(header, text).value;
  for (std::size_t i = 0; i < frames.size(); ++i)
    size += write_fap_text(static_cast<std::int32_t>(i), frames[i], std::span(text).subspan(size))
                .value;
  face::FapFrame frame;
  for ([[maybe_unused]] auto _ : state) {
    FapTextReader reader(std::span<const char>(text).first(size));
    std::size_t count = 0;
    while (reader.next(&frame).ok()) ++count;
    if (count != frames.size()) std::abort();
  }
  state.counters["us_per_frame"] = benchmark::Counter(
      static_cast<double>(frames.size()) * static_cast<double>(state.iterations()) * 1e-6,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.SetLabel(label_of(hash_of(std::span<const float>(frame.value))));
}

BENCHMARK_CAPTURE(decode, talking_2kbit, talking_2kbit)->Name("stream/decode/talking_2kbit");
BENCHMARK_CAPTURE(decode, full_face, full_face)->Name("stream/decode/full_face");
BENCHMARK_CAPTURE(decode, full_body, full_body)->Name("stream/decode/full_body");
BENCHMARK_CAPTURE(encode, talking_2kbit, talking_2kbit)->Name("stream/encode/talking_2kbit");
BENCHMARK_CAPTURE(encode, full_face, full_face)->Name("stream/encode/full_face");
BENCHMARK_CAPTURE(encode, full_body, full_body)->Name("stream/encode/full_body");
BENCHMARK(read_text)->Name("stream/read_fap_text");

}  // namespace
}  // namespace caryatid::bench
