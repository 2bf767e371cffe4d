#include "assets/bake/anthropometry/landmarks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "assets/bake/light/ray_tree.h"

namespace caryatid::bake::anthropometry {
namespace {

using Id = std::pair<int, int>;

// Landmarks that are feature points; of paired ones left, then right.
struct Same {
  const char* name;
  Id left, right;  // right {0, 0}: on the mid-line.
};
constexpr Same kSame[] = {
    {"v", {11, 4}, {}},         {"op", {11, 6}, {}},       {"tr", {11, 1}, {}},
    {"go", {2, 13}, {2, 14}},   {"pg", {2, 10}, {}},       {"gn", {2, 1}, {}},
    {"en", {3, 11}, {3, 8}},    {"ex", {3, 7}, {3, 12}},   {"p", {3, 5}, {3, 6}},
    {"ps", {3, 1}, {3, 2}},     {"pi", {3, 3}, {3, 4}},    {"sci", {4, 3}, {4, 4}},
    {"prn", {9, 3}, {}},        {"sn", {9, 15}, {}},       {"al", {9, 1}, {9, 2}},
    {"sbal", {9, 5}, {9, 4}},   {"mf", {9, 7}, {9, 6}},    {"ls", {8, 1}, {}},
    {"li", {8, 2}, {}},         {"ch", {8, 3}, {8, 4}},    {"cph", {8, 10}, {8, 9}},
    {"sa", {10, 1}, {10, 2}},   {"sba", {10, 5}, {10, 6}}, {"pa", {10, 3}, {10, 4}},
    {"obs", {10, 9}, {10, 10}}, {"obi", {10, 7}, {10, 8}}};

std::string text_of(Id id) { return std::to_string(id.first) + "." + std::to_string(id.second); }

class Finder {
 public:
  explicit Finder(const Character& character) {
    const Object* head = nullptr;
    for (const Object& object : character.objects)
      if (object.role == pack::ObjectRole::head) head = &object;
    if (!head) throw std::runtime_error(character.name + ": has no head to measure");
    weld(head->mesh);
    for (const FeaturePoint& p : character.feature_points)
      point_m_[{p.group, p.index}] = p.position_m;
    std::vector<RayTree::Triangle> triangles;
    for (const auto& [a, b, c] : out_.triangles)
      triangles.push_back({{out_.position_m[a], out_.position_m[b], out_.position_m[c]}});
    rays_ = std::make_unique<RayTree>(std::move(triangles));
  }

  MeasuredHead run() {
    for (const Same& same : kSame) {
      const bool paired = same.right.first != 0;
      take(paired ? std::string(same.name) + " l" : same.name, same.left);
      if (paired) take(std::string(same.name) + " r", same.right);
    }
    if (const auto upper = point({2, 2}), lower = point({2, 3}); upper && lower)
      add("sto", 0.5f * (*upper + *lower), "between 2.2 and 2.3");
    // Beside the mid-line by a hair, on which edges lie that a ray might slip through.
    constexpr float kBeside_m = 2e-4f;
    middle_x_ = kBeside_m + (at("prn") ? at("prn")->x : 0.0f);
    find_profile();
    for (const float side : {1.0f, -1.0f}) find_side(side, side > 0 ? " l" : " r");
    if (at("t l") && at("t r") && at("or l") && at("or r")) {
      const Vec3 ear = 0.5f * (*at("t l") + *at("t r")), orbit = 0.5f * (*at("or l") + *at("or r"));
      out_.to_frankfurt_rad = std::atan2(orbit.y - ear.y, orbit.z - ear.z);
    }
    return std::move(out_);
  }

 private:
  void weld(const Mesh& mesh) {
    std::map<std::uint32_t, std::uint32_t> number;
    std::vector<std::uint32_t> of(mesh.position_m.size());
    for (std::uint32_t v = 0; v < of.size(); ++v) {
      const auto [found, fresh] =
          number.emplace(mesh.base_vertex[v], static_cast<std::uint32_t>(out_.position_m.size()));
      if (fresh) out_.position_m.push_back(mesh.position_m[v]);
      of[v] = found->second;
    }
    for (const auto& t : mesh.triangles) out_.triangles.push_back({of[t[0]], of[t[1]], of[t[2]]});
  }

  std::optional<Vec3> point(Id id) const {
    const auto found = point_m_.find(id);
    return found == point_m_.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<Vec3> at(const std::string& name) const {
    const auto found = out_.landmarks.find(name);
    return found == out_.landmarks.end() ? std::nullopt : std::optional(found->second.place_m);
  }
  void add(const std::string& name, std::optional<Vec3> place, const std::string& source) {
    if (place) out_.landmarks[name] = {*place, source};
  }
  void take(const std::string& name, Id id) { add(name, point(id), text_of(id)); }

  // The foremost skin at a place seen from the front; the outermost seen from a side.
  std::optional<Vec3> front(float x, float y) const {
    constexpr float kFar_m = 1.0f;
    const auto hit = rays_->first_hit({x, y, kFar_m}, {0, 0, -1}, 2 * kFar_m);
    if (hit.opacity <= 0) return std::nullopt;
    return Vec3(x, y, kFar_m - hit.distance_m);
  }
  std::optional<Vec3> outside(float side, float y, float z) const {
    constexpr float kFar_m = 1.0f;
    const auto hit = rays_->first_hit({side * kFar_m, y, z}, {-side, 0, 0}, 2 * kFar_m);
    if (hit.opacity <= 0) return std::nullopt;
    return Vec3(side * (kFar_m - hit.distance_m), y, z);
  }
  // The point of the mid-line between two heights that lies foremost (sign 1) or deepest (-1).
  std::optional<Vec3> on_profile(float low_y, float high_y, float sign) const {
    std::optional<Vec3> best;
    constexpr float kStep_m = 0.0005f;
    for (float y = low_y; y <= high_y; y += kStep_m)
      if (const auto p = front(middle_x_, y); p && (!best || sign * p->z > sign * best->z))
        best = p;
    return best;
  }

  void find_profile() {
    const auto mf_l = at("mf l"), mf_r = at("mf r"), brow_l = point({4, 1}), brow_r = point({4, 2});
    if (brow_l && brow_r && at("sn")) {
      // Nasion: at the root of the nose, as high as the inner ends of the nose bones; without
      // those a fifth of the way from the inner corners of the eyes to the brows.
      float y = 0.5f * (brow_l->y + brow_r->y);
      const float brow_y = y;
      if (mf_l && mf_r)
        y = 0.5f * (mf_l->y + mf_r->y);
      else if (at("en l"))
        y = glm::mix(at("en l")->y, brow_y, 0.2f);
      add("n", front(middle_x_, y), "mid-line at the root of the nose bones");
      constexpr float kOver_m = 0.012f, kUnder_m = 0.002f;
      add("g", on_profile(brow_y - kUnder_m, brow_y + kOver_m, 1.0f),
          "foremost mid-line between the brows");
      if (at("prn") && at("g"))
        add("se", on_profile(glm::mix(at("prn")->y, y, 0.6f), at("g")->y, -1.0f),
            "deepest mid-line of the root of the nose");
    }
    if (at("li") && at("pg"))
      add("sl", on_profile(at("pg")->y, at("li")->y - 0.001f, -1.0f),
          "deepest mid-line between lower lip and chin");
    if (at("prn") && at("sn"))
      add("c'", front(middle_x_, glm::mix(at("sn")->y, at("prn")->y, 0.3f)),
          "mid-line of the columella");
  }

  void find_side(float side, const std::string& lr) {
    const auto pupil = at("p" + lr), lower = at("pi" + lr), upper = at("ps" + lr),
               brow = at("sci" + lr), outer = at("ex" + lr), obs = at("obs" + lr),
               obi = at("obi" + lr);
    if (pupil && lower && brow) {
      // Rims of the orbit beneath lid and brow, on the pupil's vertical; the lower one about a
      // lid's opening and a quarter below the lid.
      const float open = upper->y - lower->y;
      add("or" + lr, front(pupil->x, lower->y - 1.25f * open),
          "lower rim of the orbit, by the lids");
      add("os" + lr, front(pupil->x, glm::mix(upper->y, brow->y, 0.8f)), "under the brow");
    }
    if (outer && brow) {  // The narrowest forehead above the brows.
      std::optional<Vec3> narrowest;
      constexpr float kBehind_m = 0.004f, kFrom_m = 0.004f, kTo_m = 0.03f, kStep_m = 0.001f;
      for (float y = brow->y + kFrom_m; y < brow->y + kTo_m; y += kStep_m)
        if (const auto p = outside(side, y, outer->z - kBehind_m);
            p && (!narrowest || side * p->x < side * narrowest->x))
          narrowest = p;
      add("ft" + lr, narrowest, "narrowest forehead above the brow");
    }
    if (!obs || !obi) return;
    constexpr float kTragus_m = 0.010f;
    const Vec3 ear = glm::mix(*obs, *obi, 0.45f);
    add("pra" + lr, glm::mix(*obs, *obi, 0.5f), "between 10.9 and 10.7 (10.10 and 10.8)");
    add("t" + lr, outside(side, ear.y, ear.z + kTragus_m), "before the ear, at the tragus");
    const auto orbit = at("or" + lr), op = at("op"), vertex = at("v");
    if (orbit && pupil) {
      // The arch stands out before the ear, whose own rim is wider still.
      constexpr float kBeforeEar = 0.4f;
      add("zy" + lr,
          widest(side, orbit->y - 0.03f, orbit->y,
                 glm::mix(ear.z + kTragus_m, pupil->z, kBeforeEar), pupil->z),
          "widest cheek bone before the ear");
    }
    if (op && vertex)
      add("eu" + lr, widest(side, at("obs" + lr)->y + 0.02f, vertex->y, op->z, ear.z + 0.03f),
          "widest skull above the ear");
  }

  std::optional<Vec3> widest(float side, float low_y, float high_y, float back_z,
                             float front_z) const {
    std::optional<Vec3> best;
    constexpr float kStep_m = 0.002f;
    for (float y = low_y; y < high_y; y += kStep_m)
      for (float z = back_z; z < front_z; z += kStep_m)
        if (const auto p = outside(side, y, z); p && (!best || side * p->x > side * best->x))
          best = p;
    return best;
  }

  MeasuredHead out_;
  std::map<Id, Vec3> point_m_;
  std::unique_ptr<RayTree> rays_;
  float middle_x_ = 0;
};

}  // namespace

Vec3 MeasuredHead::in_frankfurt(Vec3 p) const {
  const float c = std::cos(to_frankfurt_rad), s = std::sin(to_frankfurt_rad);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

MeasuredHead find_landmarks(const Character& character) { return Finder(character).run(); }

}  // namespace caryatid::bake::anthropometry
