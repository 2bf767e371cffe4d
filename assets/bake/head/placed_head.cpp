#include "assets/bake/head/placed_head.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/bake/mesh_io/repair.h"
#include "core/body/hanim.h"

namespace caryatid::bake::foreign {
namespace {

constexpr PointId kRequired[] = {{2, 1}, {2, 2}, {2, 3}, {2, 4}, {2, 5},  {3, 1},  {3, 2},
                                 {3, 3}, {3, 4}, {3, 7}, {3, 8}, {3, 11}, {3, 12}, {4, 1},
                                 {4, 2}, {4, 3}, {4, 4}, {4, 5}, {4, 6},  {8, 1},  {8, 2},
                                 {8, 3}, {8, 4}, {9, 1}, {9, 2}, {9, 3},  {9, 15}};

// Points that lie on eyeballs, tongue, teeth, joints or hair.
bool off_skin(PointId id) {
  return id == PointId{3, 5} || id == PointId{3, 6} || id.first == 6 || id == PointId{7, 1} ||
         (id.first == 9 && id.second >= 8 && id.second <= 11) || id == PointId{11, 5};
}

void refuse_strangers(const Surface& surface, const PointList& points) {
  for (const GivenPoint& p : points.points)
    if (p.vertex && *p.vertex >= surface.position.size())
      points.fail(&p, "there is no vertex " + std::to_string(*p.vertex + 1) + " for point " +
                          name_of(p.id) + "; the mesh has " +
                          std::to_string(surface.position.size()));
}

void require_points(const PointList& points) {
  std::string missing;
  for (const PointId& id : kRequired)
    if (points.find(id) == nullptr) missing += (missing.empty() ? "" : " ") + name_of(id);
  if (!missing.empty())
    points.fail(nullptr, "points are missing without which no face moves: " + missing +
                             "; add a line for each");
}

// The file's points in its own frame, and the repaired surface they lie on.
class Source {
 public:
  Source(const Surface& surface, const PointList& points)
      : points_(points), repaired_(repair_surface(surface, &report_)) {
    if (repaired_.triangles.empty())
      points.fail(nullptr, "the mesh that the points belong to has no triangle");
    part_ = parts_of(repaired_.position.size(), repaired_.triangles);
    find_skin();
  }

  // Vertex of the repaired surface: the one that is named, or the nearest of the skin.
  std::uint32_t vertex(const GivenPoint& p) const {
    if (p.vertex) {
      const std::uint32_t v = report_.vertex_of_input[*p.vertex];
      if (v >= repaired_.position.size())
        points_.fail(&p, "vertex of point " + name_of(p.id) +
                             " is in no face; name one that is, or give x y z");
      if (part_[v] != skin_)
        points_.fail(&p, "point " + name_of(p.id) +
                             " lies on a part that is not the face's skin; name a vertex of it");
      return v;
    }
    return nearest(p.position, true);
  }
  Vec3d place(const GivenPoint& p) const {
    if (p.vertex && report_.vertex_of_input[*p.vertex] < repaired_.position.size())
      return repaired_.position[report_.vertex_of_input[*p.vertex]];
    if (p.vertex) points_.fail(&p, "vertex of point " + name_of(p.id) + " is in no face");
    return p.position;
  }
  const Surface& surface() const { return repaired_; }
  const RepairReport& report() const { return report_; }
  std::uint32_t part(std::uint32_t v) const { return part_[v]; }
  std::uint32_t skin() const { return skin_; }

 private:
  std::uint32_t nearest(Vec3d p, bool on_skin) const {
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::max();
    for (std::uint32_t v = 0; v < repaired_.position.size(); ++v) {
      if (on_skin && part_[v] != skin_) continue;
      const double d = length2(repaired_.position[v] - p);
      if (d < least) least = d, best = v;
    }
    return best;
  }

  void find_skin() {
    std::map<std::uint32_t, int> votes;
    for (const GivenPoint& p : points_.points) {
      if (off_skin(p.id)) continue;
      const std::uint32_t v =
          p.vertex ? report_.vertex_of_input[*p.vertex] : nearest(p.position, false);
      if (v < part_.size()) ++votes[part_[v]];
    }
    int most = 0;
    for (const auto& [part, count] : votes)
      if (count > most) most = count, skin_ = part;
  }

  const PointList& points_;
  RepairReport report_;
  Surface repaired_;
  std::vector<std::uint32_t> part_;
  std::uint32_t skin_ = 0;
};

// What a board can draw of one head. A scan has a hundred times that.
constexpr std::uint32_t kMostTriangles = 24000;

// A finer mesh is simplified first, its points staying where they are; they are named by place
// then.
Surface thinned(const Surface& surface, PointList& points) {
  if (surface.triangles.size() <= kMostTriangles) return surface;
  RepairReport report;
  const Surface whole = repair_surface(surface, &report);
  CollapseOptions options;
  options.target_triangles = kMostTriangles;
  for (GivenPoint& p : points.points) {
    if (!p.vertex) continue;
    const std::uint32_t v = report.vertex_of_input[*p.vertex];
    if (v < whole.position.size()) options.locked.push_back(v);
    p.position = surface.position[*p.vertex];
    p.vertex.reset();
  }
  return collapse_edges(whole, options);
}

// Turns and scale from the file's frame to ours; rows of `axes` are left, up, forward.
struct Frame {
  std::array<Vec3d, 3> axes;
  double scale = 1;

  Vec3d apply(Vec3d p) const {
    return scale * Vec3d{glm::dot(axes[0], p), glm::dot(axes[1], p), glm::dot(axes[2], p)};
  }
};

// Most files stand upright along some axis: if a turn by right angles brings the face nearly
// upright, its pitch is the modeller's will and stays.
std::array<Vec3d, 3> upright(const std::array<Vec3d, 3>& face) {
  double best = -1;
  std::array<Vec3d, 3> out = face;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      if (a % 3 == b % 3) continue;
      Vec3d left{0}, up{0};
      left[a % 3] = a < 3 ? 1 : -1;
      up[b % 3] = b < 3 ? 1 : -1;
      const std::array<Vec3d, 3> turned{left, up, glm::cross(left, up)};
      double least = 1;
      for (std::size_t k = 0; k < 3; ++k) least = std::min(least, glm::dot(turned[k], face[k]));
      if (least > best) best = least, out = turned;
    }
  constexpr double kNearly = 0.85;  // Cosine of 32 degrees.
  return best > kNearly ? out : face;
}

Frame frame_of(const PointList& points, const Source& source) {
  const auto at = [&](int group, int index) { return source.place(*points.find({group, index})); };
  const auto eye = [&](int side) {
    const GivenPoint* pupil = points.find({3, 5 + side});
    return pupil ? source.place(*pupil)
                 : 0.25 * (at(3, 1 + side) + at(3, 3 + side) + at(3, side == 0 ? 7 : 12) +
                           at(3, side == 0 ? 11 : 8));
  };
  const Vec3d across = eye(0) - eye(1);
  const Vec3d tall = 0.5 * (eye(0) + eye(1)) - 0.5 * (at(2, 4) + at(2, 5));
  const double apart = glm::length(across);
  const Vec3d left = across / std::max(apart, 1e-300);
  const Vec3d rise = tall - left * glm::dot(tall, left);
  if (!(apart > 0) || !(glm::length(rise) > 0.2 * apart) || !std::isfinite(apart))
    points.fail(points.find({3, 1}),
                "eyes and mouth lie in one place or on one line; the points of "
                "groups 2 and 3 can't be right");
  const Vec3d up = glm::normalize(rise);
  Frame frame{upright({left, up, glm::cross(left, up)}), double{kPupilDistance_m} / apart};
  const Vec3d nose = frame.apply(at(9, 3) - 0.5 * (eye(0) + eye(1)));
  if (nose.z < 0)
    points.fail(
        points.find({9, 3}),
        "the tip of the nose lies behind the eyes: left and right are exchanged (odd numbers "
        "are mostly the figure's left), or the mesh is mirrored");
  return frame;
}

// Turns triangles round when the skin around the nose faces backwards.
void face_outwards(PlacedHead& head) {
  const Vec3 nose = head.at(9, 3);
  float forward = 0;
  for (const auto& t : head.triangles) {
    const Vec3 a = head.position_m[t[0]], b = head.position_m[t[1]], c = head.position_m[t[2]];
    if (glm::length((a + b + c) / 3.0f - nose) < 0.04f) forward += glm::cross(b - a, c - a).z;
  }
  if (forward >= 0) return;
  for (auto& t : head.triangles) std::swap(t[1], t[2]);
  head.notes.emplace_back("faces were inside out");
}

void face_outwards(LoosePart& part) {
  float volume = 0;
  const Vec3 center = part.center_m();
  for (const auto& t : part.triangles)
    volume += glm::dot(part.position_m[t[0]] - center,
                       glm::cross(part.position_m[t[1]] - center, part.position_m[t[2]] - center));
  if (volume < 0)
    for (auto& t : part.triangles) std::swap(t[1], t[2]);
}

// Distributes the repaired surface over skin and loose parts. Returns the skin's vertex of each.
std::vector<std::uint32_t> take_parts(const Source& source, const Frame& frame, Vec3d origin,
                                      Vec3 shift_m, PlacedHead& head) {
  const Surface& s = source.surface();
  std::vector<std::uint32_t> local(s.position.size());
  std::map<std::uint32_t, LoosePart> parts;
  for (std::uint32_t v = 0; v < local.size(); ++v) {
    const Vec3 p = Vec3(frame.apply(s.position[v] - origin)) + shift_m;
    auto& to = source.part(v) == source.skin() ? head.position_m : parts[source.part(v)].position_m;
    local[v] = static_cast<std::uint32_t>(to.size());
    to.push_back(p);
  }
  for (const auto& t : s.triangles) {
    const std::uint32_t part = source.part(t[0]);
    auto& to = part == source.skin() ? head.triangles : parts[part].triangles;
    to.push_back({local[t[0]], local[t[1]], local[t[2]]});
  }
  for (auto& [label, part] : parts) {
    part.low_m = part.high_m = part.position_m.front();
    for (const Vec3& p : part.position_m) {
      part.low_m = glm::min(part.low_m, p);
      part.high_m = glm::max(part.high_m, p);
    }
    face_outwards(part);
    if (!part.triangles.empty()) head.parts.push_back(std::move(part));
  }
  return local;
}

// A head as wide as its eyes are apart is one; what reaches far beyond is not.
void refuse_giants(const PointList& points, const PlacedHead& head, Vec3 lids_m) {
  constexpr float kFarthest_m = 0.5f, kLargest_m = 3.0f;
  for (const GivenPoint& p : points.points)
    if (!(glm::length(head.place_m.at(p.id) - lids_m) < kFarthest_m))
      points.fail(&p, "point " + name_of(p.id) +
                          " lies far from the eyes, measured by the distance of the eyes (points "
                          "3.1-3.12); one of them is wrong");
  const auto check = [&](const std::vector<Vec3>& position_m) {
    for (const Vec3& p : position_m)
      if (!(glm::length(p - lids_m) < kLargest_m))
        points.fail(nullptr,
                    "with pupils 63 mm apart the mesh would be meters wide; check the "
                    "points of the eyes (3.1-3.12)");
  };
  check(head.position_m);
  for (const LoosePart& part : head.parts) check(part.position_m);
}

// Lips that are modelled shut have one vertex for both middles, or both quarter points.
bool may_share(PointId a, PointId b) {
  constexpr PointId kPairs[][2] = {{{2, 2}, {2, 3}}, {{2, 6}, {2, 8}}, {{2, 7}, {2, 9}}};
  for (const auto& pair : kPairs)
    if (a == pair[0] && b == pair[1]) return true;
  return false;
}

void refuse_shared(const PointList& points, const PlacedHead& head) {
  const auto matters = [](PointId id) {
    return (id.first == 2 && id.second < 10) || (id.first == 8 && id.second < 9) ||
           std::find(std::begin(kRequired), std::end(kRequired), id) != std::end(kRequired);
  };
  std::map<std::uint32_t, PointId> taken;
  for (const auto& [id, v] : head.vertex) {
    if (!matters(id)) continue;
    const auto [other, fresh] = taken.emplace(v, id);
    if (!fresh && !may_share(other->second, id))
      points.fail(points.find(id),
                  "points " + name_of(other->second) + " and " + name_of(id) +
                      " lie on one vertex; the mesh is too coarse there, or one is wrong");
  }
}

}  // namespace

std::span<const PointId> required_points() { return kRequired; }

PlacedHead place_head(const Surface& given, const PointList& given_points) {
  require_points(given_points);
  PointList points = given_points;
  refuse_strangers(given, points);
  const Surface surface = thinned(given, points);
  const Source source(surface, points);
  const Frame frame = frame_of(points, source);
  const auto raw = [&](int group, int index) { return source.place(*points.find({group, index})); };
  const Vec3d lids = 0.25 * (raw(3, 1) + raw(3, 2) + raw(3, 3) + raw(3, 4));
  // Where the seventh neck vertebra of the generic skeleton lies, seen from between the lids: so a
  // head without a body stands as high as a person's. Ratios to ES0 of our own two characters.
  constexpr float kDown = 2.35f, kBack = 2.22f;
  const Vec3 neck = body::upright_skeleton().center(body::HanimJoint::vc7);
  const Vec3 shift{0, neck.y + kDown * kPupilDistance_m, neck.z + kBack * kPupilDistance_m};
  PlacedHead head;
  head.eye_separation_m = kPupilDistance_m;
  const std::string repairs = source.report().text();
  if (!repairs.empty()) head.notes.push_back("mesh: " + repairs);
  if (surface.triangles.size() < given.triangles.size())
    head.notes.push_back("mesh: " + std::to_string(given.triangles.size()) +
                         " triangles simplified to " + std::to_string(surface.triangles.size()));
  const auto local = take_parts(source, frame, lids, shift, head);
  for (const GivenPoint& p : points.points) {
    head.place_m[p.id] = Vec3(frame.apply(source.place(p) - lids)) + shift;
    if (!off_skin(p.id)) head.vertex[p.id] = local[source.vertex(p)];
  }
  refuse_giants(points, head, shift);
  refuse_shared(points, head);
  face_outwards(head);
  char text[96];
  std::snprintf(text, sizeof text, "scale: 1 unit of the file is %.4g m (pupils %.1f mm apart)",
                frame.scale, 1e3 * double{kPupilDistance_m});
  head.notes.emplace_back(text);
  return head;
}

}  // namespace caryatid::bake::foreign
