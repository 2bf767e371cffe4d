#include "core/face/deform.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

namespace caryatid::face {
namespace {

pack::Vertex at(float x, float y) {
  pack::Vertex v{};
  v.position_m[0] = x;
  v.position_m[1] = y;
  v.normal[2] = 127;
  v.normal[3] = 9;
  return v;
}

// One triangle; vertex 2 is moved by channels 0 and 1, the others by nothing.
struct Face {
  std::vector<pack::Vertex> versions = {at(0, 0), at(1, 0), at(0, 1)};
  std::vector<std::uint16_t> indices = {0, 1, 2};
  std::vector<std::uint32_t> first = {0, 0, 0, 2};
  std::vector<pack::Move> moves = {{0, {500, 0, 0}, {0, 0, 0}, 0},
                                   {1, {0, 1000, 0}, {127, 0, 0}, 0}};
  std::array<std::byte, 4096> block{};
  Arena arena{block};
  std::array<std::uint16_t, 3> scratch{};
  mesh::LiveMesh mesh;

  Face() {
    EXPECT_TRUE(mesh.start({versions, indices, {}, {}, 3, 3, 1}, arena, scratch).ok());
    mesh.clear_dirty();
  }
  mesh::DirtyRange deform(float c0, float c1) {
    const float weights[] = {c0, c1};
    mesh::DirtyRange dirty;
    EXPECT_TRUE((DeformJob{{first, moves}, weights, &mesh, &dirty}.run().ok()));
    return dirty;
  }
};

TEST(Deform, ZeroFrameGivesTheNeutralExactly) {
  Face face;
  const mesh::DynamicVertex rest = face.mesh.rest(2);
  EXPECT_EQ(face.deform(0, 0).count, 0u);
  face.deform(1, 0.3f);
  EXPECT_EQ(face.deform(0, 0).count, 1u) << "what was moved comes back";
  EXPECT_EQ(std::memcmp(&face.mesh.dynamic()[2], &rest, sizeof(rest)), 0);
}

TEST(Deform, IsLinearInEveryChannel) {
  Face face;
  face.deform(0.5f, 0.25f);
  EXPECT_NEAR(face.mesh.dynamic()[2].position_m.x, 0.5f * 500 * pack::kMoveStep_m, 1e-9f);
  EXPECT_NEAR(face.mesh.dynamic()[2].position_m.y, 1.0f + 0.25f * 1000 * pack::kMoveStep_m, 1e-7f);
}

TEST(Deform, TurnsTheNormalAndKeepsTheOcclusion) {
  Face face;
  face.deform(0, 1);
  const mesh::DynamicVertex& v = face.mesh.dynamic()[2];
  EXPECT_EQ(v.normal[0], 90);
  EXPECT_EQ(v.normal[2], 90);
  EXPECT_EQ(v.normal[3], 9);
}

TEST(Deform, ReportsOnlyWhatChanged) {
  Face face;
  const mesh::DirtyRange dirty = face.deform(1, 0);
  EXPECT_EQ(dirty.first, 2u);
  EXPECT_EQ(dirty.count, 1u);
  EXPECT_EQ(face.deform(1, 0).count, 0u);
}

TEST(Deform, RefusesATableThatIsTooShort) {
  Face face;
  const float weights[] = {0, 0};
  const std::span<const std::uint32_t> two(face.first.data(), 2);
  EXPECT_EQ((DeformJob{{two, face.moves}, weights, &face.mesh}.run().code), Code::out_of_capacity);
  EXPECT_EQ((DeformJob{{face.first, face.moves}, weights, nullptr}.run().code),
            Code::invalid_argument);
}

}  // namespace
}  // namespace caryatid::face
