#include "assets/bake/head/foreign_head.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "assets/bake/face/fat.h"
#include "assets/bake/head/anatomy.h"
#include "assets/bake/head/head_paint.h"
#include "assets/bake/head/made_parts.h"
#include "core/body/hanim.h"

namespace caryatid::bake::foreign {
namespace {

using body::HanimJoint;
using pack::MaterialKind;
using pack::ObjectRole;

// Diameter of an iris for the distance between the pupils (faces of 102 people: 0.17).
constexpr float kIrisToEyes = 0.178f;

class Builder {
 public:
  Builder(const Surface& surface, const PointList& points, const std::string& name)
      : points_(points),
        placed_(place_head(surface, points)),
        openings_(open_head(points, placed_)) {
    out_.character.name = name;
    out_.character.joints = head_joints(placed_, openings_);
    derive_points(openings_, placed_);
  }

  ForeignHead build(const fat::WorkingRanges& ranges) {
    measure();
    make_fat_head();
    add_skin();
    add_eyes();
    add_loose_parts();
    if (!has_mouth_) add_mouth();
    place_points();
    rest_face();
    build_fat(character(), out_.head, ranges);
    out_.notes = placed_.notes;
    return std::move(out_);
  }

 private:
  Character& character() { return out_.character; }
  std::uint16_t joint(HanimJoint j) { return joint_index(character().joints, j); }

  void measure() {
    pack::Character& f = character().facts;
    const auto at = [&](int group, int index) { return placed_.at(group, index); };
    f.iris_diameter_m = 0.5f * (at(3, 1).y - at(3, 3).y + at(3, 2).y - at(3, 4).y);
    f.eye_separation_m = placed_.eye_separation_m;
    const float eyes_y = 0.5f * (placed_.place_m.at({3, 5}).y + placed_.place_m.at({3, 6}).y);
    f.eye_nose_m = eyes_y - at(9, 15).y;
    f.mouth_nose_m = at(9, 15).y - at(2, 2).y;
    f.mouth_width_m = at(8, 3).x - at(8, 4).x;
    for (const Vec3& p : placed_.position_m) f.stature_m = std::max(f.stature_m, p.y);
    f.leg_length_m = body::upright_skeleton().center(HanimJoint::l_hip).y;
    const std::pair<const char*, float> lengths[] = {{"IRISD0", f.iris_diameter_m},
                                                     {"ENS0", f.eye_nose_m},
                                                     {"MNS0", f.mouth_nose_m},
                                                     {"MW0", f.mouth_width_m}};
    constexpr float kLeast_m = 0.002f;
    for (const auto& [unit, length] : lengths)
      if (!(length > kLeast_m))
        points_.fail(nullptr,
                     std::string("the points give no face: ") + unit +
                         " would be less than 2 mm between pupils 63 mm apart; check the "
                         "points of lids (3.1-3.4), nose (9.15) and mouth (2.2, 8.3, 8.4)");
  }

  void make_fat_head() {
    fat::Head& h = out_.head;
    h.skin = fat::make_triangle_skin(placed_.position_m, placed_.triangles);
    h.normal = fat::normals(h.skin, h.skin.position_m);
    h.facts = character().facts;
    h.border.assign(h.skin.size(), false);
    h.eye = openings_.eye;
    h.lips = openings_.lips;
    h.point_vertex.insert(placed_.vertex.begin(), placed_.vertex.end());
    h.point_m.insert(placed_.place_m.begin(), placed_.place_m.end());
    h.middle_x_m = placed_.at(2, 2).x;
    const Vec3 hinge = character().joints[joint(HanimJoint::temporomandibular)].center_m;
    h.mandible = mandible_share(placed_, hinge);
    h.transforms = {.eye_separation_m = h.facts.eye_separation_m,
                    .iris_diameter_m = h.facts.iris_diameter_m,
                    .mouth_nose_m = h.facts.mouth_nose_m,
                    .mouth_width_m = h.facts.mouth_width_m,
                    .jaw_center_m = hinge,
                    .chin_m = placed_.at(2, 1)};
  }

  std::uint32_t material(MaterialKind kind, unsigned flags, Image image, float gloss,
                         float shininess) {
    pack::Material m{};
    m.kind = kind;
    m.flags = static_cast<std::uint16_t>(flags);
    m.texture = static_cast<std::uint16_t>(character().images.size());
    m.detail = pack::kNoTexture;
    for (float& t : m.tint) t = 1.0f;
    m.gloss = gloss;
    m.shininess = shininess;
    character().images.push_back(std::move(image));
    character().materials.push_back(m);
    return static_cast<std::uint32_t>(character().materials.size() - 1);
  }

  void hang(Mesh& mesh, HanimJoint on) {
    mesh.influence.assign(mesh.position_m.size(), {{joint(on)}, {1.0f}});
  }

  Object& add(std::string name, ObjectRole role, std::uint32_t of_material, Mesh mesh) {
    Object object;
    object.name = std::move(name);
    object.role = role;
    object.material = of_material;
    object.mesh = std::move(mesh);
    character().objects.push_back(std::move(object));
    return character().objects.back();
  }

  void add_skin() {
    Mesh mesh = skin_mesh(placed_, openings_, out_.head.normal);
    for (const Vec3& p : mesh.position_m)
      mesh.influence.push_back(neck_influence(character().joints, p));
    Image image = paint_skin(placed_, openings_, mesh);
    add("head", ObjectRole::head, material(MaterialKind::skin, 0, std::move(image), 0.08f, 18.0f),
        std::move(mesh));
  }

  void add_eyes() {
    const float iris =
        std::min(kIrisToEyes * placed_.eye_separation_m, 1.5f * character().facts.iris_diameter_m);
    for (std::size_t s = 0; s < 2; ++s) {
      const fat::Eye& eye = openings_.eye[s];
      Mesh mesh =
          openings_.own_ball[s]
              ? mesh_of(finer_iris(placed_.parts[openings_.ball[s]], eye.center_m, 0.55f * iris),
                        [&](Vec3 p) { return eyeball_uv(p, eye.center_m); })
              : ball_mesh(eye.center_m, eye.ball_radius_m);
      hang(mesh, s == 0 ? HanimJoint::l_eyeball_joint : HanimJoint::r_eyeball_joint);
      add(s == 0 ? "l_eye" : "r_eye", ObjectRole::eye,
          material(MaterialKind::eye, 0, paint_eye(iris, eye.ball_radius_m), 0.35f, 60.0f),
          std::move(mesh));
    }
  }

  static Mesh mesh_of(const LoosePart& part, const std::function<Vec2(Vec3)>& uv) {
    Mesh mesh;
    mesh.position_m = part.position_m;
    mesh.triangles = part.triangles;
    mesh.normal =
        fat::normals(fat::make_triangle_skin(part.position_m, part.triangles), part.position_m);
    for (const Vec3& p : part.position_m) mesh.uv.push_back(uv(p));
    mesh.base_vertex.assign(mesh.position_m.size(), kNone);
    return mesh;
  }

  // Teeth and tongue of the file's own, brows, lashes; the rest stays on the skull as it is.
  void add_loose_parts() {
    for (std::size_t i = 0; i < placed_.parts.size(); ++i) {
      if ((openings_.own_ball[0] && i == openings_.ball[0]) ||
          (openings_.own_ball[1] && i == openings_.ball[1]))
        continue;
      const LoosePart& part = placed_.parts[i];
      Mesh mesh = mesh_of(part, [](Vec3) { return Vec2(0.5f); });
      const Vec3 c = part.center_m(), mouth = 0.5f * (placed_.at(2, 4) + placed_.at(2, 5));
      const float half = 0.6f * character().facts.mouth_width_m;
      const std::string number = std::to_string(i + 1);
      const bool in_mouth = std::abs(c.x - mouth.x) < half && std::abs(c.y - mouth.y) < 0.02f &&
                            part.high_m.z < placed_.at(2, 2).z + 0.002f &&
                            part.high_m.x - part.low_m.x < 3.0f * half;
      if (in_mouth) {
        has_mouth_ = true;
        const bool lower = c.y < mouth.y;
        hang(mesh, lower ? HanimJoint::temporomandibular : HanimJoint::skullbase);
        add("mouth_part_" + number, ObjectRole::mouth,
            plain({0.80f, 0.74f, 0.66f}, MaterialKind::mouth), std::move(mesh));
      } else if (near_brow(part)) {
        hang(mesh, HanimJoint::skullbase);
        add("brow_" + number, ObjectRole::brow, plain({0.16f, 0.11f, 0.08f}, MaterialKind::cloth),
            std::move(mesh));
      } else {
        hang(mesh, HanimJoint::skullbase);
        add("part_" + number, ObjectRole::hair, plain({0.22f, 0.16f, 0.12f}, MaterialKind::cloth),
            std::move(mesh));
      }
    }
    if (!placed_.parts.empty())
      placed_.notes.push_back(std::to_string(placed_.parts.size()) + " loose parts" +
                              (has_mouth_ ? ", some in the mouth" : ""));
  }

  bool near_brow(const LoosePart& part) const {
    constexpr float kThick_m = 0.012f;
    for (int side = 0; side < fat::kSides; ++side) {
      const Vec3 inner = placed_.at(4, 1 + side), outer = placed_.at(4, 5 + side);
      const Vec3 low = glm::min(inner, outer) - kThick_m, high = glm::max(inner, outer) + kThick_m;
      if (glm::all(glm::greaterThan(part.low_m, low)) && glm::all(glm::lessThan(part.high_m, high)))
        return true;
    }
    return false;
  }

  std::uint32_t plain(Vec3 srgb, MaterialKind kind) {
    return material(kind, pack::kTwoSided, plain_image("plain", srgb), 0.1f, 16.0f);
  }

  void add_mouth() {
    const std::uint32_t teeth = material(MaterialKind::mouth, 0, paint_teeth(), 0.3f, 40.0f);
    for (const bool upper : {true, false}) {
      Mesh mesh = teeth_mesh(placed_, upper);
      hang(mesh, upper ? HanimJoint::skullbase : HanimJoint::temporomandibular);
      add(upper ? "upper_teeth" : "lower_teeth", ObjectRole::mouth, teeth, std::move(mesh));
    }
    Mesh tongue = tongue_mesh(placed_);
    hang(tongue, HanimJoint::temporomandibular);
    const Object& object =
        add("tongue", ObjectRole::mouth, plain({0.66f, 0.33f, 0.33f}, MaterialKind::mouth),
            std::move(tongue));
    const auto o = static_cast<std::uint32_t>(character().objects.size() - 1);
    const auto farthest = [&](Vec3 towards) {
      const std::vector<Vec3>& p = object.mesh.position_m;
      std::uint32_t best = 0;
      for (std::uint32_t v = 1; v < p.size(); ++v)
        if (glm::dot(p[v], towards) > glm::dot(p[best], towards)) best = v;
      return best;
    };
    const std::pair<int, Vec3> places[] = {
        {1, {0, 0, 1}}, {2, {0, 1, 0}}, {3, {1, 0, 0}}, {4, {-1, 0, 0}}};
    for (const auto& [index, towards] : places)
      add_point({6, index}, o, farthest(towards), object.mesh.position_m[farthest(towards)]);
  }

  void add_point(PointId id, std::uint32_t object, std::uint32_t vertex, Vec3 position_m) {
    character().feature_points.push_back({static_cast<std::uint8_t>(id.first),
                                          static_cast<std::uint8_t>(id.second), object, vertex,
                                          position_m});
    out_.head.point_m[id] = position_m;
  }

  void place_points() {
    std::vector<std::uint32_t> wedge(placed_.position_m.size(), kNone);
    const Mesh& mesh = character().objects.front().mesh;
    for (std::uint32_t i = 0; i < mesh.base_vertex.size(); ++i)
      if (wedge[mesh.base_vertex[i]] == kNone) wedge[mesh.base_vertex[i]] = i;
    for (const auto& [id, v] : placed_.vertex)
      if (wedge[v] != kNone) add_point(id, 0, wedge[v], placed_.position_m[v]);
    const auto on_joint = [&](PointId id, HanimJoint j) {
      add_point(id, kNone, joint(j), character().joints[joint(j)].center_m);
    };
    on_joint({3, 5}, HanimJoint::l_eyeball_joint);
    on_joint({3, 6}, HanimJoint::r_eyeball_joint);
    on_joint({7, 1}, HanimJoint::skullbase);
  }

  // Calm lids cover the rim of the iris, as on our own people, where the head has not modelled them
  // so already; the jaw is a little loose.
  void rest_face() {
    constexpr float kJaw = 25.0f, kMost = 190.0f, kOpen = 0.93f;
    const pack::Character& f = character().facts;
    const float wide_m = f.iris_diameter_m - kOpen * kIrisToEyes * f.eye_separation_m;
    const float upper = std::clamp(1024.0f * wide_m / f.iris_diameter_m, 0.0f, kMost);
    character().rest_face[3] = kJaw;
    character().rest_face[19] = character().rest_face[20] = upper;
  }

  const PointList& points_;
  PlacedHead placed_;
  Openings openings_;
  ForeignHead out_;
  bool has_mouth_ = false;
};

}  // namespace

ForeignHead build_foreign_head(const Surface& surface, const PointList& points,
                               const std::string& name, const fat::WorkingRanges& ranges) {
  return Builder(surface, points, name).build(ranges);
}

std::vector<Licence> licences_of(std::string_view text, const std::string& name) {
  constexpr std::string_view kWords[] = {"licen", "copyright", "cc0",
                                         "cc-by", "cc by",     "public domain"};
  constexpr std::size_t kMostLines = 8, kMostShown = 160;
  std::vector<Licence> out;
  for (std::size_t at = 0; at < text.size() && out.size() < kMostLines;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line(text.substr(at, std::min(end - at, kMostShown)));
    at = end + 1;
    if (line.empty() || line.front() != '#') continue;
    line.erase(0, std::min(line.find_first_not_of("# \t"), line.size()));
    std::string lower;
    for (char& c : line) {
      if (c < ' ' || c > '~') c = ' ';
      lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    for (const std::string_view word : kWords)
      if (lower.find(word) != std::string::npos) {
        out.push_back({name, line, ""});
        break;
      }
  }
  if (out.empty()) out.push_back({name, "not stated in the file; ask its author", ""});
  out.push_back({"skin, eyes, teeth and tongue drawn by the bake", "Apache-2.0", "Caryatid"});
  return out;
}

}  // namespace caryatid::bake::foreign
