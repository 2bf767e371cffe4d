#include "core/speech/sound.h"

#include <algorithm>
#include <array>
#include <optional>

namespace caryatid::speech {
namespace {

enum class Place : std::uint8_t {
  bilabial,
  labiodental,
  dental,
  alveolar,
  postalveolar,
  palatal,
  velar,  // And everything behind it: the lips know nothing of it.
  glottal,
};
enum class Manner : std::uint8_t { plosive, nasal, trill, fricative, lateral, approximant };

struct Consonant {
  char32_t symbol;
  Place place;
  Manner manner;
};

// Height 0 (close, as in see) .. 1 (open, as in spa): the rows of the IPA chart, sevenths apart.
struct Vowel {
  char32_t symbol;
  float height;
  bool front;
  bool rounded;
  float hold;  // Central vowels leave the shape to their neighbours.
};

// The chart of the International Phonetic Association (revised 2020), pulmonic consonants, and
// implosives by their place.
constexpr Consonant kConsonants[] = {
    {U'p', Place::bilabial, Manner::plosive},
    {U'b', Place::bilabial, Manner::plosive},
    {U'ɓ', Place::bilabial, Manner::plosive},
    {U'm', Place::bilabial, Manner::nasal},
    {U'ʙ', Place::bilabial, Manner::plosive},
    {U'ɸ', Place::bilabial, Manner::fricative},
    {U'β', Place::bilabial, Manner::fricative},
    {U'f', Place::labiodental, Manner::fricative},
    {U'v', Place::labiodental, Manner::fricative},
    {U'ɱ', Place::labiodental, Manner::nasal},
    {U'ʋ', Place::labiodental, Manner::approximant},
    {U'ⱱ', Place::labiodental, Manner::fricative},
    {U'θ', Place::dental, Manner::fricative},
    {U'ð', Place::dental, Manner::fricative},
    {U't', Place::alveolar, Manner::plosive},
    {U'd', Place::alveolar, Manner::plosive},
    {U'ʈ', Place::alveolar, Manner::plosive},
    {U'ɖ', Place::alveolar, Manner::plosive},
    {U'ɗ', Place::alveolar, Manner::plosive},
    {U'n', Place::alveolar, Manner::nasal},
    {U'ɳ', Place::alveolar, Manner::nasal},
    {U'r', Place::alveolar, Manner::trill},
    {U'ɾ', Place::alveolar, Manner::trill},
    {U'ɽ', Place::alveolar, Manner::trill},
    {U's', Place::alveolar, Manner::fricative},
    {U'z', Place::alveolar, Manner::fricative},
    {U'ɬ', Place::alveolar, Manner::lateral},
    {U'ɮ', Place::alveolar, Manner::lateral},
    {U'l', Place::alveolar, Manner::lateral},
    {U'ɫ', Place::alveolar, Manner::lateral},
    {U'ɭ', Place::alveolar, Manner::lateral},
    {U'ɺ', Place::alveolar, Manner::lateral},
    {U'ɹ', Place::alveolar, Manner::approximant},
    {U'ɻ', Place::alveolar, Manner::approximant},
    {U'ʃ', Place::postalveolar, Manner::fricative},
    {U'ʒ', Place::postalveolar, Manner::fricative},
    {U'ʂ', Place::postalveolar, Manner::fricative},
    {U'ʐ', Place::postalveolar, Manner::fricative},
    {U'ɕ', Place::postalveolar, Manner::fricative},
    {U'ʑ', Place::postalveolar, Manner::fricative},
    {U'c', Place::palatal, Manner::plosive},
    {U'ɟ', Place::palatal, Manner::plosive},
    {U'ɲ', Place::palatal, Manner::nasal},
    {U'ç', Place::palatal, Manner::fricative},
    {U'ʝ', Place::palatal, Manner::fricative},
    {U'ʎ', Place::palatal, Manner::lateral},
    {U'j', Place::palatal, Manner::approximant},
    {U'k', Place::velar, Manner::plosive},
    {U'g', Place::velar, Manner::plosive},
    {U'ɡ', Place::velar, Manner::plosive},
    {U'ɠ', Place::velar, Manner::plosive},
    {U'q', Place::velar, Manner::plosive},
    {U'ɢ', Place::velar, Manner::plosive},
    {U'ŋ', Place::velar, Manner::nasal},
    {U'ɴ', Place::velar, Manner::nasal},
    {U'x', Place::velar, Manner::fricative},
    {U'ɣ', Place::velar, Manner::fricative},
    {U'χ', Place::velar, Manner::fricative},
    {U'ʁ', Place::velar, Manner::fricative},
    {U'ʀ', Place::velar, Manner::trill},
    {U'ɰ', Place::velar, Manner::approximant},
    {U'ʟ', Place::velar, Manner::lateral},
    {U'ħ', Place::glottal, Manner::fricative},
    {U'ʕ', Place::glottal, Manner::fricative},
    {U'h', Place::glottal, Manner::fricative},
    {U'ɦ', Place::glottal, Manner::fricative},
    {U'ʔ', Place::glottal, Manner::plosive},
};

constexpr Vowel kVowels[] = {
    {U'i', 0.0f, true, false, 0.8f},   {U'y', 0.0f, true, true, 0.9f},
    {U'ɨ', 0.0f, false, false, 0.5f},  {U'ʉ', 0.0f, false, true, 0.8f},
    {U'ɯ', 0.0f, false, false, 0.7f},  {U'u', 0.0f, false, true, 0.9f},
    {U'ɪ', 0.17f, true, false, 0.65f}, {U'ʏ', 0.17f, true, true, 0.8f},
    {U'ᵻ', 0.17f, false, false, 0.4f}, {U'ʊ', 0.17f, false, true, 0.75f},
    {U'e', 0.33f, true, false, 0.75f}, {U'ø', 0.33f, true, true, 0.85f},
    {U'ɘ', 0.33f, false, false, 0.5f}, {U'ɵ', 0.33f, false, true, 0.7f},
    {U'ɤ', 0.33f, false, false, 0.6f}, {U'o', 0.33f, false, true, 0.85f},
    {U'ə', 0.5f, false, false, 0.3f},  {U'ɚ', 0.5f, false, false, 0.35f},
    {U'ɛ', 0.6f, true, false, 0.75f},  {U'œ', 0.6f, true, true, 0.8f},
    {U'ɜ', 0.6f, false, false, 0.6f},  {U'ɝ', 0.6f, false, false, 0.6f},
    {U'ɞ', 0.6f, false, true, 0.7f},   {U'ʌ', 0.7f, false, false, 0.65f},
    {U'ɔ', 0.67f, false, true, 0.85f}, {U'æ', 0.83f, true, false, 0.8f},
    {U'ɐ', 0.83f, false, false, 0.6f}, {U'a', 1.0f, true, false, 0.85f},
    {U'ɶ', 1.0f, true, true, 0.8f},    {U'ɑ', 1.0f, false, false, 0.85f},
    {U'ɒ', 0.9f, false, true, 0.8f},
};

// Visemes of FAP 1 by their numbers.
enum : std::uint8_t {
  kNone,
  kLips,
  kLipTeeth,
  kTongueTeeth,
  kStop,
  kBack,
  kHush,
  kHiss,
  kNasal,
  kR,
  kA,
  kE,
  kI,
  kO,
  kU
};

Sound sound(std::uint8_t first, float hold, Contact contact = Contact::none) {
  return {.first = first, .second = first, .contact = contact, .hold = hold};
}

Sound mixed(std::uint8_t first, std::uint8_t second, float share, float hold) {
  Sound s{.first = first, .second = second, .hold = hold};
  s.blend = static_cast<std::uint8_t>(std::clamp(share, 0.0f, 1.0f) * 63.0f + 0.5f);
  return s;
}

Sound alveolar(Manner manner) {
  switch (manner) {
    case Manner::plosive:
      return sound(kStop, 0.7f, Contact::tongue_palate);
    case Manner::fricative:
      return sound(kHiss, 0.8f);
    case Manner::approximant:
      return sound(kR, 0.75f);
    case Manner::trill: {
      Sound s = mixed(kNasal, kR, 0.6f, 0.5f);  // No lips: Greek and Spanish r.
      s.contact = Contact::tongue_palate;
      return s;
    }
    default:
      return sound(kNasal, 0.6f, Contact::tongue_palate);
  }
}

Sound sound_of(const Consonant& c) {
  switch (c.place) {
    case Place::bilabial:
      if (c.manner == Manner::fricative) return mixed(kLips, kU, 0.6f, 0.9f);
      return sound(kLips, 1.0f, Contact::lips);
    case Place::labiodental:
      if (c.manner == Manner::approximant) return mixed(kLipTeeth, kI, 0.6f, 0.7f);
      return sound(kLipTeeth, 1.0f, Contact::lip_teeth);
    case Place::dental:
      return sound(kTongueTeeth, 0.9f, Contact::tongue_teeth);
    case Place::alveolar:
      return alveolar(c.manner);
    case Place::postalveolar:
      return sound(kHush, 0.95f);
    case Place::palatal:
      if (c.manner == Manner::approximant) return sound(kI, 0.6f);
      if (c.manner == Manner::nasal || c.manner == Manner::lateral) {
        Sound s = mixed(kNasal, kI, 0.5f, 0.6f);
        s.contact = Contact::tongue_palate;
        return s;
      }
      return mixed(kBack, kI, 0.5f, 0.5f);
    case Place::velar:
      return sound(kBack, 0.45f);
    case Place::glottal:
      break;
  }
  return mixed(kE, kNone, 0.4f, 0.1f);
}

Sound sound_of(const Vowel& v) {
  const float open = v.height;
  Sound s;
  if (v.rounded && v.front)
    s = open < 0.25f ? mixed(kU, kI, 0.8f, v.hold) : mixed(open < 0.5f ? kU : kO, kE, 0.7f, v.hold);
  else if (v.rounded)
    s = open < 0.5f ? mixed(kU, kO, 1.0f - 2.0f * open, v.hold)
                    : mixed(kO, kA, 1.6f - open, v.hold);
  else if (open < 0.5f)
    s = mixed(kI, kE, 1.0f - 2.0f * open, v.hold);
  else
    s = mixed(kE, kA, 2.0f - 2.0f * open, v.hold);
  s.vowel = true;
  return s;
}

// One code point of UTF-8 that starts at `*io_at`, which is moved behind it; U+FFFD for what is
// none.
char32_t next_symbol(std::span<const char> text, std::size_t* io_at) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const std::size_t at = (*io_at)++;
  const std::uint32_t lead = byte(at);
  if (lead < 0x80) return lead;
  const std::size_t more = lead >= 0xF0 ? 3 : (lead >= 0xE0 ? 2 : 1);
  if (lead < 0xC2 || lead > 0xF4) return U'\uFFFD';
  std::uint32_t code = lead & (0x3Fu >> more);
  for (std::size_t i = 1; i <= more; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return U'\uFFFD';
    code = code << 6u | (byte(at + i) & 0x3Fu);
    ++*io_at;
  }
  return code;
}

std::optional<Sound> sound_of(char32_t symbol) {
  for (const Vowel& v : kVowels)
    if (v.symbol == symbol) return sound_of(v);
  for (const Consonant& c : kConsonants)
    if (c.symbol == symbol) return sound_of(c);
  if (symbol == U'w' || symbol == U'ʍ') return sound(kU, 0.85f);  // Two places at once.
  if (symbol == U'ɥ') return mixed(kU, kI, 0.7f, 0.8f);
  return std::nullopt;
}

bool is_hush(const Sound& s) { return s.first == kHush; }

}  // namespace

Phoneme phoneme_of(std::span<const char> ipa) {
  constexpr char32_t kPrimaryStress = U'ˈ', kSecondaryStress = U'ˌ';
  Phoneme out;
  int sounds = 0;
  bool unknown = false;
  for (std::size_t at = 0; at < ipa.size();) {
    const char32_t symbol = next_symbol(ipa, &at);
    out.stressed = out.stressed || symbol == kPrimaryStress;
    std::optional<Sound> known = sound_of(symbol);
    // A palatal glide by itself, as Russian has it behind soft consonants.
    if (symbol == U'ʲ' && sounds == 0) known = sound(kI, 0.4f);
    if (!known) {
      // Length, ties, diacritics and blanks have no shape of their own.
      unknown = unknown || (symbol != kPrimaryStress && symbol != kSecondaryStress &&
                            symbol > U' ' && symbol != U'_' && symbol != U'ː' && symbol != U':');
      continue;
    }
    if (sounds++ == 0) out.begins = *known;
    out.ends = *known;
  }
  if (sounds == 0 && unknown) out.begins = out.ends = mixed(kE, kNone, 0.4f, 0.2f);
  // ch and j are one gesture of the lips from their start on.
  if (is_hush(out.ends) && out.begins.first == kStop) out.begins = out.ends;
  return out;
}

}  // namespace caryatid::speech
