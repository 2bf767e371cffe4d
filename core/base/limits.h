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
// Buttons of the largest panel that we know of (12), and four for a remote control.
inline constexpr std::size_t kMaxButtons = 16;
// One utterance: the text of a full page of captions. Twelve sounds a second and two seconds of
// look-ahead and memory would do with 48 phones; one voice's numbers read out give bursts.
inline constexpr std::size_t kMaxSpeechBytes = 8192;
inline constexpr std::size_t kMaxPhones = 512;
inline constexpr std::size_t kMaxWords = 1536;  // Five bytes a word, blank included.
inline constexpr std::size_t kMaxMarks = 64;
inline constexpr std::size_t kMaxSentences = 64;  // Those that have not been heard yet.
static_assert(kMaxWords * 5 <= kMaxSpeechBytes);
// 16-bit indices: VC4 truncates longer ones.
inline constexpr std::size_t kMaxVerticesPerObject = 65535;

}  // namespace caryatid
