#include "assets/bake/face/head.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/body/hanim.h"

namespace caryatid::bake::fat {
namespace {

// Vertices of hm08 from which the rings of lids and lips are traced; the right side is found by
// mirroring. The mid-line of the upper lip from the skin beneath the nose to the vestibule.
constexpr std::uint32_t kLeftRim = 6784, kLeftRimNext = 6785, kLeftBehindRim = 13353;
constexpr std::array<std::uint32_t, 13> kUpperLipMiddle = {5342, 362, 455, 466, 467, 509, 468,
                                                           474,  520, 537, 554, 571, 588};

std::string name_of(int group, int index) {
  return std::to_string(group) + "." + std::to_string(index);
}

std::vector<Vec3> positions_of(const Character& character, std::vector<bool>& present) {
  std::vector<Vec3> out(BaseHuman::kVertexCount, Vec3(0));
  present.assign(BaseHuman::kVertexCount, false);
  for (const Object& object : character.objects) {
    if (object.role != pack::ObjectRole::head) continue;
    for (std::size_t i = 0; i < object.mesh.base_vertex.size(); ++i) {
      const std::uint32_t v = object.mesh.base_vertex[i];
      if (v == kNone) continue;
      out[v] = object.mesh.position_m[i];
      present[v] = true;
    }
  }
  return out;
}

Skin skin_of(const Character& character, const BaseHuman& base) {
  std::vector<bool> present;
  const std::vector<Vec3> position = positions_of(character, present);
  std::vector<std::array<std::uint32_t, 4>> quads;
  const std::uint16_t body = base.group("body");
  for (const Quad& quad : base.quads()) {
    if (quad.group != body) continue;
    if (std::all_of(quad.vertex.begin(), quad.vertex.end(),
                    [&](std::uint32_t v) { return present[v]; }))
      quads.push_back(quad.vertex);
  }
  if (quads.empty()) throw std::runtime_error("FAT: the character has no head of the base human");
  return make_skin(position, quads);
}

std::uint32_t on_skin(const Skin& skin, std::uint32_t base_vertex) {
  const std::uint32_t v = skin.of_base[base_vertex];
  if (v == kNone)
    throw std::runtime_error("FAT: the head lacks base vertex " + std::to_string(base_vertex));
  return v;
}

// The vertex at the mirrored place of the base's rest shape, which is symmetric.
std::uint32_t mirrored(const BaseHuman& base, std::uint32_t vertex) {
  const Vec3 p = base.rest_m()[vertex] * Vec3(-1, 1, 1);
  std::uint32_t best = vertex;
  float least = 1e9f;
  for (std::uint32_t v = 0; v < base.rest_m().size(); ++v) {
    const float d = glm::length(base.rest_m()[v] - p);
    if (d < least) least = d, best = v;
  }
  return best;
}

void flood(const Skin& skin, std::uint32_t from, std::vector<bool>& reached) {
  std::vector<std::uint32_t> open = {from};
  while (!open.empty()) {
    const std::uint32_t v = open.back();
    open.pop_back();
    if (reached[v]) continue;
    reached[v] = true;
    for (const std::uint32_t n : skin.neighbours[v]) open.push_back(n);
  }
}

Eye make_eye(const Skin& skin, const Character& character, const BaseHuman& base, int side) {
  Eye eye = find_eye(skin, base, side);
  const auto joint = body::index_of(side == 0 ? body::HanimJoint::l_eyeball_joint
                                              : body::HanimJoint::r_eyeball_joint);
  for (const Joint& j : character.joints)
    if (j.hanim == joint) eye.center_m = j.center_m;
  constexpr float kLargestEyeball_m = 0.02f;  // Other eyes are farther from this centre.
  for (const Object& object : character.objects)
    if (object.role == pack::ObjectRole::eye)
      for (const Vec3& p : object.mesh.position_m)
        if (const float r = glm::length(p - eye.center_m); r < kLargestEyeball_m)
          eye.ball_radius_m = std::max(eye.ball_radius_m, r);
  return eye;
}

std::size_t row_through(const Lips& lips, std::size_t column, std::uint32_t vertex,
                        const std::string& name) {
  for (std::size_t r = 0; r < lips.row.size(); ++r)
    if (lips.row[r][column] == vertex) return r;
  throw std::runtime_error("FAT: feature point " + name + " does not lie on a ring of the lips");
}

Lips make_lips(const Head& head, int side) {
  const Skin& skin = head.skin;
  Lips lips;
  for (const std::uint32_t middle_base : kUpperLipMiddle) {
    const std::uint32_t middle = on_skin(skin, middle_base);
    std::uint32_t toward = kNone;
    for (const std::uint32_t n : skin.neighbours[middle]) {
      const float x = (skin.position_m[n].x - skin.position_m[middle].x) * outward(side);
      if (x > 1e-4f) toward = n;
    }
    const auto walked = ring(skin, middle, toward, kLipColumns);
    if (walked.size() != kLipColumns) throw std::runtime_error("FAT: a ring of the lips is broken");
    std::copy(walked.begin(), walked.end(), lips.row.emplace_back().begin());
  }
  lips.upper_inner = row_through(lips, 0, head.vertex_of(2, 2), "2.2");
  lips.lower_inner = row_through(lips, kLipColumns - 1, head.vertex_of(2, 3), "2.3");
  lips.upper_outer = row_through(lips, 0, head.vertex_of(8, 1), "8.1");
  lips.lower_outer = row_through(lips, kLipColumns - 1, head.vertex_of(8, 2), "8.2");
  return lips;
}

std::vector<float> mandible_of(const Skin& skin, const BaseHuman& base) {
  const std::uint32_t jaw = base.bone("jaw");
  std::vector<bool> moves(base.bones().size(), false);
  for (std::size_t b = 0; b < moves.size(); ++b)
    for (std::uint32_t up = static_cast<std::uint32_t>(b); up != kNone;
         up = base.bones()[up].parent)
      if (up == jaw) moves[b] = true;
  std::vector<float> share(skin.size(), 0.0f);
  for (std::uint32_t v = 0; v < skin.size(); ++v) {
    const Influence& influence = base.influence()[skin.base[v]];
    for (std::size_t k = 0; k < 4; ++k)
      if (moves[influence.joint[k]]) share[v] += influence.weight[k];
  }
  return share;
}

std::vector<bool> border_of(const Skin& skin) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : skin.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<bool> border(skin.size(), false);
  for (const auto& [edge, count] : uses)
    if (count == 1) border[edge.first] = border[edge.second] = true;
  return border;
}

void find_points(const Character& character, Head& head) {
  for (const FeaturePoint& point : character.feature_points) {
    const std::pair<int, int> key{point.group, point.index};
    head.point_m[key] = point.position_m;
    if (point.object == kNone) continue;
    const Object& object = character.objects[point.object];
    if (object.role != pack::ObjectRole::head) continue;
    const std::uint32_t base_vertex = object.mesh.base_vertex[point.vertex];
    if (base_vertex != kNone) head.point_vertex[key] = on_skin(head.skin, base_vertex);
  }
}

}  // namespace

float brow_line_m(const Head& head, int side, Vec3 p) {
  const Vec3 inner = head.place_of(4, 1 + side), middle = head.place_of(4, 3 + side),
             outer = head.place_of(4, 5 + side);
  const float x = head.lateral(p, side), xi = head.lateral(inner, side),
              xm = head.lateral(middle, side), xo = head.lateral(outer, side);
  const float t = x < xm ? (x - xi) / (xm - xi) : (x - xm) / (xo - xm);
  const float along = std::clamp(t, 0.0f, 1.0f);
  return x < xm ? glm::mix(inner.y, middle.y, along) : glm::mix(middle.y, outer.y, along);
}

Eye find_eye(const Skin& skin, const BaseHuman& base, int side) {
  const auto id = [&](std::uint32_t left) {
    return on_skin(skin, side == 0 ? left : mirrored(base, left));
  };
  Eye eye;
  eye.rim = ring(skin, id(kLeftRim), id(kLeftRimNext));
  const auto by_x = [&](std::uint32_t a, std::uint32_t b) {
    return skin.position_m[a].x < skin.position_m[b].x;
  };
  const auto corners = std::minmax_element(eye.rim.begin(), eye.rim.end(), by_x);
  const Vec3 low = skin.position_m[*corners.first], high = skin.position_m[*corners.second];
  for (const std::uint32_t v : eye.rim) {
    if (v == *corners.first || v == *corners.second) continue;
    const Vec3 p = skin.position_m[v];
    const float t = (p.x - low.x) / (high.x - low.x);
    (p.y > low.y + t * (high.y - low.y) ? eye.upper : eye.lower).push_back(v);
  }
  std::sort(eye.upper.begin(), eye.upper.end(), by_x);
  std::sort(eye.lower.begin(), eye.lower.end(), by_x);
  eye.inside.assign(skin.size(), false);
  for (const std::uint32_t v : eye.rim) eye.inside[v] = true;  // The rim stops the flood.
  flood(skin, id(kLeftBehindRim), eye.inside);
  for (const std::uint32_t v : eye.rim) eye.inside[v] = false;
  return eye;
}

std::uint32_t Head::vertex_of(int group, int index) const {
  const auto found = point_vertex.find({group, index});
  if (found == point_vertex.end())
    throw std::runtime_error("FAT: no feature point " + name_of(group, index) + " on the skin");
  return found->second;
}

Vec3 Head::place_of(int group, int index) const {
  const auto found = point_m.find({group, index});
  if (found == point_m.end())
    throw std::runtime_error("FAT: no feature point " + name_of(group, index));
  return found->second;
}

Head make_head(const Character& character, const BaseHuman& base) {
  Head head;
  head.skin = skin_of(character, base);
  head.normal = normals(head.skin, head.skin.position_m);
  head.mandible = mandible_of(head.skin, base);
  head.border = border_of(head.skin);
  head.facts = character.facts;
  find_points(character, head);
  head.middle_x_m = head.place_of(2, 2).x;
  head.transforms = {.eye_separation_m = head.facts.eye_separation_m,
                     .iris_diameter_m = head.facts.iris_diameter_m,
                     .mouth_nose_m = head.facts.mouth_nose_m,
                     .mouth_width_m = head.facts.mouth_width_m,
                     .jaw_center_m = Vec3(0),
                     .chin_m = head.place_of(2, 1)};
  for (const Joint& joint : character.joints)
    if (joint.hanim == body::index_of(body::HanimJoint::temporomandibular))
      head.transforms.jaw_center_m = joint.center_m;
  for (int side = 0; side < kSides; ++side) {
    const auto s = static_cast<std::size_t>(side);
    head.eye[s] = make_eye(head.skin, character, base, side);
    head.lips[s] = make_lips(head, side);
  }
  return head;
}

}  // namespace caryatid::bake::fat
