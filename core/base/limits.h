#pragma once
// Every capacity of the agent in one place, each with the sum that justifies it.
#include <cstddef>

namespace caryatid {

// Joints: 94 of H-Anim LOA3 (body) + 2 eyeballs + jaw + 4 tongue = 101; rounded up.
inline constexpr std::size_t kMaxJoints = 112;
// Bones a draw can hold: 30 * 3 vec4 + 24 reserved stays under the 128 vec4 of GLES 2.0.
inline constexpr std::size_t kMaxBonesPerDraw = 30;
// Objects of a character: skin head, body, 2 hands, 2 eyes, teeth, tongue, brows, lashes, hair (2),
// garments and shoes (6), panels and captions (6); rounded up.
inline constexpr std::size_t kMaxObjects = 32;
inline constexpr std::size_t kMaxMaterials = 32;
inline constexpr std::size_t kMaxTextures = 24;
inline constexpr std::size_t kMaxDrawItems = 64;
static_assert(kMaxDrawItems >= 2 * kMaxObjects);  // Hair is drawn in two passes at most.
// One utterance: the text of a full page of captions. Twelve sounds a second and two seconds of
// look-ahead and memory would do with 48 phones; one voice's numbers read out give bursts.
inline constexpr std::size_t kMaxSpeechBytes = 8192;
inline constexpr std::size_t kMaxPhones = 512;
inline constexpr std::size_t kMaxWords = 1536;  // Five bytes a word, blank included.
inline constexpr std::size_t kMaxMarks = 64;
inline constexpr std::size_t kMaxSentences = 64;  // Those that have not been heard yet.
static_assert(kMaxWords * 5 <= kMaxSpeechBytes);
// Buttons of the largest panel that we know of (12), four for a remote control, 16 codes of a
// barcode or RFID reader.
inline constexpr std::size_t kMaxButtons = 32;
// A spoken paragraph: two minutes of Greek at 15 letters a second, two bytes each.
inline constexpr std::size_t kMaxTextBytes = 4096;
// Words of it and the blanks between them, at 8 bytes a pair.
inline constexpr std::size_t kMaxRuns = kMaxTextBytes / 4;
inline constexpr std::size_t kMaxTextLines = 128;
// Letters and boxes over the picture: a page of text (400), captions (3 lines of 45), a menu of
// nine; each letter of a caption twice, for its outline.
inline constexpr std::size_t kMaxOverlayQuads = 2048;
inline constexpr std::size_t kMaxPictures = 32;
inline constexpr std::size_t kMaxLanguages = 8;
inline constexpr std::size_t kMaxPages = 64;
// One compiled programme; the agent holds two while texts are reloaded.
inline constexpr std::size_t kMaxProgrammeBytes = 512 * 1024;
// 16-bit indices: VC4 truncates longer ones.
inline constexpr std::size_t kMaxVerticesPerObject = 65535;
static_assert(4 * kMaxOverlayQuads <= kMaxVerticesPerObject);

}  // namespace caryatid
