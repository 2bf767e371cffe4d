// The figures of every walk on both people, from the skinned vertices of their soles; and that no
// stream of body parameters tears a mesh.
#include <cmath>
#include <cstdio>
#include <limits>

#include "assets/bake/gait/analyse.h"
#include "assets/bake/gait/measure.h"
#include "assets/bake/gait/settled_walk.h"
#include "core/base/random.h"
#include "tests/support/built_person.h"

namespace caryatid::bake {
namespace {

constexpr float kFps = 30.0f;

std::vector<SolePoint> soles_of(const Character& c) {
  constexpr float kSole_m = 0.035f;
  std::vector<SolePoint> out;
  for (const Object& o : c.objects)
    for (std::size_t v = 0; v < o.mesh.position_m.size(); ++v) {
      const Vec3 rest = o.mesh.position_m[v];
      if (rest.y > kSole_m) continue;
      SolePoint p{rest, rest.x > 0.0f, {}};
      for (std::size_t k = 0; k < 4; ++k)
        if (o.mesh.influence[v].weight[k] > 0)
          p.shares.push_back(
              {static_cast<body::HanimJoint>(c.joints[o.mesh.influence[v].joint[k]].hanim),
               o.mesh.influence[v].weight[k]});
      out.push_back(std::move(p));
    }
  return out;
}

class WalkFigures : public test::EachPerson {};

TEST_P(WalkFigures, OfEveryMood) {
  const body::Skeleton s = test::skeleton_of(*person_);
  const auto soles = soles_of(*person_);
  ASSERT_GT(soles.size(), 200u);
  for (int mood = 0; mood < body::kGaitMoodCount; ++mood) {
    const char* name = body::gait_mood_name(body::GaitMood(mood));
    SettledWalk walk(s, body::gait_style(body::GaitMood(mood)));
    const WalkMeasures m = measure_walk(s, walk.record(300, kFps), kFps, soles);
    std::printf(
        "%s, %s: slide %.2f mm a frame, below floor %.2f mm, clearance %.1f mm, pelvis %.1f mm, "
        "%d to %d maxima a step\n",
        GetParam(), name, 1e3 * double(m.slide_m), 1e3 * double(m.below_floor_m),
        1e3 * double(m.clearance_m), 1e3 * double(m.pelvis_travel_m), m.fewest_maxima,
        m.most_maxima);
    EXPECT_LE(m.slide_m, 0.001f) << name;
    EXPECT_LE(m.below_floor_m, 0.001f) << name;
    EXPECT_GE(m.clearance_m, 0.005f) << name;
    EXPECT_GE(m.pelvis_travel_m, 0.005f) << name;
    EXPECT_LE(m.pelvis_travel_m, 0.07f) << name;
    EXPECT_EQ(m.fewest_maxima, 1) << name;
    EXPECT_EQ(m.most_maxima, 1) << name;
  }
}

// Joint centres of the body that carries the skin, not the curves that were asked for.
TEST_P(WalkFigures, NormalWalkLiesWithinTheNorm) {
  const body::Skeleton s = test::skeleton_of(*person_);
  SettledWalk walk(s, body::gait_style(body::GaitMood::normal));
  CycleCurves curves;
  for (std::size_t i = 0; i < 51; ++i) {
    const LegAngles a = leg_angles(
        s, walk.to_phase(std::fmod(0.502f + 0.02f * static_cast<float>(i), 1.0f)), false);
    curves.thigh[i] = a.thigh;
    curves.knee[i] = a.knee;
    curves.ankle[i] = a.ankle;
    curves.list[i] = a.list;
    curves.rotation[i] = a.rotation;
  }
  const NormativeFit fit = fit_to_norm(curves);
  std::printf("%s: within 2 SD over hip %.0f, knee %.0f, ankle %.0f, list %.0f, rotation %.0f %%\n",
              GetParam(), 100 * double(fit.hip), 100 * double(fit.knee), 100 * double(fit.ankle),
              100 * double(fit.list), 100 * double(fit.rotation));
  for (const float share : {fit.hip, fit.knee, fit.ankle, fit.list, fit.rotation})
    EXPECT_GE(share, 0.9f);
}

TEST_P(WalkFigures, NoValuesOfBodyParametersTearAMesh) {
  const body::Skeleton s = test::skeleton_of(*person_);
  Random random(11);
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const float hostile[] = {kInfinite, -kInfinite, std::nanf(""), 1e30f, -1e30f, 3e38f, 1e-40f};
  for (int round = 0; round < 40; ++round) {
    body::BapFrame frame;
    for (int bap = 1; bap <= body::kBapCount; ++bap)
      frame.set(bap, random.unit() < 0.3f ? hostile[static_cast<std::size_t>(random.unit() * 6.99f)]
                                          : random.between(-4e5f, 4e5f));
    const test::PosedBody posed(*person_, s, frame);
    body::BapFrame root;
    for (int bap = body::kFirstTranslationBap; bap < body::kFirstRootTurnBap; ++bap)
      root.set(bap, frame.get(bap));
    const test::PosedBody placed(*person_, s, root);
    const Influence hips{{0}, {1.0f, 0, 0, 0}};
    const Vec3 center = placed.moved(s.center(body::HanimJoint::humanoid_root), hips);
    for (const Object& o : person_->objects)
      for (std::size_t v = 0; v < o.mesh.position_m.size(); v += 7)
        // No point is farther from the hips than the body is long.
        ASSERT_LT(glm::distance(posed.point(o.mesh, v), center), 2.5f) << o.name << " " << round;
  }
}

CARYATID_FOR_EACH_PERSON(WalkFigures);

}  // namespace
}  // namespace caryatid::bake
