#pragma once
// Turns a finished character into the bytes of a pack file (core/pack/pack.h).
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/bake/model.h"
#include "assets/bake/simplify/animation_error.h"
#include "assets/bake/simplify/object_history.h"

namespace caryatid::bake {

struct PackOptions {
  // Triangles of the base part, as a share of full resolution: small things that carry the look
  // (eyes, brows, lashes) keep more of it. Objects stop earlier where their locks do not allow as
  // little. Index is pack::ObjectRole: head, body, hair, clothes, eye, mouth, brow, lash.
  std::array<double, 8> base_fraction = {0.075, 0.10, 0.30, 0.18, 0.25, 0.12, 1.0, 0.6};
  // Of the object "body": coarser, what skin is left beneath the clothes would poke through them.
  double torso_fraction = 0.30;
  // Textures of the base part have at most so many texels a side; larger levels come later.
  std::uint32_t base_texture_side = 128;
  // Refinements arrive in so many stages, each about as many triangles as all before.
  std::uint32_t stages = 4;
  double pose_weight = 10.0;  // See ObjectOptions. At 0.5 the lower lids broke at 680 faces.
  bool refine = true;         // false: the base part alone, for the built-in face.
};

// What went where, for --report and the log of a bake.
struct PackReport {
  struct Section {
    std::string name;
    std::uint32_t bytes = 0;
  };
  struct Object {
    std::string name;
    std::uint32_t base_triangles = 0, triangles = 0, versions = 0, splits = 0;
  };
  std::vector<AnimationError> animation;  // Of the head's base level, before quantisation.
  std::vector<Section> sections;
  std::vector<Object> objects;
  std::uint32_t file_bytes = 0, base_part_bytes = 0, arena_bytes = 0;
};

// Simplifies every object, quantises, orders the file coarse to fine. Feature points and
// Object::locked become locks. Deterministic: same character, same bytes.
// Throws std::runtime_error that names the object and what is wrong with it (too many vertices or
// bones for the format, feature point on a vertex without triangles, texture size...).
std::vector<std::byte> write_pack(const Character& character, const PackOptions& options = {},
                                  PackReport* report = nullptr);

}  // namespace caryatid::bake
