#include "platform/render/render.h"

#include <gtest/gtest.h>

#include <vector>

#include "platform/render/etc1.h"

namespace caryatid::platform {
namespace {

TEST(ClampCaps, NeverRaises) {
  const GpuCaps lowest;  // The minima of GLES 2.0.
  for (int b = 0; b <= static_cast<int>(BoardGpu::etnaviv); ++b) {
    const GpuCaps c = clamp_caps(lowest, static_cast<BoardGpu>(b));
    EXPECT_LE(c.vertex_vectors, lowest.vertex_vectors);
    EXPECT_LE(c.max_texture_size, lowest.max_texture_size);
    EXPECT_FALSE(c.etc1);
  }
}

// Every board of the table has room for what the shaders use.
TEST(ClampCaps, BoardsHoldWhatIsDrawn) {
  GpuCaps best;
  best.gles_major = 3;
  best.vertex_attributes = best.varying_vectors = 32;
  best.vertex_vectors = best.fragment_vectors = 4096;
  for (int b = 1; b <= static_cast<int>(BoardGpu::etnaviv); ++b) {
    const GpuCaps c = clamp_caps(best, static_cast<BoardGpu>(b));
    EXPECT_GE(c.vertex_vectors, kVertexVectorsUsed) << b;
    EXPECT_GE(c.vertex_attributes, 5u) << b;
    EXPECT_GE(c.fragment_vectors, 16u) << b;
  }
  EXPECT_EQ(clamp_caps(best, BoardGpu::none).vertex_vectors, 4096u);
}

// Expected values by hand from the extension's text, section 3.9.
TEST(Etc1, IndividualModeWithSmallModifiers) {
  // Base 0x4 -> 68 in red of both halves, codeword 0, all selectors 0: +2.
  const std::uint8_t block[8] = {0x44, 0, 0, 0, 0, 0, 0, 0};
  std::vector<std::uint16_t> out(16);
  decode_etc1(block, 4, 4, out);
  const auto expected = static_cast<std::uint16_t>((70 >> 3) << 11 | (2 >> 2) << 5 | 2 >> 3);
  for (const std::uint16_t texel : out) EXPECT_EQ(texel, expected);
}

TEST(Etc1, DifferentialModeSplitsLeftAndRight) {
  // Red 16 + (-4) = 12; differential, not flipped; codewords 0 and 0.
  const std::uint8_t block[8] = {16 << 3 | 4, 0, 0, 2, 0, 0, 0, 0};
  std::vector<std::uint16_t> out(16);
  decode_etc1(block, 4, 4, out);
  EXPECT_EQ(out[0] >> 11, (132 + 2) >> 3);  // 16 -> 132
  EXPECT_EQ(out[3] >> 11, (99 + 2) >> 3);   // 12 -> 99
}

TEST(Etc1, SelectorsRunDownTheColumns) {
  // Texel x = 1, y = 0 is number 4: low bit set -> large modifier of codeword 7, 183.
  const std::uint8_t block[8] = {0, 0, 0, 7 << 5 | 7 << 2, 0, 0, 0, 1 << 4};
  std::vector<std::uint16_t> out(16);
  decode_etc1(block, 4, 4, out);
  EXPECT_EQ(out[1] >> 11, 183 >> 3);
  EXPECT_EQ(out[4] >> 11, 47 >> 3);
}

TEST(Etc1, CutsBlocksAtTheEdge) {
  std::vector<std::uint8_t> blocks(etc1_bytes(5, 2));
  EXPECT_EQ(blocks.size(), 16u);
  std::vector<std::uint16_t> out(11, 0xABCD);
  decode_etc1(blocks, 5, 2, out);
  EXPECT_EQ(out[10], 0xABCD);
  EXPECT_NE(out[9], 0xABCD);
}

TEST(NullRenderer, CountsAndRefusesAsTheRealOne) {
  std::vector<pack::Object> objects(1);
  objects[0].max_vertex_count = 3;
  objects[0].max_triangle_count = 1;
  std::vector<pack::Material> materials(1);
  pack::View view;
  view.objects = objects;
  view.materials = materials;
  std::unique_ptr<Renderer> renderer;
  ASSERT_TRUE(open_null_renderer(view, {.width = 4, .height = 2}, renderer).ok());
  const std::vector<scene::DynamicVertex> dynamic(3);
  const std::vector<scene::StaticVertex> fixed(3);
  const std::vector<std::uint16_t> indices{0, 1, 2};
  const std::vector<scene::MeshView> meshes{{dynamic, fixed, indices, 3, 1}};
  const auto list = std::make_unique<scene::DrawList>();
  list->meshes = meshes;
  (void)list->items.push({0, 0, 1, 0, 0});
  EXPECT_TRUE(renderer->draw(*list).ok());
  EXPECT_EQ(renderer->last_cost().triangles, 1u);
  list->items[0].triangle_count = 2;  // More than the mesh has.
  EXPECT_EQ(renderer->draw(*list).code, Code::invalid_argument);
  list->items[0] = {0, 0, 1, 0, 1};  // A bone that is not there.
  EXPECT_EQ(renderer->draw(*list).code, Code::invalid_argument);
  std::vector<std::uint8_t> rgb(23);
  EXPECT_EQ(renderer->read_back(rgb).code, Code::out_of_capacity);
}

}  // namespace
}  // namespace caryatid::platform
