// The whole program as a service that others watch and drive: killed again and again, with hostile
// clients, with a clock that jumps, and how soon a press shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "core/base/random.h"
#include "tests/golden/program/background.h"

namespace caryatid::golden {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Service : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = fresh_folder("service"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::unique_ptr<Background> start(std::vector<std::string> arguments,
                                    const std::vector<std::string>& environment = {}) {
    arguments.insert(arguments.end(), {"--display", "none", "--audio", "null"});
    return std::make_unique<Background>(arguments, environment, folder_ / "log");
  }
  static double number(const std::string& json, const std::string& name) {
    const std::size_t at = json.find("\"" + name + "\":");
    return at == std::string::npos ? -1.0 : std::atof(json.c_str() + at + name.size() + 3);
  }
  std::filesystem::path folder_;
};

// Whenever it dies, what it remembers is whole: as it was, or with this start counted.
TEST_F(Service, KilledAtAnyMomentItRemembersItsStarts) {
  Random random(7);
  const std::string state = (folder_ / "state").string();
  unsigned long long before = 0;
  for (int i = 0; i < 20; ++i) {
    auto kiosk = start({"--state", folder_.string()});
    std::this_thread::sleep_for(std::chrono::milliseconds(random.next() % 400));
    kiosk->kill(SIGKILL);
    (void)kiosk->exit_status();
    EXPECT_THAT(kiosk->output(), Not(HasSubstr("damaged"))) << "at start " << i;
    const std::string text = content(state);
    unsigned long long starts = 0;
    if (!text.empty()) {
      ASSERT_EQ(std::sscanf(text.c_str(), "caryatid-state 1 starts %llu", &starts), 1) << text;
    }
    EXPECT_GE(starts, before);
    EXPECT_LE(starts, before + 1);
    before = starts;
  }
  auto kiosk = start({"--state", folder_.string(), "--duration", "0.2"});
  (void)kiosk->exit_status();
  EXPECT_THAT(content(state), HasSubstr("starts " + std::to_string(before + 1) + "\n"));
  EXPECT_THAT(content(state), HasSubstr("running 0")) << "an orderly end is remembered too";
}

TEST_F(Service, HostileClientsCostNobodyAFrame) {
  const std::filesystem::path path = folder_ / "control";
  auto kiosk = start({"--control", path.string()});
  const double before = [&] {
    ControlClient first(path);
    return number(first.ask("status"), "frames");
  }();
  ASSERT_GE(before, 0.0) << kiosk->output();
  // One never ends its line, one sends noise, one asks and never reads, the rest just stay.
  const std::string endless(256 * 1024, 'x');
  Random random(11);
  std::vector<std::unique_ptr<ControlClient>> hostile;
  for (int i = 0; i < 3; ++i) hostile.push_back(std::make_unique<ControlClient>(path));
  for (int i = 0; i < 3; ++i)
    ::fcntl(hostile[static_cast<std::size_t>(i)]->descriptor(), F_SETFL, O_NONBLOCK);
  for (int round = 0; round < 50; ++round) {
    (void)hostile[0]->send(endless);
    std::string noise;
    for (int b = 0; b < 500; ++b) noise += static_cast<char>(random.next());
    (void)hostile[1]->send(noise);
    for (int b = 0; b < 50; ++b) (void)hostile[2]->send("status\n");
    std::vector<std::unique_ptr<ControlClient>> crowd;
    for (int c = 0; c < 20; ++c) crowd.push_back(std::make_unique<ControlClient>(path));
  }
  // Frames went on, and who comes now is answered.
  ControlClient good(path);
  double after = 0.0;
  EXPECT_TRUE(wait_until([&] {
    after = number(good.ask("status"), "frames");
    return after > before + 10.0;
  }));
  EXPECT_EQ(good.ask("feel joy"), "ok");
  EXPECT_THAT(good.ask("dance"), HasSubstr("error: "));
  EXPECT_TRUE(wait_until(
      [&good] { return good.ask("status").find("\"emotion\":\"joy\"") != std::string::npos; }));
  const std::string last = good.ask("status");
  EXPECT_EQ(number(last, "allocations_since_seal"), 0.0) << last;
  kiosk->kill(SIGTERM);
  EXPECT_EQ(kiosk->exit_status(), 0);
}

// The wall clock jumps by years, back and forth, as when a board without a battery finds the time:
// it rules opening hours and texts, and nothing else.
TEST_F(Service, AWallClockThatJumpsIsNotFelt) {
  if (std::string(CARYATID_FAKE_CLOCK).empty())
    GTEST_SKIP() << "not with a sanitizer's own preload";
  auto kiosk = start({"--duration", "3", "--metrics", (folder_ / "m").string()},
                     {"LD_PRELOAD=" CARYATID_FAKE_CLOCK});
  EXPECT_EQ(kiosk->exit_status(), 0) << kiosk->output();
  EXPECT_THAT(kiosk->output(), HasSubstr(" 0 allocations after the seal"));
  EXPECT_THAT(kiosk->output(), HasSubstr("the clock jumped")) << "the preload was not used";
  // The kiosk's own time only ever grew, frame by frame.
  const std::string text = content(folder_ / "m");
  double time_s = -1.0;
  int frames = 0;
  for (std::size_t at = text.find("\"time_s\":"); at != std::string::npos;
       at = text.find("\"time_s\":", at + 1), ++frames) {
    const double next_s = std::atof(text.c_str() + at + 9);
    EXPECT_GE(next_s,
              time_s);  // Frames that catch up after a stall share a tenth of a millisecond.
    EXPECT_LT(next_s, time_s + 3.5);
    time_s = next_s;
  }
  EXPECT_GT(frames, 3);
}

// From the edge to the flip that shows it, as --metrics says, on the modelled board and clock: an
// edge falls anywhere between two frames, is seen by the next and shown when that one is over.
TEST_F(Service, APressShowsWithinTwoFrames) {
  for (const int fps : {30, 60}) {
    std::string script;
    Random random(static_cast<std::uint64_t>(fps));
    double at_s = 1.0;
    for (int press = 0; press < 100; ++press, at_s += 0.2) {
      at_s += 1e-3 * static_cast<double>(random.next() % 100);
      char line[64];
      std::snprintf(line, sizeof line, "%.4f joy down\n%.4f joy up\n", at_s, at_s + 0.05);
      script += line;
    }
    write_file(folder_ / "script", script);
    const Outcome run =
        run_program("--display none --audio null --virtual-clock --duration 40 --target-fps " +
                    std::to_string(fps) + " --script " + (folder_ / "script").string() +
                    " --metrics " + (folder_ / "m").string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    const std::string text = content(folder_ / "m");
    const double frame_ms = 1000.0 / fps;
    double most_ms = 0.0, sum_ms = 0.0;
    int presses = 0;
    for (std::size_t at = text.find("\"reaction_ms\":"); at != std::string::npos;
         at = text.find("\"reaction_ms\":", at + 1), ++presses) {
      const double ms = std::atof(text.c_str() + at + 14);
      EXPECT_GE(ms, frame_ms - 1e-3);
      most_ms = std::max(most_ms, ms);
      sum_ms += ms;
    }
    EXPECT_EQ(presses, 100);
    EXPECT_LE(most_ms, 2.0 * frame_ms + 1e-3);
    EXPECT_GT(most_ms, 1.5 * frame_ms) << "edges fell everywhere between two frames";
    std::printf("%d frames/s: press to flip %.1f ms, at most %.1f ms (two frames: %.1f)\n", fps,
                sum_ms / presses, most_ms, 2.0 * frame_ms);
  }
}

}  // namespace
}  // namespace caryatid::golden
