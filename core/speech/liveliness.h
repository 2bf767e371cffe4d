#pragma once
// What brows, head, eyes, hands and lungs do while a person speaks: accents on stressed words (the
// eyebrow and head beats that listeners use to find them, Krahmer and Swerts 2007), blinks and eye
// contact at phrase ends (Condon and Ogston 1967; Kendon 1967), breath before a sentence.
// Deterministic for a seed and a sequence of steps; fixed memory; O(words ahead), about 1 us.
#include "core/base/random.h"
#include "core/face/fap.h"
#include "core/speech/utterance.h"

namespace caryatid::speech {

struct Life {
  face::FapFrame faps;     // Brows 31..36, head 48..50: to be added.
  bool blink = false;      // Start one now.
  float attention = 1.0f;  // Of the eyes for the listener, 0..1.
  float breath = 0.0f;     // How full the lungs are beyond rest, 0..1.
  float beat = 0.0f;       // > 0: the hand should start a beat of this size now.
};

class Liveliness {
 public:
  explicit Liveliness(std::uint64_t seed) : random_(seed) {}

  // A new utterance: what was planned is forgotten, what moves comes to rest.
  void begin(float amount);
  // now_ms: position that is heard; negative before the first sound. dt_s: since the last step.
  // `speaking` false: everything returns to rest.
  const Life& step(const Utterance& utterance, float now_ms, float dt_s, bool speaking);

 private:
  // A movement up to a stressed sound and down again.
  struct Accent {
    float apex_ms = 0.0f;
    float size = 0.0f;
    float brow = 0.0f;  // Share of the brows; the head has the rest.
  };
  static constexpr std::size_t kAccents = 4;

  void plan(const Utterance& utterance, float now_ms);
  void phrase(const Utterance& utterance, float now_ms);
  void breathe(const Utterance& utterance, float now_ms, float dt_s, bool speaking);
  void move(float now_ms, float dt_s, bool speaking);
  bool is_last_stress(const Utterance& utterance, std::size_t word) const;

  Random random_;
  float amount_ = 1.0f;
  Accent accents_[kAccents];
  std::size_t next_accent_ = 0;
  std::size_t planned_words_ = 0;
  float last_accent_ms_ = -1e6f, last_beat_ms_ = -1e6f, last_blink_ms_ = -1e6f;
  float pause_ms_ = -1.0f;  // Start of the pause that was answered last.
  float breath_ = 0.0f;
  // Where head turns and tilts drift to in this phrase, and where they are.
  float yaw_to_ = 0.0f, roll_to_ = 0.0f, yaw_ = 0.0f, roll_ = 0.0f;
  float brow_ = 0.0f, nod_ = 0.0f;
  Life out_;
};

}  // namespace caryatid::speech
