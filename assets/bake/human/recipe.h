#pragma once
// A recipe: how a person is made from the base human. A TOML file in assets/characters; its keys
// are the fields below. Errors: std::runtime_error, one line naming file and key.
#include <filesystem>
#include <string>
#include <vector>

#include "assets/bake/human/makehuman.h"

namespace caryatid::bake {

// MakeHuman's macro sliders, 0..1 unless said otherwise. They blend `macrodetails` targets.
struct Macro {
  float female = 1.0f;      // 0 male.
  float age_years = 30.0f;  // 25..90.
  float muscle = 0.5f;
  float weight = 0.5f;
  float height = 0.5f;       // 0.5 is the average of the sex.
  float proportions = 0.5f;  // 1 ideal.
  float cup = 0.5f, firmness = 0.5f;
  float caucasian = 1.0f, asian = 0.0f, african = 0.0f;  // Sum is normalised to 1.
};

struct SkinRecipe {
  std::string texture;             // Below public/data/skins.
  Vec3 tint{1.0f};                 // Multiplies in linear light.
  Vec3 lips{0.60f, 0.30f, 0.28f};  // sRGB 0..1.
  float lips_strength = 0.5f;
  float stubble = 0.0f;    // 0..1, beard shadow.
  float lash_line = 0.0f;  // 0..1, dark line at the upper lid.
  float eye_shadow = 0.0f;
  float blush = 0.15f;
  float hairline_m = 0.010f;  // How far the short hairs of the hairline reach.
  float lines = 1.0f;         // Depth of the lines that expressions fold; 1: middle age.
  Vec3 tights{-1.0f};         // Multiplies the legs' skin, linear; negative: bare legs.
};

struct EyeRecipe {
  Vec3 iris{0.35f, 0.22f, 0.12f};  // sRGB, mean colour.
};

// A fitted part: eyes, teeth, tongue, brows, lashes, hair, clothes, shoes.
struct PartRecipe {
  std::string proxy;    // "hair/ponytail01"
  std::string texture;  // Below the proxy's folder; empty: its first.
  Vec3 tint{1.0f};      // Linear; for brows and lashes their colour.
  float saturation = 1.0f;
  float contrast = 1.0f;   // Below 1 light and dark draw together about their mean.
  float softness = 0.85f;  // Of brows and lashes: their greatest alpha.
  float gloss = 0.05f;
  float shininess = 16.0f;
  float grow_m = 0.0f;  // Pushed out along normals: outer layers over inner ones.
  // Connected parts that reach above this height when the figure stands are left out: the socks of
  // a shoe. 0: all stay.
  float drop_above_m = 0.0f;
  // Connected parts with fewer quads are left out: wisps of hair, which turn to spikes when coarse.
  int least_quads = 0;
  std::uint32_t line = 0;   // Of the file, for messages.
  bool upper_only = false;  // Of lashes: those of the lower lid are left out.
};

struct Recipe {
  std::string name;
  Macro macro;
  std::vector<TargetWeight> targets;
  std::vector<std::uint32_t> target_lines;  // Of the file, for messages; as long as `targets`.
  SkinRecipe skin;
  EyeRecipe eyes;
  std::vector<PartRecipe> parts;
  std::vector<std::pair<int, float>> rest_face;  // FAP number, value: beneath every emotion.
};

Recipe read_recipe(const std::filesystem::path& file);

// Throws, with file and line, unless the base has the targets and parts that the recipe of `file`
// names, and a skin is named.
void check_names(const Recipe& recipe, const BaseHuman& base, const std::filesystem::path& file);

// The targets that a macro stands for, with their weights. Names that the base does not have are
// left out (not every combination exists).
std::vector<TargetWeight> macro_targets(const Macro& macro, const BaseHuman& base);

// Expands a recipe's target: "eyes/eye-size-big" stands for its l- and r- halves.
std::vector<TargetWeight> expand_target(const TargetWeight& target, const BaseHuman& base);

}  // namespace caryatid::bake
