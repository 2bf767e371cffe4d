// Exact hashes of what reaches the renderer: deformed vertices, bones, draw list. No libm, no
// contraction in their path, so the same on every machine; a change must be meant.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/agent/person.h"
#include "core/base/crc.h"
#include "core/emotion/profiles.h"
#include "core/face/mixer.h"
#include "core/scene/camera.h"
#include "core/scene/compose.h"
#include "platform/cpu.h"
#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

// Of the built-in face of this tree. When one changes, first know why.
constexpr std::uint64_t kJoyHash = 0xadef75ca1b247132u, kPoseHash = 0x18d89feb35823a52u,
                        kDrawListHash = 0x8c89641f2ed2a820u;

class Hash : public testing::Test {
 protected:
  void SetUp() override {
    file_ = content(kBuiltin);
    const auto bytes = std::as_bytes(std::span(file_));
    const auto header = pack::read_header(bytes);
    ASSERT_TRUE(header.ok());
    image_.resize(header.value.image_bytes / sizeof(Vec4) + 1);
    ASSERT_TRUE(loader_->begin(header.value, std::as_writable_bytes(std::span(image_))).ok());
    ASSERT_TRUE(loader_->feed(bytes.subspan(sizeof(pack::PackHeader))).ok());
    memory_.resize(agent::Person::arena_bytes(loader_->view()));
    Arena arena(memory_);
    person_->use(face::sum_moves_for(platform::has_neon()));
    ASSERT_TRUE(person_->start(loader_->view(), arena).ok());
  }

  void show(emotion::Emotion e, float strength, const body::BapFrame& baps = {}) {
    emotion::Weights weights{};
    weights[emotion::index_of(e)] = strength;
    const face::FapFrame felt = emotion::expression(weights);
    face::MixJob mix;
    mix.rest = &person_->rest_face();
    mix.emotion = &felt;
    mix.limits = &person_->limits();
    person_->show(mix.run(), baps, Affine{}, 0.0f);
  }
  std::uint64_t vertices() const {
    std::uint64_t h = kHashSeed;
    for (const scene::MeshView& m : person_->meshes())
      h = hash_of(m.dynamic.first(m.vertex_count), h);
    return h;
  }
  std::uint64_t joints() const { return hash_of(person_->joints()); }

  std::string file_;
  std::vector<Vec4> image_;
  std::vector<std::byte> memory_;
  std::unique_ptr<pack::Loader> loader_ = std::make_unique<pack::Loader>();
  std::unique_ptr<agent::Person> person_ = std::make_unique<agent::Person>();
};

TEST_F(Hash, RestIsThePackItself) {
  person_->show({}, {}, Affine{}, 0.0f);
  const auto& view = person_->view();
  for (std::size_t o = 0; o < view.objects.size(); ++o)
    for (std::uint32_t v = 0; v < person_->meshes()[o].vertex_count; ++v) {
      const pack::Vertex& rest = view.versions[view.objects[o].first_version + v];
      ASSERT_EQ(person_->meshes()[o].dynamic[v].position_m.y, rest.position_m[1]);
    }
}

TEST_F(Hash, DeformedFaceIsExact) {
  show(emotion::Emotion::joy, 1.0f);
  const std::uint64_t joy = vertices();
  show(emotion::Emotion::fear, 0.5f);
  EXPECT_NE(vertices(), joy);
  show(emotion::Emotion::joy, 1.0f);
  EXPECT_EQ(vertices(), joy);  // No memory of what was shown between.
  EXPECT_EQ(joy, kJoyHash);
}

TEST_F(Hash, PoseIsExact) {
  body::BapFrame baps;
  baps.set(34, 40000.0f);  // l_shoulder_abduct
  baps.set(38, 90000.0f);  // l_elbow_flexion
  baps.set(89, 5000.0f);   // vt6_tilt
  show(emotion::Emotion::calm, 0.0f, baps);
  const std::uint64_t a = joints();
  show(emotion::Emotion::calm, 0.0f);
  const std::uint64_t b = joints();
  EXPECT_NE(a, b);
  EXPECT_EQ(a, kPoseHash);
  show(emotion::Emotion::calm, 0.0f, baps);
  EXPECT_EQ(joints(), a);
}

TEST_F(Hash, DrawListOrdersOpaqueBeforeAlpha) {
  show(emotion::Emotion::calm, 0.0f);
  const auto list = std::make_unique<scene::DrawList>();
  scene::ComposeJob job;
  job.pack = &person_->view();
  job.meshes = person_->meshes();
  job.joints = person_->joints();
  job.camera = scene::make_camera(scene::framing(scene::View::head, {}), 1.0f);
  ASSERT_TRUE(job.run(list.get()).ok());
  bool alpha = false;
  for (const scene::DrawItem& item : list->items) {
    const auto flags = person_->view().materials[item.material].flags;
    const bool late = (flags & (pack::kAlphaBlend | pack::kCornea)) != 0;
    EXPECT_FALSE(alpha && !late);
    alpha = alpha || late;
  }
  EXPECT_EQ(list->items.size(), person_->object_count());
  std::uint64_t hash = hash_of(std::span<const Affine>(list->bones.span()));
  for (const scene::DrawItem& i : list->items) {
    const std::uint32_t words[] = {i.object, i.material, i.triangle_count, i.first_bone,
                                   i.bone_count};
    hash = hash_of(std::span<const std::uint32_t>(words), hash);
  }
  hash = hash_of(std::span<const float>(&list->camera.view[0][0], 16), hash);
  EXPECT_EQ(hash, kDrawListHash);
}

}  // namespace
}  // namespace caryatid::golden
