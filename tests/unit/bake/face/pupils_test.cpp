// Pupils grow and shrink by FAPs 29 and 30, as measured on the drawn eye.
#include "assets/bake/face/pupils.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/bake/face/fat.h"
#include "assets/bake/head/foreign_head.h"
#include "assets/bake/human/build.h"
#include "assets/bake/human/inner_face.h"
#include "assets/bake/mesh_io/mesh_io.h"
#include "core/face/fat.h"

namespace caryatid::bake {
namespace {

const std::string kCharacters = CARYATID_SOURCE_DIR "/assets/characters/";

// A head of our own that needs no base human, and where that is there, our people.
std::vector<Character> made() {
  const auto ranges = fat::read_working_ranges(kCharacters + "fap_working_ranges.csv");
  const std::string stem = CARYATID_SOURCE_DIR "/tests/data/heads/coarse_head";
  const std::string points = stem + ".points";
  std::vector<Character> out;
  out.push_back(foreign::build_foreign_head(read_mesh(stem + ".obj"),
                                            foreign::parse_points(read_file(points), points),
                                            "coarse", ranges)
                    .character);
  if (BaseHuman::missing(BaseHuman::default_folder())) return out;
  const BaseHuman base(BaseHuman::default_folder());
  const auto places = read_feature_points(kCharacters + "feature_points.toml", base);
  for (const char* name : {"woman.toml", "man.toml"}) {
    out.push_back(build_character(read_recipe(kCharacters + name), base, places));
    build_fat(out.back(), base, ranges);
  }
  return out;
}
const std::vector<Character>& heads() {
  static const std::vector<Character> all = made();
  return all;
}

Character with_fap(const Character& head, int fap, float value) {
  Character out = head;
  face::FapFrame frame;
  frame.set(fap, value);
  std::vector<float> weight(out.channels.size());
  EXPECT_TRUE(face::evaluate_channels(out.channels, frame, weight).ok());
  for (Object& object : out.objects)
    for (std::size_t c = 0; c < weight.size(); ++c)
      for (const Move& m : object.moves[c])
        object.mesh.position_m[m.vertex] += weight[c] * m.displacement_m;
  return out;
}

TEST(Pupils, GrowByTheFapInUnitsOfTheIris) {
  for (const Character& head : heads())
    for (const int side : {0, 1})
      for (const float value : {-120.0f, 100.0f, 250.0f}) {
        const IrisMeasure before = measure_iris(head, side);
        const IrisMeasure after = measure_iris(with_fap(head, 29 + side, value), side);
        const float wanted_m = value * head.facts.iris_diameter_m / 1024.0f;
        // Between the vertices of the iris the pupil's edge follows chords.
        EXPECT_NEAR(after.pupil_diameter_m - before.pupil_diameter_m, wanted_m,
                    0.15f * std::abs(wanted_m) + 1e-4f)
            << head.name << ": FAP " << 29 + side << " = " << value;
        EXPECT_NEAR(after.iris_diameter_m, before.iris_diameter_m, 5e-4f) << head.name;
      }
}

TEST(Pupils, EachEyeIsItsOwn) {
  for (const Character& head : heads())
    EXPECT_EQ(measure_iris(with_fap(head, 29, 250.0f), 1).pupil_diameter_m,
              measure_iris(head, 1).pupil_diameter_m);
}

}  // namespace
}  // namespace caryatid::bake
