#include "assets/tool/wire.h"

#include <algorithm>

#include "assets/tool/raster.h"

namespace caryatid::tool {
namespace {

Vec3 posed(const agent::Person& person, const pack::Object& object, const scene::MeshView& mesh,
           std::size_t v) {
  const scene::StaticVertex& fixed = mesh.fixed[v];
  Vec3 sum{0};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t bone = std::min<std::size_t>(fixed.bone[k], kMaxBonesPerDraw - 1);
    if (fixed.weight[k] > 0)
      sum += static_cast<float>(fixed.weight[k]) / 255.0f *
             person.joints()[object.bone[bone]].point(mesh.dynamic[v].position_m);
  }
  return sum;
}

}  // namespace

Picture wire_picture(const agent::Person& person, const scene::Camera& camera, std::uint32_t width,
                     std::uint32_t height) {
  Raster raster(width, height, true);
  const Mat4 to_clip = camera.projection * camera.view;
  const pack::View& pack = person.view();
  for (std::size_t o = 0; o < person.object_count(); ++o) {
    const pack::Object& object = pack.objects[o];
    if ((pack.materials[object.material].flags & pack::kCornea) != 0) continue;
    const scene::MeshView& mesh = person.meshes()[o];
    std::vector<Vec4> clip(mesh.vertex_count);
    for (std::size_t v = 0; v < clip.size(); ++v)
      clip[v] = to_clip * Vec4{posed(person, object, mesh, v), 1.0f};
    for (std::size_t t = 0; t < mesh.triangle_count; ++t) {
      const auto corner = [&](std::size_t k) { return clip[mesh.indices[3 * t + k]]; };
      if (std::min({corner(0).w, corner(1).w, corner(2).w}) <= 0.0f) continue;  // Behind the eye.
      const auto seen = [&](std::size_t k) {
        const Vec4 c = corner(k);
        return bake::Vec3d{raster.width() * 0.5 * (1.0 + double{c.x / c.w}),
                           raster.height() * 0.5 * (1.0 - double{c.y / c.w}), -double{c.z / c.w}};
      };
      raster.add({seen(0), seen(1), seen(2)});
    }
  }
  return raster.picture();
}

}  // namespace caryatid::tool
