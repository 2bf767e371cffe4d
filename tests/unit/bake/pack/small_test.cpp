#include "assets/bake/pack/small.h"

#include <gtest/gtest.h>

namespace caryatid::bake {
namespace {

// Its detail texture is dropped with the images that nothing shows: a material must not name it.
TEST(Small, NoMaterialHasADetailTexture) {
  Character c;
  c.images.assign(2, Image{"x", 128, 128, std::vector<std::uint8_t>(4 * 128 * 128, 9)});
  pack::Material skin{};
  skin.texture = 0;
  skin.detail = 1;
  c.materials.push_back(skin);
  Object head;
  head.role = pack::ObjectRole::head;
  c.objects.push_back(head);
  const Character small = small_character(c, 64);
  EXPECT_EQ(small.materials[0].detail, pack::kNoTexture);
  EXPECT_EQ(small.images[0].width, 64u);
  EXPECT_EQ(small.images[1].width, 1u);
}

}  // namespace
}  // namespace caryatid::bake
