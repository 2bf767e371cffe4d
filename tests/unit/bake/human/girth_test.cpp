// Limbs keep their girth when they twist and bend: no candy-wrapper wrists, no collapsing knees.
// Measured as areas of cross-sections of the skinned meshes, skin and clothes alike.
#include <array>
#include <cmath>
#include <cstdio>

#include "core/body/ik.h"
#include "tests/support/built_person.h"

namespace caryatid::bake {
namespace {

using body::Axis;
using body::HanimJoint;

// The cut of a mesh by a plane, as points between two vertices, in pairs.
struct Cut {
  struct Point {
    std::uint32_t a, b;
    float share;
  };
  const Mesh* mesh = nullptr;
  std::vector<std::array<Point, 2>> segments;
};

// Of what moves with the joints of the limb only: the plane cuts other parts, too.
Cut cut_of(const Mesh& mesh, Vec3 center, Vec3 normal, const std::vector<bool>& on_limb) {
  constexpr float kReach_m = 0.14f;
  Cut cut{&mesh, {}};
  for (const auto& t : mesh.triangles) {
    std::vector<Cut::Point> points;
    bool near_by = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const float da = glm::dot(mesh.position_m[a] - center, normal);
      const float db = glm::dot(mesh.position_m[b] - center, normal);
      near_by &= glm::distance(mesh.position_m[a], center) < kReach_m;
      for (std::size_t i = 0; i < 4; ++i)
        near_by &= mesh.influence[a].weight[i] < 0.02f || on_limb[mesh.influence[a].joint[i]];
      if ((da < 0) != (db < 0)) points.push_back({a, b, da / (da - db)});
    }
    if (points.size() != 2 || !near_by) continue;
    // All segments run the same way round: the face's normal on their right.
    const auto at = [&](const Cut::Point& p) {
      return glm::mix(mesh.position_m[p.a], mesh.position_m[p.b], p.share);
    };
    const Vec3 face = glm::cross(mesh.position_m[t[1]] - mesh.position_m[t[0]],
                                 mesh.position_m[t[2]] - mesh.position_m[t[0]]);
    if (glm::dot(glm::cross(at(points[1]) - at(points[0]), face), normal) < 0)
      std::swap(points[0], points[1]);
    cut.segments.push_back({points[0], points[1]});
  }
  return cut;
}

// Not a piece cut by a hem or a seam of the limb.
bool closed(const Cut& cut, const test::PosedBody& rest) {
  Vec3 way(0.0f);
  for (const auto& s : cut.segments)
    for (const int end : {0, 1}) {
      const Cut::Point& p = s[static_cast<std::size_t>(end)];
      const Vec3 at = glm::mix(rest.point(*cut.mesh, p.a), rest.point(*cut.mesh, p.b), p.share);
      way += end == 0 ? -at : at;
    }
  return cut.segments.size() >= 8 && glm::length(way) < 0.002f;
}

float area(const Cut& cut, const test::PosedBody& body) {
  const auto at = [&](const Cut::Point& p) {
    return glm::mix(body.point(*cut.mesh, p.a), body.point(*cut.mesh, p.b), p.share);
  };
  Vec3 center(0.0f), sum(0.0f);
  for (const auto& s : cut.segments)
    center += (at(s[0]) + at(s[1])) / (2.0f * static_cast<float>(cut.segments.size()));
  for (const auto& s : cut.segments) sum += glm::cross(at(s[0]) - center, at(s[1]) - center);
  return 0.5f * glm::length(sum);
}

class Girth : public test::EachPerson {
 protected:
  // The worst ratio of posed to rest area over cuts from `from_m` to `to_m` along the bone.
  float least_share(HanimJoint from, HanimJoint to, float begin, float end,
                    const body::BapFrame& baps) {
    const body::Skeleton s = test::skeleton_of(*person_);
    const Vec3 a = s.center(from), d = s.center(to) - a;
    const test::PosedBody rest(*person_, s, {}), posed(*person_, s, baps);
    float least = 1e9f;
    for (float t = begin; t <= end; t += 0.04f)
      for (const Object& o : person_->objects) {
        const Cut cut = cut_of(o.mesh, a + t * d, glm::normalize(d), limb_of(from));
        const float before = area(cut, rest);
        if (!closed(cut, rest) || before < 5e-4f) continue;
        ++cuts_;
        const float share = area(cut, posed) / before;
        if (share < least) worst_ = o.name + " at " + std::to_string(t);
        least = std::min(least, share);
      }
    return least;
  }
  static body::BapFrame turned(HanimJoint joint, Axis axis, float degrees) {
    body::BapFrame f;
    set_turn(f, joint, axis, degrees * 0.0174532925f);
    return f;
  }
  void TearDown() override {
    if (person_ != nullptr) {
      EXPECT_GT(cuts_, 5);
    }
  }
  std::string worst_;
  int cuts_ = 0;

 private:
  // By joint of the character: those of the arm or leg on whose chain `joint` lies.
  std::vector<bool> limb_of(HanimJoint joint) const {
    const bool leg = joint == HanimJoint::l_hip || joint == HanimJoint::l_knee;
    const HanimJoint root = leg ? HanimJoint::l_hip : HanimJoint::l_shoulder;
    std::vector<bool> on(person_->joints.size());
    for (std::size_t j = 0; j < on.size(); ++j) {
      on[j] = person_->joints[j].hanim == body::index_of(root);
      if (person_->joints[j].parent < j) on[j] = on[j] || on[person_->joints[j].parent];
    }
    return on;
  }
};

TEST_P(Girth, ForearmsAndWristsAreNoCandyWrappers) {
  for (const HanimJoint joint : {HanimJoint::l_elbow, HanimJoint::l_wrist})
    for (const float degrees : {-90.0f, 90.0f}) {
      const float least = least_share(HanimJoint::l_elbow, HanimJoint::l_wrist, -0.3f, 1.15f,
                                      turned(joint, Axis::y, degrees));
      EXPECT_GT(least, 0.8f) << worst_ << " turned " << degrees << " at joint "
                             << static_cast<int>(joint);
    }
}

TEST_P(Girth, UpperArmsKeepTheirGirthWhenTheyTwist) {
  for (const float degrees : {-60.0f, 80.0f})
    EXPECT_GT(least_share(HanimJoint::l_shoulder, HanimJoint::l_elbow, 0.25f, 1.0f,
                          turned(HanimJoint::l_shoulder, Axis::y, degrees)),
              0.75f)
        << worst_ << " turned " << degrees;
}

TEST_P(Girth, KneesDoNotCollapse) {
  const auto bent = turned(HanimJoint::l_knee, Axis::x, 120.0f);
  EXPECT_GT(least_share(HanimJoint::l_hip, HanimJoint::l_knee, 0.8f, 1.2f, bent), 0.6f) << worst_;
}

TEST_P(Girth, ElbowsDoNotCollapse) {
  const auto bent = turned(HanimJoint::l_elbow, Axis::x, -120.0f);
  EXPECT_GT(least_share(HanimJoint::l_shoulder, HanimJoint::l_elbow, 0.75f, 1.25f, bent), 0.6f)
      << worst_;
}

CARYATID_FOR_EACH_PERSON(Girth);

}  // namespace
}  // namespace caryatid::bake
