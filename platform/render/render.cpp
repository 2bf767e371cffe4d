#include "platform/render/render.h"

namespace caryatid::platform {

bool item_is_valid(const scene::DrawList& list, const pack::View& pack,
                   const scene::DrawItem& item) {
  if (item.object >= pack.objects.size() || item.object >= list.meshes.size()) return false;
  if (item.material >= pack.materials.size()) return false;
  if (item.bone_count > kMaxBonesPerDraw) return false;
  if (std::size_t{item.first_bone} + item.bone_count > list.bones.size()) return false;
  const scene::MeshView& mesh = list.meshes[item.object];
  const pack::Object& object = pack.objects[item.object];
  return item.triangle_count <= mesh.triangle_count &&
         mesh.triangle_count <= object.max_triangle_count &&
         mesh.vertex_count <= object.max_vertex_count && mesh.dynamic.size() >= mesh.vertex_count &&
         mesh.fixed.size() >= mesh.vertex_count &&
         mesh.indices.size() >= std::size_t{3} * mesh.triangle_count;
}

}  // namespace caryatid::platform
