#pragma once
// Both characters of the project as far as the face animation tables, built once for all tests of
// the room (a few seconds), and a face posed as the agent poses it.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "assets/bake/face/fat.h"
#include "assets/bake/face/head.h"
#include "assets/bake/human/build.h"
#include "core/face/fat.h"
#include "core/face/mixer.h"
#include "core/face/transforms.h"

namespace caryatid::bake {

inline const std::string kCharacters = CARYATID_SOURCE_DIR "/assets/characters/";

struct Baked {
  BaseHuman base{BaseHuman::default_folder()};
  fat::WorkingRanges ranges = fat::read_working_ranges(kCharacters + "fap_working_ranges.csv");
  std::vector<Character> characters;  // Woman, man.
  std::vector<fat::Head> heads;
  Baked() {
    const auto places = read_feature_points(kCharacters + "feature_points.toml", base);
    for (const char* name : {"woman.toml", "man.toml"}) {
      characters.push_back(build_character(read_recipe(kCharacters + name), base, places));
      build_fat(characters.back(), base, ranges);
      heads.push_back(fat::make_head(characters.back(), base));
    }
  }
  static const Baked& get() {
    static const Baked instance;
    return instance;
  }
};

// A face of one character under a frame: after the mixer's contacts, before the head turns.
class PosedFace {
 public:
  PosedFace(std::size_t character, const face::FapFrame& frame)
      : character_(Baked::get().characters[character]), head_(Baked::get().heads[character]) {
    const face::FapLimits limits = face::limits_of(character_.channels);
    mixed_ = face::MixJob{.stream = &frame, .limits = &limits}.run();
    std::vector<float> weight(character_.channels.size());
    EXPECT_TRUE(face::evaluate_channels(character_.channels, mixed_, weight).ok());
    const auto jaw = face::evaluate_transforms(head_.transforms, mixed_);
    for (const Object& object : character_.objects) {
      std::vector<Vec3>& place = object_m.emplace_back(object.mesh.position_m);
      for (std::size_t c = 0; c < weight.size(); ++c)
        if (weight[c] > 0.0f)
          for (const Move& m : object.moves[c]) place[m.vertex] += weight[c] * m.displacement_m;
      if (object.name != "lower_teeth" && object.name != "tongue") continue;
      const Vec3 center = head_.transforms.jaw_center_m;
      for (Vec3& p : place) p = center + jaw.jaw * (p - center) + jaw.jaw_shift_m;
    }
    find_skin();
  }

  const face::FapFrame& mixed() const { return mixed_; }
  const std::vector<Vec3>& object(const std::string& name) const {
    for (std::size_t o = 0; o < object_m.size(); ++o)
      if (character_.objects[o].name == name) return object_m[o];
    throw std::runtime_error("no object " + name);
  }
  Vec3 point(int group, int index) const {
    for (const FeaturePoint& p : character_.feature_points)
      if (p.group == group && p.index == index) return object_m[p.object][p.vertex];
    throw std::runtime_error("no such point");
  }

  std::vector<Vec3> skin_m;                 // By vertex of the head's welded skin.
  std::vector<std::vector<Vec3>> object_m;  // By object.

 private:
  void find_skin() {
    skin_m = head_.skin.position_m;
    for (std::size_t o = 0; o < object_m.size(); ++o) {
      const Mesh& mesh = character_.objects[o].mesh;
      if (character_.objects[o].role != pack::ObjectRole::head) continue;
      for (std::size_t i = 0; i < object_m[o].size(); ++i)
        if (mesh.base_vertex[i] != kNone)
          if (const auto v = head_.skin.of_base[mesh.base_vertex[i]]; v != kNone)
            skin_m[v] = object_m[o][i];
    }
  }

  const Character& character_;
  const fat::Head& head_;
  face::FapFrame mixed_;
};

// Skips without the base human. The parameter is the character: 0 woman, 1 man.
class OnBothFaces : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    if (const auto missing = BaseHuman::missing(BaseHuman::default_folder()))
      GTEST_SKIP() << *missing;
  }
  const Character& character() const { return Baked::get().characters[GetParam()]; }
  const fat::Head& head() const { return Baked::get().heads[GetParam()]; }
  const fat::WorkingRanges& ranges() const { return Baked::get().ranges; }
  PosedFace posed(const face::FapFrame& frame) const { return {GetParam(), frame}; }

  // Height of the upper above the lower inner contour at every column of the lower one, but for the
  // fold in the corner.
  std::vector<float> gaps(const PosedFace& face) const {
    std::vector<float> out;
    for (int side = 0; side < fat::kSides; ++side) {
      const fat::Lips& lips = head().lips[static_cast<std::size_t>(side)];
      const float corner_x = head().lateral(face.point(2, 4 + side), side);
      for (std::size_t c = fat::kLipCorner + 1; c < fat::kLipColumns; ++c) {
        const Vec3 low = face.skin_m[lips.row[lips.lower_inner][c]];
        if (head().lateral(low, side) > 0.9f * corner_x) continue;
        out.push_back(upper_height(face, lips, low.x) - low.y);
      }
    }
    return out;
  }
  float upper_height(const PosedFace& face, const fat::Lips& lips, float x) const {
    const auto at = [&](std::size_t c) { return face.skin_m[lips.row[lips.upper_inner][c]]; };
    for (std::size_t c = 0; c < fat::kLipCorner; ++c) {
      const Vec3 a = at(c), b = at(c + 1);
      if ((x - a.x) * (x - b.x) > 0.0f) continue;
      return glm::mix(a.y, b.y, (x - a.x) / (b.x - a.x));
    }
    return at(fat::kLipCorner).y;
  }
};

inline std::string character_name(const testing::TestParamInfo<std::size_t>& made) {
  return made.param == 0 ? "woman" : "man";
}

}  // namespace caryatid::bake
