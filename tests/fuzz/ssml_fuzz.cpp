// Texts as authors write them: any bytes give plain text within its limit, with cues in order.
#include <cstdlib>
#include <string>

#include "firmware-app/texts/ssml_parser.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid;
  app::SsmlContext context;
  context.languages = {"en", "el"};
  context.constants = {{"museum", "Aegis & <b>"}};
  context.complain = [size](std::size_t at, const std::string& what) {
    if (at > size || what.empty()) std::abort();
  };
  const app::ParsedText text =
      app::parse_ssml({reinterpret_cast<const char*>(data), size}, context);
  if (text.plain.size() > kMaxTextBytes) std::abort();
  std::size_t at = 0;
  for (const agent::Cue& c : text.cues) {
    if (c.at < at || c.at > text.plain.size()) std::abort();
    at = c.at;
  }
  for (const char c : text.plain)
    if (static_cast<unsigned char>(c) > agent::kVariableCount && c != '\n' &&
        static_cast<unsigned char>(c) < ' ')
      std::abort();
  return 0;
}
