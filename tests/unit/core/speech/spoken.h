#pragma once
// Utterances for tests: phones of equal length from IPA.
#include <initializer_list>
#include <memory>

#include "core/speech/utterance.h"

namespace caryatid::speech {

inline std::unique_ptr<Utterance> spoken(std::initializer_list<const char*> ipa,
                                         std::int32_t phone_ms = 80, std::int32_t start_ms = 200) {
  auto out = std::make_unique<Utterance>();
  std::int32_t t = start_ms;
  for (const char* p : ipa) {
    (void)out->add_phone(t, phoneme_of({p, std::char_traits<char>::length(p)}));
    t += phone_ms;
  }
  (void)out->add_phone(t, Phoneme{});
  out->finish(t + 300);
  return out;
}

}  // namespace caryatid::speech
