#pragma once
// A text of the programme: plain words with a small subset of SSML 1.1 and variables.
//
//   <break time="500ms"/> <break strength="strong"/>   a pause
//   <emphasis>word</emphasis>                           stressed, and shown so
//   <say-as interpret-as="characters">AB</say-as>       letter by letter
//   <mark name="wave"/>                                 a gesture here: wave, point, nod, shake,
//                                                       shrug, beat
//   <lang xml:lang="el">Ελλάδα</lang>                   another language of the kiosk
//   <p> <s> <speak>                                     structure; a new <p> begins a new line
//   {time} {opening_hours} ...                          see agent::Variable, and [variables]
//
// Anything else between angle brackets is reported once a text and left out; what stands between
// its tags is spoken all the same.
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/agent/programme.h"

namespace caryatid::app {

struct ParsedText {
  std::string plain;  // UTF-8 without tags; a byte of 1..agent::kVariableCount is that variable.
  std::vector<agent::Cue> cues;  // In order; emphasis, language and spelling are closed again.
};

struct SsmlContext {
  std::vector<std::string> languages;            // Codes, by index.
  std::size_t language = 0;                      // Of this text.
  std::map<std::string, std::string> constants;  // [variables] of kiosk.toml.
  // Told of every fault: byte of the source, what is wrong and what to do.
  std::function<void(std::size_t, const std::string&)> complain;
};

// Never fails. At most agent's kMaxTextBytes of plain text; longer text is cut at a blank, with a
// complaint.
ParsedText parse_ssml(std::string_view source, const SsmlContext& context);

}  // namespace caryatid::app
