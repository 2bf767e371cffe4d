#include "core/speech/text.h"

#include <algorithm>
#include <cstring>

#include "core/base/crc.h"

namespace caryatid::speech {
namespace {

constexpr std::int32_t kCharacter_ms = 65;
constexpr std::int32_t kLeastWord_ms = 220;
constexpr std::int32_t kSentencePause_ms = 400;

unsigned char byte_at(std::span<const char> text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

bool follows(unsigned char c) { return (c & 0xC0u) == 0x80u; }

// Bytes of the valid character at `at` (Unicode table 3-7), or 0.
std::size_t character_bytes(std::span<const char> text, std::size_t at) {
  const unsigned char a = byte_at(text, at), b = byte_at(text, at + 1);
  if (a < 0x80) return 1;
  if (a < 0xC2 || a > 0xF4 || !follows(b)) return 0;
  if (a < 0xE0) return 2;
  if (!follows(byte_at(text, at + 2))) return 0;
  if (a < 0xF0) {
    const bool overlong = a == 0xE0 && b < 0xA0, surrogate = a == 0xED && b >= 0xA0;
    return overlong || surrogate ? 0 : 3;
  }
  if (!follows(byte_at(text, at + 3))) return 0;
  return (a == 0xF0 && b < 0x90) || (a == 0xF4 && b >= 0x90) ? 0 : 4;
}

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

bool ends_sentence(std::span<const char> text, std::size_t i) {
  const char c = text[i];
  // The Greek question mark is U+037E or a plain semicolon.
  return c == '.' || c == '!' || c == '?' || c == ';' || c == '\n' ||
         (byte_at(text, i) == 0xCD && byte_at(text, i + 1) == 0xBE);
}

}  // namespace

std::size_t mend_text(std::span<const char> text, std::span<char> out, bool* out_cut) {
  constexpr char kReplacement[] = "\xEF\xBF\xBD";
  std::size_t size = 0, after_word = 0, at = 0;
  while (at < text.size()) {
    const std::size_t whole = character_bytes(text, at);
    const char* from = whole > 0 ? text.data() + at : kReplacement;
    const std::size_t bytes = whole > 0 ? whole : 3;
    if (size + bytes > out.size()) break;
    std::memcpy(out.data() + size, from, bytes);
    if (whole == 1 && (byte_at(text, at) < 0x20 || text[at] == 0x7F) && text[at] != '\n')
      out[size] = ' ';
    if (is_blank(out[size])) after_word = size;
    size += bytes;
    at += whole > 0 ? whole : 1;
  }
  *out_cut = at < text.size();
  return *out_cut && after_word > 0 ? after_word : size;
}

FixedString<63> recording_name(std::span<const char> text, std::span<const char> language) {
  char out[64];
  std::size_t size = 0;
  const std::uint64_t hash = hash_of(text);
  for (int shift = 60; shift >= 0; shift -= 4)
    out[size++] = "0123456789abcdef"[hash >> shift & 15u];
  out[size++] = '-';
  for (const char c : language)
    if (size < 63) out[size++] = c == '/' || c == '.' ? '_' : c;
  return FixedString<63>({out, size});
}

std::optional<ByteRange> next_word(std::span<const char> text, std::uint32_t from, bool ssml) {
  std::size_t i = from;
  for (;;) {
    while (i < text.size() && is_blank(text[i])) ++i;
    if (i >= text.size()) return std::nullopt;
    if (!ssml || text[i] != '<') break;
    while (i < text.size() && text[i] != '>') ++i;
    if (i < text.size()) ++i;
  }
  std::size_t end = i;
  while (end < text.size() && !is_blank(text[end]) && !(ssml && text[end] == '<')) ++end;
  return ByteRange{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end)};
}

std::uint32_t next_sentence(std::span<const char> text, std::uint32_t from, bool ssml) {
  const auto is_gap = [ssml](char c) { return is_blank(c) || (ssml && c == '<'); };
  for (std::size_t i = from; i < text.size(); ++i) {
    if (ssml && text[i] == '<') {
      while (i < text.size() && text[i] != '>') ++i;
      continue;
    }
    if (!ends_sentence(text, i)) continue;
    // Inside a number or an abbreviation no blank follows.
    std::size_t next = i + 1;
    while (next < text.size() && (ends_sentence(text, next) || follows(byte_at(text, next))))
      ++next;
    if (next < text.size() && !is_gap(text[next]) && text[i] != '\n') continue;
    while (next < text.size() && is_blank(text[next])) ++next;
    return static_cast<std::uint32_t>(next);
  }
  return static_cast<std::uint32_t>(text.size());
}

void pace_words(std::span<const char> text, std::uint32_t from_byte, std::int32_t start_ms,
                bool ssml, Utterance* io) {
  io->continue_at(start_ms, 0);
  std::int32_t time_ms = 0;
  std::uint32_t at = from_byte;
  while (const auto word = next_word(text, at, ssml)) {
    std::int32_t characters = 1;
    for (std::uint32_t i = word->begin; i < word->end; ++i)
      characters += follows(byte_at(text, i)) ? 0 : 1;
    io->add_word(time_ms, word->begin, word->end);
    time_ms += std::max(characters * kCharacter_ms, kLeastWord_ms);
    if (ends_sentence(text, word->end - 1)) time_ms += kSentencePause_ms;
    at = word->end;
  }
  io->finish(time_ms);
}

}  // namespace caryatid::speech
