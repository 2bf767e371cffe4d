#include "firmware-app/status.h"

#include <gtest/gtest.h>
#include <time.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "platform/files/background_writer.h"

namespace caryatid::app {
namespace {

KioskStatus busy() {
  KioskStatus s;
  s.uptime_s = 12.5;
  s.starts = 3;
  s.frames = 375;
  s.presses = 7;
  s.rejected_edges = 40;
  s.emotion = emotion::Emotion::joy;
  s.has_temperature = true;
  s.temperature_celsius = 61.2;
  s.under_voltage = true;
  s.start.picture_s = 0.125;
  s.start.person_s = 0.5;
  return s;
}

TEST(Status, JsonReadsBackAndHasNoNewline) {
  char text[2048];
  const std::string_view line = format_json(busy(), text);
  EXPECT_EQ(line.find('\n'), std::string_view::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json["frames"], 375);
  EXPECT_EQ(json["emotion"], "joy");
  EXPECT_EQ(json["rejected_edges"], 40);
  EXPECT_EQ(json["under_voltage"], true);
  EXPECT_EQ(json["picture_s"], 0.125);
  EXPECT_EQ(json["person_s"], 0.5);
  EXPECT_NEAR(json["temperature_celsius"].get<double>(), 61.2, 1e-9);
}

TEST(Status, WithoutASensorThereIsNoTemperature) {
  char text[4096];
  EXPECT_TRUE(nlohmann::json::parse(format_json({}, text))["temperature_celsius"].is_null());
  EXPECT_FALSE(format_prometheus({}, text).empty());
  EXPECT_EQ(format_prometheus({}, text).find("temperature"), std::string_view::npos);
}

// Text format 0.0.4: "# HELP name text", "# TYPE name kind", "name value", each name once.
TEST(Status, PrometheusTextHasATypeAndAValueForEachName) {
  char text[4096];
  std::istringstream lines{std::string(format_prometheus(busy(), text))};
  int metrics = 0;
  for (std::string help, hash, type, name, kind, again;
       std::getline(lines, help) && lines >> hash >> type >> name >> kind; ++metrics) {
    double value = -1.0;
    ASSERT_TRUE(lines >> again >> value);
    EXPECT_EQ(lines.get(), '\n');
    EXPECT_TRUE(help.starts_with("# HELP " + name + " ") && help.ends_with(".")) << help;
    EXPECT_EQ(hash + type, "#TYPE");
    EXPECT_EQ(name, again);
    EXPECT_EQ(name.ends_with("_total"), kind == "counter") << name;
    EXPECT_GE(value, 0.0);
  }
  EXPECT_EQ(metrics, 20);
}

TEST(Status, TheLongestFitsWhereItMust) {
  KioskStatus s = busy();
  s.starts = s.frames = s.late_frames = s.presses = s.rejected_edges = s.resident_bytes =
      s.arena_bytes = s.allocations_since_seal = ~0ull;
  s.triangles = ~0u;
  s.uptime_s = s.start.picture_s = s.start.person_s = s.cpu_ms = 1e9;
  s.emotion = emotion::Emotion::surprise;
  char text[4096];
  const std::size_t json = format_json(s, text).size();
  EXPECT_GT(json, 0u);
  EXPECT_LT(json, 1023u) << "an answer of the control socket";
  const std::size_t prometheus = format_prometheus(s, text).size();
  EXPECT_GT(prometheus, 0u);
  EXPECT_LE(prometheus, platform::BackgroundWriter::kMaxFileBytes);
}

TEST(Status, NothingIsWrittenInPieces) {
  char text[2048];
  const std::size_t json = format_json(busy(), text).size();
  for (std::size_t n : {std::size_t{1}, std::size_t{50}, json})
    EXPECT_TRUE(format_json(busy(), std::span(text, n)).empty()) << n;
  EXPECT_EQ(format_json(busy(), std::span(text, json + 1)).size(), json);
}

// The kernel's tick is 10 ms and the age is rounded up by at most as much.
TEST(Status, TheAgeOfTheProcessGrowsWithTheClock) {
  const double before_s = process_age_s();
  EXPECT_GT(before_s, 0.0);
  timespec pause{0, 30'000'000};
  nanosleep(&pause, nullptr);
  EXPECT_GE(process_age_s(), before_s + 0.03);
}

TEST(Status, ResidentMemoryIsThatOfThisProcess) {
  const ResidentMemory memory;
  EXPECT_GT(memory.bytes(), 1u << 20);
  EXPECT_LT(memory.bytes(), 1ull << 32);
}

}  // namespace
}  // namespace caryatid::app
