#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "assets/bake/body/bdp.h"
#include "core/base/fixed.h"
#include "core/body/helper_joints.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;
using body::index_of;

body::Skeleton skeleton_of(const Character& c) {
  body::Skeleton s = body::upright_skeleton();
  for (const Joint& j : c.joints)
    if (j.hanim < body::kHanimJointCount) s.center_m[j.hanim] = j.center_m;
  body::derive_soles(s);
  return s;
}

body::Skeleton calibrated(const body::Skeleton& generic, const BodyDefinition& sent) {
  body::Skeleton out;
  body::CalibrationReport report;
  const Status status = body::calibrate(generic, sent.joints, out, report);
  if (status.ok()) return out;
  constexpr const char* kReasons[] = {"", "a joint stands twice", "a number is not finite",
                                      "the stature is none of a human",
                                      "a limb would scale by less than 0.3 or more than 3"};
  throw std::runtime_error(std::string("the sent body can't be taken on: ") +
                           kReasons[std::min<std::size_t>(status.detail, 4)]);
}

// The joint at the other end of a joint's bone; count where it has none that tells.
HanimJoint bone_end(HanimJoint joint) {
  switch (joint) {
    case HanimJoint::humanoid_root:
      return HanimJoint::vl5;
    case HanimJoint::vt1:
      return HanimJoint::vc7;
    case HanimJoint::l_wrist:
      return HanimJoint::l_middle1;
    case HanimJoint::r_wrist:
      return HanimJoint::r_middle1;
    case HanimJoint::sacroiliac:
    case HanimJoint::skullbase:
      return HanimJoint::count;
    default:
      break;
  }
  for (std::size_t j = index_of(joint) + 1; j < body::kHanimJointCount; ++j)
    if (body::hanim_parent(static_cast<HanimJoint>(j)) == joint) return static_cast<HanimJoint>(j);
  return HanimJoint::count;
}

// Linear part: `along` in the old bone's direction, `across` beside it, then to the new direction.
struct Motion {
  Mat3 linear{1.0f};
  Vec3 from_m{0}, to_m{0};
  Vec3 point(Vec3 p) const { return to_m + linear * (p - from_m); }
};

// Between unit vectors that are not opposite.
Quat turn_between(Vec3 u, Vec3 v) {
  const Vec3 axis = glm::cross(u, v);
  return glm::normalize(Quat(1.0f + glm::dot(u, v), axis.x, axis.y, axis.z));
}

Motion motion_of(const body::Skeleton& from, const body::Skeleton& to, HanimJoint joint,
                 float stature) {
  Motion m{Mat3(stature), from.center(joint), to.center(joint)};
  const HanimJoint end = bone_end(joint);
  if (end == HanimJoint::count) return m;
  const Vec3 a = from.center(end) - from.center(joint), b = to.center(end) - to.center(joint);
  const float la = glm::length(a), lb = glm::length(b);
  if (la < 0.015f || lb < 0.001f) return m;
  const Vec3 u = a / la, v = b / lb;
  const Mat3 stretch = Mat3(stature) + glm::outerProduct(u, u) * (lb / la - stature);
  m.linear = glm::mat3_cast(turn_between(u, v)) * stretch;
  return m;
}

// The sent centres as they are, whatever the proportions; others keep their place beside parents.
body::Skeleton sent_skeleton(const BodyDefinition& sent) {
  const body::Skeleton generic = body::upright_skeleton();
  body::Skeleton out = generic;
  BitSet<body::kHanimJointCount> known;
  float old_top = 0.1f, new_top = 0.1f;
  for (const body::JointCenter& j : sent.joints) {
    out.center_m[index_of(j.joint)] = j.center_m;
    known.set(index_of(j.joint));
    old_top = std::max(old_top, generic.center(j.joint).y);
    new_top = std::max(new_top, j.center_m.y);
  }
  for (std::size_t j = 0; j < body::kHanimJointCount; ++j) {
    if (known.test(j)) continue;
    const HanimJoint parent = body::hanim_parent(static_cast<HanimJoint>(j));
    const Vec3 from = parent == HanimJoint::count ? Vec3{0} : generic.center(parent);
    const Vec3 to = parent == HanimJoint::count ? Vec3{0} : out.center(parent);
    out.center_m[j] = to + (new_top / old_top) * (generic.center_m[j] - from);
  }
  body::derive_soles(out);
  return out;
}

}  // namespace

void calibrate_character(const BodyDefinition& sent, Character* c) {
  const body::Skeleton from = skeleton_of(*c);
  const body::Skeleton to = calibrated(from, sent);
  const float stature = to.center(HanimJoint::skullbase).y / from.center(HanimJoint::skullbase).y;
  std::vector<Motion> motions;
  for (Joint& j : c->joints) {
    const auto owner =
        j.hanim < body::kHanimJointCount
            ? static_cast<HanimJoint>(j.hanim)
            : body::helper_owner(static_cast<body::HelperJoint>(j.hanim - body::kHanimJointCount));
    motions.push_back(motion_of(from, to, owner, stature));
    j.center_m = to.center(owner);
  }
  float lowest = 1e9f;
  for (Object& o : c->objects)
    for (std::size_t v = 0; v < o.mesh.position_m.size(); ++v) {
      const Influence& influence = o.mesh.influence[v];
      Vec3 p(0.0f);
      Mat3 linear(0.0f);
      for (std::size_t k = 0; k < 4; ++k) {
        if (influence.weight[k] <= 0) continue;
        const Motion& m = motions[influence.joint[k]];
        p += influence.weight[k] * m.point(o.mesh.position_m[v]);
        linear += influence.weight[k] * m.linear;
      }
      o.mesh.position_m[v] = p;
      o.mesh.normal[v] = glm::normalize(glm::transpose(glm::inverse(linear)) * o.mesh.normal[v]);
      lowest = std::min(lowest, p.y);
    }
  const Vec3 down{0, lowest, 0};
  for (Object& o : c->objects)
    for (Vec3& p : o.mesh.position_m) p -= down;
  for (Joint& j : c->joints) j.center_m -= down;
  for (FeaturePoint& p : c->feature_points)
    p.position_m = p.object == kNone ? c->joints[p.vertex].center_m
                                     : c->objects[p.object].mesh.position_m[p.vertex];
  pack::Character& f = c->facts;
  for (float* length : {&f.iris_diameter_m, &f.eye_separation_m, &f.eye_nose_m, &f.mouth_nose_m,
                        &f.mouth_width_m, &f.stature_m})
    *length *= stature;
  f.leg_length_m = c->joints[index_of(HanimJoint::l_hip)].center_m.y;
}

Character character_of(const BodyDefinition& sent, const std::string& name) {
  if (sent.segments.empty())
    throw std::runtime_error("the sent body has no surfaces; use it to calibrate ours");
  const body::Skeleton s = sent_skeleton(sent);
  Character c;
  c.name = name;
  for (std::size_t j = 0; j < body::kHanimJointCount; ++j) {
    const HanimJoint parent = body::hanim_parent(static_cast<HanimJoint>(j));
    c.joints.push_back({static_cast<std::uint16_t>(j),
                        parent == HanimJoint::count ? pack::kNoJoint
                                                    : static_cast<std::uint16_t>(index_of(parent)),
                        s.center_m[j]});
  }
  for (const BodyDefinition::Segment& segment : sent.segments) {
    pack::Material material{};
    material.kind = pack::MaterialKind::cloth;
    material.flags = pack::kTwoSided;
    material.texture = material.detail = pack::kNoTexture;
    for (int k = 0; k < 3; ++k) material.tint[k] = segment.color[k];
    material.gloss = 0.1f;
    material.shininess = 12.0f;
    Object o;
    o.name = std::string(body::hanim_info(segment.joint).name);
    o.role = pack::ObjectRole::body;
    o.material = static_cast<std::uint32_t>(c.materials.size());
    c.materials.push_back(material);
    o.mesh.position_m = segment.position_m;
    o.mesh.triangles = segment.triangles;
    o.mesh.normal.assign(segment.position_m.size(), Vec3{0});
    for (const auto& t : segment.triangles) {
      const Vec3 n = glm::cross(segment.position_m[t[1]] - segment.position_m[t[0]],
                                segment.position_m[t[2]] - segment.position_m[t[0]]);
      for (const std::uint32_t v : t) o.mesh.normal[v] += n;
    }
    for (Vec3& n : o.mesh.normal) n = glm::length(n) > 1e-12f ? glm::normalize(n) : Vec3{0, 0, 1};
    o.mesh.uv.assign(segment.position_m.size(), Vec2{0});
    o.mesh.base_vertex.assign(segment.position_m.size(), kNone);
    o.mesh.influence.assign(
        segment.position_m.size(),
        Influence{{static_cast<std::uint16_t>(index_of(segment.joint))}, {1.0f}});
    for (const Vec3 p : segment.position_m) c.facts.stature_m = std::max(c.facts.stature_m, p.y);
    c.objects.push_back(std::move(o));
  }
  c.facts.leg_length_m = s.center(HanimJoint::l_hip).y;
  // Units of a face that the body does not have; ANSUR II's eyes, the rest by proportion.
  const float size = c.facts.stature_m / 1.7f;
  c.facts.iris_diameter_m = 0.012f * size;
  c.facts.eye_separation_m = 0.063f * size;
  c.facts.eye_nose_m = 0.047f * size;
  c.facts.mouth_nose_m = 0.018f * size;
  c.facts.mouth_width_m = 0.050f * size;
  return c;
}

}  // namespace caryatid::bake
