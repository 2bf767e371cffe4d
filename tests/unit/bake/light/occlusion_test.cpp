#include "assets/bake/light/occlusion.h"

#include <gtest/gtest.h>

#include "assets/bake/light/ray_tree.h"

namespace caryatid::bake {
namespace {

void add_quad(Mesh& m, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto first = static_cast<std::uint32_t>(m.position_m.size());
  const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
  for (const Vec3& p : {a, b, c, d}) {
    m.position_m.push_back(p);
    m.normal.push_back(n);
  }
  m.triangles.push_back({first, first + 1, first + 2});
  m.triangles.push_back({first, first + 2, first + 3});
}

Character floor_with_wall(bool wall) {
  Character c;
  c.materials.resize(1);
  c.objects.resize(1);
  Mesh& m = c.objects[0].mesh;
  add_quad(m, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0});
  if (wall) add_quad(m, {-1e-3f, 0, -1}, {-1e-3f, 1, -1}, {-1e-3f, 1, 1}, {-1e-3f, 0, 1});
  return c;
}

TEST(Occlusion, OpenFloorIsOpen) {
  Character c = floor_with_wall(false);
  bake_occlusion(c);
  for (const float o : c.objects[0].mesh.occlusion) EXPECT_FLOAT_EQ(o, 0.0f);
}

TEST(Occlusion, FootOfAWallIsShadedAndFarFromItIsNot) {
  Character c = floor_with_wall(true);
  bake_occlusion(c);
  const std::vector<float>& o = c.objects[0].mesh.occlusion;
  EXPECT_GT(o[0], 0.3f);
  EXPECT_LT(o[0], 0.55f);  // A wall hides half of the sky.
  EXPECT_FLOAT_EQ(o[2], 0.0f);
}

TEST(Occlusion, EyesStayOpen) {
  Character c = floor_with_wall(true);
  c.objects[0].role = pack::ObjectRole::eye;
  bake_occlusion(c);
  EXPECT_FLOAT_EQ(c.objects[0].mesh.occlusion[0], 0.0f);
}

TEST(Occlusion, TheMouthDarkensFromTheTeethInwards) {
  Character c = floor_with_wall(false);
  c.objects[0].role = pack::ObjectRole::mouth;
  auto& p = c.objects[0].mesh.position_m;
  for (std::size_t v = 0; v < p.size(); ++v) p[v].z = -0.01f * static_cast<float>(v);
  bake_occlusion(c);
  const std::vector<float>& o = c.objects[0].mesh.occlusion;
  EXPECT_LT(o[0], 0.1f);
  for (std::size_t v = 1; v < o.size(); ++v) EXPECT_GE(o[v], o[v - 1]);
  EXPECT_GT(o.back(), 0.5f);
}

TEST(RayTree, FindsTheNearerOfManyTriangles) {
  std::vector<RayTree::Triangle> stack;
  for (int i = 1; i <= 50; ++i) {
    const float z = 0.1f * static_cast<float>(i);
    stack.push_back({{Vec3{-1, -1, z}, Vec3{1, -1, z}, Vec3{0, 1, z}}, 1.0f});
  }
  const RayTree tree(stack);
  EXPECT_NEAR(tree.first_hit({0, 0, 1.05f}, {0, 0, 1}, 5.0f).distance_m, 0.05f, 1e-5f);
  EXPECT_NEAR(tree.first_hit({0, 0, 1.05f}, {0, 0, -1}, 5.0f).distance_m, 0.05f, 1e-5f);
  EXPECT_FLOAT_EQ(tree.first_hit({3, 0, 0}, {0, 0, 1}, 5.0f).opacity, 0.0f);
  EXPECT_FLOAT_EQ(tree.first_hit({0, 0, 0}, {0, 0, 1}, 0.05f).opacity, 0.0f);
}

}  // namespace
}  // namespace caryatid::bake
