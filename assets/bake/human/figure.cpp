#include "assets/bake/human/figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "assets/bake/human/bite.h"
#include "assets/bake/human/mesh_tools.h"
#include "assets/bake/human/neutral.h"
#include "assets/bake/human/repose.h"
#include "assets/bake/human/wet_lips.h"

namespace caryatid::bake {
namespace {

// MakeHuman's own core assets are CC0 since 2020 (LICENSE.md, section C of the project); their
// authors in the package's files tell them from what users contributed.
bool is_core_author(const std::string& author) {
  for (const char* name :
       {"Manuel Bastioni", "Manuel bastioni", "Jonas Hauquier", "Thomas Larsson", "MakeHuman Team"})
    if (author.starts_with(name)) return true;
  return false;
}

// Refuses what may not be passed on; names the licence that applies.
void settle_licence(Licence& licence) {
  if (is_core_author(licence.author)) {
    licence.licence = "CC0-1.0 (MakeHuman core asset)";
    return;
  }
  for (const char* free : {"CC0", "CC BY", "CCBY", "CC-BY"})
    if (licence.licence.starts_with(free)) return;
  throw std::runtime_error(licence.source + ": its licence (" + licence.licence +
                           ") does not allow what this project does with it");
}

// See PartRecipe::drop_above_m. Skin that only the dropped pieces hid shows again.
void drop_high_pieces(FittedPart& part, std::span<const Vec3> base_m) {
  const auto piece = pieces_of(part.proxy.quads, part.position_m.size());
  std::vector<float> piece_top_m(piece.size(), 0.0f);
  for (std::size_t v = 0; v < piece.size(); ++v)
    piece_top_m[piece[v]] = std::max(piece_top_m[piece[v]], part.position_m[v].y);
  float top_m = 0;
  for (const float top : piece_top_m)
    if (top <= part.recipe.drop_above_m) top_m = std::max(top_m, top);
  std::erase_if(part.proxy.quads, [&](const Quad& quad) {
    return piece_top_m[piece[quad.vertex[0]]] > part.recipe.drop_above_m;
  });
  constexpr float kOpening_m = 0.045f;  // How far below its top one can look into a shoe.
  for (std::size_t v = 0; v < part.proxy.hides.size(); ++v)
    if (base_m[v].y > top_m - kOpening_m) part.proxy.hides[v] = false;
}

// See PartRecipe::least_quads.
void drop_small_pieces(FittedPart& part) {
  const auto piece = pieces_of(part.proxy.quads, part.position_m.size());
  std::vector<int> quads(piece.size(), 0);
  for (const Quad& quad : part.proxy.quads) ++quads[piece[quad.vertex[0]]];
  std::erase_if(part.proxy.quads, [&](const Quad& quad) {
    return quads[piece[quad.vertex[0]]] < part.recipe.least_quads;
  });
}

// See PartRecipe::upper_only: pieces whose middle lies below that of the eye.
void drop_lower_pieces(FittedPart& part, float eye_m) {
  const auto piece = pieces_of(part.proxy.quads, part.position_m.size());
  std::vector<float> above_m(piece.size(), 0.0f);
  for (std::size_t v = 0; v < piece.size(); ++v) above_m[piece[v]] += part.position_m[v].y - eye_m;
  std::erase_if(part.proxy.quads,
                [&](const Quad& quad) { return above_m[piece[quad.vertex[0]]] < 0.0f; });
}

}  // namespace

const FittedPart* Figure::part(std::string_view kind) const {
  for (const FittedPart& part : parts)
    if (part.proxy.name.starts_with(kind)) return &part;
  return nullptr;
}

namespace {

// The helper eyeball of the base is a sphere: its box has its centre and size.
std::pair<Vec3, Vec3> eye_box(const BaseHuman* base, const std::vector<Vec3>& base_m, int side) {
  const std::uint16_t group = base->group(side == 0 ? "helper-l-eye" : "helper-r-eye");
  Vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
  for (const Quad& quad : base->quads())
    if (quad.group == group)
      for (const std::uint32_t v : quad.vertex) {
        low = glm::min(low, base_m[v]);
        high = glm::max(high, base_m[v]);
      }
  return {low, high};
}

}  // namespace

Vec3 Figure::eye_center_m(int side) const {
  const auto [low, high] = eye_box(base, base_m, side);
  return 0.5f * (low + high);
}

float Figure::eye_diameter_m() const {
  const auto [low, high] = eye_box(base, base_m, 0);
  return high.x - low.x;
}

Figure make_figure(const Recipe& recipe, const BaseHuman& base,
                   const std::vector<FeaturePointPlace>& places) {
  Figure figure;
  figure.base = &base;
  std::vector<TargetWeight> weights = macro_targets(recipe.macro, base);
  for (const TargetWeight& target : recipe.targets)
    for (const TargetWeight& half : expand_target(target, base)) weights.push_back(half);
  figure.base_m = base.apply(weights);
  settle_neutral(base, places, kIrisToBall * figure.eye_diameter_m(), figure.base_m);
  for (const PartRecipe& part : recipe.parts) {
    FittedPart fitted{base.load_proxy(part.proxy), part, {}};
    settle_licence(fitted.proxy.licence);
    fitted.position_m = fitted.proxy.fit(figure.base_m);
    if (part.grow_m != 0) {
      const auto normals = smooth_normals(fitted.proxy.quads, fitted.position_m);
      for (std::size_t i = 0; i < normals.size(); ++i)
        fitted.position_m[i] += part.grow_m * normals[i];
    }
    figure.parts.push_back(std::move(fitted));
  }
  seat_bite(places, glm::mix(kIncisorShowMan_m, kIncisorShowWoman_m, recipe.macro.female), figure);
  part_wet_lips(places, figure);
  for (const Bone& bone : base.bones())
    figure.bone_head_m.push_back(BaseHuman::mean(figure.base_m, bone.head_vertices));
  return figure;
}

namespace {

// Slope of the soles with the feet as `motions` put them: heel above ball +. The base human stands
// on its toes a little, and shoes with heels want that; what stands on the floor is the shoe.
float sole_slope_rad(const Figure& figure, const std::vector<BoneMotion>& motions) {
  const BoneMotion& foot = motions[figure.base->bone("foot.L")];
  const BoneMotion& toes = motions[figure.base->bone("toe2-1.L")];
  const float ball_z = toes.head_to_m.z, ankle_z = foot.head_to_m.z;
  std::vector<Vec3> points;
  const auto gather = [&](std::vector<Vec3> position_m, std::span<const Influence> influence) {
    apply_motions(motions, influence, position_m);
    for (const Vec3 p : position_m)
      if (p.x > 0 && p.y < foot.head_to_m.y) points.push_back(p);
  };
  bool shod = false;
  for (const FittedPart& part : figure.parts) {
    const std::size_t before = points.size();
    gather(part.position_m, part.proxy.influence);
    shod = shod || points.size() > before + 100;
  }
  if (!shod) gather(figure.base_m, figure.base->influence());
  const auto lowest = [&](float from_z, float to_z) {
    Vec3 low{0, std::numeric_limits<float>::max(), 0};
    for (const Vec3 p : points)
      if (p.z >= from_z && p.z <= to_z && p.y < low.y) low = p;
    return low;
  };
  const Vec3 heel = lowest(ankle_z - 0.2f, ankle_z + 0.01f);
  const Vec3 ball = lowest(ball_z - 0.03f, ball_z + 0.01f);
  return heel.z < ball.z ? std::atan2(heel.y - ball.y, ball.z - heel.z) : 0.0f;
}

// Poses copies of base and parts.
void pose(Figure& figure, const ArmHang& hang, float sole_pitch_rad) {
  const auto motions = rest_pose_motions(*figure.base, figure.base_m, hang, sole_pitch_rad);
  apply_motions(motions, figure.base->influence(), figure.base_m);
  for (std::size_t i = 0; i < motions.size(); ++i) figure.bone_head_m[i] = motions[i].head_to_m;
  for (FittedPart& part : figure.parts)
    apply_motions(motions, part.proxy.influence, part.position_m);
}

// Distance along x between the left hand's inner side and the outermost cloth or skin of hip and
// thigh at its height; < 0 when the hand is inside.
float hand_clearance_m(const Figure& figure) {
  std::vector<bool> is_arm;
  for (const Bone& bone : figure.base->bones()) {
    const auto is = [&](const char* stem) { return bone.name.starts_with(stem); };
    is_arm.push_back(is("upperarm") || is("lowerarm") || is("wrist") || is("finger") ||
                     is("metacarpal") || is("shoulder") || is("clavicle"));
  }
  float low_m = 10, high_m = -10, inner_m = 10, outer_m = 0;
  const auto& influence = figure.base->influence();
  for (std::size_t v = 0; v < figure.base_m.size(); ++v) {
    const std::string& bone = figure.base->bones()[influence[v].joint[0]].name;
    if (!bone.ends_with(".L") || !(bone.starts_with("finger") || bone.starts_with("metacarpal")))
      continue;
    low_m = std::min(low_m, figure.base_m[v].y);
    high_m = std::max(high_m, figure.base_m[v].y);
    inner_m = std::min(inner_m, figure.base_m[v].x);
  }
  const auto look = [&](std::span<const Vec3> p, std::span<const Influence> by) {
    for (std::size_t v = 0; v < p.size(); ++v)
      if (p[v].y > low_m && p[v].y < high_m && !is_arm[by[v].joint[0]])
        outer_m = std::max(outer_m, p[v].x);
  };
  for (const FittedPart& part : figure.parts) look(part.position_m, part.proxy.influence);
  return inner_m - outer_m;
}

}  // namespace

void stand(Figure& figure) {
  constexpr float kClearance_m = 0.006f, kStep_rad = 0.02f;
  const Figure before = figure;
  ArmHang hang;
  float pitch_rad = 0.0f;
  for (int round = 0; round < 3; ++round)
    pitch_rad +=
        sole_slope_rad(figure, rest_pose_motions(*figure.base, figure.base_m, hang, pitch_rad));
  pose(figure, hang, pitch_rad);
  for (int i = 0; i < 12 && hand_clearance_m(figure) < kClearance_m; ++i) {
    hang.upper_arm_rad += kStep_rad;
    hang.forearm_rad += 0.5f * kStep_rad;
    figure = before;
    pose(figure, hang, pitch_rad);
  }

  // The lowest thing that is seen stands on the floor: shoes where there are any.
  float floor_m = std::numeric_limits<float>::max();
  for (const Quad& quad : figure.base->quads())
    if (quad.group == 0)
      for (const std::uint32_t v : quad.vertex) floor_m = std::min(floor_m, figure.base_m[v].y);
  for (const FittedPart& part : figure.parts)
    for (const Vec3 p : part.position_m) floor_m = std::min(floor_m, p.y);
  const auto bone = [&](const char* name) { return figure.bone_head_m[figure.base->bone(name)]; };
  const Vec3 ankles = 0.5f * (bone("foot.L") + bone("foot.R"));
  const Vec3 toes = 0.5f * (bone("toe2-1.L") + bone("toe2-1.R"));
  const Vec3 middle = glm::mix(ankles, toes, 0.4f);  // Half way from heel to tip.
  const Vec3 shift{-middle.x, -floor_m, -middle.z};
  for (Vec3& p : figure.base_m) p += shift;
  for (Vec3& p : figure.bone_head_m) p += shift;
  for (FittedPart& part : figure.parts)
    for (Vec3& p : part.position_m) p += shift;
  for (FittedPart& part : figure.parts) {
    if (part.recipe.drop_above_m > 0) drop_high_pieces(part, figure.base_m);
    if (part.recipe.least_quads > 0) drop_small_pieces(part);
    if (part.recipe.upper_only) drop_lower_pieces(part, figure.eye_center_m(0).y);
  }
}

}  // namespace caryatid::bake
