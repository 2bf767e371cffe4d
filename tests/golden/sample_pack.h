#pragma once
// A still life for the renderer's tests: six spheres, one for each kind of material, with textures
// of all three formats, made here from formulas.
#include <array>
#include <vector>

#include "core/pack/view.h"
#include "core/scene/draw_list.h"

namespace caryatid::golden {

class SamplePack {
 public:
  SamplePack();
  SamplePack(const SamplePack&) = delete;
  SamplePack& operator=(const SamplePack&) = delete;

  const pack::View& view() const { return view_; }
  // A list with camera, studio light, all six spheres and patches that tell everything is new.
  const scene::DrawList& list() { return list_; }
  scene::DrawList& edit_list() { return list_; }
  // Before a renderer opens the pack.
  pack::Material& edit_material(std::size_t index) { return materials_[index]; }
  // Vertices of one sphere; changes show once a patch names them.
  std::vector<scene::DynamicVertex>& dynamic(std::size_t object) { return dynamic_[object]; }

 private:
  void add_textures();
  void add_sphere(pack::MaterialKind kind, Vec3 center_m);
  void compose();

  std::vector<pack::Texture> textures_;
  std::vector<std::byte> texels_;
  std::vector<pack::Material> materials_;
  std::vector<pack::Object> objects_;
  std::array<std::vector<scene::DynamicVertex>, 6> dynamic_;
  std::vector<scene::StaticVertex> fixed_;
  std::vector<std::uint16_t> indices_;
  std::vector<scene::MeshView> meshes_;
  pack::View view_;
  scene::DrawList list_;
};

}  // namespace caryatid::golden
