#include "assets/bake/human/bite.h"

#include <algorithm>
#include <cmath>

#include "assets/bake/human/mesh_tools.h"

namespace caryatid::bake {
namespace {

// Thickness of lips: the wet line of the upper one lies so far before the incisors.
constexpr float kBehindLips_m = 0.0060f;
// Where the arch of the teeth meets the cheeks: farther out nothing moves forward.
constexpr float kArch_m = 0.020f;
constexpr float kCrown_m = 0.0085f;  // From an incisor's edge to its neck.
constexpr float kTaller = 1.25f;     // The package's crowns are 7 mm high; incisors have 10.
constexpr float kLevel = 0.09f;      // Its bite rises backwards by 11 degrees; people's by half.
constexpr float kUpright = 0.05f;    // Incisors lean forward by this slope.
constexpr float kFront_m = 0.005f;   // Half the width of the two middle incisors.

// 1 at the mid-line, 0 at the side teeth.
float frontal(float x) {
  const float t = std::min(std::abs(x) / kArch_m, 1.0f);
  return (1.0f - t * t) * (1.0f - t * t);
}

FittedPart* find(Figure& figure, std::string_view kind) {
  for (FittedPart& part : figure.parts)
    if (part.proxy.name.starts_with(kind)) return &part;
  return nullptr;
}

struct Incisors {
  Vec3 edge_m{0};
  float lean = 0;  // Growth of z upwards from the edge to the neck.
};

// The foremost vertices of the upper teeth near the mid-line, at the edge and at the neck.
Incisors measure(const FittedPart& teeth, const std::vector<bool>& lower, float middle_x) {
  Incisors out;
  out.edge_m = Vec3(middle_x, 1e9f, 0);
  const auto middle = [&](std::size_t v) {
    return !lower[v] && std::abs(teeth.position_m[v].x - middle_x) < kFront_m;
  };
  float front = -1e9f;
  for (std::size_t v = 0; v < lower.size(); ++v)
    if (middle(v)) front = std::max(front, teeth.position_m[v].z);
  constexpr float kDeep_m = 0.008f;  // What lies farther back is palate.
  for (std::size_t v = 0; v < lower.size(); ++v)
    if (const Vec3 p = teeth.position_m[v]; middle(v) && p.z > front - kDeep_m)
      if (p.y < out.edge_m.y) out.edge_m = p;
  const auto foremost = [&](float y, float tolerance_m) {
    float z = -1e9f;
    for (std::size_t v = 0; v < lower.size(); ++v)
      if (const Vec3 p = teeth.position_m[v]; middle(v) && std::abs(p.y - y) < tolerance_m)
        z = std::max(z, p.z);
    return z;
  };
  out.edge_m.z = foremost(out.edge_m.y, 0.0006f);
  out.lean = (foremost(out.edge_m.y + kCrown_m, 0.0020f) - out.edge_m.z) / kCrown_m;
  return out;
}

// The foremost face of gums and teeth as a grid of depths over x and y.
class Face {
 public:
  explicit Face(const FittedPart& teeth, float middle_x) : middle_x_(middle_x) {
    depth_.assign(kCells * kCells, -1e9f);
    low_y_ = 1e9f;
    for (const Vec3 p : teeth.position_m) low_y_ = std::min(low_y_, p.y);
    for (const Quad& quad : teeth.proxy.quads) {
      const auto at = [&](std::size_t i) { return teeth.position_m[quad.vertex[i]]; };
      constexpr int kSteps = 12;
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
          const float u = float(i) / kSteps, w = float(j) / kSteps;
          raise(glm::mix(glm::mix(at(0), at(1), u), glm::mix(at(3), at(2), u), w));
        }
    }
  }

  // -1e9 beside the teeth.
  float depth_at(Vec3 p) const {
    const std::size_t i = cell(p);
    return i == kNowhere ? -1e9f : depth_[i];
  }

 private:
  static constexpr std::size_t kCells = 160, kNowhere = kCells * kCells;
  static constexpr float kCell_m = 0.0005f;

  std::size_t cell(Vec3 p) const {
    const float x = (p.x - middle_x_) / kCell_m + kCells / 2, y = (p.y - low_y_) / kCell_m;
    if (!(x >= 0 && y >= 0 && x < kCells && y < kCells)) return kNowhere;
    return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x);
  }
  void raise(Vec3 p) {
    if (const std::size_t i = cell(p); i != kNowhere) depth_[i] = std::max(depth_[i], p.z);
  }

  float middle_x_, low_y_;
  std::vector<float> depth_;
};

// Skin behind the lips (a walk along edges from the contours where they touch, inwards) that the
// teeth would come through lies on them instead.
void clear_lining(const std::vector<FeaturePointPlace>& places, const FittedPart& teeth,
                  Figure& figure) {
  std::vector<Quad> skin;
  for (const Quad& quad : figure.base->quads())
    if (quad.group == 0) skin.push_back(quad);
  const auto neighbours = edge_neighbours(skin, figure.base_m.size());
  const auto normals = smooth_normals(skin, figure.base_m);
  const auto point = [&](int group, int index) { return base_vertex_of(places, group, index); };
  const Face face(teeth, figure.base_m[point(2, 2)].x);
  std::vector<std::uint32_t> open = {point(2, 2), point(2, 3)};
  std::vector<bool> seen(figure.base_m.size(), false);
  constexpr float kDepth_m = 0.020f, kGap_m = 0.0005f;
  const Vec3 wet = figure.base_m[point(2, 2)];
  const float corner_x = std::abs(figure.base_m[point(2, 4)].x - wet.x);
  while (!open.empty()) {
    const std::uint32_t v = open.back();
    open.pop_back();
    if (seen[v]) continue;
    seen[v] = true;
    Vec3& p = figure.base_m[v];
    const float front = face.depth_at(p);
    if (p.z < front + kGap_m) p.z = front + kGap_m;
    for (const std::uint32_t n : neighbours[v]) {
      const Vec3 q = figure.base_m[n];
      const bool lining = normals[n].z < 0.35f && q.z > wet.z - kDepth_m &&
                          std::abs(q.x - wet.x) < corner_x && std::abs(q.y - wet.y) < kDepth_m;
      if (lining && !seen[n]) open.push_back(n);
    }
  }
}

}  // namespace

std::vector<bool> on_jaw(const BaseHuman& base, const Proxy& proxy) {
  const std::uint32_t jaw = base.bone("jaw");
  std::vector<bool> beneath(base.bones().size(), false);
  for (std::uint32_t b = 0; b < beneath.size(); ++b)
    for (std::uint32_t up = b; up != kNone; up = base.bones()[up].parent)
      if (up == jaw) beneath[b] = true;
  std::vector<bool> out;
  for (const Influence& influence : proxy.influence) {
    float share = 0.0f;
    for (std::size_t k = 0; k < 4; ++k)
      if (beneath[influence.joint[k]]) share += influence.weight[k];
    out.push_back(share > 0.5f);
  }
  return out;
}

namespace {

// Height of the upper lip's lower edge in the middle: its wet roll hangs beneath the line of the
// closed lips and covers the teeth behind it.
float upper_lip_m(const Figure& figure, Vec3 wet) {
  std::vector<Quad> skin;
  for (const Quad& quad : figure.base->quads())
    if (quad.group == 0) skin.push_back(quad);
  const auto normals = smooth_normals(skin, figure.base_m);
  constexpr float kDepth_m = 0.006f, kRoll_m = 0.002f;
  float low = wet.y;
  for (const Quad& quad : skin)
    for (const std::uint32_t v : quad.vertex) {
      const Vec3 d = figure.base_m[v] - wet;
      if (std::abs(d.x) < kFront_m && d.z <= 0.0f && d.z > -kDepth_m && normals[v].y < 0.0f &&
          d.y > -kRoll_m)
        low = std::min(low, figure.base_m[v].y);
    }
  return low;
}

}  // namespace

void seat_bite(const std::vector<FeaturePointPlace>& places, float show_m, Figure& figure) {
  FittedPart* teeth = find(figure, "teeth/");
  if (teeth == nullptr) return;
  const std::vector<bool> lower = on_jaw(*figure.base, teeth->proxy);
  const Vec3 wet = figure.base_m[base_vertex_of(places, 2, 2)];
  const Incisors incisors = measure(*teeth, lower, wet.x);
  const float down = upper_lip_m(figure, wet) - show_m - incisors.edge_m.y;
  const float forward = wet.z - kBehindLips_m - incisors.edge_m.z;
  const auto seated = [&](Vec3 p) { return p + Vec3(0, down, forward * frontal(p.x - wet.x)); };
  for (std::size_t v = 0; v < lower.size(); ++v) {
    Vec3& p = teeth->position_m[v];
    const float height = std::clamp(p.y - incisors.edge_m.y, 0.0f, 1.5f * kCrown_m);
    const float upright = lower[v] ? 0.0f : (incisors.lean + kUpright) * height;
    const float taller = lower[v] ? 0.0f : (kTaller - 1.0f) * height;
    p = seated(p) + Vec3(0, taller, -upright * frontal(p.x - wet.x));
  }
  if (FittedPart* tongue = find(figure, "tongue/"))
    for (Vec3& p : tongue->position_m) p = seated(p);
  clear_lining(places, *teeth, figure);
}

}  // namespace caryatid::bake
