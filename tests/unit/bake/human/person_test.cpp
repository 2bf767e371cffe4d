// The two people, built from their recipes: rules of the neutral face, feature points, rest pose,
// borders, weights. Needs the package of the base human; without it the tests skip.
#include <algorithm>
#include <map>
#include <set>

#include "tests/support/built_person.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;

class Person : public test::EachPerson {
 protected:
  Vec3 point(int group, int index) const {
    for (const FeaturePoint& p : person_->feature_points)
      if (p.group == group && p.index == index) return p.position_m;
    ADD_FAILURE() << "no point " << group << "." << index;
    return Vec3{0};
  }
  Vec3 joint(HanimJoint j) const { return person_->joints[body::index_of(j)].center_m; }
  const Object& object(const std::string& name) const {
    return *std::find_if(person_->objects.begin(), person_->objects.end(),
                         [&](const Object& o) { return o.name == name; });
  }
};

TEST_P(Person, HasAll84PointsOnce) {
  std::set<std::pair<int, int>> seen;
  for (const FeaturePoint& p : person_->feature_points) seen.insert({p.group, p.index});
  EXPECT_EQ(person_->feature_points.size(), 84u);
  EXPECT_EQ(seen.size(), 84u);
}

// Left and right points of the FDP table that mirror each other.
TEST_P(Person, PointsMirror) {
  constexpr int kPairs[][3] = {{2, 4, 5},  {2, 6, 7},  {2, 8, 9},  {2, 11, 12}, {2, 13, 14},
                               {3, 1, 2},  {3, 3, 4},  {3, 5, 6},  {3, 7, 12},  {3, 11, 8},
                               {4, 1, 2},  {4, 3, 4},  {4, 5, 6},  {5, 1, 2},   {5, 3, 4},
                               {8, 3, 4},  {8, 5, 6},  {8, 7, 8},  {8, 10, 9},  {9, 1, 2},
                               {10, 1, 2}, {10, 5, 6}, {10, 7, 8}, {10, 9, 10}, {11, 3, 2}};
  for (const auto& [group, left, right] : kPairs) {
    const Vec3 a = point(group, left), b = point(group, right);
    EXPECT_GT(a.x, 0.0f) << group << "." << left;
    EXPECT_LT(glm::distance(a, Vec3{-b.x, b.y, b.z}), 0.003f) << group << "." << left;
  }
}

// Recommended constraints of the FDP table that hold on any head.
TEST_P(Person, PointsKeepTheirConstraints) {
  for (const auto& [group, index] : std::initializer_list<std::pair<int, int>>{
           {2, 1}, {2, 2}, {2, 3}, {2, 10}, {8, 1}, {8, 2}, {9, 3}, {9, 12}, {9, 15}, {11, 1}})
    EXPECT_NEAR(point(group, index).x, 0.0f, 0.001f) << group << "." << index;
  EXPECT_GT(point(2, 11).x, point(8, 7).x);
  EXPECT_GT(point(5, 3).y, point(9, 15).y);
  EXPECT_LT(point(5, 3).y, point(9, 12).y);
  EXPECT_GT(point(11, 3).x, point(4, 3).x);
  EXPECT_GT(point(3, 13).y, point(3, 1).y);
  EXPECT_LT(point(3, 9).y, point(3, 3).y);
  EXPECT_NEAR(point(8, 5).x, 0.5f * (point(8, 3).x + point(8, 1).x), 0.004f);
}

TEST_P(Person, NeutralFaceByTheRules) {
  EXPECT_NEAR(point(2, 2).y, point(2, 3).y, 5e-4f);
  EXPECT_NEAR(point(2, 4).y, point(2, 5).y, 5e-4f);
  EXPECT_NEAR(point(3, 1).y - point(3, 3).y, person_->facts.iris_diameter_m, 2e-4f);
  EXPECT_GT(person_->facts.mouth_width_m, 0.035f);
  EXPECT_LT(person_->facts.mouth_width_m, 0.065f);
}

// Once, the settling of the lips walked over the cheek and tore the skin before the ears.
TEST_P(Person, SkinOfTheHeadIsNotTorn) {
  const Mesh& mesh = object("head").mesh;
  const BaseHuman base(BaseHuman::default_folder());
  constexpr float kAboveCollar_m = 0.655f;
  float longest_m = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      // Below, a collar may press the skin of the neck.
      if (base.rest_m()[mesh.base_vertex[a]].y < kAboveCollar_m) continue;
      const float now = glm::distance(mesh.position_m[a], mesh.position_m[b]);
      const float rest =
          glm::distance(base.rest_m()[mesh.base_vertex[a]], base.rest_m()[mesh.base_vertex[b]]);
      longest_m = std::max(longest_m, now - 1.6f * rest);
    }
  EXPECT_LT(longest_m, 0.006f);  // Folds of the ears give 4 mm; the tear gave 8.
}

TEST_P(Person, StandsInTheRestPose) {
  const auto lateral = [&](HanimJoint a, HanimJoint b) {
    const Vec3 d = joint(b) - joint(a);
    return glm::length(Vec2{d.x, d.z}) / glm::length(d);
  };
  EXPECT_LT(lateral(HanimJoint::l_hip, HanimJoint::l_knee), 0.02f);
  EXPECT_LT(lateral(HanimJoint::r_knee, HanimJoint::r_ankle), 0.02f);
  EXPECT_LT(lateral(HanimJoint::l_shoulder, HanimJoint::l_elbow), 0.4f);
  EXPECT_LT(joint(HanimJoint::l_wrist).y, joint(HanimJoint::l_elbow).y);
  EXPECT_GT(joint(HanimJoint::l_thumb2).z, joint(HanimJoint::l_pinky2).z);  // Palms inwards.
  float floor_m = 1;
  for (const Object& o : person_->objects)
    for (const Vec3 p : o.mesh.position_m) floor_m = std::min(floor_m, p.y);
  EXPECT_NEAR(floor_m, 0.0f, 0.002f);
}

TEST_P(Person, ParentsComeFirst) {
  for (std::size_t i = 1; i < person_->joints.size(); ++i) EXPECT_LT(person_->joints[i].parent, i);
  EXPECT_EQ(person_->joints.size(), body::kSkinJointCount);
}

TEST_P(Person, WeightsSumToOneOnAtMost30Joints) {
  for (const Object& o : person_->objects) {
    std::set<std::uint16_t> joints;
    for (const Influence& influence : o.mesh.influence) {
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += influence.weight[k];
        if (influence.weight[k] > 0) joints.insert(influence.joint[k]);
      }
      ASSERT_NEAR(sum, 1.0f, 1e-4f) << o.name;
    }
    EXPECT_LE(joints.size(), kMaxBonesPerDraw) << o.name;
  }
}

// Head and body share the loop at the neck: equal bits of place and normal, and locked.
TEST_P(Person, NeckHasNoSeam) {
  const Object &head = object("head"), &body = object("body");
  std::map<std::uint32_t, std::uint32_t> of_body;
  for (std::uint32_t i = 0; i < body.mesh.base_vertex.size(); ++i)
    of_body[body.mesh.base_vertex[i]] = i;
  std::size_t shared = 0;
  for (std::uint32_t i = 0; i < head.mesh.base_vertex.size(); ++i) {
    const auto found = of_body.find(head.mesh.base_vertex[i]);
    if (found == of_body.end()) continue;
    ++shared;
    EXPECT_EQ(head.mesh.position_m[i], body.mesh.position_m[found->second]);
    EXPECT_EQ(head.mesh.normal[i], body.mesh.normal[found->second]);
    EXPECT_TRUE(std::count(head.locked.begin(), head.locked.end(), i));
  }
  EXPECT_GT(shared, 0u);
}

TEST_P(Person, EverySourceHasAFreeLicence) {
  EXPECT_GE(person_->licences.size(), 8u);
  for (const Licence& l : person_->licences)
    EXPECT_TRUE(l.licence.starts_with("CC0") || l.licence.starts_with("CC BY")) << l.source;
}

TEST_P(Person, ImagesArePowersOfTwo) {
  for (const Image& image : person_->images) {
    EXPECT_EQ(image.width & (image.width - 1), 0u) << image.name;
    EXPECT_LE(image.width, 1024u);
    EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
  }
}

CARYATID_FOR_EACH_PERSON(Person);

}  // namespace
}  // namespace caryatid::bake
