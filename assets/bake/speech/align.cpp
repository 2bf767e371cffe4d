#include "assets/bake/speech/align.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace caryatid::bake {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::size_t kWindow = 512;  // Of 16 kHz: 32 ms.
constexpr double kRate_hz = 16000.0;
constexpr std::size_t kBands = 20;
constexpr std::size_t kFeatures = kBands + 1;  // And loudness.
using Feature = std::array<float, kFeatures>;

void fourier(std::array<std::complex<double>, kWindow>& x) {
  for (std::size_t i = 1, j = 0; i < kWindow; ++i) {
    std::size_t bit = kWindow / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t length = 2; length <= kWindow; length *= 2) {
    const auto turn = std::polar(1.0, -2.0 * std::numbers::pi / static_cast<double>(length));
    for (std::size_t i = 0; i < kWindow; i += length) {
      std::complex<double> w = 1.0;
      for (std::size_t k = 0; k < length / 2; ++k, w *= turn) {
        const auto a = x[i + k], b = x[i + k + length / 2] * w;
        x[i + k] = a + b;
        x[i + k + length / 2] = a - b;
      }
    }
  }
}

double mel(double hz) { return 2595.0 * std::log10(1.0 + hz / 700.0); }

// Loudness in mel bands, as logarithms.
Feature feature_at(const Sound16& sound, double time_s) {
  std::array<std::complex<double>, kWindow> x{};
  for (std::size_t i = 0; i < kWindow; ++i) {
    const double t = time_s + (static_cast<double>(i) - kWindow / 2.0) / kRate_hz;
    const auto at = static_cast<std::int64_t>(t * sound.rate_hz);
    if (at < 0 || at >= static_cast<std::int64_t>(sound.samples.size())) continue;
    const double window =
        0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kWindow);
    x[i] = window * sound.samples[static_cast<std::size_t>(at)] / 32768.0;
  }
  fourier(x);
  std::array<double, kBands> energy{};
  double all = 0.0;
  const double most = mel(kRate_hz / 2.0);
  for (std::size_t k = 2; k < kWindow / 2; ++k) {
    const double hz = static_cast<double>(k) * kRate_hz / kWindow;
    const auto band = std::min(static_cast<std::size_t>(mel(hz) / most * kBands), kBands - 1);
    energy[band] += std::norm(x[k]);
    all += std::norm(x[k]);
  }
  Feature out{};
  for (std::size_t b = 0; b < kBands; ++b) out[b] = static_cast<float>(std::log(energy[b] + 1e-4));
  out[kBands] = 3.0f * static_cast<float>(std::log(all + 1e-3));  // Silence must meet silence.
  return out;
}

// By band: mean 0, spread 1, so that voices and microphones matter less.
std::vector<Feature> features(const Sound16& sound) {
  if (sound.samples.empty() || sound.seconds() > 600.0)
    throw std::invalid_argument("a sound is empty or longer than ten minutes");
  std::vector<Feature> out;
  for (double t = 0.0; t < sound.seconds(); t += kStep_s) out.push_back(feature_at(sound, t));
  for (std::size_t f = 0; f < kFeatures; ++f) {
    double sum = 0.0, squares = 0.0;
    for (const Feature& x : out) sum += x[f], squares += double{x[f]} * x[f];
    const double n = static_cast<double>(out.size()), mean = sum / n;
    const double spread = std::sqrt(std::max(squares / n - mean * mean, 1e-6));
    const double weight = f == kBands ? 3.0 : 1.0;
    for (Feature& x : out) x[f] = static_cast<float>(weight * (x[f] - mean) / spread);
  }
  return out;
}

float difference(const Feature& a, const Feature& b) {
  float sum = 0.0f;
  for (std::size_t f = 0; f < kFeatures; ++f) sum += (a[f] - b[f]) * (a[f] - b[f]);
  return std::sqrt(sum);
}

enum Move : std::uint8_t { kBoth, kFirst, kSecond };

// The cheapest way from the first pair of frames to the last; for each step of the first sound the
// middle of the frames of the second that it meets.
std::vector<double> warp(const std::vector<Feature>& a, const std::vector<Feature>& b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<Move> moves(n * m, kBoth);
  std::vector<float> above(m, 1e30f), row(m);
  constexpr float kStand = 1.15f;  // One sound waiting for the other costs a little more.
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      const float d = difference(a[i], b[j]);
      const float both = i > 0 && j > 0 ? above[j - 1] : (i + j == 0 ? 0.0f : 1e30f);
      const float first = i > 0 ? above[j] + 0.15f * d : 1e30f;
      const float second = j > 0 ? row[j - 1] + 0.15f * d : 1e30f;
      const float least = std::min({both, first, second});
      moves[i * m + j] = least == both ? kBoth : (least == first ? kFirst : kSecond);
      row[j] = least + (least == both ? d : (kStand - 0.15f) * d);
    }
    std::swap(above, row);
  }
  std::vector<double> sum(n, 0.0);
  std::vector<int> count(n, 0);
  for (std::size_t i = n - 1, j = m - 1;;) {
    sum[i] += static_cast<double>(j);
    ++count[i];
    if (i == 0 && j == 0) break;
    const Move move = moves[i * m + j];
    if (move != kSecond) --i;
    if (move != kFirst) --j;
  }
  for (std::size_t i = 0; i < n; ++i) sum[i] = sum[i] / count[i] * kStep_s;
  return sum;
}

}  // namespace

double TimeMap::operator()(double time_s) const {
  if (to_s_.empty()) return time_s;
  const double at = std::clamp(time_s / step_s_, 0.0, static_cast<double>(to_s_.size() - 1));
  const auto i = static_cast<std::size_t>(at);
  const std::size_t next = std::min(i + 1, to_s_.size() - 1);
  return std::lerp(to_s_[i], to_s_[next], at - static_cast<double>(i));
}

TimeMap align(const Sound16& known, const Sound16& recording) {
  return {warp(features(known), features(recording)), kStep_s};
}

}  // namespace caryatid::bake
