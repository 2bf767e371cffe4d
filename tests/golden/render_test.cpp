// The GLES renderer on the host's software GPU: pictures beside stored ones, and what must not
// change a picture.
#include "core/base/trig.h"
#include "tests/golden/studio.h"

namespace caryatid::golden {
namespace {

using platform::BoardGpu;
using scene::Shading;

TEST_F(Studio, PerPixelShading) {
  open();
  expect_golden(shoot(), "materials_per_pixel");
}

TEST_F(Studio, PerVertexShading) {
  open();
  pack_.edit_list().shading = Shading::per_vertex;
  expect_golden(shoot(), "materials_per_vertex");
}

TEST_F(Studio, CheapestShading) {
  open();
  pack_.edit_list().shading = Shading::cheapest;
  expect_golden(shoot(), "materials_cheapest");
}

// The tiers are one look at three prices.
TEST_F(Studio, TiersResembleEachOther) {
  open();
  const Image best = shoot();
  pack_.edit_list().shading = Shading::per_vertex;
  EXPECT_LT(compare(best, shoot()).mean, 5.0);
  pack_.edit_list().shading = Shading::cheapest;
  EXPECT_LT(compare(best, shoot()).mean, 12.0);
}

// The stripes of the alpha texture stand for the lines of a face.
TEST_F(Studio, LinesOfTheSkinShowAsTheyFoldAndTheCheapestShadingLeavesThem) {
  open();
  const Image plain = shoot();
  pack_.edit_material(0).detail = 1;
  open();
  EXPECT_EQ(shoot().rgb, plain.rgb) << "level lines are no lines";
  for (const Shading tier : {Shading::per_pixel, Shading::per_vertex, Shading::cheapest}) {
    pack_.edit_list().shading = tier;
    pack_.edit_list().wrinkles = {};
    const Image smooth = shoot();
    pack_.edit_list().wrinkles.left.fill(0.5f);
    const Image left = shoot();
    if (tier == Shading::cheapest) {
      EXPECT_EQ(left.rgb, smooth.rgb);
      continue;
    }
    EXPECT_GT(compare(smooth, left).mean, 0.2);
    pack_.edit_list().wrinkles.right.fill(0.5f);
    EXPECT_GT(compare(left, shoot()).mean, 0.05) << "the other side has its own weights";
  }
}

TEST_F(Studio, BonesTurnTheHalfThatHangsOnThem) {
  open();
  const Image before = shoot();
  for (std::size_t b = 1; b < pack_.list().bones.size(); b += 2)
    pack_.edit_list().bones[b].row[1].w = 0.06f;
  expect_golden(shoot(), "skinned");
  EXPECT_GT(compare(before, shoot()).mean, 0.5);
}

TEST_F(Studio, SamePictureEveryFrame) {
  open();
  const Image first = shoot();
  pack_.edit_list().patches.clear();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(shoot().rgb, first.rgb) << "frame " << i;
}

TEST_F(Studio, PatchesReachAllThreeBufferSets) {
  open();
  (void)shoot();
  pack_.edit_list().patches.clear();
  for (int i = 0; i < 3; ++i) (void)shoot();
  for (scene::DynamicVertex& v : pack_.dynamic(0)) v.position_m.x += 0.1f;
  const auto vertices = static_cast<std::uint32_t>(pack_.dynamic(0).size());
  (void)pack_.edit_list().patches.push({0, {0, vertices}, {}, {}});
  const Image moved = shoot();
  EXPECT_EQ(renderer_->last_cost().uploaded_bytes, 16 * vertices);
  pack_.edit_list().patches.clear();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(shoot().rgb, moved.rgb) << "frame " << i;
  EXPECT_EQ(renderer_->last_cost().uploaded_bytes, 0u);
}

TEST_F(Studio, BoardLimitsChangeTheEdgesOnly) {
  open();
  const Image free = shoot();
  for (const BoardGpu board : {BoardGpu::vc4, BoardGpu::v3d, BoardGpu::lima, BoardGpu::panfrost,
                               BoardGpu::etnaviv, BoardGpu::es2_minimum}) {
    platform::RenderOptions options;
    options.clamp = board;
    for (scene::MeshPatch& p : pack_.edit_list().patches) p.fixed = p.dynamic;
    open(options);
    const Difference d = compare(free, shoot());
    EXPECT_LT(d.mean, 1.5) << "board " << static_cast<int>(board);
  }
}

TEST_F(Studio, Etc1ExpandedLooksAsOnTheGpu) {
  open();
  if (!renderer_->caps().etc1) GTEST_SKIP() << "this driver has no ETC1 to compare with";
  platform::RenderOptions options;
  options.samples = 0;
  open(options);
  const Image native = shoot();
  options.clamp = BoardGpu::es2_minimum;
  open(options);
  EXPECT_LT(compare(native, shoot()).mean, 0.3);
}

TEST_F(Studio, TexturesOfTheBasePartAreSoftThenSharp) {
  open({}, true);
  const Image soft = shoot();
  for (std::uint16_t t = 0; t < 3; ++t) ASSERT_TRUE(renderer_->upload_texture(t, true).ok());
  const Image sharp = shoot();
  open();
  EXPECT_EQ(shoot().rgb, sharp.rgb);
  EXPECT_GT(compare(soft, sharp).mean, 0.02);
  EXPECT_EQ(renderer_->upload_texture(3, true).code, Code::invalid_argument);
}

TEST_F(Studio, RenderScaleKeepsThePicture) {
  platform::RenderOptions options;
  options.scalable = true;
  open(options);
  const Image full = shoot();
  pack_.edit_list().render_scale = 0.5f;
  const Image half = shoot();
  EXPECT_EQ(half.width, kWidth);
  EXPECT_LT(compare(full, half).mean, 4.0);
  EXPECT_GT(compare(full, half).mean, 0.1);
}

TEST_F(Studio, ResizeGivesAPictureOfTheNewSize) {
  open();
  ASSERT_TRUE(renderer_->resize(120, 80).ok());
  EXPECT_EQ(shoot().width, 120u);
}

TEST_F(Studio, AWrongItemIsSkippedAndTold) {
  open();
  pack_.edit_list().items[0].material = 99;
  const Status status = renderer_->draw(pack_.list());
  EXPECT_EQ(status.code, Code::invalid_argument);
  EXPECT_EQ(status.detail, static_cast<std::uint16_t>(platform::RenderFault::draw_list));
  EXPECT_GE(renderer_->last_cost().draw_calls, 5u);
}

TEST_F(Studio, ReadBackWantsRoomForThePicture) {
  open();
  ASSERT_TRUE(renderer_->draw(pack_.list()).ok());
  std::vector<std::uint8_t> small(10);
  EXPECT_EQ(renderer_->read_back(small).code, Code::out_of_capacity);
}

TEST(Compare, FindsMeanAndPercentile) {
  Image a{100, 10, std::vector<std::uint8_t>(3000, 100)}, b = a;
  b.rgb[5] = 160;
  EXPECT_DOUBLE_EQ(compare(a, b).mean, 60.0 / 3000);
  EXPECT_EQ(compare(a, b).percentile_99_9, 0);
  for (std::size_t i = 0; i < 30; ++i) b.rgb[i] = 130;
  EXPECT_EQ(compare(a, b).percentile_99_9, 30);
}

}  // namespace
}  // namespace caryatid::golden
