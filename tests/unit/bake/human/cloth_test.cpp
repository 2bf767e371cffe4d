// Skin stays beneath the clothes that are outside of it at rest (hands: outside of what they hang
// beside), at any pose of the walk and the gestures.
#include <algorithm>
#include <cmath>
#include <vector>

#include "assets/bake/gait/settled_walk.h"
#include "core/body/gesture.h"
#include "core/body/ik.h"
#include "tests/support/built_person.h"

namespace caryatid::bake {
namespace {

constexpr float kLooseness_m = 0.08f;  // Cloth farther out than this does not cover.
constexpr float kDepth_m = 0.03f;      // Skin that sticks out farther is another fold of the cloth.

// Where a ray along the unit `n` meets the triangle, +inf when it does not within (low, high).
float hit(Vec3 p, Vec3 n, const Vec3* t, float low, float high) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], h = glm::cross(n, e2);
  const float det = glm::dot(e1, h);
  if (std::abs(det) < 1e-12f) return INFINITY;
  const Vec3 s = p - t[0];
  const float u = glm::dot(s, h) / det;
  const Vec3 q = glm::cross(s, e1);
  const float v = glm::dot(n, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return INFINITY;
  const float d = glm::dot(e2, q) / det;
  return d > low && d < high ? d : INFINITY;
}

// A vertex of skin under cloth, and the cloth near it.
struct Covered {
  const Mesh* skin;
  std::uint32_t vertex;
  const Mesh* cloth;
  std::vector<std::uint32_t> triangles;
};

std::vector<Covered> covered_skin(const Character& c) {
  constexpr float kNear_m = 0.10f;
  std::vector<Covered> out;
  for (const Object& skin : c.objects)
    for (const Object& cloth : c.objects) {
      if (cloth.role != pack::ObjectRole::clothes || skin.role != pack::ObjectRole::body) continue;
      const Mesh &s = skin.mesh, &m = cloth.mesh;
      for (std::uint32_t v = 0; v < s.position_m.size(); ++v) {
        Covered one{&s, v, &m, {}};
        float outwards = INFINITY;
        for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
          const Vec3 at[3] = {m.position_m[m.triangles[t][0]], m.position_m[m.triangles[t][1]],
                              m.position_m[m.triangles[t][2]]};
          if (glm::distance(at[0], s.position_m[v]) > kNear_m) continue;
          one.triangles.push_back(t);
          outwards = std::min(outwards, hit(s.position_m[v], s.normal[v], at, 0, kLooseness_m));
        }
        if (outwards < kLooseness_m) out.push_back(std::move(one));
      }
    }
  return out;
}

// How far the skin of the vertex is outside of its cloth: cloth lies beneath it and none above.
float protrusion(const Covered& c, const std::vector<Vec3>& skin, Vec3 normal,
                 const std::vector<Vec3>& cloth) {
  float above = INFINITY, beneath = INFINITY;
  for (const std::uint32_t t : c.triangles) {
    const auto& v = c.cloth->triangles[t];
    const Vec3 at[3] = {cloth[v[0]], cloth[v[1]], cloth[v[2]]};
    above = std::min(above, hit(skin[c.vertex], normal, at, 0, kLooseness_m));
    beneath = std::min(beneath, hit(skin[c.vertex], -normal, at, 0, kDepth_m));
  }
  return above == INFINITY && beneath < kDepth_m ? beneath : 0.0f;
}

class Cloth : public test::EachPerson {
 protected:
  void SetUp() override {
    EachPerson::SetUp();
    if (person_ == nullptr) return;
    skeleton_ = test::skeleton_of(*person_);
    covered_ = covered_skin(*person_);
  }

  // Largest protrusion in a pose; remembers the vertex.
  float worst_of(const body::BapFrame& frame) {
    const test::PosedBody posed(*person_, skeleton_, frame);
    std::map<const Mesh*, std::vector<Vec3>> at;
    for (const Object& o : person_->objects)
      if (o.role == pack::ObjectRole::clothes || o.role == pack::ObjectRole::body)
        at[&o.mesh] = posed.points(o.mesh);
    float worst = 0.0f;
    for (const Covered& c : covered_) {
      const Vec3 rest = c.skin->position_m[c.vertex];
      const Influence& influence = c.skin->influence[c.vertex];
      const Vec3 n =
          glm::normalize(posed.moved(rest + 0.01f * c.skin->normal[c.vertex], influence) -
                         posed.moved(rest, influence));
      const float d = protrusion(c, at[c.skin], n, at[c.cloth]);
      if (d > worst) place_ = rest;
      worst = std::max(worst, d);
    }
    return worst;
  }
  void expect_covered(const body::BapFrame& frame, const std::string& pose) {
    constexpr float kSeen_m = 0.001f;
    const float worst = worst_of(frame);
    EXPECT_LE(worst, kSeen_m) << pose << ", skin at rest at " << place_.x << " " << place_.y << " "
                              << place_.z;
  }

  body::Skeleton skeleton_;
  std::vector<Covered> covered_;
  Vec3 place_{0};
};

TEST_P(Cloth, CoversSkinAtRest) {
  EXPECT_GT(covered_.size(), 50u);
  expect_covered({}, "rest");
}

TEST_P(Cloth, AHandPressedIntoTheThighIsSeen) {
  float worst = 0.0f;
  for (float rad = -0.05f; rad > -0.4f; rad -= 0.05f) {
    body::BapFrame frame;
    set_turn(frame, body::HanimJoint::l_shoulder, body::Axis::z, rad);
    worst = std::max(worst, worst_of(frame));
  }
  EXPECT_GT(worst, 0.005f);
}

TEST_P(Cloth, CoversSkinInEveryWalk) {
  for (int m = 0; m < body::kGaitMoodCount; ++m) {
    SettledWalk walk(skeleton_, body::gait_style(body::GaitMood(m)));
    for (int i = 1; i <= 16; ++i)
      expect_covered(
          walk.to_phase(std::fmod(0.5f + static_cast<float>(i) / 16.0f, 1.0f)),
          std::string(body::gait_mood_name(body::GaitMood(m))) + " " + std::to_string(i) + "/16");
  }
}

TEST_P(Cloth, CoversSkinInEveryGesture) {
  for (int k = 1; k <= static_cast<int>(body::GestureKind::beat); ++k)
    for (const bool walking : {false, true}) {
      body::Walker walker(&skeleton_);
      body::GestureLayer layer;
      body::BapFrame body;
      if (walking) walker.walk_to({0, 1e4f});
      for (int i = 0; i < 120; ++i) walker.step(1.0f / 60.0f, body);
      const Vec3 ahead{-1.0f, 1.6f, walker.place().y + 1.2f};
      layer.start({.kind = body::GestureKind(k), .target_m = ahead});
      for (int i = 0; i < 90; ++i) {
        walker.step(1.0f / 60.0f, body);
        layer.step(1.0f / 60.0f);
        if (i % 10 != 0) continue;
        body::BapFrame shown = body;
        layer.apply(skeleton_, shown);
        expect_covered(shown, std::string(body::gesture_name(body::GestureKind(k))) +
                                  (walking ? " walking " : " ") + std::to_string(i));
      }
    }
}

CARYATID_FOR_EACH_PERSON(Cloth);

}  // namespace
}  // namespace caryatid::bake
