// The face in one frame: mixing, channel weights, deformation. Synthetic head of the size of a real
// one (pack of the woman: 161 channels; about 4800 vertices of the head at full resolution carry
// 40 000 moves), because a benchmark must run without the base human.
#include <vector>

#include "core/base/arena.h"
#include "core/base/crc.h"
#include "core/base/random.h"
#include "core/emotion/profiles.h"
#include "core/face/deform.h"
#include "core/face/mixer.h"
#include "core/face/visemes.h"
#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

constexpr std::uint32_t kVertices = 4800, kMovesPerVertex = 8;
constexpr std::uint16_t kChannels = 161;

face::FapLimits limits() {
  face::FapLimits out;
  out.low.fill(-1200.0f);
  out.high.fill(1200.0f);
  return out;
}

face::FapFrame mixed(const face::FapLimits& range) {
  emotion::Weights weights{};
  weights[emotion::index_of(emotion::Emotion::joy)] = 0.8f;
  const face::FapFrame feeling = emotion::expression(weights);
  const face::FapFrame viseme = face::viseme_frame(10);
  face::FapFrame idle;
  idle.set(19, 300.0f);
  idle.set(20, 300.0f);
  idle.set(25, 4000.0f);
  idle.set(26, 4000.0f);
  return face::MixJob{.emotion = &feeling,
                      .speech = &viseme,
                      .speech_strength = 0.7f,
                      .idle = &idle,
                      .limits = &range}
      .run();
}

// Two or three channels of every FAP, as the bake makes them.
std::vector<pack::Channel> channels() {
  std::vector<pack::Channel> out;
  for (std::uint16_t i = 0; i < kChannels; ++i) {
    const auto fap = static_cast<std::uint16_t>(3 + i % 66);
    const float from = i < 132 ? 0.0f : 300.0f;
    out.push_back({fap, 0, from, i < 66 ? from + 300.0f : -300.0f, 0.0f, 0.0f});
  }
  return out;
}

void mix(benchmark::State& state) {
  const face::FapLimits range = limits();
  face::FapFrame frame;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(frame = mixed(range));
  state.SetLabel(label_of(hash_of(std::span<const float>(frame.value))));
}
BENCHMARK(mix)->Name("face/mix");

void weigh(benchmark::State& state) {
  const face::FapLimits range = limits();
  const face::FapFrame frame = mixed(range);
  const auto table = channels();
  std::vector<float> weight(table.size());
  for ([[maybe_unused]] auto _ : state) {
    if (!face::evaluate_channels(table, frame, weight).ok()) state.SkipWithError("channels");
    benchmark::DoNotOptimize(weight.data());
  }
  state.SetLabel(label_of(hash_of(std::span<const float>(weight))));
}
BENCHMARK(weigh)->Name("face/channels");

struct Head {
  std::vector<pack::Vertex> versions;
  std::vector<std::uint16_t> indices;
  std::vector<std::uint32_t> first{0};
  std::vector<pack::Move> moves;
  std::vector<std::byte> block = std::vector<std::byte>(4u << 20);
  std::vector<std::uint16_t> scratch = std::vector<std::uint16_t>(3 * kVertices);
  Arena arena{block};
  mesh::LiveMesh mesh;
  bool ok = false;

  Head() {
    Random random(7);
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      pack::Vertex vertex{};
      for (float& p : vertex.position_m) p = random.between(-0.1f, 0.1f);
      vertex.normal[2] = 127;
      versions.push_back(vertex);
      for (std::uint32_t m = 0; m < kMovesPerVertex; ++m)
        moves.push_back({static_cast<std::uint16_t>((v / 40 + 13 * m) % kChannels),
                         {static_cast<std::int16_t>(100 + m), -50, 25},
                         {3, -2, 1},
                         0});
      first.push_back(static_cast<std::uint32_t>(moves.size()));
    }
    for (std::uint32_t t = 0; t + 2 < kVertices; ++t)
      for (std::uint32_t c = 0; c < 3; ++c) indices.push_back(static_cast<std::uint16_t>(t + c));
    const auto triangles = static_cast<std::uint32_t>(indices.size() / 3);
    ok = mesh.start({versions, indices, {}, {}, kVertices, kVertices, triangles}, arena, scratch)
             .ok();
  }
};

void deform(benchmark::State& state) {
  Head head;
  if (!head.ok) return state.SkipWithError("mesh");
  const face::FapLimits range = limits();
  std::vector<float> weight(kChannels);
  if (!face::evaluate_channels(channels(), mixed(range), weight).ok())
    return state.SkipWithError("channels");
  for ([[maybe_unused]] auto _ : state) {
    weight[0] = 1.0f - weight[0];  // Something moves in every frame.
    mesh::DirtyRange dirty;
    if (!face::DeformJob{{head.first, head.moves}, weight, &head.mesh, &dirty}.run().ok())
      state.SkipWithError("deform");
    benchmark::DoNotOptimize(dirty);
  }
  weight[0] = 0.5f;
  if (!face::DeformJob{{head.first, head.moves}, weight, &head.mesh}.run().ok())
    state.SkipWithError("deform");
  state.counters["moves"] = static_cast<double>(head.moves.size());
  state.SetLabel(label_of(
      hash_of(std::span<const mesh::DynamicVertex>(head.mesh.dynamic().data(), kVertices))));
}
BENCHMARK(deform)->Name("face/deform");

}  // namespace
}  // namespace caryatid::bench
