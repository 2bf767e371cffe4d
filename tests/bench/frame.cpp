// The stages of a frame that do not hang on the bake or the GPU, each on the built-in face, so that
// the numbers can be had from a bare checkout: FAP mix, deform and pose, draw list, a second of the
// agent.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "core/agent/agent.h"
#include "core/agent/person.h"
#include "core/base/crc.h"
#include "core/emotion/profiles.h"
#include "core/face/mixer.h"
#include "core/scene/camera.h"
#include "core/scene/compose.h"
#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

// CARYATID_BENCH_PACK names another pack than the built-in face.
struct Stage {
  Stage() {
    const char* named = std::getenv("CARYATID_BENCH_PACK");
    std::ifstream in(named != nullptr ? named : CARYATID_BUILTIN_PACK, std::ios::binary);
    file.assign(std::istreambuf_iterator<char>(in), {});
    const auto bytes = std::as_bytes(std::span(file));
    const auto header = pack::read_header(bytes);
    if (!header.ok()) std::abort();
    image.resize(header.value.image_bytes / sizeof(Vec4) + 1);
    if (!loader->begin(header.value, std::as_writable_bytes(std::span(image))).ok() ||
        !loader->feed(bytes.subspan(sizeof(pack::PackHeader))).ok())
      std::abort();
    memory.resize(agent::Person::arena_bytes(loader->view()));
    Arena arena(memory);
    if (!person->start(loader->view(), arena).ok() || !person->refine(*loader).ok()) std::abort();
    const std::vector<std::uint32_t> all(person->object_count(), 0xFFFFFFFFu);
    person->set_levels(all);
    weights[1] = 0.6f;
    weights[6] = 0.4f;
    felt = emotion::expression(weights);
  }
  face::FapFrame mixed() const {
    face::MixJob mix;
    mix.rest = &person->rest_face();
    mix.emotion = &felt;
    mix.idle = &felt;
    mix.limits = &person->limits();
    return mix.run();
  }
  std::vector<char> file;
  std::vector<Vec4> image;
  std::vector<std::byte> memory;
  std::unique_ptr<pack::Loader> loader = std::make_unique<pack::Loader>();
  std::unique_ptr<agent::Person> person = std::make_unique<agent::Person>();
  emotion::Weights weights{};
  face::FapFrame felt;
};

void mix(benchmark::State& state) {
  const Stage stage;
  face::FapFrame out;
  for (auto _ : state) benchmark::DoNotOptimize(out = stage.mixed());
  state.SetLabel(label_of(hash_of(std::span<const float>(out.value))));
}
BENCHMARK(mix)->Name("frame/fap_mix")->Unit(benchmark::kMicrosecond);

void express(benchmark::State& state) {
  const Stage stage;
  face::FapFrame out;
  for (auto _ : state) benchmark::DoNotOptimize(out = emotion::expression(stage.weights));
  state.SetLabel(label_of(hash_of(std::span<const float>(out.value))));
}
BENCHMARK(express)->Name("frame/emotion")->Unit(benchmark::kMicrosecond);

// Deform and pose together, as a frame runs them; vertices a second as the rate.
void show(benchmark::State& state) {
  const Stage stage;
  const face::FapFrame a = stage.mixed(), b;
  bool flip = false;
  for (auto _ : state) {
    stage.person->show(flip ? a : b, {}, Affine{}, 0.0f);
    flip = !flip;
  }
  stage.person->show(a, {}, Affine{}, 0.0f);
  std::uint64_t hash = kHashSeed;
  for (const scene::MeshView& m : stage.person->meshes())
    hash = hash_of(m.dynamic.first(m.vertex_count), hash);
  state.counters["vertices"] = stage.person->deformed_vertices();
  state.SetLabel(label_of(hash));
}
BENCHMARK(show)->Name("frame/deform_and_pose")->Unit(benchmark::kMicrosecond);

void compose(benchmark::State& state) {
  const Stage stage;
  const auto list = std::make_unique<scene::DrawList>();
  scene::ComposeJob job;
  job.pack = &stage.person->view();
  job.meshes = stage.person->meshes();
  job.joints = stage.person->joints();
  job.camera = scene::make_camera(scene::framing(scene::View::head, {}), 1.6f);
  for (auto _ : state)
    if (!job.run(list.get()).ok()) std::abort();
  state.SetLabel(label_of(hash_of(std::span<const Affine>(list->bones.span()))));
}
BENCHMARK(compose)->Name("frame/draw_list")->Unit(benchmark::kMicrosecond);

void agent_step(benchmark::State& state) {
  agent::Agent agent(1);
  for (auto _ : state) benchmark::DoNotOptimize(agent.step(1.0f / 30.0f));
}
BENCHMARK(agent_step)->Name("frame/agent_step")->Unit(benchmark::kMicrosecond);

// All levels of all objects, down and up again.
void levels(benchmark::State& state) {
  const Stage stage;
  if (stage.person->view().splits.empty()) {
    state.SkipWithError("this pack has one level; name another by CARYATID_BENCH_PACK");
    return;
  }
  std::vector<std::uint32_t> none(stage.person->object_count(), 0), all(none.size(), 0xFFFFFFFFu);
  for (auto _ : state) {
    stage.person->set_levels(none);
    stage.person->set_levels(all);
  }
  std::size_t splits = stage.person->view().splits.size();
  state.counters["ns_per_record"] = benchmark::Counter(
      2.0 * static_cast<double>(splits) * static_cast<double>(state.iterations()) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.SetLabel(label_of(stage.person->triangle_count()));
}
BENCHMARK(levels)->Name("frame/all_levels_down_and_up")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace caryatid::bench
