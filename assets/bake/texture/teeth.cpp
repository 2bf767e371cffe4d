#include "assets/bake/texture/teeth.h"

#include "assets/bake/texture/atlas.h"

namespace caryatid::bake {

void paint_teeth(LinearImage& image) {
  constexpr Vec3 kIvory{0.78f, 0.72f, 0.60f}, kGum{0.56f, 0.22f, 0.20f};  // Linear.
  for (Vec4& t : image.texel) {
    const float most = std::max({t.x, t.y, t.z}), least = std::min({t.x, t.y, t.z});
    const float gum = smooth_step(0.30f, 0.60f, (most - least) / std::max(most, 1e-3f));
    const float tooth_form = glm::mix(0.50f, 1.0f, smooth_step(0.03f, 0.55f, most));
    const float gum_form = glm::mix(0.60f, 1.15f, smooth_step(0.02f, 0.30f, most));
    t = Vec4{glm::mix(kIvory * tooth_form, kGum * gum_form, gum), t.w};
  }
}

}  // namespace caryatid::bake
