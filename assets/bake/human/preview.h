#pragma once
// A small software renderer for looking at a character without a GPU: z-buffer, texture, alpha,
// soft key, fill and rim light. It makes the numbered picture of the feature points in the
// documentation; the kiosk never uses it.
#include "assets/bake/model.h"

namespace caryatid::bake {

struct PreviewView {
  Vec3 target_m{0, 0.9f, 0};
  float height_m = 1.9f;  // What the picture's height shows at the target.
  float yaw_rad = 0;      // 0 looks at the front, +pi/2 at the figure's left side.
  float pitch_rad = 0;    // > 0 from above.
  float distance_m = 4.0f;
  std::uint32_t width = 800, height = 1000;
  bool number_feature_points = false;
  bool textures = true;
  std::vector<std::string> hide;  // Names of objects to leave out.
};

Image render_preview(const Character& character, const PreviewView& view);

}  // namespace caryatid::bake
