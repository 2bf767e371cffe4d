#include "core/scene/compose.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/body/hanim.h"
#include "core/scene/camera.h"

namespace caryatid::scene {
namespace {

class Compose : public testing::Test {
 protected:
  Compose() {
    add(pack::kAlphaBlend, pack::ObjectRole::hair, 0.0f);
    add(0, pack::ObjectRole::body, -0.5f);
    add(pack::kCornea, pack::ObjectRole::eye, 0.3f);
    add(0, pack::ObjectRole::head, 0.5f);
    add(pack::kAlphaBlend, pack::ObjectRole::lash, 0.2f);
    view_.objects = objects_;
    view_.materials = materials_;
    view_.joints = joints_;
    job_.pack = &view_;
    job_.meshes = meshes_;
    job_.joints = affines_;
    job_.camera = make_camera(framing(View::head, Subject{}), 1.0f);
  }
  void add(std::uint16_t flags, pack::ObjectRole role, float z_m) {
    pack::Material m{};
    m.flags = flags;
    materials_.push_back(m);
    pack::Object o{};
    o.material = static_cast<std::uint16_t>(objects_.size());
    o.role = role;
    o.bone_count = 1;
    o.center_m[1] = 1.6f;
    o.center_m[2] = z_m;
    o.radius_m = 0.1f;
    objects_.push_back(o);
    MeshView mesh;
    mesh.triangle_count = 10;
    meshes_.push_back(mesh);
  }
  std::vector<std::uint16_t> order() {
    std::vector<std::uint16_t> out;
    for (const DrawItem& item : list_->items) out.push_back(item.object);
    return out;
  }

  std::vector<pack::Object> objects_;
  std::vector<pack::Material> materials_;
  std::vector<pack::Joint> joints_{1};
  std::vector<Affine> affines_{1};
  std::vector<MeshView> meshes_;
  pack::View view_;
  ComposeJob job_;
  std::unique_ptr<DrawList> list_ = std::make_unique<DrawList>();
};

TEST_F(Compose, OpaqueFrontToBackThenLashesHairAndCorneas) {
  ASSERT_TRUE(job_.run(list_.get()).ok());
  EXPECT_EQ(order(), (std::vector<std::uint16_t>{3, 1, 4, 0, 2}));
}

TEST_F(Compose, ObjectsWithoutTrianglesAreLeftOut) {
  meshes_[3].triangle_count = 0;
  ASSERT_TRUE(job_.run(list_.get()).ok());
  EXPECT_EQ(list_->items.size(), 4u);
}

TEST_F(Compose, SameInputGivesTheSameListAgain) {
  ASSERT_TRUE(job_.run(list_.get()).ok());
  const auto first = order();
  ASSERT_TRUE(job_.run(list_.get()).ok());
  EXPECT_EQ(order(), first);
  EXPECT_EQ(list_->bones.size(), 5u);
}

TEST_F(Compose, RefusesSpansThatDoNotMatchThePack) {
  job_.joints = {};
  EXPECT_EQ(job_.run(list_.get()).code, Code::invalid_argument);
  job_.joints = affines_;
  job_.pack = nullptr;
  EXPECT_EQ(job_.run(list_.get()).code, Code::invalid_argument);
}

TEST_F(Compose, LightsAreUnitAndPatchesStay) {
  ASSERT_TRUE(list_->patches.push({2, {0, 3}, {}, {}}));
  ASSERT_TRUE(job_.run(list_.get()).ok());
  EXPECT_NEAR(glm::length(list_->key.direction), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::length(list_->rim.direction), 1.0f, 1e-6f);
  EXPECT_EQ(list_->patches.size(), 1u);
}

TEST_F(Compose, AFootThatLiftsLosesItsShadow) {
  joints_[0].hanim = body::index_of(body::HanimJoint::l_ankle);
  ASSERT_TRUE(job_.run(list_.get()).ok());
  ASSERT_EQ(list_->floor_shadows.size(), 2u);
  EXPECT_GT(list_->floor_shadows[1].strength, 0.5f);
  affines_[0].row[1].w = 0.3f;
  ASSERT_TRUE(job_.run(list_.get()).ok());
  EXPECT_EQ(list_->floor_shadows[1].strength, 0.0f);
}

TEST_F(Compose, ImportanceGrowsWithNearnessAndIsZeroBehindTheCamera) {
  const float near_px = importance(job_, 3, 800, 480).screen_px;
  const float far_px = importance(job_, 1, 800, 480).screen_px;
  EXPECT_GT(near_px, far_px);
  EXPECT_LE(near_px, 800.0f * 480.0f);
  affines_[0].row[2].w = 50.0f;
  EXPECT_EQ(importance(job_, 3, 800, 480).screen_px, 0.0f);
}

}  // namespace
}  // namespace caryatid::scene
