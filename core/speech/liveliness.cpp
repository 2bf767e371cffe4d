#include "core/speech/liveliness.h"

#include <algorithm>

#include "core/base/trig.h"

namespace caryatid::speech {
namespace {

constexpr float kAnglesPerDegree = 1745.329f;  // FAP angles are 1e-5 rad.
constexpr float kAhead_ms = 220.0f;            // An accent is planned so long before its apex.
constexpr float kRise_ms = 180.0f, kFall_ms = 380.0f;
constexpr float kApart_ms = 520.0f;  // Between two accents.
constexpr float kBeatsApart_ms = 1900.0f;
constexpr float kBlinksApart_ms = 1400.0f;
constexpr float kPause_ms = 110.0f;   // A phrase ends.
constexpr float kBreath_ms = 380.0f;  // Speakers breathe in within 0.3 to 0.6 s (Winkworth 1995).
constexpr float kBrow = 95.0f;        // FAPs 31..36 of a full accent, 1/1024 of ENS.
constexpr float kNod_deg = 2.6f;      // Head of a full accent; Munhall 2004: a few degrees.

float smooth(float x) {
  const float c = std::clamp(x, 0.0f, 1.0f);
  return c * c * (3.0f - 2.0f * c);
}

float pulse(float now_ms, float apex_ms) {
  return now_ms < apex_ms ? smooth(1.0f - (apex_ms - now_ms) / kRise_ms)
                          : smooth(1.0f - (now_ms - apex_ms) / kFall_ms);
}

// Start of the pause that is heard at `now_ms`, or -1.
float pause_at(const Utterance& u, float now_ms) {
  const auto phones = u.phones();
  for (std::size_t i = 0; i < phones.size(); ++i) {
    const float from = static_cast<float>(phones[i].start_ms);
    if (from > now_ms) break;
    // Silent phones come in pairs at the end of a clause; the first of them counts.
    float to = static_cast<float>(u.end_ms());
    if (!phones[i].phoneme.begins.silent()) continue;
    std::size_t next = i + 1;
    while (next < phones.size() && phones[next].phoneme.begins.silent()) ++next;
    if (next < phones.size()) to = static_cast<float>(phones[next].start_ms);
    if (to > now_ms && to - from >= kPause_ms) return from;
    i = next - 1;
  }
  return -1.0f;
}

}  // namespace

void Liveliness::begin(float amount) {
  amount_ = std::clamp(amount, 0.0f, 1.5f);
  for (Accent& a : accents_) a = {};
  planned_words_ = 0;
  last_accent_ms_ = last_beat_ms_ = last_blink_ms_ = -1e6f;
  pause_ms_ = -1.0f;
  yaw_to_ = random_.between(-1.0f, 1.0f);
  roll_to_ = random_.between(-1.0f, 1.0f);
}

// No stressed word follows before the next pause, as far as is known.
bool Liveliness::is_last_stress(const Utterance& u, std::size_t word) const {
  const auto words = u.words();
  for (std::size_t w = word + 1; w < words.size(); ++w) {
    // A gap between a word's end and the next one's start is a pause.
    if (words[w - 1].end_ms >= 0 && words[w].start_ms - words[w - 1].end_ms > 60) return true;
    if (words[w].stressed()) return false;
  }
  return true;
}

void Liveliness::plan(const Utterance& u, float now_ms) {
  const auto words = u.words();
  while (planned_words_ < words.size()) {
    const Word& word = words[planned_words_];
    // Its stress may still be on the way.
    if (static_cast<float>(word.start_ms) > now_ms + kAhead_ms) return;
    if (!word.stressed() && word.end_ms < 0) return;
    const std::size_t index = planned_words_++;
    if (!word.stressed()) continue;
    const float apex = static_cast<float>(word.stress_ms) + 60.0f;
    if (apex < now_ms - 100.0f || apex - last_accent_ms_ < kApart_ms) continue;
    const bool last = is_last_stress(u, index);
    const float size = last ? random_.between(0.8f, 1.0f) : random_.between(0.25f, 0.8f);
    if (!last && random_.unit() < 0.35f) continue;
    accents_[next_accent_] = {apex, size, random_.between(0.3f, 0.9f)};
    next_accent_ = (next_accent_ + 1) % kAccents;
    last_accent_ms_ = apex;
    if (size > 0.7f && apex - last_beat_ms_ > kBeatsApart_ms) {
      last_beat_ms_ = apex;
      out_.beat = 0.6f * size * amount_;
    }
  }
}

void Liveliness::phrase(const Utterance& u, float now_ms) {
  const float pause = pause_at(u, now_ms);
  if (pause < 0.0f || pause == pause_ms_) return;
  pause_ms_ = pause;
  yaw_to_ = random_.between(-1.0f, 1.0f);
  roll_to_ = random_.between(-1.0f, 1.0f);
  if (now_ms - last_blink_ms_ < kBlinksApart_ms || random_.unit() < 0.25f) return;
  last_blink_ms_ = now_ms;
  out_.blink = true;
}

void Liveliness::breathe(const Utterance& u, float now_ms, float dt_s, bool speaking) {
  bool inhaling = speaking && u.phones().empty() && !u.finished();
  for (const std::int32_t start : u.sentences_ms()) {
    const float left = static_cast<float>(start) - now_ms;
    inhaling = inhaling || (left > 0.0f && left < kBreath_ms);
  }
  // In fast, out slowly while the voice uses it up.
  const float target = inhaling ? 1.0f : 0.0f;
  const float rate = inhaling ? 9.0f : 0.8f;
  breath_ += (target - breath_) * (1.0f - exp_of(-rate * dt_s));
  out_.breath = breath_;
}

void Liveliness::move(float now_ms, float dt_s, bool speaking) {
  float brow = 0.0f, nod = 0.0f;
  for (const Accent& a : accents_) {
    if (a.size <= 0.0f || !speaking) continue;
    const float p = a.size * pulse(now_ms, a.apex_ms);
    brow = std::max(brow, p * a.brow);
    nod = std::max(nod, p * (1.2f - a.brow));
  }
  // Accents begin and end softly by themselves; this rounds off what an interruption cuts.
  const float follow = 1.0f - exp_of(-22.0f * dt_s);
  brow_ += (amount_ * brow - brow_) * follow;
  nod_ += (amount_ * nod - nod_) * follow;
  const float drift = 1.0f - exp_of(-1.8f * dt_s);
  yaw_ += ((speaking ? yaw_to_ : 0.0f) - yaw_) * drift;
  roll_ += ((speaking ? roll_to_ : 0.0f) - roll_) * drift;
  for (const int fap : {31, 32, 33, 34}) out_.faps.set(fap, kBrow * brow_);
  for (const int fap : {35, 36}) out_.faps.set(fap, 0.75f * kBrow * brow_);
  // Breath lifts the head a little, an accent nods it down.
  out_.faps.set(48, (kNod_deg * nod_ - 0.8f * breath_) * kAnglesPerDegree);
  out_.faps.set(49, 1.6f * amount_ * yaw_ * kAnglesPerDegree);
  out_.faps.set(50, 1.2f * amount_ * roll_ * kAnglesPerDegree);
}

const Life& Liveliness::step(const Utterance& utterance, float now_ms, float dt_s, bool speaking) {
  out_.blink = false;
  out_.beat = 0.0f;
  if (speaking) {
    plan(utterance, now_ms);
    phrase(utterance, now_ms);
  }
  breathe(utterance, now_ms, dt_s, speaking);
  // Speakers look away when they begin a long turn and back as a phrase ends (Kendon 1967); this
  // one serves, so she looks away little.
  const bool pausing = pause_ms_ >= 0.0f && now_ms - pause_ms_ < 500.0f;
  out_.attention = !speaking || pausing ? 1.0f : 0.8f;
  move(now_ms, dt_s, speaking);
  return out_;
}

}  // namespace caryatid::speech
