#include "core/agent/person.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/unit/core/pack/tiny_pack.h"

namespace caryatid::agent {
namespace {

// A person from the smallest pack: one triangle whose first vertex FAP 3 lowers by 0.2 mm.
struct Fixture {
  Fixture() {
    const auto file = pack::TinyPack().file();
    const auto header = pack::read_header(file).value;
    image.resize(header.image_bytes / sizeof(Vec4) + 1);
    EXPECT_TRUE(loader->begin(header, std::as_writable_bytes(std::span(image))).ok());
    EXPECT_TRUE(loader->feed(std::span(file).subspan(sizeof header)).ok());
    memory.resize(Person::arena_bytes(loader->view()));
  }
  std::vector<Vec4> image;
  std::unique_ptr<pack::Loader> loader = std::make_unique<pack::Loader>();
  std::vector<std::byte> memory;
  std::unique_ptr<Person> person = std::make_unique<Person>();
};

TEST(Person, StartsInTheMemoryThatItAskedFor) {
  Fixture f;
  Arena arena(f.memory);
  ASSERT_TRUE(f.person->start(f.loader->view(), arena).ok());
  EXPECT_EQ(f.person->triangle_count(), 1u);
  EXPECT_EQ(f.person->meshes().size(), 1u);
  Arena small(std::span(f.memory).first(f.memory.size() / 4));
  EXPECT_EQ(f.person->start(f.loader->view(), small).code, Code::out_of_capacity);
}

TEST(Person, FapMovesItsFeaturePointAndReportsThePatch) {
  Fixture f;
  Arena arena(f.memory);
  ASSERT_TRUE(f.person->start(f.loader->view(), arena).ok());
  FixedVector<scene::MeshPatch, kMaxObjects> patches;
  f.person->collect_patches(&patches);
  face::FapFrame faps;
  faps.set(3, 50.0f);  // Half of the channel's ramp.
  f.person->show(faps, {}, Affine{}, 0.0f);
  EXPECT_NEAR(f.person->feature_point_m(2, 1).y, 1.0f - 0.5f * 100.0f * pack::kMoveStep_m, 1e-6f);
  f.person->collect_patches(&patches);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0].dynamic.count, 1u);
  EXPECT_EQ(patches[0].indices.count, 0u);
  f.person->show(faps, {}, Affine{}, 0.0f);
  f.person->collect_patches(&patches);
  EXPECT_TRUE(patches.empty());  // Nothing changed, nothing to upload.
}

TEST(Person, PlaceMovesAllOfIt) {
  Fixture f;
  Arena arena(f.memory);
  ASSERT_TRUE(f.person->start(f.loader->view(), arena).ok());
  Affine place;
  place.row[0].w = 2.0f;
  f.person->show({}, {}, place, 0.0f);
  EXPECT_NEAR(f.person->feature_point_m(2, 1).x, 2.0f, 1e-6f);
}

TEST(Person, RefusesAJointThatTheSkeletonLacks) {
  Fixture f;
  auto* joint = const_cast<pack::Joint*>(f.loader->view().joints.data());
  joint->hanim = 999;
  Arena arena(f.memory);
  EXPECT_EQ(f.person->start(f.loader->view(), arena).code, Code::corrupt_data);
}

}  // namespace
}  // namespace caryatid::agent
