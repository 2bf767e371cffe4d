// Lips against the whole surface of teeth and gums, lips and skin against each other, lids against
// the eye: on the deformed finest mesh of both people, as the mixer resolves what frames ask for.
//
// What is tolerated, and why. Lips are soft and about 10 mm thick. What can be seen of a lip, skin
// and red up to the line where closed lips meet, may lie in a tooth by 0.3 mm (a pixel of a
// full-screen face). The wet side behind it, which presses against teeth and is never seen there,
// gives by 2 mm; so do lips that press each other (0.4 mm a side stays at rest). A fold beneath the
// lip or in the corner of the mouth presses skin to skin as people's do. Lids lie on the white (0.2
// mm: the facets of both); of the clear cornea nothing but a highlight is drawn, and a gaze far
// down slides it 0.7 mm into a lid that it would lift by as much.
#include <functional>

#include "core/base/random.h"
#include "core/emotion/profiles.h"
#include "core/face/fap_fill.h"
#include "core/face/fap_table.h"
#include "core/face/visemes.h"
#include "tests/unit/bake/face/baked.h"
#include "tests/unit/bake/face/solids.h"

namespace caryatid::bake {
namespace {

using face::FapFrame;
using fat::kLipColumns;
using fat::kLipCorner;
using solids::Sample;

constexpr float kSeenInTeeth_m = 0.0003f, kWetInTeeth_m = 0.0020f;
constexpr float kSkinInSkin_m = 0.0015f, kWetInWet_m = 0.0023f;
constexpr float kLidInEye_m = 0.0002f, kLidInCornea_m = 0.0008f;

// FAPs that move the mouth, and those that FIT fills the others from.
constexpr int kMouth[] = {3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                          16, 17, 18, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60};
constexpr int kLeading[] = {3, 4, 5, 6, 12, 14, 15, 16, 17, 18};

class Collision : public OnBothFaces {
 protected:
  void SetUp() override {
    OnBothFaces::SetUp();
    if (IsSkipped()) return;
    for (int side = 0; side < fat::kSides; ++side) sample_lips(side);
    ASSERT_GT(seen_.size(), 2000u);
    ASSERT_GT(wet_.size(), 1000u);
    upper_ = std::make_unique<solids::Teeth>(teeth("upper_teeth"));
    lower_ = std::make_unique<solids::Teeth>(teeth("lower_teeth"));
  }

  // Deepest places of one pose, by what they may touch.
  struct Depths {
    float seen_in_teeth = 0, wet_in_teeth = 0, skin_in_skin = 0, wet_in_wet = 0;
  };
  Depths depths(const PosedFace& face) const {
    Depths out;
    const solids::Flesh flesh(face.skin_m, head().skin.triangles);
    const auto measure = [&](const std::vector<Sample>& samples, float* teeth, float* skin) {
      for (const Sample& s : samples) {
        const Vec3 p = s.at(face.skin_m);
        *teeth = std::max({*teeth, upper_->depth_m(p), lower_->depth_m(in_jaw(face, p))});
        *skin = std::max(*skin, flesh.depth_m(p, s.normal(face.skin_m)));
      }
    };
    measure(seen_, &out.seen_in_teeth, &out.skin_in_skin);
    measure(wet_, &out.wet_in_teeth, &out.wet_in_wet);
    return out;
  }
  void expect_clear(const FapFrame& frame, const std::string& what) const {
    const Depths d = depths(posed(frame));
    EXPECT_LT(d.seen_in_teeth, kSeenInTeeth_m) << what;
    EXPECT_LT(d.wet_in_teeth, kWetInTeeth_m) << what;
    EXPECT_LT(d.skin_in_skin, kSkinInSkin_m) << what;
    EXPECT_LT(d.wet_in_wet, kWetInWet_m) << what;
  }

  float end(int fap, bool high) const {
    const auto i = static_cast<std::size_t>(fap);
    return high ? ranges().high[i] : ranges().low[i];
  }

 private:
  // The lips' grid but its last ring, where the lining is grown to the gum.
  void sample_lips(int side) {
    const fat::Lips& lips = head().lips[static_cast<std::size_t>(side)];
    struct Place {
      std::size_t row, column;
    };
    std::map<std::uint32_t, Place> place;
    for (std::size_t r = 0; r + 1 < lips.row.size(); ++r)
      for (std::size_t c = 0; c < kLipColumns; ++c) place[lips.row[r][c]] = {r, c};
    for (const solids::Triangle& t : head().skin.triangles) {
      if (!std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return place.contains(v); }))
        continue;
      bool wet = false;
      for (const std::uint32_t v : t) {
        const Place at = place[v];
        wet |= at.row > (at.column <= kLipCorner ? lips.upper_inner : lips.lower_inner);
      }
      constexpr float kSpacing_m = 0.0015f;
      add_samples(t, head().skin.position_m, kSpacing_m, wet ? &wet_ : &seen_);
    }
  }
  solids::Teeth teeth(const std::string& name) const {
    for (const Object& object : character().objects)
      if (object.name == name) return {object.mesh.position_m, object.mesh.triangles};
    throw std::runtime_error("no " + name);
  }
  // Where a point lies before the jaw has turned: the lower teeth stay there.
  Vec3 in_jaw(const PosedFace& face, Vec3 p) const {
    const auto jaw = face::evaluate_transforms(head().transforms, face.mixed());
    const Vec3 center = head().transforms.jaw_center_m;
    return center + glm::inverse(jaw.jaw) * (p - jaw.jaw_shift_m - center);
  }

  std::vector<Sample> seen_, wet_;
  std::unique_ptr<solids::Teeth> upper_, lower_;
};

TEST_P(Collision, TheMeasureSeesTeethThatComeThrough) {
  PosedFace face = posed({});
  for (Vec3& p : face.skin_m) p.z -= 0.008f;
  EXPECT_GT(depths(face).seen_in_teeth, 0.001f);
  PosedFace shut = posed({});
  for (const fat::Lips& lips : head().lips)
    for (std::size_t r = 0; r <= lips.lower_inner; ++r)
      for (std::size_t c = kLipCorner + 2; c < kLipColumns; ++c)
        shut.skin_m[lips.row[r][c]].y += 0.004f;
  EXPECT_GT(depths(shut).skin_in_skin, kSkinInSkin_m);
}

TEST_P(Collision, EveryFapAtBothEndsOfItsWorkingRange) {
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    for (const bool high : {false, true}) {
      FapFrame frame;
      frame.set(fap, end(fap, high));
      expect_clear(frame, "FAP " + std::to_string(fap) + " " + std::to_string(end(fap, high)));
    }
}

// Every pair of mouth FAPs, each time with another one of the four combinations of their ends.
TEST_P(Collision, PairsOfMouthFaps) {
  for (std::size_t i = 0; i < std::size(kMouth); ++i)
    for (std::size_t j = i + 1; j < std::size(kMouth); ++j) {
      const int a = kMouth[i], b = kMouth[j];
      const std::size_t combination = (i * 7 + j * 3) % 4;
      FapFrame frame;
      frame.set(a, end(a, combination % 2 == 1));
      frame.set(b, end(b, combination / 2 == 1));
      expect_clear(frame, "FAPs " + std::to_string(a) + " " + std::to_string(frame.get(a)) + ", " +
                              std::to_string(b) + " " + std::to_string(frame.get(b)));
    }
}

TEST_P(Collision, RandomMouths) {
  Random random(6);
  const auto chance = [&] { return static_cast<float>(random.next() % 1000) / 1000.0f; };
  for (int n = 0; n < 120; ++n) {
    FapFrame frame;
    std::string what = "frame " + std::to_string(n) + ":";
    const auto set = [&](int fap, float value) {
      frame.set(fap, value);
      what += " " + std::to_string(fap) + "=" + std::to_string(static_cast<int>(value));
    };
    if (n % 2 == 0) {
      for (const int fap : kMouth) set(fap, glm::mix(end(fap, false), end(fap, true), chance()));
    } else {
      for (const int fap : kLeading)
        if (chance() < 0.6f) set(fap, end(fap, chance() < 0.5f));
      face::fill_from_partners(&frame);
    }
    expect_clear(frame, what);
  }
}

TEST_P(Collision, VisemesAndExpressions) {
  for (int v = 0; v < face::kVisemeCount; ++v) {
    const FapFrame spoken = face::viseme_frame(v);
    expect_clear(spoken, "viseme " + std::to_string(v));
    const FapFrame other = face::blend_visemes(
        {static_cast<std::uint8_t>(v), static_cast<std::uint8_t>((v + 5) % 15), 30, false});
    expect_clear(other, "viseme " + std::to_string(v) + " half another");
  }
  for (std::size_t e = 1; e < emotion::kEmotionCount; ++e)
    expect_clear(emotion::peak_face(static_cast<emotion::Emotion>(e)),
                 "emotion " + std::to_string(e));
}

// --- Lids and eyes ---

// An eyeball (white and iris, or its clear cornea) as radii around its centre; it turns with the
// gaze.
class Eyeball {
 public:
  Eyeball(const Character& character, Vec3 center, bool cornea) : center_(center) {
    for (const Object& object : character.objects) {
      const bool clear = (character.materials[object.material].flags & pack::kCornea) != 0;
      if (object.role != pack::ObjectRole::eye || clear != cornea) continue;
      for (const solids::Triangle& t : object.mesh.triangles) {
        std::array<Vec3, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) corner[i] = object.mesh.position_m[t[i]] - center;
        constexpr float kBall_m = 0.02f;
        if (glm::length(corner[0]) < kBall_m) triangles_.push_back(corner);
      }
    }
  }
  float depth_m(Vec3 p, const Quat& gaze) const {
    const Vec3 d = glm::inverse(gaze) * (p - center_);
    const float r = glm::length(d);
    float outer = 0.0f;
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 n = glm::cross(b - a, c - a);
      const float along = glm::dot(n, d);
      if (std::abs(along) < 1e-15f) continue;
      const float t = glm::dot(n, a) / along;
      const Vec3 q = t * d;
      const bool inside = t > 0.0f && glm::dot(glm::cross(b - a, q - a), n) >= 0.0f &&
                          glm::dot(glm::cross(c - b, q - b), n) >= 0.0f &&
                          glm::dot(glm::cross(a - c, q - c), n) >= 0.0f;
      if (inside) outer = std::max(outer, t * r);
    }
    return std::max(outer - r, 0.0f);
  }

 private:
  Vec3 center_;
  std::vector<std::array<Vec3, 3>> triangles_;
};

TEST_P(Collision, LidsAtAnyGaze) {
  for (int side = 0; side < fat::kSides; ++side) {
    const fat::Eye& eye = head().eye[static_cast<std::size_t>(side)];
    const Eyeball ball(character(), eye.center_m, false), cornea(character(), eye.center_m, true);
    // The rim and what shows of the lids above and beneath it.
    std::vector<Sample> lids;
    const auto away = fat::distance_m(head().skin, eye.rim, 0.008f);
    for (const solids::Triangle& t : head().skin.triangles)
      if (std::all_of(t.begin(), t.end(),
                      [&](std::uint32_t v) { return std::isfinite(away[v]) && !eye.inside[v]; }))
        add_samples(t, head().skin.position_m, 0.0015f, &lids);
    ASSERT_GT(lids.size(), 300u);
    for (const float yaw : {-61000.0f, -25000.0f, 0.0f, 61000.0f})
      for (const float pitch : {-44000.0f, -20000.0f, 0.0f, 52000.0f})
        for (const float shut : {-330.0f, 0.0f, 400.0f, 800.0f, 1024.0f}) {
          FapFrame frame;
          frame.set(23 + side, yaw);
          frame.set(25 + side, pitch);
          frame.set(19 + side, shut);
          const PosedFace face = posed(frame);
          const auto turned = face::evaluate_transforms(head().transforms, face.mixed());
          const Quat gaze = side == 0 ? turned.left_eye : turned.right_eye;
          float in_ball = 0.0f, in_cornea = 0.0f;
          for (const Sample& s : lids) {
            const Vec3 p = s.at(face.skin_m);
            in_ball = std::max(in_ball, ball.depth_m(p, gaze));
            in_cornea = std::max(in_cornea, cornea.depth_m(p, gaze));
          }
          EXPECT_LT(in_ball, kLidInEye_m) << "yaw " << yaw << " pitch " << pitch << " lid " << shut;
          EXPECT_LT(in_cornea, kLidInCornea_m)
              << "yaw " << yaw << " pitch " << pitch << " lid " << shut;
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Characters, Collision, testing::Values(std::size_t{0}, std::size_t{1}),
                         character_name);

}  // namespace
}  // namespace caryatid::bake
