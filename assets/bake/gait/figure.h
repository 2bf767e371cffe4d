#pragma once
// Stick figures of posed skeletons as SVG: to look at a walk before and beside the skinned body.
#include <span>
#include <string>
#include <vector>

#include "core/body/bap.h"
#include "core/body/bap_axes.h"
#include "core/body/hanim.h"

namespace caryatid::bake {

enum class FigureView { side, front };

struct FigureStrip {
  std::string caption;
  std::vector<body::BapFrame> frames;
  FigureView view = FigureView::side;
  body::BapConvention convention = body::BapConvention::signed_axes;
};

// Strips beneath each other, each figure on its own piece of floor (the body's travel is taken
// out), left limbs red, right limbs blue. Side view: walking to the right.
std::string figure_svg(const body::Skeleton& skeleton, std::span<const FigureStrip> strips);

}  // namespace caryatid::bake
