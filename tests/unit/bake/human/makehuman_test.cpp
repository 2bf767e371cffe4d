#include "assets/bake/human/makehuman.h"

#include <gtest/gtest.h>

#include <fstream>

#include "assets/bake/human/json_mesh.h"

namespace caryatid::bake {
namespace {

// Tests of this fixture read the package; without it they skip.
class Package : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!BaseHuman::missing(BaseHuman::default_folder()))
      human_ = std::make_unique<BaseHuman>(BaseHuman::default_folder());
  }
  static void TearDownTestSuite() { human_.reset(); }
  void SetUp() override {
    if (!human_) GTEST_SKIP() << *BaseHuman::missing(BaseHuman::default_folder());
  }
  static inline std::unique_ptr<BaseHuman> human_;
};

TEST_F(Package, HasTheBaseMesh) {
  EXPECT_EQ(human_->rest_m().size(), 19158u);
  EXPECT_EQ(human_->quads().size(), 18486u);
  EXPECT_EQ(human_->bones().size(), 163u);
  EXPECT_EQ(human_->target_names().size(), 1258u);
  EXPECT_EQ(human_->groups()[0], "body");
}

TEST_F(Package, EveryBoneButTheRootHasAParent) {
  std::size_t roots = 0;
  for (const Bone& bone : human_->bones())
    if (bone.parent == kNone) ++roots;
  EXPECT_EQ(roots, 1u);
  EXPECT_EQ(human_->bones()[human_->bones()[human_->bone("lowerarm01.L")].parent].name,
            "upperarm02.L");
}

TEST_F(Package, LeftIsPositiveX) {
  EXPECT_GT(human_->head(human_->rest_m(), "wrist.L").x, 0.3f);
  EXPECT_LT(human_->head(human_->rest_m(), "wrist.R").x, -0.3f);
}

TEST_F(Package, ATargetIsLinear) {
  const TargetWeight half[] = {{"macrodetails/caucasian-female-young", 0.5f}};
  const TargetWeight full[] = {{"macrodetails/caucasian-female-young", 1.0f}};
  const auto a = human_->apply(half), b = human_->apply(full);
  const auto rest = human_->rest_m();
  for (std::size_t i = 0; i < rest.size(); i += 97)
    EXPECT_LT(glm::length(2.0f * (a[i] - rest[i]) - (b[i] - rest[i])), 1e-6f);
}

// Rows of the binary file and names go together: a shape moves the part that it names.
TEST_F(Package, AShapeMovesWhatItNames) {
  const auto center_y_m = [](const char* name) {
    double sum = 0, height = 0;
    const auto moved = human_->target_m(name);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      sum += double(glm::length(moved[i]));
      height += double(glm::length(moved[i])) * double(human_->rest_m()[i].y);
    }
    return height / sum;
  };
  EXPECT_NEAR(center_y_m("expression/units/caucasian/eye-left-closure"), 0.73, 0.02);
  EXPECT_NEAR(center_y_m("expression/units/caucasian/mouth-open"), 0.65, 0.03);
  EXPECT_NEAR(center_y_m("armslegs/l-foot-scale-incr"), -0.79, 0.05);
}

TEST_F(Package, AProxyFollowsTheBase) {
  const Proxy eyes = human_->load_proxy("eyes/HighPolyEyes");
  std::vector<Vec3> moved(human_->rest_m().begin(), human_->rest_m().end());
  for (Vec3& p : moved) p += Vec3{0.1f, 0.2f, 0.3f};
  const auto here = eyes.fit(human_->rest_m()), there = eyes.fit(moved);
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_LT(glm::length(there[i] - here[i] - Vec3{0.1f, 0.2f, 0.3f}), 1e-4f);
}

TEST_F(Package, UnknownNamesAreRefused) {
  EXPECT_THROW(human_->target("nose/none"), std::runtime_error);
  EXPECT_THROW(human_->bone("tail"), std::runtime_error);
  EXPECT_THROW(human_->load_proxy("hair/none"), std::runtime_error);
}

TEST(Missing, OneLineNamesTheFolder) {
  const auto line = BaseHuman::missing("/nowhere/at/all");
  ASSERT_TRUE(line);
  EXPECT_NE(line->find("/nowhere/at/all"), std::string::npos);
  EXPECT_EQ(line->find('\n'), std::string::npos);
}

// The reader of meshes, on a mesh of our own.
Json one_quad() {
  return Json::parse(R"({"vertices":[0,0,0, 1,0,0, 1,1,0, 0,1,0], "uvs":[[0,0, 1,0, 1,1, 0,1]],
      "faces":[11,0,1,2,3,7,0,1,2,3], "skinIndices":[2,0,0,0, 2,4,0,0, 0,0,0,0, 0,0,0,0],
      "skinWeights":[1,0,0,0, 0.5,1.5,0,0, 0,0,0,0, 2,0,0,0],
      "metadata":{"license":{"license":"CC0","author":"A"}}})");
}

TEST(JsonMesh, PositionsBecomeMetres) { EXPECT_FLOAT_EQ(read_positions(one_quad())[2].y, 0.1f); }

TEST(JsonMesh, QuadsKeepGroupAndUvs) {
  const auto quads = read_quads(one_quad(), 4, 4);
  ASSERT_EQ(quads.size(), 1u);
  EXPECT_EQ(quads[0].group, 7u);
  EXPECT_EQ(quads[0].vertex[3], 3u);
}

TEST(JsonMesh, WeightsSumToOne) {
  for (const Influence& influence : read_influences(one_quad(), 4, 3)) {
    float sum = 0;
    for (const float weight : influence.weight) sum += weight;
    EXPECT_FLOAT_EQ(sum, 1.0f);
  }
}

TEST(JsonMesh, HeadBonesHalve) { EXPECT_EQ(read_influences(one_quad(), 4, 3)[1].joint[1], 2u); }

TEST(JsonMesh, IndicesOutOfRangeAreRefused) {
  EXPECT_THROW(read_quads(one_quad(), 3, 4), std::runtime_error);
  EXPECT_THROW(read_quads(one_quad(), 4, 3), std::runtime_error);
  EXPECT_THROW(read_influences(one_quad(), 4, 2), std::runtime_error);
}

TEST(JsonMesh, LicenceIsKept) { EXPECT_EQ(read_licence(one_quad(), "x").licence, "CC0"); }

}  // namespace
}  // namespace caryatid::bake
