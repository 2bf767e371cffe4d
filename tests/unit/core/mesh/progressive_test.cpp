#include "core/mesh/progressive.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

namespace caryatid::mesh {
namespace {

pack::Vertex at(float x, float y, std::uint16_t u) {
  pack::Vertex v{};
  v.position_m[0] = x;
  v.position_m[1] = y;
  v.uv[0] = u;
  return v;
}

// A square of two triangles whose corner 0 splits: the new slot 4 takes over triangle 1 and a third
// triangle closes the gap. Then slot 4 splits again at the border: slot 5.
struct Fixture {
  std::vector<pack::Vertex> versions = {at(0, 0, 0),   at(1, 0, 100), at(1, 1, 200), at(0, 1, 300),
                                        at(0, -1, 10), at(-1, 0, 20),   // Split 0: slots 0, 4.
                                        at(-2, 0, 30), at(-2, 1, 40)};  // Split 1: slots 4, 5.
  std::vector<std::uint16_t> base = {0, 1, 2, 0, 2, 3};
  std::vector<std::uint16_t> words = {0, 0,      // Slot 0 had version 0.
                                      0,         // Slot 4 comes from slot 0.
                                      0, 2, 4,   // Triangle 2.
                                      1,         // Triangle 1 goes over.
                                      4, 5,      // Slot 4 had version 5.
                                      4,         // Slot 5 comes from slot 4.
                                      4, 3, 5};  // Triangle 3.
  std::vector<pack::Split> splits = {{0, 4, 1, 1, 1, 1, 0}, {7, 6, 0, 1, 1, 1, 0}};
  MeshSource source() { return {versions, base, splits, words, 4, 6, 4}; }
};

struct Live {
  Fixture data;
  std::array<std::byte, 4096> block{};
  Arena arena{block};
  std::array<std::uint16_t, 12> scratch{};
  LiveMesh mesh;
  Live() {
    EXPECT_TRUE(mesh.start(data.source(), arena, scratch).ok());
    mesh.set_available(2);
  }
  std::vector<std::uint16_t> indices() const {
    return {mesh.indices().begin(), mesh.indices().begin() + 3 * mesh.triangle_count()};
  }
};

TEST(LiveMesh, StartsWithTheBaseMesh) {
  Live live;
  EXPECT_EQ(live.mesh.triangle_count(), 2u);
  EXPECT_EQ(live.mesh.vertex_count(), 4u);
  EXPECT_EQ(live.indices(), live.data.base);
}

TEST(LiveMesh, SplitsRewriteOnlyWhatTheyTouch) {
  Live live;
  live.mesh.clear_dirty();
  live.mesh.set_level(3);
  EXPECT_EQ(live.indices(), (std::vector<std::uint16_t>{0, 1, 2, 4, 2, 3, 0, 2, 4}));
  EXPECT_EQ(live.mesh.dynamic()[0].position_m, Vec3(0, -1, 0));
  EXPECT_EQ(live.mesh.dynamic()[4].position_m, Vec3(-1, 0, 0));
  EXPECT_EQ(live.mesh.dirty_indices().first, 3u);
  EXPECT_EQ(live.mesh.dirty_indices().count, 6u);
}

TEST(LiveMesh, DownAndUpGivesTheSameBits) {
  Live live, straight;
  straight.mesh.set_level(4);
  for (const std::uint32_t level : {4u, 2u, 3u, 4u, 2u, 4u}) live.mesh.set_level(level);
  EXPECT_EQ(live.indices(), straight.indices());
  EXPECT_EQ(std::memcmp(live.mesh.dynamic().data(), straight.mesh.dynamic().data(),
                        live.mesh.dynamic().size_bytes()),
            0);
}

TEST(LiveMesh, WaitsForSplitsThatHaveNotArrived) {
  Live live;
  live.mesh.set_available(1);
  live.mesh.set_level(1000);
  EXPECT_EQ(live.mesh.triangle_count(), 3u);
}

TEST(LiveMesh, GeomorphStartsAndEndsAtTheTwoLevels) {
  Live live;
  live.mesh.morph_to_level(4, 0.4f);
  EXPECT_EQ(live.mesh.triangle_count(), 4u);
  // All of the new slots begin where their common ancestor stood.
  for (const std::uint32_t slot : {0u, 4u, 5u})
    EXPECT_EQ(live.mesh.dynamic()[slot].position_m, Vec3(0, 0, 0));
  live.mesh.advance(0.2f);
  EXPECT_EQ(live.mesh.dynamic()[5].position_m, Vec3(-1, 0.5f, 0));
  EXPECT_EQ(live.mesh.fixed()[5].uv[0], 20);
  live.mesh.advance(0.3f);
  EXPECT_FALSE(live.mesh.morphing());
  EXPECT_EQ(live.mesh.dynamic()[5].position_m, Vec3(-2, 1, 0));
}

TEST(LiveMesh, CoarseningGeomorphSwapsConnectivityAtItsEnd) {
  Live live;
  live.mesh.set_level(4);
  live.mesh.morph_to_level(2, 0.4f);
  EXPECT_EQ(live.mesh.triangle_count(), 4u);
  EXPECT_EQ(live.mesh.target_triangle_count(), 2u);
  live.mesh.advance(0.39999f);
  EXPECT_NEAR(live.mesh.dynamic()[5].position_m.x, 0.0f, 1e-3f);
  live.mesh.advance(0.1f);
  EXPECT_EQ(live.mesh.triangle_count(), 2u);
  EXPECT_EQ(live.indices(), live.data.base);
  EXPECT_EQ(live.mesh.dynamic()[0].position_m, Vec3(0, 0, 0));
}

MeshFault fault_of(Fixture& data) {
  SplitChecker checker;
  Status status = checker.start(data.source());
  std::array<std::uint16_t, 4> scratch{};
  if (status.ok())
    status =
        checker.check(data.source(), 0, static_cast<std::uint32_t>(data.splits.size()), scratch);
  return static_cast<MeshFault>(status.detail);
}

TEST(SplitChecker, AcceptsAGoodHistory) {
  Fixture data;
  EXPECT_EQ(fault_of(data), MeshFault::none);
}

TEST(SplitChecker, NamesEachFault) {
  const auto fault_after = [](auto change) {
    Fixture data;
    change(data);
    return fault_of(data);
  };
  EXPECT_EQ(fault_after([](Fixture& f) { f.base[2] = 4; }), MeshFault::base_index_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.splits[0].added_vertices = 3; }), MeshFault::counts);
  EXPECT_EQ(fault_after([](Fixture& f) { f.splits[1].data = 9; }), MeshFault::words_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.splits[1].first_version = 7; }),
            MeshFault::version_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.words[8] = 8; }), MeshFault::version_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.words[0] = 4; }), MeshFault::slot_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.words[6] = 2; }), MeshFault::triangle_range);
  EXPECT_EQ(fault_after([](Fixture& f) { f.versions.resize(3); }), MeshFault::too_many_vertices);
  EXPECT_EQ(fault_after([](Fixture& f) { f.splits.push_back(f.splits[1]); }), MeshFault::capacity);
}

TEST(SplitChecker, RefusesAReorderThatIsNoPermutation) {
  Fixture data;
  data.words.insert(data.words.end(), {4, 0, 1, 1, 3});
  data.splits.push_back({13, 0, 0, 0, 0, 0, pack::kReorder});
  EXPECT_EQ(fault_of(data), MeshFault::not_a_permutation);
}

TEST(LiveMesh, ReorderIsUndoneExactly) {
  Live live;
  live.data.words.insert(live.data.words.end(), {4, 2, 0, 3, 1});
  live.data.splits.push_back({13, 0, 0, 0, 0, 0, pack::kReorder});
  live.arena.~Arena();
  new (&live.arena) Arena(live.block);
  ASSERT_TRUE(live.mesh.start(live.data.source(), live.arena, live.scratch).ok());
  live.mesh.set_available(3);
  live.mesh.set_level(4);
  EXPECT_EQ(live.indices(), (std::vector<std::uint16_t>{0, 2, 4, 0, 1, 2, 4, 3, 5, 4, 2, 3}));
  live.mesh.set_level(3);
  EXPECT_EQ(live.indices(), (std::vector<std::uint16_t>{0, 1, 2, 4, 2, 3, 0, 2, 4}));
}

}  // namespace
}  // namespace caryatid::mesh
