// The surface tools on small meshes of our own.
#include "assets/bake/face/skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "assets/bake/face/movement.h"
#include "assets/bake/face/smooth.h"
#include "assets/bake/face/working_ranges.h"

namespace caryatid::bake::fat {
namespace {

constexpr std::uint32_t kSide = 13;  // Vertices along one side; 1 mm apart.
std::uint32_t at(std::uint32_t x, std::uint32_t y) { return y * kSide + x; }

// A flat sheet. With `slit`, the two rows of quads meet in the middle but share no vertices there
// for 3 < x < 9: a mouth.
Skin sheet(bool slit) {
  std::vector<Vec3> position;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x)
      position.emplace_back(1e-3f * static_cast<float>(x), 1e-3f * static_cast<float>(y), 0.0f);
  const std::uint32_t middle = kSide / 2;
  std::vector<std::uint32_t> twin(kSide);
  for (std::uint32_t x = 0; x < kSide; ++x) {
    twin[x] = at(x, middle);
    if (!slit || x <= 3 || x >= 9) continue;
    twin[x] = static_cast<std::uint32_t>(position.size());
    position.push_back(position[at(x, middle)]);
  }
  std::vector<std::array<std::uint32_t, 4>> quads;
  const auto vertex = [&](std::uint32_t x, std::uint32_t y, bool above) {
    return y == middle && above ? twin[x] : at(x, y);
  };
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const bool above = y >= middle;
      quads.push_back({vertex(x, y, above), vertex(x + 1, y, above), vertex(x + 1, y + 1, above),
                       vertex(x, y + 1, above)});
    }
  return make_skin(position, quads);
}

std::vector<std::uint32_t> edge(const Skin& skin) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t v = 0; v < skin.size(); ++v) {
    const Vec3 p = skin.position_m[v] * 1e3f;
    const auto end = static_cast<float>(kSide - 1);
    if (p.x < 1.5f || p.y < 1.5f || p.x > end - 1.5f || p.y > end - 1.5f) out.push_back(v);
  }
  return out;
}

TEST(Skin, RingRunsStraightOn) {
  const Skin skin = sheet(false);
  const auto row = ring(skin, at(1, 4), at(2, 4));
  ASSERT_EQ(row.size(), kSide - 1u);
  EXPECT_EQ(row.back(), at(kSide - 1, 4));
}

TEST(Skin, DistanceRunsAlongTheSurface) {
  const Skin whole = sheet(false), mouth = sheet(true);
  const std::uint32_t above[] = {at(6, kSide / 2 + 1)};
  const std::uint32_t below = at(6, kSide / 2);
  EXPECT_NEAR(distance_m(whole, above, 1.0f)[below], 1e-3f, 1e-6f);
  EXPECT_GT(distance_m(mouth, above, 1.0f)[below], 5e-3f) << "around the corner of the mouth";
}

TEST(SmoothFields, ReproducesLinearFunctionsOnAFlatSheet) {
  const Skin skin = sheet(false);
  const auto given = edge(skin);
  std::vector<float> value;
  for (const std::uint32_t v : given) value.push_back(2.0f * skin.position_m[v].x);
  const auto field = SmoothFields(skin, given).solve(value);
  for (std::uint32_t v = 0; v < skin.size(); ++v)
    EXPECT_NEAR(field[v], 2.0f * skin.position_m[v].x, 1e-5f);
}

TEST(SmoothFields, LipsThatTouchStayIndependent) {
  const Skin skin = sheet(true);
  auto given = edge(skin);
  std::vector<float> value(given.size(), 0.0f);
  // The upper lip's middle: the twin of (6, middle), the vertex there that the lower rows lack.
  std::uint32_t upper = kNone;
  for (std::uint32_t v = kSide * kSide; v < skin.size(); ++v)
    if (std::abs(skin.position_m[v].x - 6e-3f) < 1e-6f) upper = v;
  given.push_back(upper);
  value.push_back(1.0f);
  const auto field = SmoothFields(skin, given).solve(value);
  EXPECT_GT(field[at(6, kSide / 2 + 1)], 0.5f);
  EXPECT_LT(std::abs(field[at(6, kSide / 2)]), 0.2f) << "the lower lip, at the same place";
}

TEST(SmoothFields, NamesAnUnreachedPart) {
  EXPECT_THROW(SmoothFields(sheet(false), std::vector<std::uint32_t>{}), std::runtime_error);
}

TEST(AlongSurface, KeepsTheWantedPartAndLiesInTheSurface) {
  const Vec3 normal = glm::normalize(Vec3(0, 0.4f, 1));
  const Vec3 d = along_surface(normal, {0, 1, 0});
  EXPECT_NEAR(d.y, 1.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(d, normal), 0.0f, 1e-5f);
}

class WorkingRangesFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const auto file = std::filesystem::temp_directory_path() / "caryatid_ranges_test.csv";
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(WorkingRangesFile, TheProjectsOwnIsWhole) {
  const WorkingRanges r =
      read_working_ranges(CARYATID_SOURCE_DIR "/assets/characters/fap_working_ranges.csv");
  for (std::size_t fap = 3; fap < r.low.size(); ++fap) EXPECT_LT(r.low[fap], r.high[fap]) << fap;
}

TEST_F(WorkingRangesFile, RefusesBadLines) {
  EXPECT_THROW(read_working_ranges(write("3,0,100,x\n")), std::runtime_error) << "missing FAPs";
  EXPECT_THROW(read_working_ranges(write("3,5,100,x\n")), std::runtime_error) << "low above 0";
  EXPECT_THROW(read_working_ranges(write("jaw,0,1,x\n")), std::runtime_error);
  EXPECT_THROW(read_working_ranges("/nonexistent/ranges.csv"), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::bake::fat
