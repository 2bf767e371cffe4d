#include "assets/bake/pack/writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/agent/person.h"
#include "core/face/fit.h"
#include "core/mesh/progressive.h"
#include "core/pack/loader.h"

namespace caryatid::bake {
namespace {

// A sphere with a texture seam along one meridian, two bones, and one channel that stretches it.
Object sphere(std::uint32_t rows, std::uint32_t columns) {
  Object o;
  o.name = "sphere";
  o.moves.resize(1);
  Mesh& m = o.mesh;
  for (std::uint32_t r = 0; r <= rows; ++r)
    for (std::uint32_t c = 0; c <= columns; ++c) {
      const double theta = std::numbers::pi * r / rows;
      const double phi = 2 * std::numbers::pi * (c % columns) / columns;
      const Vec3 n(r == 0 || r == rows ? 0.0 : std::sin(theta) * std::sin(phi), std::cos(theta),
                   r == 0 || r == rows ? 0.0 : std::sin(theta) * std::cos(phi));
      m.position_m.push_back(0.1f * n);
      m.normal.push_back(n);
      m.uv.push_back({static_cast<float>(c) / static_cast<float>(columns),
                      static_cast<float>(r) / static_cast<float>(rows)});
      const float w = 0.5f + 0.5f * n.y;
      m.influence.push_back({{1, 2, 0, 0}, {w, 1.0f - w, 0.0f, 0.0f}});
      o.moves[0].push_back({static_cast<std::uint32_t>(m.position_m.size() - 1),
                            {0.0f, 0.01f * n.y, 0.0f},
                            {0, 0, 0}});
    }
  const auto at = [columns](std::uint32_t r, std::uint32_t c) { return r * (columns + 1) + c; };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      if (r + 1 < rows) m.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      if (r > 0) m.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
  return o;
}

Character character() {
  Character c;
  c.name = "ball";
  c.facts.iris_diameter_m = c.facts.eye_separation_m = c.facts.eye_nose_m = 0.05f;
  c.facts.mouth_nose_m = c.facts.mouth_width_m = c.facts.stature_m = c.facts.leg_length_m = 1.0f;
  c.joints = {{0, pack::kNoJoint, {0, 0, 0}}, {1, 0, {0, 0, 0}}, {2, 1, {0, 1, 0}}};
  c.objects.push_back(sphere(24, 32));
  c.objects[0].material = 0;
  c.materials.push_back({pack::MaterialKind::skin, 0, 0, pack::kNoTexture, {1, 1, 1, 1}, 0, 1});
  Image image{"skin", 256, 128, std::vector<std::uint8_t>(4 * 256 * 128, 200), false};
  c.images.push_back(image);
  c.channels.push_back({3, 0, 0.0f, 512.0f, 0.0f, 0.0f});
  c.feature_points.push_back({2, 10, 0, 5 * 33 + 7, c.objects[0].mesh.position_m[5 * 33 + 7]});
  return c;
}

struct Loaded {
  std::vector<std::byte> file;
  std::vector<std::byte> image;
  pack::Loader loader;
  explicit Loaded(std::vector<std::byte> bytes) : file(std::move(bytes)) {
    const auto header = pack::read_header(file);
    EXPECT_TRUE(header.ok());
    image.resize(header.value.image_bytes + 16);
    void* at = image.data();
    std::size_t space = image.size();
    std::align(16, header.value.image_bytes, at, space);
    EXPECT_TRUE(loader.begin(header.value, {static_cast<std::byte*>(at), space}).ok());
    const Status fed = loader.feed(std::span(file).subspan(sizeof(pack::PackHeader)));
    EXPECT_TRUE(fed.ok()) << pack::refusal_text(static_cast<pack::Refusal>(fed.detail));
    EXPECT_TRUE(loader.end().ok());
  }
  mesh::MeshSource source(std::size_t object) const {
    const pack::View& v = loader.view();
    const pack::Object& o = v.objects[object];
    return {v.versions.subspan(o.first_version, o.version_count),
            v.base_indices.subspan(o.first_base_index, 3 * o.base_triangle_count),
            {reinterpret_cast<const pack::Split*>(v.splits.data()) + o.first_split, o.split_count},
            v.split_data,
            o.base_vertex_count,
            o.max_vertex_count,
            o.max_triangle_count};
  }
};

struct Live {
  mesh::MeshSource source;
  std::vector<std::byte> memory;
  std::vector<std::uint16_t> scratch;
  Arena arena;
  mesh::LiveMesh mesh;
  explicit Live(const mesh::MeshSource& s)
      : source(s),
        memory(mesh::LiveMesh::arena_bytes(s)),
        scratch(3 * s.max_triangle_count),
        arena(memory) {
    EXPECT_TRUE(mesh.start(source, arena, scratch).ok());
    mesh.set_available(static_cast<std::uint32_t>(s.splits.size()));
  }
};

TEST(PackWriter, WhatItWritesIsLoadedWithoutComplaint) {
  PackReport report;
  const Loaded pack(write_pack(character(), {}, &report));
  EXPECT_TRUE(pack.loader.complete());
  EXPECT_LT(report.base_part_bytes, report.file_bytes);
  const mesh::MeshSource source = pack.source(0);
  EXPECT_EQ(pack.loader.splits_ready(0), source.splits.size());
  mesh::SplitChecker checker;
  std::vector<std::uint16_t> scratch(source.max_triangle_count);
  ASSERT_TRUE(checker.start(source).ok());
  EXPECT_TRUE(
      checker.check(source, 0, static_cast<std::uint32_t>(source.splits.size()), scratch).ok());
  EXPECT_EQ(checker.triangle_count, source.max_triangle_count);
  EXPECT_EQ(checker.vertex_count, source.max_vertex_count);
}

TEST(PackWriter, RulesOfInterpolationTravelInThePack) {
  const Loaded with_default(write_pack(character(), {}, nullptr));
  const auto built_in = face::default_fit();
  ASSERT_EQ(with_default.loader.view().fit.size(), built_in.size());
  EXPECT_EQ(
      std::memcmp(with_default.loader.view().fit.data(), built_in.data(), built_in.size_bytes()),
      0);
  Character other = character();
  other.fit = {built_in.begin(), built_in.begin() + 3};
  const Loaded with_own(write_pack(other, {}, nullptr));
  ASSERT_EQ(with_own.loader.view().fit.size(), 3u);
}

// Progressive transmission: a frame can be drawn from the base part alone, and is refined while the
// rest of the bytes still come.
TEST(PackWriter, TheFirstFrameNeedsTheBasePartAlone) {
  PackReport report;
  const std::vector<std::byte> file = write_pack(character(), {}, &report);
  const auto header = pack::read_header(file);
  ASSERT_TRUE(header.ok());
  std::vector<std::byte> image(header.value.image_bytes);
  pack::Loader loader;
  ASSERT_TRUE(loader.begin(header.value, image).ok());
  std::size_t at = sizeof(pack::PackHeader);
  const auto feed = [&](std::size_t bytes) {
    bytes = std::min(bytes, file.size() - at);
    EXPECT_TRUE(loader.feed(std::span(file).subspan(at, bytes)).ok());
    at += bytes;
  };
  while (!loader.base_ready()) feed(64);
  EXPECT_LT(at, report.base_part_bytes + 128);
  EXPECT_LT(at, file.size() / 2);
  std::vector<std::byte> memory(agent::Person::arena_bytes(loader.view()));
  Arena arena(memory);
  agent::Person person;
  ASSERT_TRUE(person.start(loader.view(), arena).ok());
  person.show({}, {}, Affine{}, 0.02f);
  const std::uint32_t full = header.ok() ? 2u * 32 * 23 : 0;
  const std::uint32_t wanted[] = {full};
  EXPECT_GT(person.triangle_count(), 0u);
  EXPECT_LT(person.triangle_count(), full / 5);
  std::uint32_t before = person.triangle_count();
  int refined = 0;
  while (!loader.complete()) {
    feed(2000);
    ASSERT_TRUE(person.refine(loader).ok());
    person.set_levels(wanted);
    person.show({}, {}, Affine{}, 0.02f);
    EXPECT_GE(person.triangle_count(), before);
    refined += person.triangle_count() > before;
    before = person.triangle_count();
  }
  EXPECT_GT(refined, 2);
  EXPECT_EQ(person.triangle_count(), full);
}

TEST(PackWriter, BaseMeshIsSmall) {
  const Loaded pack(write_pack(character()));
  const mesh::MeshSource source = pack.source(0);
  EXPECT_EQ(source.max_triangle_count, 2u * 32 * 23);
  EXPECT_LE(source.base_indices.size() / 3, source.max_triangle_count / 10);
}

using Corner = std::array<float, 5>;  // Position and texture coordinate.
std::vector<std::array<Corner, 3>> sorted_triangles(
    const std::vector<std::array<Corner, 3>>& triangles) {
  auto out = triangles;
  for (auto& t : out) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::array<Corner, 3>> shown(const mesh::LiveMesh& mesh) {
  std::vector<std::array<Corner, 3>> out;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<Corner, 3> triangle;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint16_t slot = mesh.indices()[3 * t + i];
      const Vec3 p = mesh.dynamic()[slot].position_m;
      const auto& uv = mesh.fixed()[slot].uv;
      triangle[i] = {p.x, p.y, p.z, static_cast<float>(uv[0]), static_cast<float>(uv[1])};
    }
    out.push_back(triangle);
  }
  return sorted_triangles(out);
}

TEST(PackWriter, FullLevelIsTheObjectItself) {
  const Character c = character();
  const Loaded pack(write_pack(c));
  Live live(pack.source(0));
  live.mesh.set_level(0xFFFF);
  std::vector<std::array<Corner, 3>> expected;
  const Mesh& m = c.objects[0].mesh;
  for (const auto& t : m.triangles) {
    std::array<Corner, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i] = {m.position_m[t[i]].x, m.position_m[t[i]].y, m.position_m[t[i]].z,
                     std::round(65535.0f * m.uv[t[i]].x), std::round(65535.0f * m.uv[t[i]].y)};
    expected.push_back(triangle);
  }
  EXPECT_EQ(shown(live.mesh), sorted_triangles(expected));
}

TEST(PackWriter, EveryLevelIsTheSameUpAndDown) {
  const Loaded pack(write_pack(character()));
  Live up(pack.source(0)), down(pack.source(0));
  down.mesh.set_level(0xFFFF);
  const std::uint32_t base = up.mesh.triangle_count();
  std::vector<std::vector<std::uint16_t>> seen;
  for (std::uint32_t n = base; n <= 1472; n += 37) {
    up.mesh.set_level(n);
    seen.push_back(
        {up.mesh.indices().begin(), up.mesh.indices().begin() + 3 * up.mesh.triangle_count()});
  }
  for (std::size_t i = seen.size(); i-- > 0;) {
    down.mesh.set_level(base + static_cast<std::uint32_t>(37 * i));
    const std::vector<std::uint16_t> indices(
        down.mesh.indices().begin(), down.mesh.indices().begin() + 3 * down.mesh.triangle_count());
    EXPECT_EQ(indices, seen[i]);
  }
}

TEST(PackWriter, FeaturePointsStayWhereTheyAre) {
  const Character c = character();
  const Loaded pack(write_pack(c));
  Live live(pack.source(0));
  const pack::FeaturePoint* p = pack::find_feature_point(pack.loader.view(), 2, 10);
  ASSERT_NE(p, nullptr);
  for (const std::uint32_t level : {0u, 200u, 800u, 5000u}) {
    live.mesh.set_level(level);
    EXPECT_EQ(live.mesh.dynamic()[p->vertex].position_m, c.feature_points[0].position_m);
  }
}

TEST(PackWriter, MovesFollowTheSurface) {
  const Loaded pack(write_pack(character()));
  const pack::View& view = pack.loader.view();
  std::size_t checked = 0;
  double error = 0;
  for (std::uint32_t v = 0; v < view.versions.size(); ++v)
    for (std::uint32_t m = view.fat_first[v]; m < view.fat_first[v + 1]; ++m, ++checked)
      error += std::abs(static_cast<float>(view.fat_moves[m].d[1]) * pack::kMoveStep_m -
                        0.01f * view.versions[v].position_m[1] / 0.1f);
  EXPECT_GT(checked, 300u);
  // Linear over the sphere, so that blending keeps it but for vertices that stand off the surface
  // from which they take it: all of 88 triangles round a ball, hardly any of 1000.
  EXPECT_LT(error / static_cast<double>(checked), 1e-4);
}

TEST(PackWriter, SameCharacterSameBytes) {
  EXPECT_EQ(write_pack(character()), write_pack(character()));
}

TEST(PackWriter, RefusesWhatTheFormatCannotHold) {
  Character c = character();
  c.images[0].width = 200;
  EXPECT_THROW((void)write_pack(c), std::runtime_error);
  c = character();
  c.feature_points[0].vertex = 1000000;
  EXPECT_THROW((void)write_pack(c), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::bake
