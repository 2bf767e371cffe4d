// Files are looked at before the work: no input is overwritten, nothing is found out too late.
#include "tests/tool/tool.h"

namespace caryatid::tool_test {
namespace {

TEST_F(Tool, NeverWritesOverAnInput) {
  const std::string before = content("s.obj");
  refuses("simplify s.obj --faces 2 -o s.obj", 2, "over the input");
  refuses("simplify s.obj --faces 2 -o b.obj --history s.obj", 2, "over the input");
  refuses("simplify s.obj --faces 2 -o b.obj --report ./s.obj", 2, "over the input");
  std::filesystem::create_symlink("s.obj", folder_ / "link.obj");
  refuses("simplify s.obj --faces 2 -o link.obj", 2, "over the input");
  std::filesystem::create_hard_link(folder_ / "s.obj", folder_ / "hard.obj");
  refuses("simplify s.obj --faces 2 -o hard.obj", 2, "over the input");
  refuses("fba rate t.fap --plot t.fap", 2, ".svg");
  write("w.png", content("s.obj"));
  refuses("render --pack w.png -o w.png", 2, "over the input");
  EXPECT_EQ(content("s.obj"), before);
  EXPECT_FALSE(exists("b.obj"));
}

TEST_F(Tool, NeverWritesAFileTwice) {
  refuses("simplify s.obj --faces 2 -o b.obj --report b.obj", 2, "twice");
  refuses("simplify s.obj --faces 2 -o b.obj --history ./b.obj", 2, "twice");
  refuses("gait synth -o a.bap --plot a.svg --strip ./a.svg", 2, "twice");
}

TEST_F(Tool, OutputsAreLookedAtBeforeTheWork) {
  std::filesystem::create_directory(folder_ / "dir.obj");
  refuses("simplify s.obj --faces 2 -o dir.obj", 1, "names a folder");
  EXPECT_FALSE(exists("dir.obj.part"));
  refuses("gait synth -o a.bap --plot none/x.svg", 1, "there is no folder none");
  refuses("simplify s.obj --faces 2 -o b.obj --report none/r", 1, "there is no folder none");
  refuses("fba rate t.fap --plot none/x.svg", 1, "there is no folder none");
  EXPECT_FALSE(exists("a.bap"));
  EXPECT_FALSE(exists("b.obj"));
}

TEST_F(Tool, AFullDiskIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this machine";
  refuses("simplify s.obj --faces 2 -o b.obj --report /dev/full", 1,
          "/dev/full: cannot be written");
  refuses("fba encode t.fap -o /dev/full", 1, "/dev/full: cannot be written");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(Tool, PicturesOnAFullDiskAreAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this machine";
  refuses("sheet lods --mesh s.obj --cell 64 -o /dev/full", 1, "/dev/full: cannot be written");
}

TEST_F(Tool, OutputsEndAsWhatTheyAre) {
  refuses("render --pack " + pack_ + " -o a.jpg", 2, ".png is written");
  refuses("clip --pack " + pack_ + " --text Hi -o a.gif", 2, ".png is written");
  refuses("plot fap t.fap -o a.png", 2, ".svg is written");
  ASSERT_EQ(run("fba encode t.fap -o t.fba").exit_code, 0);
  refuses("fba decode t.fba -o hello.txt", 2, ".fap or .bap is written");
  refuses("fba decode t.fba -o hello.bap", 1, "has a face and no body");
  EXPECT_EQ(run("fba decode t.fba -o hello.fap").exit_code, 0);
  EXPECT_TRUE(exists("hello.fap"));
}

TEST_F(Tool, InputsThatAreFoldersOrMissingAreNamed) {
  std::filesystem::create_directory(folder_ / "d.fap");
  std::filesystem::create_directory(folder_ / "d.obj");
  refuses("render --pack d.obj -o a.png", 1, "d.obj: is a folder");
  refuses("render --pack " + pack_ + " --fap d.fap -o a.png", 1, "d.fap: is a folder");
  refuses("fba info d.fap", 1, "d.fap: is a folder");
  refuses("fba decode d.fap -o a.fap", 1, "d.fap: is a folder");
  refuses("fba encode d.fap -o a.fba", 1, "d.fap: is a folder");
  refuses("simplify d.obj --faces 2 -o a.obj", 1, "d.obj: is a folder");
  refuses("simplify s.obj --faces 2 -o a.obj --lock d.obj", 1, "d.obj: is a folder");
  refuses("history d.obj --faces 2 -o a.obj", 1, "d.obj: is a folder");
  refuses("bake head s.obj --points d.obj -o a.pack", 1, "d.obj: is a folder");
  refuses("fba rate nope", 1, "nope: there is no such file");
  refuses("simplify nope.obj --faces 2 -o a.obj", 1, "nope.obj: there is no such file");
}

TEST_F(Tool, WhatAMeshLosesIsSaid) {
  const Outcome got = run("simplify s.obj --faces 4 -o b.obj --report r.json");
  EXPECT_EQ(got.exit_code, 0) << got.output;
  EXPECT_NE(got.output.find("left out: 1 texture coordinates"), std::string::npos) << got.output;
  EXPECT_NE(content("r.json").find("left out: 1 texture"), std::string::npos);
}

}  // namespace
}  // namespace caryatid::tool_test
