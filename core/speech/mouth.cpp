#include "core/speech/mouth.h"

#include <algorithm>
#include <cmath>

#include "core/base/trig.h"

namespace caryatid::speech {
namespace {

constexpr float kShortPause_ms = 60.0f;  // Shorter silence is a stop's or a joint's, not a pause.
constexpr float kRampIn_ms = 40.0f, kRampOut_ms = 36.0f;  // Of a contact: a stop bursts open.
constexpr float kFade_ms = 160.0f;       // Of the whole mouth, before the first and after the last.
constexpr float kLongPause_ms = 450.0f;  // In which the mood gets the mouth back.

// The middle of the +15 (sound first) .. -45 ms (sound last) in which people accept a picture; two
// of them are taken back by the blend, which leans forward.
constexpr float kCentre_ms = 13.0f;
constexpr float kLeastFrame_ms = 8.0f, kMostFrame_ms = 100.0f;

// Groups of FAPs that one set of dominances rules.
enum Group : std::uint8_t { kJaw, kHeight, kWidth, kTongue, kGroupCount };

Group group_of(int fap) {
  if (fap == 3 || fap == 14 || fap == 15 || fap == 18) return kJaw;
  if (fap >= 43 && fap <= 47) return kTongue;
  switch (fap) {
    case 6:
    case 7:
    case 12:
    case 13:
    case 16:
    case 17:
    case 53:
    case 54:
    case 59:
    case 60:
      return kWidth;
    default:
      return kHeight;
  }
}

// How much each viseme insists on its shape, by group, 0..1: the order of deformability that
// phoneticians give (Pelachaud 1996): p f least deformable, then sh th, s, t n k most.
constexpr float kInsists[face::kVisemeCount][kGroupCount] = {
    {0.5f, 0.5f, 0.4f, 0.5f},    // none
    {0.6f, 1.0f, 0.25f, 0.2f},   // p b m: rounding shows through.
    {0.7f, 1.0f, 0.5f, 0.3f},    // f v
    {0.6f, 0.7f, 0.4f, 1.0f},    // T D
    {0.5f, 0.45f, 0.25f, 0.9f},  // t d
    {0.4f, 0.35f, 0.2f, 0.9f},   // k g
    {0.9f, 0.9f, 0.95f, 0.8f},   // tS dZ S
    {0.95f, 0.7f, 0.6f, 0.8f},   // s z: the teeth stay near.
    {0.5f, 0.45f, 0.25f, 0.9f},  // n l
    {0.6f, 0.6f, 0.7f, 0.8f},    // r
    {0.9f, 0.9f, 0.6f, 0.5f},    // A:
    {0.8f, 0.8f, 0.7f, 0.5f},    // e
    {0.8f, 0.8f, 0.8f, 0.6f},    // I
    {0.9f, 0.9f, 0.9f, 0.5f},    // Q
    {0.8f, 0.9f, 1.0f, 0.5f},    // U
};

// Time constants of the negative exponentials, ms: before the sound and after it. Lips that round
// start early (Perkell and Matthies 1992); the jaw is the slowest. Tuned with kCentre_ms on 18
// minutes of English and Greek; caryatid-tool speech sync measures them on texts of their own
// (tests/data/speech).
constexpr float kBefore_ms[kGroupCount] = {25.0f, 20.0f, 34.0f, 36.0f};
constexpr float kAfter_ms[kGroupCount] = {28.0f, 22.0f, 32.0f, 36.0f};

// A stretch of time with one sound.
struct Segment {
  float from_ms, to_ms;
  const Sound* sound;
  bool stressed;
};

using Segments = FixedVector<Segment, 48>;

constexpr Sound kSilence{};

void add(Segments& out, float from_ms, float to_ms, const Sound& sound, bool stressed) {
  (void)out.push({from_ms, to_ms, &sound, stressed});
}

// The sounds around `t`, with endless silence before the first and after the last.
void collect(const Utterance& u, float t, Segments& out) {
  constexpr float kFar_ms = 1e6f;
  const auto phones = u.phones();
  const Phone* first = std::lower_bound(
      phones.data(), phones.data() + phones.size(), t - kLookAhead_ms,
      [](const Phone& p, float time) { return static_cast<float>(p.start_ms) < time; });
  auto i = static_cast<std::size_t>(first - phones.data());
  i = i > 0 ? i - 1 : 0;
  // What has been forgotten is silence; it is too far away to matter unless nothing was ever said.
  const float begin = phones.empty() ? kFar_ms : static_cast<float>(phones[i].start_ms);
  add(out, -kFar_ms, begin, kSilence, false);
  for (; i < phones.size(); ++i) {
    const float from = static_cast<float>(phones[i].start_ms);
    if (from > t + kLookAhead_ms) return;
    const float to = i + 1 < phones.size() ? static_cast<float>(phones[i + 1].start_ms)
                                           : static_cast<float>(u.end_ms());
    const Phoneme& p = phones[i].phoneme;
    if (p.begins == p.ends) {
      add(out, from, to, p.begins, p.stressed);
    } else {
      // A diphthong's first half is the longer one (Lehiste and Peterson 1961).
      const float middle = from + 0.55f * (to - from);
      add(out, from, middle, p.begins, p.stressed);
      add(out, middle, to, p.ends, p.stressed);
    }
  }
  add(out, static_cast<float>(u.end_ms()), kFar_ms, kSilence, false);
}

float dominance(const Segment& s, float t, Group group) {
  const Sound& sound = *s.sound;
  const float length = s.to_ms - s.from_ms;
  float strength;
  if (sound.silent()) {
    if (length < kShortPause_ms) return 0.0f;
    strength = 0.9f;
  } else {
    const float share = static_cast<float>(sound.blend) / 63.0f;
    strength = sound.hold * (share * kInsists[sound.first][group] +
                             (1.0f - share) * kInsists[sound.second][group]);
    if (group == kTongue && sound.contact != Contact::none) strength = 1.0f;
  }
  // Full in the middle half of the sound, falling off on both sides.
  const float flat = std::min(0.25f * length, 40.0f);
  const float before = s.from_ms + flat - t;
  const float after = t - (s.to_ms - flat);
  if (before > 0.0f) return strength * exp_of(-before / kBefore_ms[group]);
  if (after > 0.0f) return strength * exp_of(-after / kAfter_ms[group]);
  return strength;
}

struct Shares {
  float of[kGroupCount][face::kVisemeCount] = {};  // Sum to 1 in each group.
};

// Stress opens the mouth, the lack of it and haste keep it small (JALI: loudness moves the jaw).
float openness(const Segment& s) {
  if (!s.sound->vowel) return 1.0f;
  return s.stressed ? 1.1f : 0.9f;
}

Shares blend(const Segments& segments, float t) {
  Shares out;
  for (int g = 0; g < kGroupCount; ++g) {
    float sum = 1e-12f;
    for (const Segment& s : segments) {
      const float d = dominance(s, t, static_cast<Group>(g));
      if (d <= 0.0f) continue;
      sum += d;
      const bool opens = g == kJaw || g == kHeight;
      const float share = static_cast<float>(s.sound->blend) / 63.0f;
      const float w = opens ? d * openness(s) : d;
      out.of[g][s.sound->first] += w * share;
      out.of[g][s.sound->second] += w * (1.0f - share);
    }
    for (float& w : out.of[g]) w /= sum;
  }
  return out;
}

face::VisemeField nearest_field(const Shares& shares) {
  float total[face::kVisemeCount];
  for (std::size_t v = 0; v < face::kVisemeCount; ++v)
    total[v] = shares.of[kJaw][v] + shares.of[kHeight][v] + shares.of[kWidth][v];
  std::size_t a = 0, b = 0;
  for (std::size_t v = 1; v < face::kVisemeCount; ++v)
    if (total[v] > total[a]) a = v;
  b = a == 0 ? 1 : 0;
  for (std::size_t v = 0; v < face::kVisemeCount; ++v)
    if (v != a && total[v] > total[b]) b = v;
  face::VisemeField out;
  out.first = static_cast<std::uint8_t>(a);
  out.second = static_cast<std::uint8_t>(b);
  out.blend = static_cast<std::uint8_t>(63.0f * total[a] / (total[a] + total[b]) + 0.5f);
  return out;
}

float smooth(float x) {
  const float c = std::clamp(x, 0.0f, 1.0f);
  return c * c * (3.0f - 2.0f * c);
}

// The time in which a segment's contact is held: the closure of a stop, at least `least_ms`.
struct Hold {
  float from_ms, to_ms;
  float weight(float t) const {
    if (t < from_ms) return smooth(1.0f - (from_ms - t) / kRampIn_ms);
    if (t > to_ms) return smooth(1.0f - (t - to_ms) / kRampOut_ms);
    return 1.0f;
  }
};

Hold hold_of(const Segment& s, float least_ms) {
  // A stop's last part is its burst: the lips have let go.
  const float release = std::min(0.3f * (s.to_ms - s.from_ms), 25.0f);
  const float to = s.to_ms - release;
  const float missing = std::max(least_ms - (to - s.from_ms), 0.0f);
  return {s.from_ms - 0.5f * missing, to + 0.5f * missing};
}

void toward(face::FapFrame& io, int fap, float target, float weight) {
  io.set(fap, io.get(fap) + weight * (target - io.get(fap)));
}

// At most, and at least, with a weight.
void limit_above(face::FapFrame& io, int fap, float most, float weight) {
  if (io.get(fap) > most) toward(io, fap, most, weight);
}
void limit_below(face::FapFrame& io, int fap, float least, float weight) {
  if (io.get(fap) < least) toward(io, fap, least, weight);
}

constexpr int kLipHeights[] = {4, 5, 8, 9, 10, 11, 51, 52, 55, 56, 57, 58};

void hold_lips(face::FapFrame& io, const face::FapFrame& shape, float weight) {
  for (const int fap : kLipHeights) toward(io, fap, shape.get(fap), weight);
  for (const int fap : {16, 17}) toward(io, fap, shape.get(fap), weight);
  limit_above(io, 3, shape.get(3) + 60.0f, weight);
}

void hold_tongue(face::FapFrame& io, const face::FapFrame& shape, float weight) {
  for (int fap = 43; fap <= 47; ++fap) toward(io, fap, shape.get(fap), weight);
}

// The mouth is open enough to see the tongue in it.
void show_tongue(face::FapFrame& io, const face::FapFrame& shape, float weight) {
  for (const int fap : {4, 8, 9, 51, 55, 56}) limit_above(io, fap, 0.8f * shape.get(fap), weight);
  for (const int fap : {5, 10, 11, 52, 57, 58})
    limit_above(io, fap, 0.85f * shape.get(fap), weight);
  limit_below(io, 3, 0.85f * shape.get(3), weight);
}

}  // namespace

float mouth_lead_ms(float frame_ms) {
  return kCentre_ms + 0.5f * std::clamp(frame_ms, kLeastFrame_ms, kMostFrame_ms);
}

Mouth::Mouth(bool holds_contacts) : holds_contacts_(holds_contacts) {
  for (int v = 0; v < face::kVisemeCount; ++v) {
    const auto i = static_cast<std::size_t>(v);
    shapes_[i] = face::viseme_frame(v);
    // Whatever a viseme leaves out of mouth and tongue it leaves at rest.
    for (int fap = 3; fap <= 60; ++fap)
      if ((fap <= 18 || fap >= 51 || (fap >= 43 && fap <= 47)) && !shapes_[i].has(fap))
        shapes_[i].set(fap, 0.0f);
  }
}

namespace {

using Shapes = std::array<face::FapFrame, face::kVisemeCount>;

void mix_shapes(const Shapes& shapes, const Shares& shares, face::FapFrame& out) {
  for (int fap = 3; fap <= 60; ++fap) {
    if (!shapes[0].has(fap)) continue;
    const auto& share = shares.of[group_of(fap)];
    float sum = 0.0f;
    for (std::size_t v = 1; v < face::kVisemeCount; ++v) sum += share[v] * shapes[v].get(fap);
    out.set(fap, sum);
  }
}

// What the contacts of lips near a moment ask for. They exclude each other: where two are near, the
// one whose time it is has all, and between them one passes into the other.
class LipContacts {
 public:
  explicit LipContacts(float t) : t_(t) {}

  void add(const Segment& s, const face::FapFrame& shape, float weight) {
    const float away = std::abs(t_ - 0.5f * (s.from_ms + s.to_ms));
    const bool firm = weight >= 1.0f;
    if (firm && firm_ && away >= firm_away_) return;
    if (firm) {
      firm_ = true;
      firm_away_ = away;
      sum_ = {};
      shares_ = at_teeth_ = 0.0f;
    } else if (firm_) {
      return;
    }
    const float share = weight / (1.0f - weight + 1e-4f);
    for (int fap = 3; fap <= 60; ++fap) sum_.set(fap, sum_.get(fap) + share * shape.get(fap));
    shares_ += share;
    if (s.sound->contact == Contact::lip_teeth) at_teeth_ += share;
    weight_ = std::max(weight_, weight);
  }
  void hold(face::FapFrame& io) {
    if (shares_ <= 0.0f) return;
    for (float& v : sum_.value) v /= shares_;
    hold_lips(io, sum_, weight_);
    // A lip that is drawn in or spread by its neighbours, or taken along by the jaw, misses the
    // teeth by a millimetre or two: here the sound has its own jaw and corners.
    const float teeth = weight_ * at_teeth_ / shares_;
    toward(io, 3, sum_.get(3), teeth);
    for (const int fap : {6, 7, 12, 13, 53, 54, 59, 60})
      toward(io, fap, sum_.get(fap), 0.85f * teeth);
  }

 private:
  float t_;
  face::FapFrame sum_;
  float shares_ = 0.0f, at_teeth_ = 0.0f, weight_ = 0.0f, firm_away_ = 0.0f;
  bool firm_ = false;
};

float hold_contacts(const Segments& segments, const Shapes& shapes, float t, float least_ms,
                    face::FapFrame& io) {
  LipContacts lips(t);
  float strongest = 0.0f;
  for (const Segment& s : segments) {
    const Contact contact = s.sound->contact;
    if (contact == Contact::none) continue;
    const float w = hold_of(s, least_ms).weight(t);
    if (w <= 0.0f) continue;
    strongest = std::max(strongest, w);
    const face::FapFrame& shape = shapes[s.sound->first];
    if (contact == Contact::lips || contact == Contact::lip_teeth) {
      lips.add(s, shape, w);
      continue;
    }
    hold_tongue(io, shape, w);
    if (contact == Contact::tongue_teeth || s.sound->first == 8) show_tongue(io, shape, w);
  }
  lips.hold(io);  // Last, so that nothing undoes them.
  return strongest;
}

float strength_at(const Segments& segments, float t) {
  float strength = 0.0f;
  for (const Segment& s : segments) {
    if (s.sound->silent()) {
      // Through a short pause the mouth stays the voice's.
      const bool inner = s.from_ms > -1e5f && s.to_ms < 1e5f && s.to_ms - s.from_ms < kLongPause_ms;
      if (inner && t >= s.from_ms && t < s.to_ms) return 1.0f;
      continue;
    }
    const float away = std::max({s.from_ms - t, t - s.to_ms, 0.0f});
    strength = std::max(strength, smooth(1.0f - away / kFade_ms));
  }
  return strength;
}

}  // namespace

MouthShape Mouth::at(const Utterance& utterance, float now_ms, float frame_ms) const {
  const float t = now_ms + mouth_lead_ms(frame_ms);
  // Two milliseconds more than a frame: times of events are rounded.
  const float least_ms = std::clamp(frame_ms, kLeastFrame_ms, kMostFrame_ms) + 2.0f;
  Segments segments;
  collect(utterance, t, segments);
  const Shares shares = blend(segments, t);
  MouthShape out;
  mix_shapes(shapes_, shares, out.faps);
  if (holds_contacts_) out.contact = hold_contacts(segments, shapes_, t, least_ms, out.faps);
  out.viseme = nearest_field(shares);
  out.strength = strength_at(segments, t);
  return out;
}

}  // namespace caryatid::speech
