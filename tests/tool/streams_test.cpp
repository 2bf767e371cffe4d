// Streams and texts that are damaged or promise what they do not hold: said, and how much is lost.
#include "tests/tool/tool.h"

namespace caryatid::tool_test {
namespace {

// A frame of FAP 3 alone.
std::string frame(int number) {
  std::string mask = "0 0 1";
  for (int fap = 4; fap <= 68; ++fap) mask += " 0";
  return mask + "\n" + std::to_string(number) + " 100\n";
}

TEST_F(Tool, HeadersAndNumbersThatDoNotFitAreSaid) {
  const auto notes = [&](const std::string& text) {
    write("a.fap", text);
    const Outcome got = run("fba encode a.fap -o a.fba");
    EXPECT_EQ(got.exit_code, 0) << got.output;
    return got.output;
  };
  EXPECT_EQ(notes("2.1 a 25 2\n" + frame(0) + frame(1)).find("a.fap:"), std::string::npos);
  EXPECT_EQ(notes("2.1 a 25 2\n" + frame(1) + frame(2)).find("a.fap:"), std::string::npos);
  EXPECT_NE(notes("2.1 a 25 99999\n" + frame(0)).find("a.fap:1: the header promises 99999"),
            std::string::npos);
  EXPECT_NE(notes("2.1 a 25 1\n" + frame(5)).find("a.fap:3: frame 1 is numbered 5"),
            std::string::npos);
  EXPECT_NE(notes("2.1 a 25 2\n" + frame(0) + frame(0)).find("a.fap:5: frame 2 is numbered 0"),
            std::string::npos);
}

TEST_F(Tool, WhatADamagedStreamLosesIsSaid) {
  ASSERT_EQ(run("fba track -o long.fap --seconds 8").exit_code, 0);
  ASSERT_EQ(run("fba encode long.fap -o long.fba --intra 25").exit_code, 0);
  const std::string whole = content("long.fba");
  const Outcome sound = run("fba decode long.fba -o sound.fap");
  EXPECT_EQ(sound.exit_code, 0);
  EXPECT_EQ(sound.output, "");
  write("cut.fba", whole.substr(0, whole.size() / 2));
  const Outcome cut = run("fba decode cut.fba -o cut.fap");
  EXPECT_EQ(cut.exit_code, 0);
  EXPECT_NE(cut.output.find("are lost; that is the rest"), std::string::npos) << cut.output;
  std::string damaged = whole;
  for (std::size_t i = 0; i < 4; ++i) damaged[whole.size() / 2 + i] ^= 0x5A;
  write("damaged.fba", damaged);
  const Outcome hit = run("fba decode damaged.fba -o damaged.fap");
  EXPECT_EQ(hit.exit_code, 0);
  EXPECT_NE(hit.output.find("are lost; decoding goes on there"), std::string::npos) << hit.output;
}

}  // namespace
}  // namespace caryatid::tool_test
