// The five kinds of measurement on shapes whose answers are known, and on our own people.
#include "assets/bake/anthropometry/measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "assets/bake/anthropometry/surface_distance.h"
#include "assets/bake/head/foreign_head.h"
#include "assets/bake/human/build.h"
#include "assets/bake/mesh_io/mesh_io.h"

namespace caryatid::bake::anthropometry {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A sphere of rows of longitude and latitude, poles on the Y axis: vertex 0 the north pole, the
// last the south pole.
struct Ball {
  std::vector<Vec3> position;
  Triangles triangles;

  Ball(float radius, std::uint32_t columns, std::uint32_t rows) {
    position.push_back({0, radius, 0});
    for (std::uint32_t r = 1; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const float down = kPi * static_cast<float>(r) / static_cast<float>(rows);
        const float turn = 2 * kPi * static_cast<float>(c) / static_cast<float>(columns);
        position.push_back(radius * Vec3(std::sin(down) * std::cos(turn), std::cos(down),
                                         std::sin(down) * std::sin(turn)));
      }
    position.push_back({0, -radius, 0});
    const auto at = [&](std::uint32_t r, std::uint32_t c) {
      return 1 + (r - 1) * columns + c % columns;
    };
    for (std::uint32_t c = 0; c < columns; ++c) {
      triangles.push_back({0, at(1, c + 1), at(1, c)});
      for (std::uint32_t r = 1; r + 1 < rows; ++r) {
        triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c)});
        triangles.push_back({at(r + 1, c), at(r, c + 1), at(r + 1, c + 1)});
      }
      triangles.push_back(
          {at(rows - 1, c), at(rows - 1, c + 1), static_cast<std::uint32_t>(position.size() - 1)});
    }
  }
};

TEST(SkinTape, FollowsGreatCirclesOfASphere) {
  const Ball ball(0.1f, 48, 24);
  const SkinTape tape(ball.position, ball.triangles);
  const auto south = static_cast<std::uint32_t>(ball.position.size() - 1);
  EXPECT_NEAR(tape.distance_m(0, south), 0.1f * kPi, 0.01f * 0.1f * kPi);
  // Two places across the rows: 60 degrees of latitude and 90 of longitude apart.
  const std::uint32_t a = 1 + 7 * 48, b = 1 + 15 * 48 + 12;
  const float angle = std::acos(glm::dot(ball.position[a], ball.position[b]) / 0.01f);
  EXPECT_NEAR(tape.distance_m(a, b), 0.1f * angle, 0.01f * 0.1f * angle);
}

TEST(SkinTape, IsStraightAcrossAFlatMeshWhateverItsEdges) {
  std::vector<Vec3> position;
  Triangles triangles;
  constexpr std::uint32_t kSide = 11;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i)
    position.push_back({static_cast<float>(i % kSide), static_cast<float>(i / kSide), 0});
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t v = y * kSide + x;
      triangles.push_back({v, v + 1, v + kSide});
      triangles.push_back({v + 1, v + kSide + 1, v + kSide});
    }
  const SkinTape tape(position, triangles);
  EXPECT_NEAR(tape.distance_m(0, kSide * kSide - 1), 10 * std::sqrt(2.0f), 0.1f);
  EXPECT_NEAR(tape.distance_m(3, kSide * kSide - 1), std::hypot(7.0f, 10.0f), 0.1f);
}

TEST(SkinTape, ThereIsNoWayBetweenParts) {
  const std::vector<Vec3> position{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                   {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const Triangles triangles{{0, 1, 2}, {3, 4, 5}};
  const SkinTape tape(position, triangles);
  EXPECT_TRUE(std::isinf(tape.distance_m(0, 3)));
}

TEST(Inclination, CountsFromTheVerticalForwardPositive) {
  EXPECT_NEAR(inclination_degrees({0, 0, 0}, {0.3f, 1, 0}), 0.0f, 1e-4f);
  EXPECT_NEAR(inclination_degrees({0, 0, 0}, {0, 1, 1}), 45.0f, 1e-4f);
  EXPECT_NEAR(inclination_degrees({0, 0, 0}, {0, 1, -1}), -45.0f, 1e-4f);
}

TEST(Angle, LiesAtTheMiddleLandmark) {
  EXPECT_NEAR(angle_degrees({1, 0, 0}, {0, 0, 0}, {0, 2, 0}), 90.0f, 1e-4f);
  EXPECT_NEAR(angle_degrees({1, 0, 0}, {0, 0, 0}, {-3, 0, 0}), 180.0f, 1e-3f);
}

TEST(Frankfurt, EarAndOrbitLieLevelInIt) {
  MeasuredHead head;
  head.to_frankfurt_rad = std::atan2(0.02f, 0.08f);  // Orbit 20 mm above the ear, 80 mm before it.
  const Vec3 ear = head.in_frankfurt({0, 1.5f, 0}), orbit = head.in_frankfurt({0, 1.52f, 0.08f});
  EXPECT_NEAR(ear.y, orbit.y, 1e-6f);
  EXPECT_NEAR(orbit.z - ear.z, std::hypot(0.02f, 0.08f), 1e-6f);
}

float value_of(const std::vector<Measurement>& all, const std::string& name) {
  for (const Measurement& m : all)
    if (m.name == name) return m.value;
  ADD_FAILURE() << "not measured: " << name;
  return 0;
}

// A human head has human measures: within four deviations of the norm of its sex.
void expect_human(const Character& person, bool woman) {
  const MeasuredHead head = find_landmarks(person);
  EXPECT_LT(std::abs(head.to_frankfurt_rad), 0.35f);
  for (const Measurement& m : measure(head)) {
    const std::optional<Norm>& norm = woman ? m.women : m.men;
    if (!norm || norm->deviation == 0) continue;
    EXPECT_NEAR(m.value, norm->mean, 4.0f * norm->deviation) << person.name << ": " << m.name;
  }
}

TEST(Measures, OurPeopleAreHuman) {
  if (const auto missing = BaseHuman::missing(BaseHuman::default_folder()))
    GTEST_SKIP() << *missing;
  const std::string folder = CARYATID_SOURCE_DIR "/assets/characters/";
  const BaseHuman base(BaseHuman::default_folder());
  const auto places = read_feature_points(folder + "feature_points.toml", base);
  for (const bool woman : {true, false})
    expect_human(
        build_character(read_recipe(folder + (woman ? "woman.toml" : "man.toml")), base, places),
        woman);
}

class CoarseHead : public testing::Test {
 protected:
  static Character character() {
    const std::string stem = CARYATID_SOURCE_DIR "/tests/data/heads/coarse_head";
    const std::string points = stem + ".points";
    return foreign::build_foreign_head(
               read_mesh(stem + ".obj"), foreign::parse_points(read_file(points), points), "coarse",
               fat::read_working_ranges(CARYATID_SOURCE_DIR
                                        "/assets/characters/fap_working_ranges.csv"))
        .character;
  }
};

TEST_F(CoarseHead, AllFiveKindsAreMeasured) {
  const std::vector<Measurement> all = measure(find_landmarks(character()));
  EXPECT_NEAR(value_of(all, "pupils p-p"), 62.9f, 1.5f);
  for (const Kind kind :
       {Kind::straight, Kind::axial, Kind::tangential, Kind::inclination, Kind::angle})
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Measurement& m) {
      return m.kind == kind;
    })) << name_of(kind);
  // A tape is never shorter than the straight line.
  const MeasuredHead head = find_landmarks(character());
  const float straight =
      glm::length(head.landmarks.at("t l").place_m - head.landmarks.at("gn").place_m) +
      glm::length(head.landmarks.at("t r").place_m - head.landmarks.at("gn").place_m);
  EXPECT_GT(value_of(all, "bitragion-chin arc t-gn-t"), 1000.0f * straight * 0.97f);
}

TEST_F(CoarseHead, TheReportNamesValueAndNorms) {
  const MeasuredHead head = find_landmarks(character());
  const std::vector<Measurement> all = measure(head);
  EXPECT_THAT(as_table(all), testing::HasSubstr("139.1 +- 5.3"));
  const auto json = nlohmann::json::parse(as_json(head, all));
  EXPECT_EQ(json["measurements"].size(), all.size());
  EXPECT_EQ(json["landmarks"]["prn"]["source"], "9.3");
}

}  // namespace
}  // namespace caryatid::bake::anthropometry
