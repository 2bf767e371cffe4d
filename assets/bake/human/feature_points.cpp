#include "assets/bake/human/feature_points.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "core/body/hanim.h"

namespace caryatid::bake {
namespace {

constexpr float kMiddle_m = 0.004f;

[[noreturn]] void fail(const std::filesystem::path& file, const toml::node& at,
                       const std::string& what) {
  throw std::runtime_error(file.string() + ":" + std::to_string(at.source().begin.line) + ": " +
                           what);
}

FeaturePointPlace read_place(const std::filesystem::path& file, const toml::table& t) {
  FeaturePointPlace p;
  const std::string id = t["id"].value_or(std::string());
  if (std::sscanf(id.c_str(), "%d.%d", &p.group, &p.index) != 2)
    fail(file, t, "a point needs an id such as \"2.1\"");
  p.base_vertex = static_cast<std::uint32_t>(t["vertex"].value_or(std::int64_t{kNone}));
  p.joint = t["joint"].value_or(std::string());
  p.object = t["object"].value_or(std::string());
  p.middle = t["middle"].value_or(false);
  if (const toml::array* a = t["towards"].as_array(); a != nullptr && a->size() == 3)
    for (std::size_t k = 0; k < 3; ++k) p.towards[static_cast<int>(k)] = a->get(k)->value_or(0.0f);
  const int ways = (p.base_vertex != kNone) + !p.joint.empty() + !p.object.empty();
  if (ways != 1) fail(file, t, "point " + id + " needs one of vertex, joint, object");
  return p;
}

std::uint32_t farthest(const Mesh& mesh, Vec3 towards, bool middle) {
  std::uint32_t best = kNone;
  float best_score = 0.0f;
  for (std::uint32_t v = 0; v < mesh.position_m.size(); ++v) {
    if (middle && std::abs(mesh.position_m[v].x) > kMiddle_m) continue;
    const float score = glm::dot(mesh.position_m[v], towards);
    if (best == kNone || score > best_score) best = v, best_score = score;
  }
  return best;
}

std::string name_of(const FeaturePointPlace& p) {
  return "feature point " + std::to_string(p.group) + "." + std::to_string(p.index);
}

FeaturePoint on_skin(const FeaturePointPlace& p, const Character& c) {
  for (std::uint32_t o = 0; o < c.objects.size(); ++o) {
    const Mesh& mesh = c.objects[o].mesh;
    if (c.objects[o].role != pack::ObjectRole::head) continue;
    const auto at = std::find(mesh.base_vertex.begin(), mesh.base_vertex.end(), p.base_vertex);
    if (at == mesh.base_vertex.end()) continue;
    const auto v = static_cast<std::uint32_t>(at - mesh.base_vertex.begin());
    return {static_cast<std::uint8_t>(p.group), static_cast<std::uint8_t>(p.index), o, v,
            mesh.position_m[v]};
  }
  throw std::runtime_error(name_of(p) + ": its vertex is not on the head");
}

FeaturePoint on_joint(const FeaturePointPlace& p, const Character& c) {
  const auto joint = body::find_hanim_joint({p.joint.data(), p.joint.size()});
  if (joint.ok())
    for (std::uint32_t j = 0; j < c.joints.size(); ++j)
      if (c.joints[j].hanim == body::index_of(joint.value))
        return {static_cast<std::uint8_t>(p.group), static_cast<std::uint8_t>(p.index), kNone, j,
                c.joints[j].center_m};
  throw std::runtime_error(name_of(p) + ": there is no joint " + p.joint);
}

FeaturePoint on_object(const FeaturePointPlace& p, const Character& c) {
  for (std::uint32_t o = 0; o < c.objects.size(); ++o) {
    if (c.objects[o].name != p.object) continue;
    const std::uint32_t v = farthest(c.objects[o].mesh, p.towards, p.middle);
    if (v != kNone)
      return {static_cast<std::uint8_t>(p.group), static_cast<std::uint8_t>(p.index), o, v,
              c.objects[o].mesh.position_m[v]};
  }
  throw std::runtime_error(name_of(p) + ": there is no object " + p.object);
}

Vec3 position(const Character& c, int group, int index) {
  for (const FeaturePoint& p : c.feature_points)
    if (p.group == group && p.index == index) return p.position_m;
  throw std::runtime_error("feature point missing");
}

void measure_fapu(Character& c) {
  pack::Character& f = c.facts;
  const auto at = [&](int group, int index) { return position(c, group, index); };
  f.iris_diameter_m = 0.5f * (at(3, 1).y - at(3, 3).y + at(3, 2).y - at(3, 4).y);
  f.eye_separation_m = at(3, 5).x - at(3, 6).x;
  f.eye_nose_m = 0.5f * (at(3, 5).y + at(3, 6).y) - at(9, 15).y;
  f.mouth_nose_m = at(9, 15).y - at(2, 2).y;
  f.mouth_width_m = at(8, 3).x - at(8, 4).x;
  f.stature_m = at(11, 4).y;
  for (const Joint& j : c.joints)
    if (j.hanim == body::index_of(body::HanimJoint::l_hip)) f.leg_length_m = j.center_m.y;
}

}  // namespace

std::uint32_t mirrored_vertex(const BaseHuman& base, std::uint32_t vertex) {
  const Vec3 wanted = base.rest_m()[vertex] * Vec3{-1, 1, 1};
  std::uint32_t best = vertex;
  float nearest = 1e9f;
  for (const Quad& quad : base.quads())
    if (quad.group == 0)
      for (const std::uint32_t v : quad.vertex) {
        const Vec3 d = base.rest_m()[v] - wanted;
        if (const float l = glm::dot(d, d); l < nearest) nearest = l, best = v;
      }
  return best;
}

std::vector<FeaturePointPlace> read_feature_points(const std::filesystem::path& file,
                                                   const BaseHuman& base) {
  toml::table root;
  try {
    root = toml::parse_file(file.string());
  } catch (const toml::parse_error& e) {
    throw std::runtime_error(file.string() + ":" + std::to_string(e.source().begin.line) + ": " +
                             std::string(e.description()));
  }
  std::vector<FeaturePointPlace> out;
  const toml::array* points = root["point"].as_array();
  if (points == nullptr) fail(file, root, "there is no [[point]]");
  for (const toml::node& node : *points) {
    const toml::table* t = node.as_table();
    if (t == nullptr) fail(file, node, "a point is a table; write [[point]]");
    out.push_back(read_place(file, *t));
    const std::string mirror = (*t)["mirror"].value_or(std::string());
    if (mirror.empty()) continue;
    FeaturePointPlace other = out.back();
    if (std::sscanf(mirror.c_str(), "%d.%d", &other.group, &other.index) != 2 ||
        other.base_vertex == kNone)
      fail(file, node, "mirror needs a point such as \"2.5\" and a vertex");
    other.base_vertex = mirrored_vertex(base, other.base_vertex);
    out.push_back(other);
  }
  std::set<std::pair<int, int>> seen;
  for (const FeaturePointPlace& p : out)
    if (!seen.insert({p.group, p.index}).second) fail(file, root, name_of(p) + " is there twice");
  if (out.size() != kFeaturePointCount)
    fail(file, root,
         std::to_string(out.size()) + " points, wanted " + std::to_string(kFeaturePointCount));
  return out;
}

std::uint32_t base_vertex_of(const std::vector<FeaturePointPlace>& places, int group, int index) {
  for (const FeaturePointPlace& p : places)
    if (p.group == group && p.index == index && p.base_vertex != kNone) return p.base_vertex;
  throw std::runtime_error("feature point " + std::to_string(group) + "." + std::to_string(index) +
                           " is not on the base");
}

void place_feature_points(const std::vector<FeaturePointPlace>& places, Character& c) {
  c.feature_points.clear();
  for (FeaturePointPlace p : places) {
    if (!p.joint.empty()) {
      c.feature_points.push_back(on_joint(p, c));
    } else if (!p.object.empty()) {
      const bool bald =
          p.object == "hair" && std::none_of(c.objects.begin(), c.objects.end(),
                                             [](const Object& o) { return o.name == "hair"; });
      if (bald) p.base_vertex = base_vertex_of(places, 11, 4);
      c.feature_points.push_back(bald ? on_skin(p, c) : on_object(p, c));
    } else {
      c.feature_points.push_back(on_skin(p, c));
    }
  }
  measure_fapu(c);
}

}  // namespace caryatid::bake
