// What a user may get wrong, and what a hostile file may hold: one clear line each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "assets/bake/head/foreign_head.h"
#include "assets/bake/mesh_io/mesh_io.h"
#include "core/base/random.h"

namespace caryatid::bake::foreign {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kHeads = CARYATID_SOURCE_DIR "/tests/data/heads/";

const Surface& mesh() {
  static const Surface surface = read_mesh(kHeads + "coarse_head.obj");
  return surface;
}
const std::string& good_points() {
  static const std::string text = read_file(kHeads + "coarse_head.points");
  return text;
}

std::string refusal(const std::string& points_text) {
  try {
    (void)place_head(mesh(), parse_points(points_text, "F"));
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

// The good list with the line of one point replaced; an empty line takes the point out.
std::string with(const std::string& id, const std::string& line) {
  std::string text = "\n" + good_points();
  const std::size_t at = text.find("\n" + id + " ") + 1;
  text.replace(at, text.find('\n', at) - at, line);
  return text.substr(1);
}

TEST(PointsFile, EachFaultHasItsLine) {
  EXPECT_THAT(refusal(""), HasSubstr("F: there is no point in it"));
  EXPECT_THAT(refusal("# only\nhello\n"), StartsWith("F:2: \"hello\" is no feature point"));
  EXPECT_THAT(refusal("2.99 5\n"), HasSubstr("F:1: the standard has no feature point 2.99"));
  EXPECT_THAT(refusal("2.1\n"), HasSubstr("needs a vertex or x y z"));
  EXPECT_THAT(refusal("2.1 0\n"), HasSubstr("vertices count from 1"));
  EXPECT_THAT(refusal("count 2\n"), HasSubstr("write `count 0` or `count 1`"));
  EXPECT_THAT(refusal("2.1 1 2\n"), HasSubstr("needs one vertex, or x y z"));
  EXPECT_THAT(refusal("2.1 1 2 nan\n"), HasSubstr("\"nan\" is not a finite number"));
  EXPECT_THAT(refusal("2.1 1 2 3 4\n"), HasSubstr("more on the line"));
  EXPECT_THAT(refusal("2.1 7\n\n2.1 8\n"),
              StartsWith("F:3: point 2.1 is there already, on line 1"));
  EXPECT_THAT(refusal(std::string("\x01\x02\xff 3\n")), HasSubstr("\"???\" is no feature point"));
}

TEST(PointsFile, MissingPointsAreAllNamed) {
  EXPECT_THAT(refusal(with("3.1", "").substr(0)), HasSubstr("no face moves: 3.1;"));
  EXPECT_THAT(refusal("2.1 5\n"), HasSubstr("2.2 2.3 2.4 2.5 3.1 3.2"));
}

TEST(PointsFile, PointsThatCanNotBe) {
  EXPECT_THAT(refusal(with("9.3", "9.3 999999")), HasSubstr("there is no vertex 999999"));
  EXPECT_THAT(refusal(with("8.1", "8.1 1e300 0 0")), HasSubstr("lies far from the eyes"));
  const std::string eye = with("2.1", "2.1 " + std::to_string(mesh().position.size()));
  EXPECT_THAT(refusal(eye), HasSubstr("not the face's skin"));
}

TEST(PointsFile, ExchangedSidesAreSeen) {
  std::string text;
  for (const GivenPoint& p : parse_points(good_points(), "F").points) {
    // Odd and even numbers of paired groups exchanged.
    PointId id = p.id;
    if (id.first == 3)
      id.second += id.second % 2 == 1 ? (id.second > 6 ? 0 : 1) : (id.second > 6 ? 0 : -1);
    if (id == PointId{3, 7})
      id = {3, 12};
    else if (id == PointId{3, 12})
      id = {3, 7};
    else if (id == PointId{3, 11})
      id = {3, 8};
    else if (id == PointId{3, 8})
      id = {3, 11};
    text += name_of(id) + " " + std::to_string(*p.vertex + 1) + "\n";
  }
  EXPECT_THAT(refusal(text), HasSubstr("left and right are exchanged"));
}

TEST(Licences, AreReadFromComments) {
  const auto silent = licences_of("v 0 0 0\n", "a.obj");
  EXPECT_THAT(silent.front().licence, HasSubstr("not stated"));
  const auto said = licences_of("# Head by N.N.\n# License: CC-BY 4.0\nv 0 0 0\n", "a.obj");
  EXPECT_EQ(said.front().licence, "License: CC-BY 4.0");
}

// Any points on the mesh: a head without a number that is none, or one line.
TEST(ForeignHead, ScrambledPointsNeverBreakTheBake) {
  const auto ranges =
      fat::read_working_ranges(CARYATID_SOURCE_DIR "/assets/characters/fap_working_ranges.csv");
  Random random(7);
  int built = 0;
  for (int round = 0; round < 24; ++round) {
    PointList points = parse_points(good_points(), "F");
    for (int k = 0; k <= round; ++k) {
      GivenPoint& p = points.points[random.next() % points.points.size()];
      p.vertex = random.next() % static_cast<std::uint32_t>(mesh().position.size());
    }
    try {
      const ForeignHead head = build_foreign_head(mesh(), points, "scrambled", ranges);
      for (const Object& object : head.character.objects) {
        for (const Vec3& p : object.mesh.position_m) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
        for (const auto& moves : object.moves)
          for (const Move& m : moves)
            ASSERT_TRUE(std::isfinite(glm::length(m.displacement_m) + glm::length(m.normal_change)))
                << object.name << " round " << round;
      }
      ++built;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(built, 0);
}

}  // namespace
}  // namespace caryatid::bake::foreign
