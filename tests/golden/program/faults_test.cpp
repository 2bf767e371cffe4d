// The whole program with something missing, full, damaged or wrong: it says what and goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/golden/program/background.h"
#include "tests/golden/program/pixels.h"

namespace caryatid::golden {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Faults : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = fresh_folder("faults"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Runs it for a moment, on the real clock, without a screen.
  Outcome run(const std::string& arguments, const std::string& before = "") {
    return run_program("--display none --duration 0.5 " + arguments, before);
  }
  // It went on to its end, and said `words`.
  static void expect_told(const Outcome& run, const std::string& words) {
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr(words));
    EXPECT_THAT(run.output, HasSubstr(" 0 allocations after the seal")) << run.output;
  }
  std::string config(const std::string& toml) {
    return " --config " + write_file(folder_ / "kiosk.toml", toml).string();
  }

  std::filesystem::path folder_;
};

TEST_F(Faults, NoGpioChip) {
  const Outcome missing =
      run("--audio null" +
          config("[[button]]\nname = 'a'\ngpio = { chip = 'gpiochip77', offset = 3 }\n"));
  expect_told(missing, "gpiochip77");
  EXPECT_THAT(missing.output, HasSubstr("going on without it"));
  EXPECT_THAT(missing.output, HasSubstr("--list-hardware")) << "how to find the right one";
}

TEST_F(Faults, NoHidDevice) {
  const Outcome missing = run("--audio null" + config("[[hid]]\nvendor = 0xfffe\nproduct = 0xfffd\n"
                                                      "[[button]]\nname = 'a'\nkey = 'a'\n"));
  if (missing.output.find("no USB buttons") != std::string::npos)
    GTEST_SKIP() << "built without hidapi";
  expect_told(missing, "a USB button device is not there; waiting for it");
}

TEST_F(Faults, NoSound) {
  const std::string nothing = "ALSA_CONFIG_PATH=/dev/null ";
  expect_told(run("--audio auto --say Hello", nothing), " frames in ");
  expect_told(run("--audio alsa:nowhere --say Hello", nothing), "nowhere");
}

TEST_F(Faults, NoDisplay) {
  // A folder without cards in place of /dev/dri would need root; a machine with a screen skips.
  if (std::filesystem::exists("/dev/dri/card0") || std::filesystem::exists("/dev/dri/card1"))
    GTEST_SKIP() << "this machine has a graphics card";
  const Outcome drm = run_program("--display drm --duration 0.5");
  EXPECT_EQ(drm.exit_code, 1);
  EXPECT_THAT(drm.output, HasSubstr("card"));
  const Outcome window =
      run_program("--display window --duration 0.5", "env -u DISPLAY -u WAYLAND_DISPLAY ");
  EXPECT_EQ(window.exit_code, 1);
  EXPECT_THAT(window.output, HasSubstr("--display surfaceless"));
}

// The notice stands over a quarter of the picture; without a fault that place is bare.
TEST_F(Faults, ADamagedPackIsOutOfOrder) {
  const auto cut = write_file(folder_ / "cut.pack", content(kBuiltin).substr(0, 5000));
  const std::string screen =
      " --display surfaceless --virtual-clock --duration 1 --target-fps 5 --frames-every 4 --size "
      "400x240"
      " --audio null --frames-out ";
  const auto dark = [](const std::filesystem::path& picture) {
    const Pixels p = read_png(picture);
    int count = 0;
    for (int y = 0; y < p.height / 2; ++y)
      for (int x = p.width / 2; x < p.width; ++x) count += p.rgb[p.at(x, y)] < 60 ? 1 : 0;
    return static_cast<double>(count) / (p.width * p.height);
  };
  const Outcome sound = run_program(screen + (folder_ / "sound").string());
  EXPECT_EQ(sound.exit_code, 0) << sound.output;
  for (const std::string& pack : {cut.string(), (folder_ / "none.pack").string()}) {
    const Outcome damaged =
        run_program(screen + (folder_ / "damaged").string() + " --pack " + pack);
    expect_told(damaged, "the built-in face stands in, out of order");
    EXPECT_LT(dark(folder_ / "sound/frame_00004.png"), 0.02);
    EXPECT_GT(dark(folder_ / "damaged/frame_00004.png"), 0.04);
  }
}

// Left alone the picture fades out; a press lights it again in its frame.
TEST_F(Faults, AScreenThatNobodyLooksAtGoesDarkAndWakesAtAPress) {
  const auto script = write_file(folder_ / "script", "7 a down\n7.1 a up\n");
  const Outcome run = run_program(
      "--display surfaceless --size 64x48 --audio null --virtual-clock --target-fps 5 --duration 8 "
      "--lod 500 --frames-out " +
      (folder_ / "out").string() + " --script " + script.string() +
      config("[screen]\noff_after_s = 1\n[[button]]\nname = 'a'\n"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const auto light = [this](int frame) {
    char name[32];
    std::snprintf(name, sizeof name, "out/frame_%05d.png", frame);
    const Pixels p = read_png(folder_ / name);
    double sum = 0.0;
    for (const unsigned char c : p.rgb) sum += c;
    return p.rgb.empty() ? -1.0 : sum / static_cast<double>(p.rgb.size());
  };
  EXPECT_GT(light(0), 60.0);
  for (int frame = 5; frame < 21; ++frame) EXPECT_LE(light(frame), light(frame - 1) + 2.0) << frame;
  for (int frame = 22; frame < 35; ++frame) {
    EXPECT_GE(light(frame), 0.0);
    EXPECT_LT(light(frame), 1.0) << frame;
  }
  EXPECT_GT(light(35), 60.0);
}

// A deployer's own notice takes the place of the built-in one, and a wrong one does not.
TEST_F(Faults, TheNoticeMayBeTheDeployersOwn) {
  const std::string arguments =
      "--audio null --pack none.pack" + config("[[button]]\nname = 'a'\n");
  write_file(folder_ / "out_of_order.toml", "always_shown = 3\n[[page]\n");
  expect_told(run(arguments), "out_of_order.toml:2: ");
  write_file(folder_ / "out_of_order.toml",
             "always_shown = true\n[[page]]\nname = 'oops'\ntitle = 'oops.title'\n");
  const Outcome own = run(arguments);
  EXPECT_EQ(own.exit_code, 0);
  EXPECT_THAT(own.output, Not(HasSubstr("out_of_order.toml:2: "))) << own.output;
}

TEST_F(Faults, AProgrammeThatIsTooLargeIsReplacedByTheOneThatWorkedLast) {
  const std::string state = " --audio null --state " + folder_.string();
  const std::string good = "[[button]]\nname = 'a'\n";
  EXPECT_EQ(run(config(good) + state).exit_code, 0);
  std::string large = "languages = ['en']\n" + good;
  std::string texts;
  for (int page = 0; page < 60; ++page) {
    large += "[[page]]\nname = 'p" + std::to_string(page) + "'\n";
    texts += "[p" + std::to_string(page) + "]\nbody = '" + std::string(1900, 'x') + " " +
             std::to_string(page) + "'\n";
  }
  std::filesystem::create_directories(folder_ / "texts");
  write_file(folder_ / "texts/en.toml", texts);
  const Outcome refused = run(config(large) + state);
  expect_told(refused, "worked last stands in");
  EXPECT_EQ(content(folder_ / "last_good/kiosk.toml"), good) << "the bad one was kept as good";
}

// A disk of 64 KiB in a name space of its own.
TEST_F(Faults, AFullDisk) {
  const std::string disk = folder_.string();
  if (std::system("unshare -Urm true 2>/dev/null") != 0)
    GTEST_SKIP() << "this system lets no user mount";
  const std::string before = "unshare -Urm sh -c 'mount -t tmpfs -o size=64k t " + disk +
                             " && { cat /dev/zero >" + disk + "/fill; true; } 2>/dev/null; exec ";
  const std::string after = " --display none --audio null --duration 7 --state " + disk +
                            " --status " + disk + "/status --metrics " + disk + "/metrics'";
  Outcome full;
  std::FILE* pipe = popen((before + CARYATID_PROGRAM + after + " 2>&1").c_str(), "r");
  char piece[512];
  while (std::fgets(piece, sizeof piece, pipe) != nullptr) full.output += piece;
  full.exit_code = WEXITSTATUS(pclose(pipe));
  expect_told(full, "status: No space left on device; the kiosk goes on without it");
  EXPECT_THAT(full.output, HasSubstr("metrics: can't be written any more; make room"));
}

}  // namespace
}  // namespace caryatid::golden
