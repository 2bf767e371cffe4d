#pragma once
// An expanded text as SSML for the voice, and the way back: voices report words by their bytes in
// what they were given, captions need them in the plain text.
#include "core/agent/programme.h"

namespace caryatid::agent {

class Ssml {
 public:
  // Writes `text` with its cues. What does not fit is cut; elements are closed all the same.
  // O(bytes).
  void write(const Programme& programme, const Utterable& text);
  std::string_view text() const { return {text_.begin(), text_.size()}; }
  // Byte of the plain text for a byte of text(); inside a tag: where the tag stands. O(log tags).
  std::uint32_t plain_byte(std::uint32_t ssml_byte) const;

 private:
  struct Anchor {
    std::uint32_t ssml = 0, plain = 0;
  };
  void put(std::string_view piece);
  void anchor(std::size_t plain_at);
  void put_cue(const Programme& programme, const Cue& cue);

  FixedVector<char, kMaxSpeechBytes> text_;
  FixedVector<Anchor, 1024> anchors_;
  bool emphasis_ = false, language_ = false, spell_ = false;
};

}  // namespace caryatid::agent
