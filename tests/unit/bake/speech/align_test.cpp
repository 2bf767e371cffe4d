// Timing is carried from one voice to another.
#include "assets/bake/speech/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace caryatid::bake {
namespace {

struct Tone {
  double seconds, hz;  // 0 Hz: silence.
};

std::vector<std::int16_t> sing(const std::vector<Tone>& tones, double rate_hz, double loudness,
                               double pitch) {
  std::vector<std::int16_t> out;
  for (const Tone& t : tones)
    for (int i = 0; i < static_cast<int>(t.seconds * rate_hz); ++i) {
      double sum = 0.0;
      for (int harmonic = 1; harmonic <= 3; ++harmonic)
        sum += std::sin(2.0 * std::numbers::pi * t.hz * pitch * harmonic * i / rate_hz) / harmonic;
      out.push_back(static_cast<std::int16_t>(loudness * sum));
    }
  return out;
}

TEST(Align, CarriesEachBoundaryOver) {
  const std::vector<double> known_s{0.3, 0.2, 0.25, 0.2, 0.3}, sung_s{0.5, 0.3, 0.2, 0.45, 0.4};
  const std::vector<double> hz{0.0, 200.0, 700.0, 1800.0, 0.0};
  std::vector<Tone> known, sung;
  for (std::size_t i = 0; i < hz.size(); ++i) {
    known.push_back({known_s[i], hz[i]});
    sung.push_back({sung_s[i], hz[i]});
  }
  const auto a = sing(known, 22050.0, 9000.0, 1.0), b = sing(sung, 44100.0, 3000.0, 1.04);
  const TimeMap map = align({a, 22050}, {b, 44100});
  double from = 0.0, to = 0.0;
  for (std::size_t i = 0; i + 1 < hz.size(); ++i) {
    from += known_s[i];
    to += sung_s[i];
    EXPECT_NEAR(map(from), to, 0.06) << i;
  }
}

TEST(Align, ASoundIsAlignedToItself) {
  const auto a = sing({{0.2, 0}, {0.3, 300}, {0.2, 900}, {0.3, 0}}, 22050.0, 8000.0, 1.0);
  const TimeMap map = align({a, 22050}, {a, 22050});
  for (double t = 0.05; t < 0.95; t += 0.1) EXPECT_NEAR(map(t), t, 0.015);
}

TEST(Align, TimesRise) {
  const auto a = sing({{0.3, 200}, {0.3, 900}}, 22050.0, 8000.0, 1.0);
  const auto b = sing({{0.5, 900}, {0.2, 200}}, 22050.0, 8000.0, 1.0);
  const TimeMap map = align({a, 22050}, {b, 22050});
  double before = -1.0;
  for (double t = 0.0; t < 0.6; t += 0.01) {
    EXPECT_GE(map(t), before);
    before = map(t);
  }
}

TEST(Align, NothingIsRefused) {
  const auto a = sing({{0.3, 200}}, 22050.0, 8000.0, 1.0);
  EXPECT_THROW((void)align({a, 22050}, {{}, 22050}), std::invalid_argument);
}

}  // namespace
}  // namespace caryatid::bake
