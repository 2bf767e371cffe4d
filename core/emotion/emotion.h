#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace caryatid::emotion {

// The six universal emotions, numbered as MPEG-4's FAP 2 selects them (ISO/IEC 14496-2 annex C).
enum class Emotion : std::uint8_t { calm, joy, sadness, anger, fear, disgust, surprise };
inline constexpr std::size_t kEmotionCount = 7;  // With calm.

inline constexpr std::array<std::string_view, kEmotionCount> kEmotionNames = {
    "calm", "joy", "sadness", "anger", "fear", "disgust", "surprise"};

constexpr std::size_t index_of(Emotion e) { return static_cast<std::size_t>(e); }

// How much of each emotion is shown, 0..1 each; entry 0 (calm) is not used.
using Weights = std::array<float, kEmotionCount>;

}  // namespace caryatid::emotion
