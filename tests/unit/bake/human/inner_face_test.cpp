// Eyes and tongue of the neutral face: measured, settled, refused. Skipped without the base human.
#include "assets/bake/human/inner_face.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "assets/bake/human/build.h"
#include "assets/bake/human/neutral.h"

namespace caryatid::bake {
namespace {

const std::string kCharacters = CARYATID_SOURCE_DIR "/assets/characters/";

class InnerFace : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (const auto missing = BaseHuman::missing(BaseHuman::default_folder()))
      GTEST_SKIP() << *missing;
    const BaseHuman base(BaseHuman::default_folder());
    const auto places = read_feature_points(kCharacters + "feature_points.toml", base);
    person = build_character(read_recipe(kCharacters + GetParam()), base, places);
  }
  Mesh& mesh(const char* name) {
    for (Object& object : person.objects)
      if (object.name == name) return object.mesh;
    throw std::runtime_error(name);
  }
  std::string refusal() const {
    try {
      check_inner_face(person);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  Character person;
};

TEST_P(InnerFace, PupilIsAThirdOfTheIrisAndLooksAhead) {
  for (const int side : {0, 1}) {
    const IrisMeasure eye = measure_iris(person, side);
    EXPECT_NEAR(eye.pupil_diameter_m / eye.iris_diameter_m, 1.0f / 3.0f, 0.05f);
    EXPECT_NEAR(eye.iris_diameter_m, 0.013f, 0.0015f);
    EXPECT_LT(std::hypot(eye.pupil_m.x, eye.pupil_m.y), 0.0003f);
  }
}

TEST_P(InnerFace, TongueTouchesWhereTheTeethMeet) {
  const TongueMeasure tongue = measure_tongue(person);
  EXPECT_LT(tongue.tip_to_teeth_m, 0.0006f);
  EXPECT_NEAR(tongue.above_bite_m, 0.0f, 0.001f);
  EXPECT_EQ(refusal(), "");
}

TEST_P(InnerFace, AWidePupilIsRefused) {
  for (Object& object : person.objects)  // A narrower picture of the iris: all uv nearer to it.
    if (object.name == "eyes")
      for (Vec2& uv : object.mesh.uv) {
        const Vec2 middle = uv.x > uv.y ? Vec2(0.703f, 0.297f) : Vec2(0.290f, 0.706f);
        const float r = glm::distance(uv, middle);
        uv = middle + (uv - middle) * (r < 0.06f ? 0.5f : 1.0f);
      }
  EXPECT_THAT(refusal(), testing::HasSubstr("left pupil over iris"));
}

TEST_P(InnerFace, ASquintIsRefused) {
  for (Object& object : person.objects)
    if (object.role == pack::ObjectRole::eye)
      for (Vec3& p : object.mesh.position_m) p.x += p.x > 0 ? 0.001f : 0.0f;
  EXPECT_THAT(refusal(), testing::HasSubstr("left gaze off +Z"));
}

TEST_P(InnerFace, ATongueThatHangsBackIsRefused) {
  for (Vec3& p : mesh("tongue").position_m) p -= Vec3(0, 0, 0.003f);
  EXPECT_THAT(refusal(), testing::HasSubstr("tip of the tongue from the teeth"));
}

INSTANTIATE_TEST_SUITE_P(People, InnerFace, testing::Values("woman.toml", "man.toml"));

}  // namespace
}  // namespace caryatid::bake
