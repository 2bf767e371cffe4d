#pragma once
// Lines of the face: how deep each group of them is folded by the face that is shown. The skin over
// a muscle folds across its pull: frontalis lifts the brows and folds the forehead in rows,
// corrugator draws them together and folds upright lines between them, orbicularis oculi closes
// round the eye and fans out from its corner, zygomaticus pulls the cheek over the fold beside nose
// and mouth (thesis chapter 6; the lines that its section 8.2 asks for).
//
// The lines themselves are drawn once, in the detail texture of a pack's skin: one channel a group,
// in this order. Left is the figure's left.
#include <array>

#include "core/face/fap.h"

namespace caryatid::face {

enum class Wrinkle : std::uint8_t { forehead, glabella, crows_foot, nasolabial };
inline constexpr std::size_t kWrinkleCount = 4;

// 0 smooth .. 1 as deep as drawn, by Wrinkle.
struct Wrinkles {
  std::array<float, kWrinkleCount> left{}, right{};
  friend bool operator==(const Wrinkles&, const Wrinkles&) = default;
};

// From the frame that is shown (absolute FAPs, as MixJob gives them). Each weight rises smoothly
// and monotonically with the FAPs that fold its lines; left and right depend on their own side's
// alone. A blink folds nothing. Any finite input; O(1).
Wrinkles wrinkles_of(const FapFrame& faps);

}  // namespace caryatid::face
