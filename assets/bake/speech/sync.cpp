#include "assets/bake/speech/sync.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/face/visemes.h"
#include "core/speech/sound.h"

namespace caryatid::bake {
namespace {

using speech::Contact;
using speech::Sound;

MouthFrame shape_of(const Sound& s) {
  const face::FapFrame f = face::blend_visemes({s.first, s.second, s.blend});
  return {0.0, f.get(3), f.get(4), f.get(5), f.get(6), f.get(16), f.get(17)};
}

double distance(const MouthFrame& a, const MouthFrame& b) {
  const auto d = [](float x, float y) { return double{x - y} * double{x - y}; };
  // Corners move less than lips do and say as much.
  return std::sqrt(d(a.jaw, b.jaw) + d(a.upper_lip, b.upper_lip) + d(a.lower_lip, b.lower_lip) +
                   4.0 * d(a.corner, b.corner) + d(a.lower_thrust, b.lower_thrust) +
                   d(a.upper_thrust, b.upper_thrust));
}

constexpr double kGrid_s = 0.005;
constexpr int kHalfWindow = 50;  // 0.25 s.
constexpr int kMostShift = 30;   // 0.15 s.

double squared(const MouthFrame& a, const MouthFrame& b) {
  const double d = distance(a, b);
  return d * d;
}

// What is shown, and what is heard, every 5 ms from 0 on.
std::vector<MouthFrame> shown_track(std::span<const MouthFrame> frames, std::size_t size) {
  std::vector<MouthFrame> out(size);
  std::size_t f = 0;
  for (std::size_t i = 0; i < size && !frames.empty(); ++i) {
    while (f + 1 < frames.size() && frames[f + 1].time_s <= static_cast<double>(i) * kGrid_s) ++f;
    out[i] = frames[f];
  }
  return out;
}

std::vector<MouthFrame> heard_track(std::span<const TimedPhone> phones, std::size_t size) {
  std::vector<MouthFrame> out(size);
  for (std::size_t p = 0; p < phones.size(); ++p) {
    const speech::Phoneme phoneme = speech::phoneme_of(phones[p].ipa);
    const double from_s = phones[p].start_s;
    const double to_s = p + 1 < phones.size() ? phones[p + 1].start_s : from_s + 0.1;
    // A joint between sounds, not a pause: the mouth knows nothing of it.
    const bool joint = phoneme.begins.silent() && to_s - from_s < 0.06 && p > 0;
    const Sound begins = joint ? speech::phoneme_of(phones[p - 1].ipa).ends : phoneme.begins;
    const Sound ends = joint ? begins : phoneme.ends;
    for (double t = from_s; t < to_s; t += kGrid_s) {
      const auto i = static_cast<std::size_t>(t / kGrid_s);
      if (i < size) out[i] = shape_of(t < 0.45 * from_s + 0.55 * to_s ? begins : ends);
    }
  }
  return out;
}

// The shift of the mouth that fits best around grid point `at`, in grid steps; positive: it is
// late.
int best_shift(std::span<const MouthFrame> shown, std::span<const MouthFrame> heard, int at) {
  int best = 0;
  double least = 1e30;
  // From no shift outwards, so that the smallest of equals wins.
  for (int k = 0; k <= 2 * kMostShift; ++k) {
    const int shift = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
    double sum = 0.0;
    for (int i = at - kHalfWindow; i <= at + kHalfWindow; ++i)
      sum +=
          squared(shown[static_cast<std::size_t>(i + shift)], heard[static_cast<std::size_t>(i)]);
    if (sum >= least) continue;
    least = sum;
    best = shift;
  }
  return best;
}

// The first frame for which `is_so` holds among those in which the sound may be seen: from 45 ms
// before it begins to 15 ms after it ends.
template <class Check>
std::optional<double> first_frame(std::span<const MouthFrame> frames, double from_s, double to_s,
                                  Check is_so) {
  const auto first = std::lower_bound(frames.begin(), frames.end(), from_s - 0.045,
                                      [](const MouthFrame& f, double t) { return f.time_s < t; });
  for (auto f = first; f != frames.end() && f->time_s <= to_s + 0.015; ++f)
    if (is_so(*f)) return f->time_s;
  return std::nullopt;
}

void count_contact(std::span<const MouthFrame> frames, const Sound& s, double from_s, double to_s,
                   SyncReport* io) {
  std::optional<double> at;
  if (s.contact == Contact::lips) {
    ++io->bilabials;
    at = first_frame(frames, from_s, to_s,
                     [](const MouthFrame& f) { return f.upper_lip + f.lower_lip >= -1e-3f; });
    io->shut += at.has_value();
  } else if (s.contact == Contact::lip_teeth) {
    ++io->labiodentals;
    const MouthFrame target = shape_of(s);
    at = first_frame(frames, from_s, to_s, [&target](const MouthFrame& f) {
      return std::max({std::abs(f.upper_lip - target.upper_lip),
                       std::abs(f.lower_lip - target.lower_lip),
                       std::abs(f.lower_thrust - target.lower_thrust)}) <= 5.0f;
    });
    io->touching += at.has_value();
  }
  if (at) io->contact_late_s.push_back(*at - from_s);
}

}  // namespace

std::int64_t find_sound(std::span<const std::int16_t> whole, std::span<const std::int16_t> part,
                        std::int64_t guess, std::int64_t reach) {
  double energy = 0.0;
  for (const std::int16_t s : part) energy += double(s) * s;
  std::int64_t best = -1;
  double best_likeness = 0.5;
  for (std::int64_t at = std::max<std::int64_t>(guess - reach, 0); at <= guess + reach; ++at) {
    if (at + static_cast<std::int64_t>(part.size()) > static_cast<std::int64_t>(whole.size()))
      break;
    double product = 0.0, own = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const double w = whole[static_cast<std::size_t>(at) + i];
      product += w * part[i];
      own += w * w;
    }
    const double likeness = energy * own > 0.0 ? product / std::sqrt(energy * own) : 0.0;
    if (likeness <= best_likeness) continue;
    best_likeness = likeness;
    best = at;
  }
  return best;
}

SyncReport measure_sync(std::span<const MouthFrame> frames, std::span<const TimedPhone> phones) {
  SyncReport out;
  if (frames.empty() || phones.empty()) return out;
  const auto size = static_cast<std::size_t>(frames.back().time_s / kGrid_s);
  const std::vector<MouthFrame> shown = shown_track(frames, size),
                                heard = heard_track(phones, size);
  for (std::size_t p = 0; p < phones.size(); ++p) {
    const Sound sound = speech::phoneme_of(phones[p].ipa).begins;
    if (sound.silent()) continue;
    const double from_s = phones[p].start_s;
    const double to_s = p + 1 < phones.size() ? phones[p + 1].start_s : from_s + 0.1;
    count_contact(frames, sound, from_s, to_s, &out);
    const auto at = static_cast<int>(0.5 * (from_s + to_s) / kGrid_s);
    const int reach = kHalfWindow + kMostShift;
    if (at < reach || at + reach >= static_cast<int>(size)) continue;
    out.late_s.push_back(kGrid_s * best_shift(shown, heard, at));
    out.at_s.push_back(from_s);
  }
  return out;
}

double share_within(std::span<const double> values, double least, double most) {
  const auto within = std::count_if(values.begin(), values.end(),
                                    [&](double v) { return v >= least && v <= most; });
  return values.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(values.size());
}

double percentile(std::span<const double> values, double percent) {
  if (values.empty()) return 0.0;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double at = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(at + 0.5)];
}

double drift_s_per_s(const SyncReport& r) {
  const auto n = static_cast<double>(r.late_s.size());
  if (n < 2.0) return 0.0;
  const double mean_at = std::accumulate(r.at_s.begin(), r.at_s.end(), 0.0) / n;
  const double mean_late = std::accumulate(r.late_s.begin(), r.late_s.end(), 0.0) / n;
  double both = 0.0, own = 0.0;
  for (std::size_t i = 0; i < r.late_s.size(); ++i) {
    both += (r.at_s[i] - mean_at) * (r.late_s[i] - mean_late);
    own += (r.at_s[i] - mean_at) * (r.at_s[i] - mean_at);
  }
  return own > 0.0 ? both / own : 0.0;
}

}  // namespace caryatid::bake
