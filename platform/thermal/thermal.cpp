#include "platform/thermal/thermal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace caryatid::platform {
namespace {

// Zones report nonsense while their sensor sleeps; no board that runs is outside of this.
constexpr std::int32_t kColdest_mC = -40'000, kHottest_mC = 150'000;

int open_file(const char* folder, const char* name) {
  char path[256];
  const int size = std::snprintf(path, sizeof path, "%s/%s", folder, name);
  if (size < 0 || static_cast<std::size_t>(size) >= sizeof path) return -1;
  return ::open(path, O_RDONLY | O_CLOEXEC);
}

// The number at the start of a sysfs file; nothing when there is none.
std::optional<std::int64_t> read_number(int file, int base) {
  char text[32];
  const ssize_t size = ::pread(file, text, sizeof text, 0);
  if (size <= 0) return std::nullopt;
  const char* begin = text;
  const char* const end = text + size;
  if (base == 16 && size > 2 && text[0] == '0' && text[1] == 'x') begin += 2;
  std::int64_t value = 0;
  if (std::from_chars(begin, end, value, base).ec != std::errc()) return std::nullopt;
  return value;
}

std::int32_t lower_edge_mC(Heat step, const HeatSteps& steps) {
  switch (step) {
    case Heat::warm:
      return steps.warm_mC;
    case Heat::hot:
      return steps.hot_mC;
    case Heat::critical:
      return steps.critical_mC;
    case Heat::normal:
      break;
  }
  return kColdest_mC;
}

}  // namespace

Heat heat_step(std::int32_t temperature_mC, Heat before, const HeatSteps& steps) {
  const Heat rising = temperature_mC >= steps.critical_mC ? Heat::critical
                      : temperature_mC >= steps.hot_mC    ? Heat::hot
                      : temperature_mC >= steps.warm_mC   ? Heat::warm
                                                          : Heat::normal;
  if (rising >= before) return rising;
  // Falling: down to the highest step whose edge, less the hysteresis, is still below.
  for (Heat step = before; step > rising; step = static_cast<Heat>(static_cast<int>(step) - 1))
    if (temperature_mC > lower_edge_mC(step, steps) - steps.hysteresis_mC) return step;
  return rising;
}

Supply supply_of(std::uint32_t get_throttled) {
  const auto bit = [get_throttled](unsigned n) { return (get_throttled >> n & 1u) != 0; };
  return {bit(0), bit(1), bit(2), bit(3), bit(16)};
}

Heat heat_of(const Supply& supply) {
  if (supply.throttled) return Heat::hot;
  return supply.under_voltage || supply.clock_capped || supply.soft_limit ? Heat::warm
                                                                          : Heat::normal;
}

Thermal::~Thermal() {
  for (const int zone : zones_) ::close(zone);
  if (throttled_ >= 0) ::close(throttled_);
}

Status Thermal::open(const char* sysfs, const HeatSteps& steps) {
  steps_ = steps;
  for (std::size_t i = 0; i < kMaxZones; ++i) {
    char name[64];
    std::snprintf(name, sizeof name, "class/thermal/thermal_zone%zu/temp", i);
    const int zone = open_file(sysfs, name);
    if (zone >= 0) (void)zones_.push(zone);
  }
  throttled_ = open_file(sysfs, "devices/platform/soc/soc:firmware/get_throttled");
  return zones_.empty() ? Status{Code::unsupported} : Status{};
}

Status Thermal::read(ThermalReading* out) {
  if (zones_.empty()) return {Code::unsupported};
  std::optional<std::int32_t> hottest_mC;
  for (const int zone : zones_) {
    const std::optional<std::int64_t> value = read_number(zone, 10);
    if (!value || *value < kColdest_mC || *value > kHottest_mC) continue;
    hottest_mC = std::max(static_cast<std::int32_t>(*value), hottest_mC.value_or(kColdest_mC));
  }
  if (!hottest_mC) return {Code::io};
  heat_ = heat_step(*hottest_mC, heat_, steps_);
  *out = {*hottest_mC, heat_, std::nullopt};
  if (throttled_ < 0) return {};
  const std::optional<std::int64_t> bits = read_number(throttled_, 16);
  if (!bits) return {};
  out->supply = supply_of(static_cast<std::uint32_t>(*bits));
  out->heat = std::max(heat_, heat_of(*out->supply));
  return {};
}

}  // namespace caryatid::platform
