#pragma once
// The character while it is being made: full resolution, floats, heap. The stages of the bake hand
// it on and each fills its part: human (meshes, skeleton, feature points, textures) -> face (FAT)
// -> simplify (histories) -> pack (bytes). Frame and units as core/base/vec.h, H-Anim rest pose,
// MPEG-4 neutral face.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/pack/pack.h"

namespace caryatid::bake {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// Up to four joints (index into Character::joints); unused entries have weight 0. Weights sum to 1.
struct Influence {
  std::array<std::uint16_t, 4> joint{};
  std::array<float, 4> weight{1.0f, 0.0f, 0.0f, 0.0f};
};

// A triangle mesh with one texture coordinate a vertex: vertices on a texture seam stand twice
// (same position bits, same normal). All per-vertex arrays have the same length.
struct Mesh {
  std::vector<Vec3> position_m;
  std::vector<Vec3> normal;
  // How much of the sky around the vertex its own body hides at rest: 0 open .. 1 closed. Filled by
  // the bake once all objects stand; empty counts as open.
  std::vector<float> occlusion;
  std::vector<Vec2> uv;  // v runs downwards, as image rows do.
  std::vector<Influence> influence;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // Counter-clockwise seen from outside.
  // The vertex of the base human (hm08 numbering, 0..19157) that this one came from; kNone for
  // vertices of proxies (hair, clothes, eyes...).
  std::vector<std::uint32_t> base_vertex;
};

// What one FAT channel does to one vertex of an object at full ramp.
struct Move {
  std::uint32_t vertex = 0;
  Vec3 displacement_m{0};
  Vec3 normal_change{0};
};

struct Object {
  std::string name;
  pack::ObjectRole role = pack::ObjectRole::body;
  std::uint32_t material = 0;  // Index into Character::materials.
  Mesh mesh;
  // moves[channel]: sparse, vertices ascending. Same length as Character::channels, or empty.
  std::vector<std::vector<Move>> moves;
  // Vertices that simplification never moves or removes (feature points, borders to other objects).
  std::vector<std::uint32_t> locked;
  // Closed or open chains of vertices that may thin out but keep their line: lip contours, lid
  // rims.
  struct Loop {
    std::string name;
    std::vector<std::uint32_t> vertices;
    std::uint32_t keep_at_least = 8;
  };
  std::vector<Loop> loops;
};

// An image in memory, sRGB, 8 bits, 4 channels (RGBA), first row on top. Power of two, <= 1024.
struct Image {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  bool has_alpha = false;
  bool is_data = false;  // Numbers in four channels of their own, not a colour that alpha weighs.
};

struct Joint {
  std::uint16_t hanim = 0;  // body::HanimJoint
  std::uint16_t parent = pack::kNoJoint;
  Vec3 center_m{0};
};

struct FeaturePoint {
  std::uint8_t group = 0, index = 0;
  std::uint32_t object = kNone;  // kNone: the centre of joint `vertex`.
  std::uint32_t vertex = 0;
  Vec3 position_m{0};
};

struct Licence {
  std::string source;   // File or asset name.
  std::string licence;  // e.g. "CC0-1.0"
  std::string author;
};

struct Character {
  std::string name;
  pack::Character facts{};  // FAPU, stature, leg length; name is copied in by the writer.
  std::vector<Joint> joints;
  std::vector<Object> objects;
  std::vector<pack::Material> materials;
  std::vector<Image> images;  // Material::texture indexes these.
  std::vector<pack::Channel> channels;
  std::vector<FeaturePoint> feature_points;
  std::vector<pack::FitRule> fit;     // FAP interpolation; empty: face::default_fit() is packed.
  std::array<float, 69> rest_face{};  // FAP values of the calm face beneath every emotion.
  std::vector<Licence> licences;
};

}  // namespace caryatid::bake
