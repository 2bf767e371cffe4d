#include "platform/thermal/thermal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace caryatid::platform {
namespace {

namespace fs = std::filesystem;

// A sysfs of our own.
class ThermalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("caryatid-sysfs-" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  void zone(int number, const std::string& text) {
    write("class/thermal/thermal_zone" + std::to_string(number) + "/temp", text);
  }

  fs::path root_;
  Thermal thermal_;
  ThermalReading reading_;
};

TEST_F(ThermalTest, TheHottestZoneCounts) {
  zone(0, "41000\n");
  zone(2, "79500\n");
  ASSERT_TRUE(thermal_.open(root_.c_str()).ok());
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.temperature_mC, 79500);
  EXPECT_EQ(reading_.heat, Heat::hot);
  EXPECT_FALSE(reading_.supply.has_value());
}

TEST_F(ThermalTest, ItFollowsTheFile) {
  zone(0, "50000\n");
  ASSERT_TRUE(thermal_.open(root_.c_str()).ok());
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  zone(0, "90000\n");
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.heat, Heat::critical);
}

TEST_F(ThermalTest, NonsenseAndSleepingSensorsAreSkipped) {
  zone(0, "-274000\n");
  zone(1, "warm\n");
  zone(2, "");
  zone(3, "9999999\n");
  ASSERT_TRUE(thermal_.open(root_.c_str()).ok());
  EXPECT_EQ(thermal_.read(&reading_).code, Code::io);
  zone(2, "30000");
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.temperature_mC, 30000);
}

TEST_F(ThermalTest, ABoardWithoutSensorsIsUnsupported) {
  EXPECT_EQ(thermal_.open(root_.c_str()).code, Code::unsupported);
  EXPECT_EQ(thermal_.read(&reading_).code, Code::unsupported);
}

TEST_F(ThermalTest, TheSupplyOfARaspberryPi) {
  zone(0, "50000\n");
  write("devices/platform/soc/soc:firmware/get_throttled", "50005\n");
  ASSERT_TRUE(thermal_.open(root_.c_str()).ok());
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  ASSERT_TRUE(reading_.supply.has_value());
  EXPECT_TRUE(reading_.supply->under_voltage && reading_.supply->throttled);
  EXPECT_FALSE(reading_.supply->clock_capped || reading_.supply->soft_limit);
  EXPECT_TRUE(reading_.supply->under_voltage_since_boot);
}

TEST_F(ThermalTest, ASlowedClockIsHeatWhateverTheSensorSays) {
  zone(0, "50000\n");
  write("devices/platform/soc/soc:firmware/get_throttled", "50004\n");
  ASSERT_TRUE(thermal_.open(root_.c_str()).ok());
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.heat, Heat::hot);
  write("devices/platform/soc/soc:firmware/get_throttled", "50001\n");  // The supply sags.
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.heat, Heat::warm);
  write("devices/platform/soc/soc:firmware/get_throttled", "50000\n");  // It did, since boot.
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.heat, Heat::normal);
  zone(0, "90000\n");
  ASSERT_TRUE(thermal_.read(&reading_).ok());
  EXPECT_EQ(reading_.heat, Heat::critical);
}

TEST(HeatStep, RisesAtOnceAndFallsBehindTheHysteresis) {
  EXPECT_EQ(heat_step(64'999, Heat::normal), Heat::normal);
  EXPECT_EQ(heat_step(65'000, Heat::normal), Heat::warm);
  EXPECT_EQ(heat_step(83'000, Heat::normal), Heat::critical);
  EXPECT_EQ(heat_step(79'500, Heat::critical), Heat::critical);
  EXPECT_EQ(heat_step(79'000, Heat::critical), Heat::hot);
  EXPECT_EQ(heat_step(61'500, Heat::warm), Heat::warm);
  EXPECT_EQ(heat_step(61'000, Heat::warm), Heat::normal);
  EXPECT_EQ(heat_step(20'000, Heat::critical), Heat::normal);
}

// Property: a reading that swings by less than the hysteresis changes the step at most once.
TEST(HeatStep, SmallSwingsDoNotToggle) {
  for (std::int32_t middle_mC = 50'000; middle_mC < 95'000; middle_mC += 250) {
    Heat heat = heat_step(middle_mC, Heat::normal);
    int changes = 0;
    for (int i = 0; i < 20; ++i) {
      const Heat next = heat_step(middle_mC + (i % 2 == 0 ? 1'900 : -1'900), heat);
      changes += next != heat ? 1 : 0;
      heat = next;
    }
    EXPECT_LE(changes, 1) << middle_mC;
  }
}

}  // namespace
}  // namespace caryatid::platform
