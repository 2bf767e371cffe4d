#pragma once
// Fits the timing of one voice to another that says the same: a synthesised utterance, whose sounds
// are known to the millisecond, is laid over a recording by dynamic time warping of what their
// spectra look like (Sakoe and Chiba 1978). No model of any language is needed.
#include <cstdint>
#include <span>
#include <vector>

namespace caryatid::bake {

struct Sound16 {
  std::span<const std::int16_t> samples;
  std::uint32_t rate_hz = 22050;
  double seconds() const { return static_cast<double>(samples.size()) / rate_hz; }
};

// A map from times of one sound to times of the other; rises.
class TimeMap {
 public:
  // Entry i: where the moment i * step_s of the first lies in the second.
  TimeMap(std::vector<double> to_s, double step_s) : to_s_(std::move(to_s)), step_s_(step_s) {}
  double operator()(double time_s) const;

 private:
  std::vector<double> to_s_;
  double step_s_;
};

// O(length of one times length of the other) in steps of 10 ms: a minute takes about a second.
// Throws std::invalid_argument when one of them is empty or longer than ten minutes.
TimeMap align(const Sound16& known, const Sound16& recording);

}  // namespace caryatid::bake
