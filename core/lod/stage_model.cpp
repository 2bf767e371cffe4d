#include "core/lod/stage_model.h"

#include <algorithm>
#include <cmath>

namespace caryatid::lod {
namespace {

constexpr float kGainMin = 0.125f, kGainMax = 8.0f;
constexpr float kVarianceMin = 0.02f * 0.02f, kVarianceMax = 0.12f * 0.12f;
constexpr float kWalk = 5e-7f;       // Variance that a gain gains per frame: settles in ~50 frames.
constexpr float kSurprise = 0.005f;  // A term may be 7 % off when something else is drawn.
constexpr float kClipFit = 2.5f;     // Deviations.
constexpr float kClipRun = 6.0f;
// CUSUM: allowance k and threshold h in deviations. False alarms of normal noise come once in about
// exp(2 k h) frames: 0.75 and 9 give 7e5, that is hours.
constexpr float kAllowance = 0.75f;
constexpr float kThreshold = 9.0f, kThresholdLate = 5.0f, kThresholdEvidence = 4.0f;
constexpr float kThresholdDown = 12.0f;  // No hurry: nothing is late while it is cheaper.
constexpr int kLateWindow = 120, kProbeMin = 30 * 60, kProbeMax = 600 * 60;  // Frames.

}  // namespace

void StageModel::Run::add(float z, float e) {
  score = std::max(0.0f, score + std::min(z, kClipRun) - kAllowance);
  if (score <= 0.0f) {
    *this = {};
    return;
  }
  sum += e;
  largest = frames == 0 ? e : std::max(largest, e);
  ++frames;
}

float StageModel::Run::mean_ratio() const {
  const float others = frames < 2 ? sum : (sum - largest) / static_cast<float>(frames - 1);
  const bool spiked = frames >= 2 && largest > 2.0f * others;
  const float mean = spiked ? others : sum / static_cast<float>(std::max(frames, 1));
  return 1.0f + std::max(mean, 0.0f);
}

float StageModel::predict(const Terms& x) const {
  float us = 0.0f;
  for (std::size_t k = 0; k < kTermCount; ++k) us += gain_[k] * x[k];
  return us;
}

float StageModel::deviation() const { return std::sqrt(variance_); }

float StageModel::learn(const Terms& x, float measured_us, bool late, bool evidence) {
  const float predicted = std::max(predict(x), 1.0f);
  const float ratio = std::clamp(measured_us, 1.0f, 1e7f) / predicted;
  const float e = ratio >= 1.0f ? ratio - 1.0f : 1.0f - 1.0f / ratio;  // Symmetric in the ratio.
  const float deviation_now = deviation();
  const float z = e / deviation_now;
  up_.add(z, e);
  down_.add(-z, -e);
  const bool risen = up_.score > kThreshold ||
                     (late && up_.frames >= 2 && up_.score > kThresholdLate) ||
                     (evidence && up_.score > kThresholdEvidence);
  if (risen || down_.score > kThresholdDown) {
    const float factor = risen ? up_.mean_ratio() : 1.0f / down_.mean_ratio();
    scale(factor);
    expect_change();
    up_ = down_ = {};
    return factor;
  }
  fit(x, predicted, std::clamp(e, -kClipFit * deviation_now, kClipFit * deviation_now) * predicted);
  const float clipped = std::clamp(e, -3.0f * deviation_now, 3.0f * deviation_now);
  variance_ =
      std::clamp(variance_ + 0.01f * (clipped * clipped - variance_), kVarianceMin, kVarianceMax);
  return 1.0f;
}

void StageModel::fit(const Terms& x, float predicted_us, float innovation_us) {
  Terms px{};  // Covariance times x; terms that are not drawn are skipped.
  float excited = variance_ * predicted_us * predicted_us;
  for (std::size_t j = 0; j < kTermCount; ++j) {
    if (x[j] == 0.0f) continue;
    for (std::size_t i = 0; i < kTermCount; ++i) px[i] += covariance_[i * kTermCount + j] * x[j];
  }
  for (std::size_t i = 0; i < kTermCount; ++i) excited += x[i] * px[i];
  const float scale_down = 1.0f / excited;
  for (std::size_t i = 0; i < kTermCount; ++i) {
    gain_[i] = std::clamp(gain_[i] + px[i] * scale_down * innovation_us, kGainMin, kGainMax);
    for (std::size_t j = 0; j < kTermCount; ++j)
      covariance_[i * kTermCount + j] -= px[i] * px[j] * scale_down;
  }
  for (std::size_t i = 0; i < kTermCount; ++i) {
    float& diagonal = covariance_[i * kTermCount + i];
    diagonal = std::max(diagonal, 0.0f) + kWalk;
    if (diagonal <= kPrior) continue;
    const float shrink = std::sqrt(kPrior / diagonal);  // Row and column: stays positive definite.
    for (std::size_t j = 0; j < kTermCount; ++j) {
      covariance_[i * kTermCount + j] *= shrink;
      covariance_[j * kTermCount + i] *= shrink;
    }
  }
}

void StageModel::expect_change() {
  for (std::size_t i = 0; i < kTermCount; ++i)
    covariance_[i * kTermCount + i] = std::min(covariance_[i * kTermCount + i] + kSurprise, kPrior);
}

void StageModel::learn_bound(const Terms& x, float bound_us, bool late) {
  const float predicted = std::max(predict(x), 1.0f);
  const float bound = std::max(bound_us, 1.0f);
  if (late && predicted > bound) return;  // As the model expected: nothing is learnt.
  if (!late) {
    since_late_ = std::min(since_late_ + 1, 1 << 20);
    if (predicted > bound) scale(std::max(bound / predicted, 0.98f));
    if (++calm_ < probe_frames_) return;
    calm_ = 0;
    scale(0.96f);
    if (++hopes_ >= 3) probe_frames_ = std::max(probe_frames_ / 2, kProbeMin);
    return;
  }
  const bool again = since_late_ < kLateWindow;
  const float least = since_late_ < 30 ? 1.5f : 1.2f;
  since_late_ = 0;
  calm_ = 0;
  if (!again) return;  // One late frame may be a spike.
  if (hopes_ > 0) probe_frames_ = std::min(2 * probe_frames_, kProbeMax);
  hopes_ = 0;
  // Late says that the cost was above the bound, however far below it the model was.
  scale(std::max(least, 1.1f * bound / predicted));
}

void StageModel::scale(float factor) {
  for (float& g : gain_) g = std::clamp(g * factor, kGainMin, kGainMax);
  slowdown_ = std::clamp(slowdown_ * factor, kGainMin, kGainMax);
}

}  // namespace caryatid::lod
