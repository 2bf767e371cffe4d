// Wrong usage: exit code 2, one line, and where the help stands.
#include "tests/tool/tool.h"

namespace caryatid::tool_test {
namespace {

TEST_F(Tool, NumbersAreFiniteAndInRange) {
  const std::string render = "render --pack " + pack_ + " -o a.png ";
  for (const std::string& arguments : {std::string("fba track -o a.fap --seconds nan"),
                                       std::string("fba track -o a.fap --fps nan"),
                                       std::string("fba rate t.fap --fps 1e9"),
                                       std::string("fba rate t.fap --fps -5"),
                                       std::string("fba rate t.fap --fps nan"),
                                       std::string("fba rate t.fap --intra -7"),
                                       std::string("fba encode t.fap -o a.fba --fps nan"),
                                       std::string("fba encode t.fap -o a.fba --kbps nan"),
                                       std::string("fba encode t.fap -o a.fba --kbps 0"),
                                       std::string("fba encode t.fap -o a.fba --kbps -1"),
                                       std::string("gait synth -o a.bap --fps nan"),
                                       std::string("gait synth -o a.bap --mood nan,0"),
                                       std::string("gait synth -o a.bap --mood 2,2"),
                                       std::string("simplify s.obj --max-error nan -o b.obj"),
                                       std::string("simplify s.obj --max-error 0 -o b.obj"),
                                       std::string("speech bake Hi -o a --rate nan"),
                                       render + "--set 3=nan",
                                       render + "--set 3=1e30",
                                       render + "--set 2=1",
                                       render + "--phase nan",
                                       render + "--size 100x100x",
                                       render + "--size 3x",
                                       render + "--emotion joy:nan",
                                       render + "--lod 0",
                                       render + "--view behind",
                                       render + "--fap t.fap@x",
                                       render + "--fap t.fap@-1"}) {
    refuses(arguments, 2, "--help");
  }
}

TEST_F(Tool, AFrameThatIsNotThereIsRefused) {
  refuses("render --pack " + pack_ + " -o a.png --fap t.fap@25", 1, "has 25 frames");
}

TEST_F(Tool, TextsSaySomething) {
  refuses("speech bake '' -o a", 2, "nothing to say");
  refuses("speech bake \"$(printf 'a\\377b')\" -o a", 2, "byte 2");
  refuses("speech contacts --pack " + pack_ + " --text ' '", 2, "nothing to say");
  refuses("clip --pack " + pack_ + " --text '' -o a.png", 2, "nothing to say");
}

TEST_F(Tool, TheHelpOfTheSubcommandIsNamed) {
  refuses("fba encode --foo", 2, "see caryatid-tool fba encode --help");
  refuses("gait synth", 2, "see caryatid-tool gait synth --help");
  refuses("bake", 2, "see caryatid-tool bake --help");
  refuses("simplify s.obj -o b.obj", 2, "see caryatid-tool simplify --help");
  refuses("gait synth --run --mood sad -o a.bap", 2, "excludes");
  const Outcome version = run("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.output.starts_with("caryatid-tool ")) << version.output;
}

TEST_F(Tool, AVoiceThatSaysNothingIsNamed) {
  write("mute", "#!/bin/sh\nexec sleep 600\n");
  std::filesystem::permissions(folder_ / "mute", std::filesystem::perms::owner_all);
  refuses("speech bake Hi -o a --voice ./mute", 1, "./mute: said nothing for 8 s");
  EXPECT_FALSE(exists("a.wav"));
}

TEST_F(Tool, ThereIsSomethingToMeasure) {
  const auto voice = std::filesystem::path(CARYATID_TOOL).parent_path() / "caryatid-voice";
  if (!std::filesystem::exists(voice)) GTEST_SKIP() << "needs caryatid-voice; build all targets";
  const std::string text = "'Press five for maps.'";
  ASSERT_EQ(run("speech bake " + text + " -o a").exit_code, 0);
  write("m.jsonl", "");
  refuses("speech sync --audio a.wav --metrics m.jsonl --text " + text, 1, "nothing to measure");
  refuses("speech sync --audio a.wav --metrics m.jsonl --text 'Where are the stairs?'", 1,
          "a.wav: does not hold the sound");
}

TEST_F(Tool, PhonemesAreIpa) {
  write("p", "p a _\nt #\n");
  write("a.wav", "RIFF");
  refuses("speech time a.wav --phones p -o b", 1, "a.wav: ");
  write("a.flac", "RIFF");
  refuses("speech time a.flac --phones p -o b", 1, "a.flac: is no FLAC file");
  std::string wav(
      "RIFF\x24\x10\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x40\x1F\0\0\x80\x3E\0\0\2\0\x10\0data"
      "\0\x10\0\0",
      44);
  write("a.wav", wav + std::string(4096, '\5'));
  refuses("speech time a.wav --phones p -o b", 1, "p:2: '#' is no phoneme");
  write("p", "p a\x02 \xff\n");
  refuses("speech time a.wav --phones p -o b", 1, "p:1: 'a\\x02' is no phoneme");
  write("p", "p a _ t a\n");
  EXPECT_EQ(run("speech time a.wav --phones p -o b").exit_code, 0);
}

TEST_F(Tool, BytesOfAFileDoNothingToTheTerminal) {
  write("g.epf", "\x1b[31mred 1\n");
  refuses("fba encode t.fap -o a.fba --epf g.epf", 1, "\\x1B[31mred");
}

}  // namespace
}  // namespace caryatid::tool_test
