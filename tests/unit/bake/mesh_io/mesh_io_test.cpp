#include "assets/bake/mesh_io/mesh_io.h"

#include <gtest/gtest.h>

#include "assets/bake/mesh_io/repair.h"
#include "tests/unit/bake/simplify/shapes.h"

namespace caryatid::bake {
namespace {

std::string error_of(std::string_view text, MeshFormat format) {
  try {
    (void)parse_mesh(text, format, "m");
  } catch (const MeshError& e) {
    return e.what();
  }
  return "";
}

TEST(MeshIo, WhatIsWrittenReadsBackBitForBit) {
  const Surface s = ball(5, 0.123);
  for (const MeshFormat f : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply}) {
    const Surface back = parse_mesh(format_mesh(s, f), f, "m");
    EXPECT_EQ(back.position, s.position);
    EXPECT_EQ(back.triangles, s.triangles);
  }
}

TEST(MeshIo, ObjTakesPolygonsSlashesAndNegativeNumbers) {
  const Surface s =
      parse_mesh("# c\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0\nvt 0 0\nf -4//1 2/1/1 3 4 # x\r\n",
                 MeshFormat::obj, "m");
  EXPECT_EQ(s.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(MeshIo, PlyTextAndBigEndian) {
  const Surface s = parse_mesh(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement face 1\n"
      "property list uchar int vertex_index\nend_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
      MeshFormat::ply, "m");
  EXPECT_EQ(s.triangles.size(), 1u);
  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\n"
      "property short z\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n";
  big += std::string(
      "\0\0\0\0\0\0"
      "\0\1\0\0\0\0"
      "\0\0\1\2\0\0"
      "\3\0\0\0\1\0\2",
      25);
  const Surface b = parse_mesh(big, MeshFormat::ply, "m");
  EXPECT_EQ(b.position[2], Vec3d(0, 258, 0));
  EXPECT_EQ(b.triangles[0], (Triangle{0, 1, 2}));
}

TEST(MeshIo, NamesTheOffendingElement) {
  EXPECT_EQ(error_of("v 0 0 0\nv 1 x 0\n", MeshFormat::obj), "m:2: \"x\" is not a finite number");
  EXPECT_EQ(error_of("v 0 0 nan\n", MeshFormat::obj), "m:1: \"nan\" is not a finite number");
  EXPECT_EQ(error_of("v 0 0 0\nf 1 1 9\n", MeshFormat::obj),
            "m:2: vertex 9 is not there; the file has 1");
  EXPECT_EQ(error_of("v 0 0 0\n", MeshFormat::obj), "m:1: the file has no faces");
  EXPECT_EQ(error_of("OFF\n9999999 1 0\n0 0 0\n", MeshFormat::off),
            "m:2: a count of 9999999 is more than the file can hold");
  EXPECT_EQ(error_of("OFF\n1 1 0\n0 0 0\n3 0 0 7\n", MeshFormat::off),
            "m:4: face 0 names vertex 7 of 1");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n0\n",
                     MeshFormat::ply),
            "m:6: vertex 1: the file ends before it");
  EXPECT_EQ(error_of("solid\n", MeshFormat::ply), "m:1: this is no PLY file");
}

TEST(Repair, ReportsWhatItDid) {
  Surface s = grid(2, 2, 0.3);
  s.position.push_back({9, 9, 9});      // Unreferenced.
  s.position.push_back(s.position[0]);  // Duplicate, and used:
  s.triangles[0][0] = static_cast<std::uint32_t>(s.position.size() - 1);
  s.triangles.push_back({0, 0, 1});                 // Degenerate.
  s.triangles.push_back(s.triangles[3]);            // Duplicate.
  std::swap(s.triangles[5][0], s.triangles[5][1]);  // Turned round.
  RepairReport report;
  const Surface out = repair_surface(s, &report);
  EXPECT_EQ(report.unreferenced_vertices, 1u);
  EXPECT_EQ(report.duplicate_vertices, 1u);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.duplicate_triangles, 1u);
  EXPECT_EQ(report.flipped_triangles, 1u);
  EXPECT_EQ(out.triangles.size(), 8u);
  EXPECT_EQ(facts_of(out).border_loops, 1u);
}

TEST(Repair, CutsAFinOffAnEdge) {
  Surface s = grid(1, 2, 0.0);
  s.position.push_back({1, 0.5, 3});
  s.triangles.push_back({1, 4, 6});  // A third triangle on the edge 1-4.
  RepairReport report;
  const Surface out = repair_surface(s, &report);
  EXPECT_EQ(report.topology.non_manifold_edges, 1u);
  EXPECT_EQ(out.triangles.size(), 5u);
  EXPECT_GE(facts_of(out).components, 2u);
}

// Every reader: nothing, or next to nothing, is an error with a line, not a mesh.
TEST(MeshIo, EmptyFilesAreRefused) {
  for (const MeshFormat f : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply})
    for (const char* text : {"", "\n", "OFF\n0 0 0\n", "ply\n"})
      EXPECT_EQ(error_of(text, f).substr(0, 2), "m:") << text;
}

// Counts are held against the bytes that are there before memory is taken for them.
TEST(MeshIo, HugeCountsTakeNoMemory) {
  EXPECT_NE(error_of("OFF\n4294967295 4294967295 0\n", MeshFormat::off), "");
  EXPECT_NE(error_of("OFF\n99999999999999999999 1 0\n", MeshFormat::off), "");
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string text = std::string("ply\nformat ") + format +
                             " 1.0\nelement vertex 4000000000\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 4000000000\n"
                             "property list uchar int vertex_indices\nend_header\n";
    EXPECT_NE(error_of(text, MeshFormat::ply), "") << format;
  }
  EXPECT_NE(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967299\n", MeshFormat::obj), "");
}

TEST(Repair, TwoPiecesStayTwo) {
  Surface s = ball(4, 0.0);
  const Surface other = s;
  const auto first = static_cast<std::uint32_t>(s.position.size());
  for (const Vec3d& p : other.position) s.position.push_back(p + Vec3d(3, 0, 0));
  for (const Triangle& t : other.triangles)
    s.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  RepairReport report;
  const Surface out = repair_surface(s, &report);
  EXPECT_EQ(report.text(), "");
  EXPECT_EQ(facts_of(out).components, 2u);
  CollapseOptions options;
  options.target_triangles = 20;
  EXPECT_EQ(facts_of(collapse_edges(out, options)).components, 2u);
}

// Two tetrahedra that touch in one vertex: each stays a surface of its own.
TEST(Repair, AVertexOfTwoFansIsSplit) {
  Surface s = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}}};
  RepairReport report;
  const Surface out = repair_surface(s, &report);
  EXPECT_EQ(report.topology.non_manifold_vertices, 1u);
  EXPECT_EQ(out.position.size(), 8u);
  EXPECT_EQ(facts_of(out).components, 2u);
  EXPECT_NE(report.text(), "");
}

// Nothing of a repaired mesh is lost without a word: what the report does not name is still there.
TEST(Repair, OrientationOfAWholeComponentIsLeftAsItIs) {
  Surface s = ball(5, 0.0);
  for (Triangle& t : s.triangles) std::swap(t[1], t[2]);
  RepairReport report;
  const Surface out = repair_surface(s, &report);
  EXPECT_EQ(report.flipped_triangles, 0u);
  EXPECT_EQ(out.triangles.size(), s.triangles.size());
  EXPECT_LT(facts_of(out).volume, 0.0);
}

TEST(Repair, AMeshOfDegenerateFacesEndsEmpty) {
  Surface s = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}, {0, 0, 1}}};
  RepairReport report;
  EXPECT_TRUE(repair_surface(s, &report).triangles.empty());
  EXPECT_EQ(report.degenerate_triangles, 2u);
  CollapseOptions options;
  EXPECT_TRUE(collapse_edges({}, options).triangles.empty());
}

}  // namespace
}  // namespace caryatid::bake
