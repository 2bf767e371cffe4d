#include "assets/bake/human/build.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "assets/bake/human/bite.h"
#include "assets/bake/human/cover.h"
#include "assets/bake/human/figure.h"
#include "assets/bake/human/inner_face.h"
#include "assets/bake/human/mesh_tools.h"
#include "assets/bake/human/neutral.h"
#include "assets/bake/human/skeleton.h"
#include "assets/bake/texture/brow.h"
#include "assets/bake/texture/eye.h"
#include "assets/bake/texture/head_skin.h"
#include "assets/bake/texture/image.h"
#include "assets/bake/texture/teeth.h"
#include "core/body/hanim.h"

namespace caryatid::bake {
namespace {

constexpr float kClothGap_m = 0.004f;
// hm08 has an edge loop of 46 vertices at the foot of the neck, all others above it are head.
constexpr float kNeckLoop_m = 0.59f;

enum class Region : std::uint8_t { head, body, legs, l_hand, r_hand, count };
constexpr const char* kRegionNames[] = {"head", "body", "legs", "l_hand", "r_hand"};

// Which skin object each vertex of the base would choose.
std::vector<Region> vertex_regions(const BaseHuman& base) {
  std::vector<Region> of_bone;
  for (const Bone& bone : base.bones()) {
    const auto is = [&](const char* stem) { return bone.name.starts_with(stem); };
    Region region = Region::body;
    if (is("wrist") || is("finger") || is("metacarpal"))
      region = bone.name.ends_with(".L") ? Region::l_hand : Region::r_hand;
    if (is("upperleg") || is("lowerleg") || is("foot") || is("toe")) region = Region::legs;
    of_bone.push_back(region);
  }
  std::vector<Region> out(BaseHuman::kVertexCount, Region::body);
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::array<float, static_cast<std::size_t>(Region::count)> share{};
    const Influence& influence = base.influence()[i];
    for (std::size_t k = 0; k < 4; ++k)
      share[static_cast<std::size_t>(of_bone[influence.joint[k]])] += influence.weight[k];
    out[i] = static_cast<Region>(std::max_element(share.begin(), share.end()) - share.begin());
    if (base.rest_m()[i].y > kNeckLoop_m) out[i] = Region::head;
  }
  return out;
}

// A quad belongs to a region when all its vertices do; mixed ones go to the body.
Region quad_region(const Quad& quad, std::span<const Region> regions) {
  for (const std::uint32_t v : quad.vertex)
    if (regions[v] != regions[quad.vertex[0]]) return Region::body;
  return regions[quad.vertex[0]];
}

class Builder {
 public:
  Builder(const Recipe& recipe, const BaseHuman& base, const std::vector<FeaturePointPlace>& places)
      : recipe_(recipe), base_(base), places_(places), figure_(make_figure(recipe, base, places)) {
    stand(figure_);
    const Vec3 eyes[2] = {figure_.eye_center_m(0), figure_.eye_center_m(1)};
    out_.name = recipe.name;
    out_.joints = hanim_joints(base, figure_.bone_head_m, eyes);
    weights_ = std::make_unique<WeightMap>(base, out_.joints);
  }

  Character build() {
    add_skin();
    for (const FittedPart& part : figure_.parts) add_part(part);
    settle_gaze(out_);
    settle_tongue(out_);
    for (const auto& [fap, value] : recipe_.rest_face)
      out_.rest_face[static_cast<std::size_t>(fap)] = value;
    limit_joints();
    place_feature_points(places_, out_);
    paint_own_head();
    check_neutral(out_, kIrisToBall * figure_.eye_diameter_m());
    return std::move(out_);
  }

 private:
  std::uint16_t add_image(Image image) {
    out_.images.push_back(std::move(image));
    return static_cast<std::uint16_t>(out_.images.size() - 1);
  }
  std::uint32_t add_material(pack::MaterialKind kind, unsigned flags, std::uint16_t texture,
                             float gloss, float shininess) {
    pack::Material material{};
    material.kind = kind;
    material.flags = static_cast<std::uint16_t>(flags);
    material.texture = texture;
    material.detail = pack::kNoTexture;
    for (float& t : material.tint) t = 1.0f;
    material.gloss = gloss;
    material.shininess = shininess;
    out_.materials.push_back(material);
    return static_cast<std::uint32_t>(out_.materials.size() - 1);
  }

  // The head has a texture of its own; the rest of the body keeps the base's.
  void paint_own_head() {
    for (Object& object : out_.objects) {
      if (object.role != pack::ObjectRole::head) continue;
      pack::Material material = out_.materials[object.material];
      std::vector<Vec3> border_m;
      for (const std::uint32_t v : object.locked) border_m.push_back(object.mesh.position_m[v]);
      HeadImages images =
          paint_head(out_, recipe_.skin, out_.images[material.texture], border_m, object.mesh);
      material.texture = add_image(std::move(images.skin));
      material.detail = add_image(std::move(images.lines));
      out_.materials.push_back(material);
      object.material = static_cast<std::uint32_t>(out_.materials.size() - 1);
    }
  }

  void add_skin() {
    std::vector<Quad> skin;
    for (const Quad& quad : base_.quads())
      if (quad.group == 0) skin.push_back(quad);
    // Normals before the push beneath the clothes: what shows keeps its shading.
    const auto normals = smooth_normals(skin, figure_.base_m);
    const auto rest_m = figure_.base_m;
    const std::vector<bool> hidden = cover_skin(figure_, kClothGap_m);
    const auto regions = vertex_regions(base_);
    const Image image = read_image(base_.folder() / "public/data/skins" / recipe_.skin.texture);
    out_.licences.push_back({recipe_.skin.texture, "CC0-1.0 (MakeHuman core asset)", "MakeHuman"});
    const std::uint32_t material =
        add_material(pack::MaterialKind::skin, 0, add_image(image), 0.08f, 18.0f);
    for (int k = 0; k < 3; ++k) out_.materials[material].tint[k] = recipe_.skin.tint[k];
    const MeshSource source{
        skin,
        figure_.base_m,
        normals,
        base_.uvs(),
        [&](std::uint32_t v) { return (*weights_)(base_.influence()[v], rest_m[v]); },
        true};
    for (std::size_t r = 0; r < static_cast<std::size_t>(Region::count); ++r) {
      Object object;
      object.name = kRegionNames[r];
      object.role = r == 0 ? pack::ObjectRole::head : pack::ObjectRole::body;
      object.material = material;
      if (static_cast<Region>(r) == Region::legs && recipe_.skin.tights.x >= 0.0f) {
        object.material = add_material(pack::MaterialKind::cloth, 0,
                                       out_.materials[material].texture, 0.3f, 12.0f);
        for (int k = 0; k < 3; ++k) out_.materials.back().tint[k] = recipe_.skin.tights[k];
      }
      object.mesh = make_mesh(source, [&](const Quad& quad) {
        const bool covered = std::all_of(quad.vertex.begin(), quad.vertex.end(),
                                         [&](std::uint32_t v) { return hidden[v]; });
        return !covered && quad_region(quad, regions) == static_cast<Region>(r);
      });
      if (!object.mesh.triangles.empty()) out_.objects.push_back(std::move(object));
    }
    lock_shared_borders();
  }

  // Vertices that two skin objects share never move: their borders stay bit-equal at every level.
  void lock_shared_borders() {
    std::map<std::uint32_t, std::set<std::size_t>> owners;
    for (std::size_t o = 0; o < out_.objects.size(); ++o)
      for (const std::uint32_t v : out_.objects[o].mesh.base_vertex) owners[v].insert(o);
    for (Object& object : out_.objects)
      for (std::uint32_t i = 0; i < object.mesh.base_vertex.size(); ++i)
        if (owners[object.mesh.base_vertex[i]].size() > 1) object.locked.push_back(i);
  }

  Image part_image(const FittedPart& part) const {
    if (part.proxy.textures.empty()) throw std::runtime_error(part.proxy.name + ": has no texture");
    const auto file = part.recipe.texture.empty() ? part.proxy.textures.front()
                                                  : part.proxy.folder / part.recipe.texture;
    LinearImage image = to_linear(read_image(file));
    if (part.recipe.contrast != 1.0f) set_contrast(image, part.recipe.contrast);
    const std::string kind = part.proxy.name.substr(0, part.proxy.name.find('/'));
    // Brows and lashes are drawn black: they take the colour of the hair whole, softened a little.
    const bool hairs =
        part.proxy.name.starts_with("eyebrows") || part.proxy.name.starts_with("eyelashes");
    for (Vec4& t : image.texel) {
      if (hairs) {
        t = Vec4{part.recipe.tint, part.recipe.softness * t.w};
        continue;
      }
      const float grey = glm::dot(Vec3{t}, Vec3{0.2126f, 0.7152f, 0.0722f});
      t = Vec4{glm::mix(Vec3{grey}, Vec3{t}, part.recipe.saturation) * part.recipe.tint, t.w};
    }
    if (kind == "teeth") paint_teeth(image);
    if (kind == "eyes") paint_eyes(recipe_.eyes.iris, image);
    if (kind == "eyebrows") thin_heads(part.proxy, part.position_m, image);
    if (hairs) bleed_alpha(image, 0.02f);
    // Thin ends are the colour of the strands they end, not of what they were once drawn upon.
    if (kind == "hair") bleed_alpha(image, 0.5f);
    // Small things on the screen need no more than this.
    const std::uint32_t most = kind == "hair" || kind == "eyes" || kind == "clothes" ? 512 : 256;
    if (image.width > most || image.height > most)
      image = resize(image, std::min(image.width, most), std::min(image.height, most));
    return to_srgb(image, file.stem().string());
  }

  void add_part(const FittedPart& part) {
    out_.licences.push_back(part.proxy.licence);
    const std::string& name = part.proxy.name;
    const std::string kind = name.substr(0, name.find('/'));
    pack::MaterialKind material = pack::MaterialKind::cloth;
    pack::ObjectRole role = pack::ObjectRole::clothes;
    unsigned flags = pack::kTwoSided;  // One sees into collars, sleeves and hems.
    if (kind == "hair") {
      material = pack::MaterialKind::hair, role = pack::ObjectRole::hair;
      flags = pack::kTwoSided | pack::kAlphaBlend;
    } else if (kind == "eyebrows" || kind == "eyelashes") {
      material = pack::MaterialKind::lash;
      role = kind == "eyebrows" ? pack::ObjectRole::brow : pack::ObjectRole::lash;
      flags = pack::kTwoSided | pack::kAlphaBlend;
    } else if (kind == "teeth" || kind == "tongue") {
      material = pack::MaterialKind::mouth, role = pack::ObjectRole::mouth;
      flags = 0;
    } else if (kind == "eyes") {
      material = pack::MaterialKind::eye, role = pack::ObjectRole::eye;
      flags = 0;
    }
    const std::uint32_t m = add_material(material, flags, add_image(part_image(part)),
                                         part.recipe.gloss, part.recipe.shininess);
    const auto normals = smooth_normals(part.proxy.quads, part.position_m);
    const MeshSource source{
        part.proxy.quads,
        part.position_m,
        normals,
        part.proxy.uvs,
        [&](std::uint32_t v) { return (*weights_)(part.proxy.influence[v], part.position_m[v]); },
        false};
    if (kind == "teeth") {  // The lower ones go with the jaw.
      const std::vector<bool> lower = on_jaw(base_, part.proxy);
      const auto is_lower = [&](const Quad& quad) { return bool(lower[quad.vertex[0]]); };
      add_object("upper_teeth", role, m,
                 make_mesh(source, [&](const Quad& q) { return !is_lower(q); }));
      Mesh jaw = make_mesh(source, is_lower);
      for (Influence& influence : jaw.influence)
        influence = {{joint_of(body::HanimJoint::temporomandibular)}, {1.0f}};
      add_object("lower_teeth", role, m, std::move(jaw));
      return;
    }
    if (kind == "eyes") {  // The clear cap over the iris has its own corner of the texture.
      const auto is_cornea = [&](const Quad& quad) {
        const Vec2 uv = part.proxy.uvs[quad.uv[0]];
        return uv.x > 0.85f && uv.y < 0.15f;
      };
      add_object("eyes", role, m, make_mesh(source, [&](const Quad& q) { return !is_cornea(q); }));
      const std::uint32_t clear =
          add_material(material, pack::kCornea, pack::kNoTexture, 1.0f, 120.0f);
      add_object("corneas", role, clear, make_mesh(source, is_cornea));
      return;
    }
    if (kind == "tongue") {  // Rooted in the jaw's floor.
      Mesh tongue = make_mesh(source, [](const Quad&) { return true; });
      for (Influence& influence : tongue.influence)
        influence = {{joint_of(body::HanimJoint::temporomandibular)}, {1.0f}};
      add_object(kind, role, m, std::move(tongue));
      return;
    }
    if (kind == "clothes") return add_garment(name.substr(name.find('/') + 1), m, source);
    add_object(kind, role, m, make_mesh(source, [](const Quad&) { return true; }));
  }

  // A suit moves with more joints than a draw holds: jacket and trousers become two objects.
  void add_garment(const std::string& name, std::uint32_t material, const MeshSource& source) {
    Mesh whole = make_mesh(source, [](const Quad&) { return true; });
    std::set<std::uint16_t> joints;
    for (const Influence& influence : whole.influence)
      for (std::size_t k = 0; k < 4; ++k)
        if (influence.weight[k] > 0) joints.insert(influence.joint[k]);
    if (joints.size() <= kMaxBonesPerDraw)
      return add_object(name, pack::ObjectRole::clothes, material, std::move(whole));
    const auto piece = connected_pieces(source.quads, source.position_m.size());
    std::set<std::uint32_t> pieces;
    for (const Quad& quad : source.quads) pieces.insert(piece[quad.vertex[0]]);
    std::size_t number = 0;
    for (const std::uint32_t p : pieces)
      add_object(name + "_" + std::to_string(++number), pack::ObjectRole::clothes, material,
                 make_mesh(source, [&](const Quad& q) { return piece[q.vertex[0]] == p; }));
  }

  void add_object(std::string name, pack::ObjectRole role, std::uint32_t material, Mesh mesh) {
    Object object;
    object.name = std::move(name);
    object.role = role;
    object.material = material;
    object.mesh = std::move(mesh);
    out_.objects.push_back(std::move(object));
  }

  std::uint16_t joint_of(body::HanimJoint joint) const {
    for (std::uint16_t j = 0; j < out_.joints.size(); ++j)
      if (out_.joints[j].hanim == body::index_of(joint)) return j;
    throw std::runtime_error("the skeleton lacks a joint");
  }

  // A draw holds so many joints: the one that carries least gives its share to its parent.
  void limit_joints() {
    for (Object& object : out_.objects)
      for (;;) {
        std::map<std::uint16_t, float> share;
        for (const Influence& influence : object.mesh.influence)
          for (std::size_t k = 0; k < 4; ++k)
            if (influence.weight[k] > 0) share[influence.joint[k]] += influence.weight[k];
        if (share.size() <= kMaxBonesPerDraw) break;
        const auto least = std::min_element(share.begin(), share.end(), [](auto& a, auto& b) {
                             return a.second < b.second;
                           })->first;
        for (Influence& influence : object.mesh.influence)
          for (std::uint16_t& joint : influence.joint)
            if (joint == least) joint = out_.joints[least].parent;
      }
  }

  const Recipe& recipe_;
  const BaseHuman& base_;
  const std::vector<FeaturePointPlace>& places_;
  Figure figure_;
  Character out_;
  std::unique_ptr<WeightMap> weights_;
};

}  // namespace

Character build_character(const Recipe& recipe, const BaseHuman& base,
                          const std::vector<FeaturePointPlace>& places) {
  return Builder(recipe, base, places).build();
}

}  // namespace caryatid::bake
