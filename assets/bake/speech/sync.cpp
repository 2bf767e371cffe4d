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

constexpr double kReach_s = 0.15;  // A change is looked for so far from its sound.

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

struct Change {
  double sound_s;
  MouthFrame from, to;
};

// Where the mouth becomes more like `to` than like `from`, nearest to the sound.
std::optional<double> crossing(std::span<const MouthFrame> frames, const Change& c) {
  std::optional<double> best;
  const auto first = std::lower_bound(frames.begin(), frames.end(), c.sound_s - kReach_s,
                                      [](const MouthFrame& f, double t) { return f.time_s < t; });
  for (auto f = first; f != frames.end() && f->time_s < c.sound_s + kReach_s; ++f) {
    if (f == frames.begin()) continue;
    const MouthFrame& a = *(f - 1);
    const double before = distance(a, c.to) - distance(a, c.from);
    const double after = distance(*f, c.to) - distance(*f, c.from);
    if (before <= 0.0 || after > 0.0) continue;
    const double step = f->time_s - a.time_s;
    const double at = a.time_s + step * before / (before - after) + 0.5 * step;
    if (!best || std::abs(at - c.sound_s) < std::abs(*best - c.sound_s)) best = at;
  }
  return best;
}

// Least of `measure` among the frames in which the sound may be seen: 45 ms before it begins to
// 15 ms after it ends.
template <class Measure>
double least(std::span<const MouthFrame> frames, double from_s, double to_s, Measure measure) {
  double out = 1e9;
  for (const MouthFrame& f : frames)
    if (f.time_s >= from_s - 0.045 && f.time_s <= to_s + 0.015) out = std::min(out, measure(f));
  return out;
}

void count_contact(std::span<const MouthFrame> frames, const Sound& s, double from_s, double to_s,
                   SyncReport* io) {
  if (s.contact == Contact::lips) {
    ++io->bilabials;
    const auto gap = [](const MouthFrame& f) { return -double{f.upper_lip} - double{f.lower_lip}; };
    if (least(frames, from_s, to_s, gap) <= 1e-3) ++io->shut;
  }
  if (s.contact == Contact::lip_teeth) {
    ++io->labiodentals;
    const MouthFrame target = shape_of(s);
    const auto away = [&target](const MouthFrame& f) {
      return double{std::max({std::abs(f.upper_lip - target.upper_lip),
                              std::abs(f.lower_lip - target.lower_lip),
                              std::abs(f.lower_thrust - target.lower_thrust)})};
    };
    if (least(frames, from_s, to_s, away) <= 5.0) ++io->touching;
  }
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
  std::optional<MouthFrame> before;
  Sound last{};
  for (std::size_t i = 0; i < phones.size(); ++i) {
    const speech::Phoneme p = speech::phoneme_of(phones[i].ipa);
    const double from_s = phones[i].start_s;
    const double to_s = i + 1 < phones.size() ? phones[i + 1].start_s : from_s + 0.1;
    if (p.begins.silent() && to_s - from_s < 0.06) continue;  // A joint, not a pause.
    const MouthFrame shape = shape_of(p.begins);
    count_contact(frames, p.begins, from_s, to_s, &out);
    if (before && p.begins.first != last.first && distance(*before, shape) > 1.0) {
      ++out.sounds;
      if (const auto at = crossing(frames, {from_s, *before, shape})) {
        ++out.seen;
        out.late_s.push_back(*at - from_s);
        out.at_s.push_back(from_s);
      }
    }
    before = shape_of(p.ends);
    last = p.ends;
  }
  return out;
}

double SyncReport::share_within(double least_s, double most_s) const {
  const auto within = std::count_if(late_s.begin(), late_s.end(),
                                    [&](double s) { return s >= least_s && s <= most_s; });
  return late_s.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(late_s.size());
}

double SyncReport::percentile_s(double percent) const {
  if (late_s.empty()) return 0.0;
  std::vector<double> sorted = late_s;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(percent / 100.0 * static_cast<double>(sorted.size() - 1) +
                                         0.5)];
}

double SyncReport::drift_s_per_s() const {
  const auto n = static_cast<double>(late_s.size());
  if (n < 2.0) return 0.0;
  const double mean_at = std::accumulate(at_s.begin(), at_s.end(), 0.0) / n;
  const double mean_late = std::accumulate(late_s.begin(), late_s.end(), 0.0) / n;
  double both = 0.0, own = 0.0;
  for (std::size_t i = 0; i < late_s.size(); ++i) {
    both += (at_s[i] - mean_at) * (late_s[i] - mean_late);
    own += (at_s[i] - mean_at) * (at_s[i] - mean_at);
  }
  return own > 0.0 ? both / own : 0.0;
}

}  // namespace caryatid::bake
