#include "assets/tool/soles.h"

namespace caryatid::tool {

std::vector<bake::SolePoint> skinned_soles(const agent::Person& person) {
  std::vector<bake::SolePoint> points;
  const pack::View& view = person.view();
  for (std::size_t o = 0; o < person.object_count(); ++o) {
    const pack::Object& object = view.objects[o];
    const scene::MeshView& mesh = person.meshes()[o];
    for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
      const Vec3 rest = mesh.dynamic[v].position_m;
      if (rest.y > 0.035f) continue;
      bake::SolePoint p{rest, rest.x > 0.0f, {}};
      const scene::StaticVertex& skin = mesh.fixed[v];
      for (std::size_t k = 0; k < 4; ++k)
        if (skin.weight[k] > 0)
          p.shares.push_back(
              {static_cast<body::HanimJoint>(view.joints[object.bone[skin.bone[k]]].hanim),
               static_cast<float>(skin.weight[k]) / 255.0f});
      points.push_back(std::move(p));
    }
  }
  return points;
}

}  // namespace caryatid::tool
