// Draw list of a person of 24 objects with 30 bones each, and the importance of all of them.
#include <memory>
#include <vector>

#include "core/base/crc.h"
#include "core/scene/camera.h"
#include "core/scene/compose.h"
#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

constexpr std::size_t kObjects = 24, kJoints = 101;

struct Stage {
  Stage() {
    materials.resize(3);
    materials[1].flags = pack::kAlphaBlend;
    materials[2].flags = pack::kCornea;
    for (std::size_t i = 0; i < kObjects; ++i) {
      pack::Object o{};
      o.material = static_cast<std::uint16_t>(i % 3);
      o.bone_count = kMaxBonesPerDraw;
      for (std::size_t b = 0; b < kMaxBonesPerDraw; ++b)
        o.bone[b] = static_cast<std::uint16_t>((3 * i + b) % kJoints);
      o.center_m[1] = 0.07f * static_cast<float>(i);
      o.radius_m = 0.2f;
      objects.push_back(o);
      meshes[i].triangle_count = 1000;
    }
    view.objects = objects;
    view.materials = materials;
    view.joints = joints;
    job.pack = &view;
    job.meshes = meshes;
    job.joints = affines;
    job.camera = scene::make_camera(scene::framing(scene::View::body, {}), 1.6f);
  }

  std::vector<pack::Object> objects;
  std::vector<pack::Material> materials;
  std::vector<pack::Joint> joints = std::vector<pack::Joint>(kJoints);
  std::vector<Affine> affines = std::vector<Affine>(kJoints);
  std::vector<scene::MeshView> meshes = std::vector<scene::MeshView>(kObjects);
  pack::View view;
  scene::ComposeJob job;
  std::unique_ptr<scene::DrawList> list = std::make_unique<scene::DrawList>();
};

void draw_list(benchmark::State& state) {
  Stage stage;
  for (auto _ : state) {
    if (!stage.job.run(stage.list.get()).ok()) state.SkipWithError("refused");
    benchmark::DoNotOptimize(stage.list.get());
  }
  std::uint64_t hash = hash_of(std::span<const Affine>(stage.list->bones.span()));
  for (const scene::DrawItem& item : stage.list->items)
    hash = hash_of(std::span<const std::uint16_t>(&item.object, 1), hash);
  state.SetLabel(label_of(hash));
}
BENCHMARK(draw_list)->Name("scene/draw_list");

void importance(benchmark::State& state) {
  Stage stage;
  float sum = 0.0f;
  for (auto _ : state) {
    sum = 0.0f;
    for (std::size_t o = 0; o < kObjects; ++o)
      sum += scene::importance(stage.job, o, 800, 480).screen_px;
    benchmark::DoNotOptimize(sum);
  }
  state.SetLabel(label_of(hash_of(std::span<const float>(&sum, 1))));
}
BENCHMARK(importance)->Name("scene/importance");

}  // namespace
}  // namespace caryatid::bench
