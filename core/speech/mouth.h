#pragma once
// The mouth of an utterance at a moment: neighbouring sounds blended by dominance functions (Cohen
// and Massaro 1993), then contacts made certain that make a sound readable: lips shut on p b m,
// lower lip at the teeth on f v, tongue seen on th and l. Looks ahead: lips move before the sound.
#include <array>

#include "core/face/fap.h"
#include "core/face/visemes.h"
#include "core/speech/utterance.h"

namespace caryatid::speech {

// How long before its sound a shape comes on the screen: 13 ms, and half of the time for which a
// picture stays there.
float mouth_lead_ms(float frame_ms);
// Events this far ahead of the moment have a say; a voice that streams must be ahead by as much.
inline constexpr float kLookAhead_ms = 350.0f;

struct MouthShape {
  face::FapFrame faps;       // Mouth and tongue FAPs, inner and outer lips, all present.
  face::VisemeField viseme;  // The nearest that FAP 1 can say.
  float strength = 0.0f;     // 0 far from any sound .. 1: for face::MixJob::speech_strength.
  float contact = 0.0f;      // 1: the contact of a sound is being held.
};

class Mouth {
 public:
  // Takes the shapes of face::viseme_frame(), about 20 us. holds_contacts: false leaves the blend
  // to itself, so that tests can show what the certainty of contacts is worth.
  explicit Mouth(bool holds_contacts = true);

  // now_ms: the moment in the utterance's audio that is heard when the picture is seen;
  // mouth_lead_ms() is added here. frame_ms: time until the next picture (clamped to 8..100): no
  // contact is shorter than that, so that each is seen. About 3 us, no state.
  MouthShape at(const Utterance& utterance, float now_ms, float frame_ms) const;

 private:
  std::array<face::FapFrame, face::kVisemeCount> shapes_;
  bool holds_contacts_;
};

}  // namespace caryatid::speech
