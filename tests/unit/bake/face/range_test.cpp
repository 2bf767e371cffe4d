// The whole coding range of every FAP, and combinations that collide, on both characters' meshes.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/emotion/profiles.h"
#include "core/face/fap_fill.h"
#include "core/face/fap_table.h"
#include "core/face/visemes.h"
#include "tests/unit/bake/face/baked.h"

namespace caryatid::bake {
namespace {

using face::FapFrame;
using fat::kLipColumns;
using fat::kLipCorner;

class Whole : public OnBothFaces {
 protected:
  // Pairs of neighbouring triangles of the skin that shows, flat enough at rest to fold at all.
  struct Hinge {
    std::array<std::uint32_t, 3> a, b;
  };
  std::vector<Hinge> hinges() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> seen;
    std::vector<Hinge> out;
    const fat::Skin& skin = head().skin;
    for (std::size_t t = 0; t < skin.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& tri = skin.triangles[t];
        const auto edge = std::minmax(tri[i], tri[(i + 1) % 3]);
        const auto [found, is_new] = seen.emplace(edge, t);
        if (is_new || !shows(tri) || !shows(skin.triangles[found->second])) continue;
        const Hinge hinge{skin.triangles[found->second], tri};
        if (bend(hinge, skin.position_m) > 0.5f) out.push_back(hinge);
      }
    return out;
  }
  bool shows(const std::array<std::uint32_t, 3>& triangle) const {
    for (const std::uint32_t v : triangle) {
      if (head().normal[v].z < 0.25f) return false;
      for (const fat::Eye& eye : head().eye)
        if (eye.inside[v] || in_crease(eye, v)) return false;
    }
    return true;
  }
  // Between brow and lid, and in the bag beneath it, loose skin does fold in people.
  bool in_crease(const fat::Eye& eye, std::uint32_t v) const {
    const Vec3 d = head().skin.position_m[v] - eye.center_m;
    return std::abs(d.x) < 0.024f && d.y < 0.026f && d.y > -0.018f;
  }
  // Cosine between the normals: 1 flat, -1 folded onto itself.
  static float bend(const Hinge& hinge, const std::vector<Vec3>& p) {
    const auto normal = [&](const std::array<std::uint32_t, 3>& t) {
      const Vec3 n = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
      return n / std::max(glm::length(n), 1e-12f);
    };
    return glm::dot(normal(hinge.a), normal(hinge.b));
  }
  std::size_t folds(const PosedFace& face, const std::vector<Hinge>& of) const {
    return static_cast<std::size_t>(std::count_if(
        of.begin(), of.end(), [&](const Hinge& h) { return bend(h, face.skin_m) < -0.9f; }));
  }
  // Radius of an eyeball's white.
  float white_m(const fat::Eye& eye) const {
    std::vector<float> all;
    for (const Object& object : character().objects)
      if (object.role == pack::ObjectRole::eye && object.name == "eyes")
        for (const Vec3 p : object.mesh.position_m)
          if (const float r = glm::length(p - eye.center_m); r < 0.02f) all.push_back(r);
    std::nth_element(all.begin(), all.begin() + static_cast<long>(all.size() / 2), all.end());
    return all[all.size() / 2];
  }
  // Least height of the upper over the lower rim, and least distance of both from the centre.
  struct Lids {
    float opening_m = 1e9f, radius_m = 1e9f;
  };
  Lids lids(const PosedFace& face, const fat::Eye& eye) const {
    Lids out;
    for (const std::uint32_t v : eye.upper) {
      out.radius_m = std::min(out.radius_m, glm::length(face.skin_m[v] - eye.center_m));
      for (const std::uint32_t w : eye.lower)
        if (std::abs(face.skin_m[v].x - face.skin_m[w].x) < 5e-4f)
          out.opening_m = std::min(out.opening_m, face.skin_m[v].y - face.skin_m[w].y);
    }
    for (const std::uint32_t v : eye.lower)
      out.radius_m = std::min(out.radius_m, glm::length(face.skin_m[v] - eye.center_m));
    return out;
  }
};

TEST_P(Whole, NothingBreaksOverTheCodingRange) {
  const std::vector<Hinge> skin = hinges();
  ASSERT_GT(skin.size(), 3000u);
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    for (const float share : {-1.0f, -0.3f, 0.3f, 1.0f}) {
      FapFrame frame;
      frame.set(fap, share * face::coding_limit(face::fap_info(fap)));
      const PosedFace face = posed(frame);
      for (const Vec3 p : face.skin_m) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << fap;
      EXPECT_EQ(folds(face, skin), 0u) << "FAP " << fap << " at " << frame.get(fap);
    }
}

TEST_P(Whole, NoEmotionOrVisemeFoldsTheSkin) {
  const std::vector<Hinge> skin = hinges();
  for (std::size_t e = 1; e < emotion::kEmotionCount; ++e)
    EXPECT_EQ(folds(posed(emotion::peak_face(static_cast<emotion::Emotion>(e))), skin), 0u) << e;
  for (int v = 1; v < face::kVisemeCount; ++v)
    EXPECT_EQ(folds(posed(face::viseme_frame(v)), skin), 0u) << v;
}

TEST_P(Whole, LidsStayOnTheEyeballAndNeverCrossAtAnyGaze) {
  for (const float pitch : {-40000.0f, -20000.0f, 0.0f, 25000.0f, 50000.0f})
    for (const float upper : {-300.0f, 0.0f, 400.0f, 800.0f, 1024.0f})
      for (const float lower : {-150.0f, 0.0f, 300.0f}) {
        FapFrame frame;
        for (const int side : {0, 1}) {
          frame.set(25 + side, pitch);
          frame.set(19 + side, upper);
          frame.set(21 + side, lower);
        }
        const PosedFace face = posed(frame);
        for (const fat::Eye& eye : head().eye) {
          const Lids found = lids(face, eye);
          EXPECT_GT(found.opening_m, -6e-4f) << upper << " " << lower << " " << pitch;
          EXPECT_GT(found.radius_m, white_m(eye) - 2e-4f) << upper << " " << lower << " " << pitch;
        }
      }
}

// Lips never pass through each other, whatever jaw and lips are told.
TEST_P(Whole, LipsNeverCross) {
  for (const float jaw : {0.0f, 300.0f, 1200.0f})
    for (const float upper : {-400.0f, 0.0f, 150.0f})
      for (const float lower : {-900.0f, 0.0f, 300.0f})
        for (const float corner : {-300.0f, 0.0f, 380.0f}) {
          FapFrame frame;
          frame.set(3, jaw);
          frame.set(4, upper);
          frame.set(5, lower);
          frame.set(12, corner);
          face::fill_from_partners(&frame);
          const PosedFace face = posed(frame);
          for (const float gap : gaps(face))
            EXPECT_GT(gap, -8e-4f) << "jaw " << jaw << " upper " << upper << " lower " << lower
                                   << " corner " << corner;
        }
}

INSTANTIATE_TEST_SUITE_P(Characters, Whole, testing::Values(std::size_t{0}, std::size_t{1}),
                         character_name);

}  // namespace
}  // namespace caryatid::bake
