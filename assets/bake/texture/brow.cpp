#include "assets/bake/texture/brow.h"

#include "assets/bake/texture/atlas.h"

namespace caryatid::bake {
namespace {

constexpr float kHead_m = 0.009f;  // Length of the brow over which it grows dense.

}  // namespace

void thin_heads(const Proxy& brows, std::span<const Vec3> position_m, LinearImage& image) {
  // Distance from the middle plane by texel; only texels that the mesh shows.
  std::vector<float> side_m(image.texel.size(), -1.0f);
  const auto uv = [&](const Quad& quad, std::size_t k) {
    const Vec2 t = brows.uvs[quad.uv[k]];
    return Vec2{t.x, 1.0f - t.y};
  };
  for (const Quad& quad : brows.quads)
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
      for_texels(image.width, uv(quad, 0), uv(quad, k), uv(quad, k + 1),
                 [&](std::uint32_t x, std::uint32_t y, Vec3 w) {
                   side_m[std::size_t{y} * image.width + x] = std::abs(
                       w.x * position_m[quad.vertex[0]].x + w.y * position_m[quad.vertex[k]].x +
                       w.z * position_m[quad.vertex[k + 1]].x);
                 });
  float inner_m = 1.0f;
  for (std::size_t i = 0; i < side_m.size(); ++i)
    if (side_m[i] >= 0.0f && image.texel[i].w > 0.25f) inner_m = std::min(inner_m, side_m[i]);
  for (std::size_t i = 0; i < side_m.size(); ++i) {
    if (side_m[i] < 0.0f) continue;
    float& alpha = image.texel[i].w;
    const float dense = smooth_step(inner_m - 0.001f, inner_m + kHead_m, side_m[i]);
    // The darkest strokes of the drawing outlast the rest.
    alpha *= dense * glm::mix(smooth_step(0.3f, 0.8f, alpha), 1.0f, dense);
  }
}

}  // namespace caryatid::bake
