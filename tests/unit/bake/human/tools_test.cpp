// The room's tools on small data of our own: recipes, meshes from quads, motions, images.
#include <gtest/gtest.h>

#include <fstream>

#include "assets/bake/human/mesh_tools.h"
#include "assets/bake/human/preview.h"
#include "assets/bake/human/recipe.h"
#include "assets/bake/human/repose.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake {
namespace {

std::filesystem::path written(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "recipe.toml";
  std::ofstream(file) << text;
  return file;
}

TEST(Recipe, KeysBecomeFields) {
  const Recipe r = read_recipe(
      written("name='x'\n[macro]\nfemale=0.25\n[targets]\n'a/b'=0.5\n[[part]]\nproxy='hair/h'\n"
              "[rest_face]\n3=25\n"));
  EXPECT_EQ(r.macro.female, 0.25f);
  EXPECT_EQ(r.targets.at(0).name, "a/b");
  EXPECT_EQ(r.parts.at(0).proxy, "hair/h");
  EXPECT_EQ(r.rest_face.at(0), std::pair(3, 25.0f));
}

TEST(Recipe, MisspeltKeysAreRefused) {
  EXPECT_THROW(read_recipe(written("name='x'\n[macro]\nfemail=1\n")), std::runtime_error);
  EXPECT_THROW(read_recipe(written("name='x'\nhat=1\n")), std::runtime_error);
}

std::string refusal(const std::string& text) {
  try {
    (void)read_recipe(written(text));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Recipe, NumbersAreInRangeAndTheLineIsNamed) {
  for (const char* line :
       {"[macro]\nage_years='x'", "[macro]\nage_years=9999", "[macro]\nage_years=nan",
        "[macro]\nfemale=inf", "[macro]\ncaucasian=0", "[targets]\n'nose/a'=50",
        "[targets]\n'nose/a'='x'", "[rest_face]\n3=99999", "[rest_face]\n2=1", "[rest_face]\n3x=1",
        "[skin]\nlips=[1,2]", "[skin]\ntexture=5", "[eyes]\niris=[0,nan,1]", "[[part]]\nproxy=''",
        "macro=5\n", "part=[1]"}) {
    const std::string said = refusal(std::string("name='x'\n") + line + "\n");
    EXPECT_NE(said.find("recipe.toml:"), std::string::npos) << line << ": " << said;
    EXPECT_TRUE(said.find(":2: ") != std::string::npos || said.find(":3: ") != std::string::npos)
        << line << ": " << said;
  }
}

TEST(Recipe, TheHouseRecipesAreInRange) {
  for (const char* name : {"woman.toml", "man.toml"})
    EXPECT_NO_THROW(
        (void)read_recipe(CARYATID_SOURCE_DIR "/assets/characters/" + std::string(name)));
}

TEST(Recipe, NeedsAName) { EXPECT_THROW(read_recipe(written("[macro]\n")), std::runtime_error); }
TEST(Recipe, BrokenTomlIsRefused) {
  EXPECT_THROW(read_recipe(written("name=")), std::runtime_error);
}

// Two quads side by side in the plane z = 0; their common edge is a seam of the texture.
struct Strip {
  std::vector<Vec3> position{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  std::vector<Vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Quad> quads{{{0, 1, 4, 3}, {0, 1, 2, 3}, 0}, {{1, 2, 5, 4}, {0, 1, 2, 3}, 0}};
};

TEST(Mesh, NormalsOfAPlaneStandOnIt) {
  const Strip s;
  for (const Vec3 n : smooth_normals(s.quads, s.position)) EXPECT_EQ(n, Vec3(0, 0, 1));
}

TEST(Mesh, SeamsDoubleTheirVertices) {
  const Strip s;
  const auto normals = smooth_normals(s.quads, s.position);
  const MeshSource source{s.quads, s.position, normals, s.uv, [](auto) { return Influence{}; },
                          true};
  const Mesh mesh = make_mesh(source, [](const Quad&) { return true; });
  EXPECT_EQ(mesh.position_m.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.uv[0], Vec2(0, 1));  // v turned downwards.
}

TEST(Mesh, OnlyKeptQuadsStay) {
  const Strip s;
  const auto normals = smooth_normals(s.quads, s.position);
  const MeshSource source{s.quads, s.position, normals, s.uv, [](auto) { return Influence{}; },
                          false};
  const Mesh mesh = make_mesh(source, [](const Quad& q) { return q.vertex[0] == 0; });
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.base_vertex[0], kNone);
}

TEST(Mesh, NeighboursAreSymmetric) {
  const Strip s;
  const auto neighbours = edge_neighbours(s.quads, s.position.size());
  EXPECT_EQ(neighbours[1].size(), 3u);
  EXPECT_EQ(neighbours[0].size(), 2u);
}

BoneMotion quarter_turn() {
  const float h = std::sqrt(0.5f);
  return {Quat{h, 0, 0, h}, {1, 0, 0}, {1, 0, 0}};  // About z through x = 1.
}

TEST(Motions, OneBoneMovesRigidly) {
  const BoneMotion motion[] = {quarter_turn()};
  const Influence influence[] = {{}};
  std::vector<Vec3> p{{2, 0, 0}};
  apply_motions(motion, influence, p);
  EXPECT_LT(glm::distance(p[0], Vec3(1, 1, 0)), 1e-6f);
}

// Half way between two turns about one axis lies on the arc: dual quaternions keep the radius.
TEST(Motions, BlendsKeepVolume) {
  const BoneMotion motions[] = {{Quat{1, 0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, quarter_turn()};
  Influence half;
  half.joint = {0, 1, 0, 0};
  half.weight = {0.5f, 0.5f, 0, 0};
  std::vector<Vec3> p{{2, 0, 0}};
  apply_motions(motions, std::span(&half, 1), p);
  EXPECT_NEAR(glm::distance(p[0], Vec3(1, 0, 0)), 1.0f, 1e-5f);
}

TEST(MeshTools, PiecesAreWhatEdgesConnect) {
  const std::vector<Quad> quads = {
      {{0, 1, 2, 3}, {}, 0}, {{1, 4, 5, 2}, {}, 0}, {{6, 7, 8, 9}, {}, 0}};
  const std::vector<std::uint32_t> piece = pieces_of(quads, 11);
  EXPECT_EQ(piece[0], piece[5]);
  EXPECT_EQ(piece[6], piece[9]);
  EXPECT_NE(piece[0], piece[6]);
  EXPECT_NE(piece[10], piece[0]) << "a vertex without quads is a piece of its own";
}

TEST(Images, SrgbRoundTrips) {
  for (const float c : {0.0f, 0.02f, 0.2f, 0.7f, 1.0f})
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(c)), c, 1e-5f);
}

TEST(Images, SamplingHitsTexelCentres) {
  LinearImage image(2, 2, Vec4{0});
  image.at(1, 0) = Vec4{1};
  EXPECT_NEAR(sample_bilinear(image, {0.75f, 0.25f}).x, 1.0f, 1e-6f);
  EXPECT_NEAR(sample_bicubic(image, {0.75f, 0.25f}).x, 1.0f, 1e-6f);
}

TEST(Images, BleedingKeepsOpaqueTexelsAndAlpha) {
  LinearImage image(4, 4, Vec4{0, 0, 0, 0});
  image.at(0, 0) = {1, 0.5f, 0.25f, 1};
  bleed_alpha(image, 0.02f);
  EXPECT_EQ(image.at(0, 0), Vec4(1, 0.5f, 0.25f, 1));
  EXPECT_NEAR(image.at(3, 3).x, 1.0f, 1e-4f);
  EXPECT_EQ(image.at(3, 3).w, 0.0f);
}

TEST(Images, LessContrastDrawsBrightnessTogetherAndKeepsHues) {
  LinearImage image(2, 1, Vec4{0.4f, 0.2f, 0.1f, 1});
  image.at(1, 0) = {0.04f, 0.02f, 0.01f, 1};
  set_contrast(image, 0.5f);
  EXPECT_LT(image.at(0, 0).x, 0.4f);
  EXPECT_GT(image.at(1, 0).x, 0.04f);
  EXPECT_LT(image.at(1, 0).x, image.at(0, 0).x);
  EXPECT_NEAR(image.at(1, 0).x, 2.0f * image.at(1, 0).y, 1e-5f);
}

TEST(Images, PngRoundTrips) {
  Image image;
  image.width = image.height = 2;
  image.rgba = {1, 2, 3, 255, 4, 5, 6, 128, 7, 8, 9, 0, 10, 11, 12, 255};
  const auto file = std::filesystem::path(testing::TempDir()) / "x.png";
  write_png(image, file);
  const Image back = read_image(file);
  EXPECT_EQ(back.rgba, image.rgba);
  EXPECT_TRUE(back.has_alpha);
}

TEST(Images, MissingFilesAreNamed) { EXPECT_THROW(read_image("/nowhere.png"), std::runtime_error); }

TEST(Preview, DrawsWhatFacesTheCamera) {
  Character c;
  c.materials.push_back({});
  for (float& t : c.materials[0].tint) t = 1;
  c.materials[0].texture = pack::kNoTexture;
  Object o;
  o.mesh.position_m = {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  o.mesh.normal.assign(3, Vec3{0, 0, 1});
  o.mesh.uv.assign(3, Vec2{0});
  o.mesh.triangles = {{0, 1, 2}};
  c.objects.push_back(o);
  PreviewView view;
  view.width = view.height = 16;
  const auto middle = [&] {
    const Image image = render_preview(c, view);
    return int{image.rgba[4 * (8 * 16 + 8)]};
  };
  const int front = middle();
  view.yaw_rad = 3.14159265f;
  EXPECT_GT(front, middle());  // From behind the triangle is culled.
}

}  // namespace
}  // namespace caryatid::bake
