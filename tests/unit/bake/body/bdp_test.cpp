#include "assets/bake/body/bdp.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "assets/bake/gait/soles.h"
#include "assets/bake/pack/writer.h"
#include "tests/support/built_person.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;

// A humanoid as senders write it: joints before and after their names, a prototype, a box.
constexpr const char* kSent = R"(#VRML V2.0 utf8
PROTO Joint [ exposedField SFVec3f center 0 0 0 field SFString name "" ] { Transform { } }
DEF hanim_HumanoidRoot Joint { name "HumanoidRoot" center 0, 0.95, 0.02
  children [ DEF hanim_l_hip Joint { center 0.1 0.93 0 name "l_hip" children [
    Joint { name "l_knee" center 0.1 0.5 0 children [ Joint { name "l_ankle" center 0.1 0.08 0 }
      Segment { children Shape {
        appearance Appearance { material Material { diffuseColor 1 0.5 0 } }
        geometry IndexedFaceSet {
          coord DEF c Coordinate { point [ 0 0 0, 0.1 0 0, 0.1 0.4 0, 0 0.4 0.1 ] }
          coordIndex [ 0 1 2 3 -1 0 2 3 -1 ] } } } ] } ] }
    Joint { name "skullbase" center 0 1.75 0.02 } ] }
)";

TEST(Bdp, ReadsJointsAndSurfaces) {
  const BodyDefinition sent = read_bdp(kSent, "sent.wrl");
  ASSERT_EQ(sent.joints.size(), 5u);
  EXPECT_EQ(sent.joints[1].joint, HanimJoint::l_hip);
  EXPECT_FLOAT_EQ(sent.joints[1].center_m.y, 0.93f);
  EXPECT_FLOAT_EQ(sent.joints[2].center_m.y, 0.5f);
  ASSERT_EQ(sent.segments.size(), 1u);
  EXPECT_EQ(sent.segments[0].joint, HanimJoint::l_knee);
  EXPECT_EQ(sent.segments[0].triangles.size(), 3u);
  EXPECT_FLOAT_EQ(sent.segments[0].color.y, 0.5f);
}

TEST(Bdp, BadTextIsRefusedWithItsLine) {
  const std::string whole = kSent;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& bad :
       {with("0.93 0 name", "0.93 x name"), with("l_knee", "l_hip"), with("0 1 2 3", "0 1 2 9"),
        with("0.08 0 }", "0.08 0 } }"), std::string("#VRML V2.0 utf8\nGroup { }"),
        with("\"skullbase\"", "\"skullbase"), with("0.95", "1e30")})
    try {
      read_bdp(bad, "bad.wrl");
      FAIL() << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()).rfind("bad.wrl:", 0), 0u) << e.what();
    }
  for (std::size_t n = 0; n < whole.size(); ++n) try {
      (void)read_bdp(whole.substr(0, n), "cut.wrl");
    } catch (const std::runtime_error&) {
    }
}

TEST(Bdp, APredictedBodyReplacesOurs) {
  Character c = character_of(read_bdp(kSent, "sent.wrl"), "sent");
  EXPECT_EQ(c.objects.size(), 1u);
  EXPECT_FLOAT_EQ(c.joints[body::index_of(HanimJoint::l_knee)].center_m.y, 0.5f);
  add_sole_points(c);
  EXPECT_GT(write_pack(c).size(), 1000u);
  BodyDefinition bare = read_bdp(kSent, "sent.wrl");
  bare.segments.clear();
  EXPECT_THROW(character_of(bare, "bare"), std::runtime_error);
}

class Calibrated : public test::EachPerson {
 protected:
  // The other person's joints, sent to this one.
  BodyDefinition other() const {
    const Character& c = test::built_person(GetParam() == std::string("man") ? "woman" : "man");
    BodyDefinition sent;
    for (const HanimJoint j :
         {HanimJoint::humanoid_root, HanimJoint::l_hip, HanimJoint::r_hip, HanimJoint::l_knee,
          HanimJoint::r_knee, HanimJoint::l_ankle, HanimJoint::r_ankle, HanimJoint::l_metatarsal,
          HanimJoint::r_metatarsal, HanimJoint::vl5, HanimJoint::vt1, HanimJoint::vc7,
          HanimJoint::skullbase, HanimJoint::l_shoulder, HanimJoint::r_shoulder,
          HanimJoint::l_elbow, HanimJoint::r_elbow, HanimJoint::l_wrist, HanimJoint::r_wrist})
      sent.joints.push_back({j, c.joints[body::index_of(j)].center_m});
    return sent;
  }
};

TEST_P(Calibrated, TakesOnTheSentJointsAndSkinFollows) {
  Character c = *person_;
  const BodyDefinition sent = other();
  calibrate_character(sent, &c);
  const float shift = c.joints[0].center_m.y - sent.joints[0].center_m.y;  // To stand on the floor.
  EXPECT_LT(std::abs(shift), 0.03f);
  for (const body::JointCenter& j : sent.joints)
    EXPECT_LT(
        glm::distance(c.joints[body::index_of(j.joint)].center_m, j.center_m + Vec3{0, shift, 0}),
        1e-4f);
  const float ratio = c.facts.stature_m / person_->facts.stature_m;
  EXPECT_GT(std::abs(ratio - 1.0f), 0.02f);
  float lowest = 1, highest = 0;
  for (const Object& o : c.objects)
    for (const Vec3 p : o.mesh.position_m) {
      lowest = std::min(lowest, p.y);
      highest = std::max(highest, p.y);
    }
  EXPECT_NEAR(lowest, 0.0f, 1e-4f);
  EXPECT_NEAR(highest, c.facts.stature_m, 0.08f);  // Hair stands above.
  // The face keeps its form: all of its points scale alike.
  const auto apart = [](const Character& who, std::size_t a, std::size_t b) {
    return glm::distance(who.feature_points[a].position_m, who.feature_points[b].position_m);
  };
  for (std::size_t i = 1; i < 20; ++i)
    EXPECT_NEAR(apart(c, 0, i), ratio * apart(*person_, 0, i), 0.002f) << i;
}

TEST_P(Calibrated, ItsOwnJointsChangeNothing) {
  Character c = *person_;
  BodyDefinition own;
  for (const Joint& j : person_->joints)
    if (j.hanim < body::kHanimJointCount)
      own.joints.push_back({static_cast<HanimJoint>(j.hanim), j.center_m});
  calibrate_character(own, &c);
  for (std::size_t o = 0; o < c.objects.size(); ++o)
    for (std::size_t v = 0; v < c.objects[o].mesh.position_m.size(); v += 5)
      EXPECT_LT(
          glm::distance(c.objects[o].mesh.position_m[v], person_->objects[o].mesh.position_m[v]),
          2e-3f);
}

TEST_P(Calibrated, RefusesABodyOfNobody) {
  Character c = *person_;
  BodyDefinition giant = other();
  for (body::JointCenter& j : giant.joints) j.center_m *= 3.0f;
  EXPECT_THROW(calibrate_character(giant, &c), std::runtime_error);
}

CARYATID_FOR_EACH_PERSON(Calibrated);

}  // namespace
}  // namespace caryatid::bake
