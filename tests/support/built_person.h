#pragma once
// The woman and the man as the bake builds them, and their bodies in any pose at full detail.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "assets/bake/human/build.h"
#include "assets/bake/human/feature_points.h"
#include "core/body/helper_joints.h"
#include "core/body/pose.h"

namespace caryatid::test {

// Built once a program; call only where BaseHuman::missing() says nothing.
inline const bake::Character& built_person(const std::string& name) {
  static std::map<std::string, bake::Character> built;
  const auto found = built.find(name);
  if (found != built.end()) return found->second;
  const std::filesystem::path characters = CARYATID_SOURCE_DIR "/assets/characters";
  const bake::BaseHuman base(bake::BaseHuman::default_folder());
  return built[name] = bake::build_character(
             bake::read_recipe(characters / (name + ".toml")), base,
             bake::read_feature_points(characters / "feature_points.toml", base));
}

inline body::Skeleton skeleton_of(const bake::Character& c) {
  body::Skeleton s = body::upright_skeleton();
  for (const bake::Joint& j : c.joints)
    if (j.hanim < body::kHanimJointCount) s.center_m[j.hanim] = j.center_m;
  body::derive_soles(s);
  body::SoleFitter fitter;
  for (const bake::Object& o : c.objects)
    for (const Vec3 p : o.mesh.position_m) fitter.add(p);
  fitter.finish(s);
  return s;
}

// Where the joints' motions take a skinned point.
class PosedBody {
 public:
  PosedBody(const bake::Character& c, const body::Skeleton& s, const body::BapFrame& baps)
      : character_(c), pose_(body::kSkinJointCount) {
    EXPECT_TRUE((body::PoseJob{.skeleton = &s, .baps = &baps, .out = pose_}).run().ok());
    EXPECT_TRUE(body::pose_helpers(s, pose_).ok());
  }
  Vec3 point(const bake::Mesh& mesh, std::size_t vertex) const {
    return moved(mesh.position_m[vertex], mesh.influence[vertex]);
  }
  Vec3 moved(Vec3 rest_m, const bake::Influence& influence) const {
    Vec3 out(0.0f);
    for (std::size_t k = 0; k < 4; ++k)
      if (influence.weight[k] > 0)
        out +=
            influence.weight[k] * pose_[character_.joints[influence.joint[k]].hanim].point(rest_m);
    return out;
  }
  std::vector<Vec3> points(const bake::Mesh& mesh) const {
    std::vector<Vec3> out(mesh.position_m.size());
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = point(mesh, v);
    return out;
  }

 private:
  const bake::Character& character_;
  std::vector<Affine> pose_;
};

// Fixture over "woman" and "man"; skips without the base human's package.
class EachPerson : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (auto line = bake::BaseHuman::missing(bake::BaseHuman::default_folder()))
      GTEST_SKIP() << *line;
    person_ = &built_person(GetParam());
  }
  const bake::Character* person_ = nullptr;
};
#define CARYATID_FOR_EACH_PERSON(Fixture)                                     \
  INSTANTIATE_TEST_SUITE_P(Recipes, Fixture, testing::Values("woman", "man"), \
                           [](const auto& who) { return std::string(who.param); })

}  // namespace caryatid::test
