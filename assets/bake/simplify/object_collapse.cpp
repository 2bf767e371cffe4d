// Edge collapse of a mesh with attributes. The surface is simplified over welded positions; every
// corner of a triangle also has a *wedge*: the vertex of the object with its texture coordinate, of
// which a point on a texture seam has two.
//
// Which edges may collapse, and to where:
//   free - free            anywhere (Lindstrom-Turk position), attributes from the closest point of
//                          the old surface
//   along a seam           anywhere; both wedge pairs are blended along the edge
//   along a loop           onto the cheaper end, while the loop keeps its minimum
//   free - seam/loop/fixed onto the latter; its attributes stay bit for bit, but for baked shade
//   fixed - fixed and all else: never
//
// On a mesh that is symmetric about x = 0 the mirrored edge follows each collapse, to the mirrored
// place; edges on or across the plane stay on it.
// Fixed are locked vertices, and corners: where seams end, meet, or reach a border.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <stdexcept>

#include "assets/bake/simplify/cache_order.h"
#include "assets/bake/simplify/half_edges.h"
#include "assets/bake/simplify/neighbourhood.h"
#include "assets/bake/simplify/object_history.h"
#include "assets/bake/simplify/placement.h"
#include "assets/bake/simplify/symmetry.h"
#include "assets/bake/simplify/vertex_blend.h"

namespace caryatid::bake {
namespace {

// A triangle may not turn by more than 75 degrees in one step, nor shrink to nothing.
constexpr double kMinTurnCosine = 0.25;
constexpr double kMinShape = 0.02;  // 4 sqrt(3) area / sum of squared edges; 1 is equilateral.
constexpr float kSharedBoneWeight = 0.1f;
constexpr double kMirrorTolerance_m = 2e-5;
// Shade that is baked into vertices resists as if it were relief: so deep where none of the sky is
// seen. Without it the fold of the upper lid spreads over half the lid at 680 faces.
constexpr float kShadeDepth_m = 0.004f;
constexpr float kLeastShade = 1.0f / 255.0f;  // As fine as it is stored.
constexpr std::uint16_t kShadeChannel = 0xFFFF;

struct Loop {
  std::uint32_t count = 0, keep_at_least = 0;
};

struct Candidate {
  double cost, tie;
  std::uint32_t half_edge;
  std::uint32_t serial;
  bool operator<(const Candidate& o) const {  // std::priority_queue takes the largest.
    if (cost != o.cost) return cost > o.cost;
    if (tie != o.tie) return tie > o.tie;
    return half_edge > o.half_edge;
  }
};

enum class Kind : std::uint8_t { none, free, seam, onto };

// A collapse that the rules allow: onto `keep` = from[half_edge].
struct Plan {
  Kind kind = Kind::none;
  std::uint32_t half_edge = kNoHalfEdge;
  Vec3d x{0};
  double cost = 0;
};

class ObjectCollapse {
 public:
  ObjectCollapse(const Object& object, const ObjectOptions& options)
      : object_(object), options_(options) {
    check();
    weld();
    find_versions();
    find_locks();
  }
  ObjectHistory run();

 private:
  void check() const;
  void weld();
  void find_versions();
  void find_locks();
  std::uint32_t wedge_count(std::uint32_t v) const;
  bool seam_edge(std::uint32_t h) const;
  void classify(std::uint32_t v);
  bool fixed(std::uint32_t v) const { return locked_[v] || corner_[v]; }
  bool loop_edge(std::uint32_t h) const;
  EdgeSums sums_at_rest(std::uint32_t h, const Vec3d& origin) const;
  double pose_cost(std::uint32_t h, const Vec3d& x, double s) const;
  double edge_parameter(std::uint32_t h, const Vec3d& x) const;
  Plan plan(std::uint32_t h) const;
  Plan plan_onto(std::uint32_t h, const EdgeSums& sums) const;
  bool share_a_bone(std::uint32_t h) const;
  bool valid(const Plan& plan);
  void make_symmetric(Plan* plan) const;
  void collapse_pair(const Plan& plan);
  bool keeps_shape(const Plan& plan) const;
  bool keeps_wedges(const Plan& plan) const;
  void push(std::uint32_t h);
  void refresh_around(std::uint32_t v);
  void collapse(const Plan& plan);
  void update_loops(std::uint32_t keep, std::uint32_t gone);
  struct Shade {
    double area = 0, sum = 0, low = 1, high = 0;
    void add(const Shade& other);
  };
  Shade shade_of(std::uint32_t h, std::uint32_t without) const;
  void keep_shade(std::uint32_t keep, const Shade& before, SplitRecord* record);
  std::uint32_t add_version(std::uint32_t wedge, VertexVersion version, SplitRecord* record);
  ObjectHistory finish();

  const Object& object_;
  const ObjectOptions& options_;
  HalfEdges mesh_;
  std::vector<Vec3d> position_;         // By surface vertex.
  std::vector<std::uint32_t> wedge_;    // By half-edge: wedge of the corner at from[h].
  std::vector<std::uint32_t> version_;  // By wedge: version that it shows now.
  std::vector<VertexVersion> versions_;
  std::vector<bool> locked_, corner_, border_;
  std::vector<std::uint32_t> mirror_;  // By surface vertex; kNone: none, or no longer.
  std::vector<float> importance_;      // By surface vertex; may be empty.
  std::vector<std::uint8_t> seam_degree_;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> loop_edges_;  // (other, loop)
  std::vector<Loop> loops_;
  std::vector<std::uint32_t> serial_, scratch_;
  std::priority_queue<Candidate> queue_;
  std::vector<SplitRecord> records_;  // In order of collapse; slots are wedges, triangles original.
  std::vector<std::uint32_t> gone_wedges_;  // In order; as many a record as it adds back.
  std::uint32_t live_triangles_ = 0;
};

void ObjectCollapse::check() const {
  const Mesh& m = object_.mesh;
  const std::size_t n = m.position_m.size();
  const auto fail = [this](const char* what) {
    throw std::runtime_error("object " + object_.name + ": " + what);
  };
  if (m.normal.size() != n || m.uv.size() != n || m.influence.size() != n)
    fail("its vertex arrays differ in length");
  for (const Vec3& p : m.position_m)
    if (!std::isfinite(p.x + p.y + p.z)) fail("a position is not a finite number");
  for (const auto& t : m.triangles)
    for (const std::uint32_t v : t)
      if (v >= n) fail("a triangle names a vertex that is not there");
  for (const auto& moves : object_.moves)
    for (const Move& move : moves)
      if (move.vertex >= n) fail("a FAT move names a vertex that is not there");
  for (const std::uint32_t v : object_.locked)
    if (v >= n) fail("a lock names a vertex that is not there");
  if (!options_.importance.empty() && options_.importance.size() != n)
    fail("its importance is not as long as its vertices");
}

// Vertices at the same place are one surface vertex. Triangles that name a place twice carry no
// surface; they would pass through all levels unchanged, so the object must not have them.
void ObjectCollapse::weld() {
  const Mesh& m = object_.mesh;
  struct Less {
    bool operator()(const Vec3& a, const Vec3& b) const {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
  };
  std::map<Vec3, std::uint32_t, Less> places;
  std::vector<std::uint32_t> place(m.position_m.size());
  for (std::size_t v = 0; v < place.size(); ++v)
    place[v] = places.try_emplace(m.position_m[v], static_cast<std::uint32_t>(places.size()))
                   .first->second;
  std::vector<std::uint32_t> corners;
  for (const auto& t : m.triangles) {
    if (place[t[0]] == place[t[1]] || place[t[1]] == place[t[2]] || place[t[2]] == place[t[0]])
      throw std::runtime_error("object " + object_.name +
                               ": a triangle has two corners in one place");
    for (const std::uint32_t v : t) {
      corners.push_back(place[v]);
      wedge_.push_back(v);
    }
  }
  TopologyRepairs repairs;
  std::vector<std::uint32_t> origin;
  mesh_ = build_half_edges(std::move(corners), static_cast<std::uint32_t>(places.size()), &origin,
                           &repairs);
  position_.resize(mesh_.first.size());
  for (std::size_t h = 0; h < wedge_.size(); ++h)
    position_[mesh_.from[h]] = Vec3d(m.position_m[wedge_[h]]);
  live_triangles_ = static_cast<std::uint32_t>(m.triangles.size());
  serial_.assign(mesh_.from.size(), 0);
  mirror_.assign(position_.size(), kNone);
  if (options_.symmetric_pairs) mirror_ = mirror_points(position_, kMirrorTolerance_m);
  if (options_.importance.empty()) return;
  importance_.assign(position_.size(), 0.0f);
  for (std::size_t h = 0; h < wedge_.size(); ++h)
    importance_[mesh_.from[h]] =
        std::max(importance_[mesh_.from[h]], options_.importance[wedge_[h]]);
}

void ObjectCollapse::find_versions() {
  const Mesh& m = object_.mesh;
  for (std::size_t v = 0; v < m.position_m.size(); ++v) {
    const float occlusion = m.occlusion.empty() ? 0.0f : m.occlusion[v];
    versions_.push_back({m.position_m[v], m.normal[v], m.uv[v], occlusion, m.influence[v], {}});
    version_.push_back(static_cast<std::uint32_t>(v));
  }
  for (std::size_t channel = 0; channel < object_.moves.size(); ++channel)
    for (const Move& move : object_.moves[channel])
      versions_[move.vertex].moves.push_back(
          {static_cast<std::uint16_t>(channel), move.displacement_m, move.normal_change});
}

void ObjectCollapse::find_locks() {
  const std::size_t count = mesh_.first.size();
  locked_.assign(count, false);
  corner_.assign(count, false);
  border_.assign(count, false);
  seam_degree_.assign(count, 0);
  loop_edges_.resize(count);
  // An object vertex may have become several surface vertices.
  std::multimap<std::uint32_t, std::uint32_t> surface;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t h = 0; h < wedge_.size(); ++h) pairs.insert({wedge_[h], mesh_.from[h]});
  surface.insert(pairs.begin(), pairs.end());
  for (const std::uint32_t v : object_.locked)
    for (auto [i, end] = surface.equal_range(v); i != end; ++i) locked_[i->second] = true;
  // A wedge that serves two fans would have to split in two: it stays.
  for (auto i = surface.begin(); i != surface.end(); ++i)
    if (surface.count(i->first) > 1) locked_[i->second] = true;
  for (const Object::Loop& loop : object_.loops) {
    const auto id = static_cast<std::uint32_t>(loops_.size());
    const auto n = static_cast<std::uint32_t>(loop.vertices.size());
    loops_.push_back({n, loop.keep_at_least});
    std::vector<std::uint32_t> chain;
    for (const std::uint32_t v : loop.vertices) {
      const auto i = surface.find(v);
      if (i == surface.end())
        throw std::runtime_error("object " + object_.name + ": loop " + loop.name +
                                 " names a vertex without triangles");
      chain.push_back(i->second);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = chain[i], b = chain[(i + 1) % n];
      if (mesh_.find(a, b) == kNoHalfEdge && mesh_.find(b, a) == kNoHalfEdge) continue;
      loop_edges_[a].push_back({b, id});
      loop_edges_[b].push_back({a, id});
    }
    // Chain ends, and vertices of two loops, keep their place.
    for (const std::uint32_t v : chain)
      if (loop_edges_[v].size() != 2) locked_[v] = true;
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    if (mesh_.first[v] == kNoHalfEdge) continue;
    border_[v] = mesh_.on_border(v);
    classify(v);
  }
}

std::uint32_t ObjectCollapse::wedge_count(std::uint32_t v) const {
  std::set<std::uint32_t> wedges;
  mesh_.for_fan(v, [&](std::uint32_t h) { wedges.insert(wedge_[h]); });
  return static_cast<std::uint32_t>(wedges.size());
}

bool ObjectCollapse::seam_edge(std::uint32_t h) const {
  const std::uint32_t t = mesh_.twin[h];
  if (t == kNoHalfEdge) return false;
  return wedge_[h] != wedge_[next_in_triangle(t)] || wedge_[next_in_triangle(h)] != wedge_[t];
}

void ObjectCollapse::classify(std::uint32_t v) {
  std::uint32_t degree = 0;
  mesh_.for_fan(v, [&](std::uint32_t h) { degree += seam_edge(h); });
  const std::uint32_t wedges = wedge_count(v);
  const bool plain = degree == 0 && wedges == 1;
  const bool seam = degree == 2 && wedges == 2 && !border_[v];
  seam_degree_[v] = static_cast<std::uint8_t>(degree);
  corner_[v] = !plain && !seam;
}

bool ObjectCollapse::loop_edge(std::uint32_t h) const {
  const std::uint32_t b = mesh_.to(h);
  for (const auto& [other, id] : loop_edges_[mesh_.from[h]])
    if (other == b) return true;
  return false;
}

EdgeSums ObjectCollapse::sums_at_rest(std::uint32_t h, const Vec3d& origin) const {
  return sums_of(mesh_, h, [&](std::uint32_t v) { return position_[v] - origin; });
}

double ObjectCollapse::edge_parameter(std::uint32_t h, const Vec3d& x) const {
  const Vec3d a = position_[mesh_.from[h]], d = position_[mesh_.to(h)] - a;
  const double l2 = length2(d);
  return l2 > 0 ? std::clamp(dot(x - a, d) / l2, 0.0, 1.0) : 0.5;
}

// Sum over the channels that move this neighbourhood of f_V with the channel at full ramp; baked
// shade counts as one more.
double ObjectCollapse::pose_cost(std::uint32_t h, const Vec3d& x, double s) const {
  std::map<std::uint16_t, std::map<std::uint32_t, Vec3d>> moved;
  for_edge_triangles(mesh_, h, [&](std::uint32_t g) {
    for (const std::uint32_t e : {g, next_in_triangle(g), prev_in_triangle(g)}) {
      const VertexVersion& version = versions_[version_[wedge_[e]]];
      for (const VertexVersion::ChannelMove& m : version.moves)
        moved[m.channel][mesh_.from[e]] = Vec3d(m.displacement_m);
      if (version.occlusion > 0.0f)
        moved[kShadeChannel][mesh_.from[e]] =
            Vec3d(kShadeDepth_m * version.occlusion * version.normal);
    }
  });
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  const Vec3d middle = 0.5 * (position_[a] + position_[b]);
  double cost = 0;
  for (const auto& [channel, moves] : moved) {
    const auto shift = [&moves = moves](std::uint32_t v) {
      const auto i = moves.find(v);
      return i == moves.end() ? Vec3d{0} : i->second;
    };
    const EdgeSums sums =
        sums_of(mesh_, h, [&](std::uint32_t v) { return position_[v] + shift(v) - middle; });
    cost += collapse_cost(sums, x - middle + (1 - s) * shift(a) + s * shift(b));
  }
  return cost;
}

Plan ObjectCollapse::plan_onto(std::uint32_t h, const EdgeSums& sums) const {
  const Vec3d middle = 0.5 * (position_[mesh_.from[h]] + position_[mesh_.to(h)]);
  Plan p{Kind::onto, h, position_[mesh_.from[h]], 0};
  p.cost = collapse_cost(sums, p.x - middle);
  p.cost += options_.pose_weight * pose_cost(h, p.x, 0.0);
  return p;
}

Plan ObjectCollapse::plan(std::uint32_t h) const {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  const std::uint32_t back = mesh_.twin[h];
  const bool seam = seam_edge(h), loop = loop_edge(h);
  // Ends that must not leave their place; a loop vertex may, along its loop.
  const auto pinned = [&](std::uint32_t v) {
    return fixed(v) || (seam_degree_[v] != 0 && !seam) || (!loop_edges_[v].empty() && !loop);
  };
  const bool pin_a = pinned(a), pin_b = pinned(b);
  if ((pin_a && pin_b) || (seam && (seam_degree_[a] == 0 || seam_degree_[b] == 0))) return {};
  if (seam &&
      (wedge_[h] == wedge_[next_in_triangle(back)] || wedge_[next_in_triangle(h)] == wedge_[back]))
    return {};  // The seam ends here.
  if (border_[a] != border_[b] && ((border_[b] && pin_a) || (border_[a] && pin_b))) return {};
  if (!share_a_bone(h)) return {};
  const Vec3d middle = 0.5 * (position_[a] + position_[b]);
  const EdgeSums sums = sums_at_rest(h, middle);
  if (loop) {
    for (const auto& [other, id] : loop_edges_[a])
      if (other == b && loops_[id].count <= loops_[id].keep_at_least) return {};
  }
  if (pin_a || pin_b || loop) {
    // Collapse onto from[]: without a twin the border edge can only go one way.
    Plan best;
    if (!pin_b) best = plan_onto(h, sums);
    if (!pin_a && back != kNoHalfEdge) {
      const Plan other = plan_onto(back, sums);
      if (best.kind == Kind::none || other.cost < best.cost) best = other;
    }
    return best;
  }
  const std::optional<Vec3d> x = best_position(sums);
  Plan p{seam ? Kind::seam : Kind::free, h, middle + x.value_or(Vec3d{0}), 0};
  p.cost = collapse_cost(sums, p.x - middle) +
           options_.pose_weight * pose_cost(h, p.x, edge_parameter(h, p.x));
  return p;
}

bool ObjectCollapse::share_a_bone(std::uint32_t h) const {
  const Influence& a = versions_[version_[wedge_[h]]].influence;
  const Influence& b = versions_[version_[wedge_[next_in_triangle(h)]]].influence;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (a.joint[i] == b.joint[j] && a.weight[i] >= kSharedBoneWeight &&
          b.weight[j] >= kSharedBoneWeight)
        return true;
  return false;
}

bool ObjectCollapse::keeps_shape(const Plan& plan) const {
  const std::uint32_t a = mesh_.from[plan.half_edge], b = mesh_.to(plan.half_edge);
  bool good = true;
  for_edge_triangles(mesh_, plan.half_edge, [&](std::uint32_t g) {
    std::uint32_t v[3] = {mesh_.from[g], mesh_.to(g), mesh_.opposite(g)};
    Vec3d p[3], q[3];
    int ends = 0;
    for (int i = 0; i < 3; ++i) {
      const bool end = v[i] == a || v[i] == b;
      ends += end;
      p[i] = position_[v[i]];
      q[i] = end ? plan.x : p[i];
    }
    if (ends == 2) return;  // Disappears.
    // A triangle within the plane of symmetry would be a crease down the middle of a face.
    const auto on_plane = [](const Vec3d* c) {
      return std::max({std::abs(c[0].x), std::abs(c[1].x), std::abs(c[2].x)}) < kMirrorTolerance_m;
    };
    if (on_plane(q) && !on_plane(p)) good = false;
    const Vec3d before = cross(p[1] - p[0], p[2] - p[0]), after = cross(q[1] - q[0], q[2] - q[0]);
    const double edges = length2(q[1] - q[0]) + length2(q[2] - q[1]) + length2(q[0] - q[2]);
    const double old_edges = length2(p[1] - p[0]) + length2(p[2] - p[1]) + length2(p[0] - p[2]);
    const double l0 = std::sqrt(length2(before)), l1 = std::sqrt(length2(after));
    if (dot(before, after) <= kMinTurnCosine * l0 * l1) good = false;
    const double shape = 2 * std::sqrt(3.0) * l1 / edges;
    if (shape < kMinShape && shape < 2 * std::sqrt(3.0) * l0 / old_edges) good = false;
  });
  return good;
}

// Whether every wedge of the triangles that disappear still has a triangle afterwards, apart from
// those that go with the vertex: a record has no place for others, their slots would be lost.
bool ObjectCollapse::keeps_wedges(const Plan& plan) const {
  const std::uint32_t h = plan.half_edge, back = mesh_.twin[h];
  const std::uint32_t keep = mesh_.from[h], gone = mesh_.to(h);
  const auto removed = [&](std::uint32_t e) {
    return e / 3 == h / 3 || (back != kNoHalfEdge && e / 3 == back / 3);
  };
  // The wedge that a corner at `gone` takes on.
  const auto renamed = [&](std::uint32_t wedge) {
    if (wedge == wedge_[next_in_triangle(h)]) return wedge_[h];
    if (back != kNoHalfEdge && wedge == wedge_[back]) return wedge_[next_in_triangle(back)];
    return wedge;
  };
  bool all = true;
  for (const std::uint32_t side : {h, back}) {
    if (side == kNoHalfEdge) continue;
    for (const std::uint32_t corner : {side, next_in_triangle(side), prev_in_triangle(side)}) {
      if (mesh_.from[corner] == gone) continue;
      bool kept = false;
      mesh_.for_fan(mesh_.from[corner],
                    [&](std::uint32_t e) { kept |= !removed(e) && wedge_[e] == wedge_[corner]; });
      if (mesh_.from[corner] == keep)
        mesh_.for_fan(gone, [&](std::uint32_t e) {
          kept |= !removed(e) && renamed(wedge_[e]) == wedge_[corner];
        });
      all &= kept;
    }
  }
  // A wedge of `gone` without a pair would stay behind on no vertex.
  mesh_.for_fan(gone, [&](std::uint32_t e) { all &= renamed(wedge_[e]) != wedge_[e]; });
  return all;
}

void ObjectCollapse::push(std::uint32_t h) {
  const std::uint32_t t = mesh_.twin[h];
  if (t != kNoHalfEdge && t < h) h = t;
  const Plan p = plan(h);
  ++serial_[h];
  if (p.kind == Kind::none) return;
  const double l2 = length2(position_[mesh_.to(h)] - position_[mesh_.from[h]]);
  const double counts = importance_.empty()
                            ? 1.0
                            : std::sqrt(static_cast<double>(importance_[mesh_.from[h]]) *
                                        static_cast<double>(importance_[mesh_.to(h)]));
  // Costs below rounding are all alike: flat ground goes by edge length.
  const double flat = 1e-18 * l2 * l2 * l2;
  queue_.push({p.cost > flat ? counts * p.cost : 0.0, l2, h, serial_[h]});
}

void ObjectCollapse::refresh_around(std::uint32_t v) {
  std::set<std::uint32_t> edges;
  const auto add = [&](std::uint32_t h) {
    const std::uint32_t t = mesh_.twin[h];
    edges.insert(t != kNoHalfEdge ? std::min(h, t) : h);
  };
  const auto add_fan = [&](std::uint32_t w) {
    mesh_.for_fan(w, [&](std::uint32_t h) {
      add(h);
      add(prev_in_triangle(h));
    });
  };
  add_fan(v);
  mesh_.for_ring(v, add_fan);
  for (const std::uint32_t h : edges) push(h);
}

std::uint32_t ObjectCollapse::add_version(std::uint32_t wedge, VertexVersion version,
                                          SplitRecord* record) {
  const auto id = static_cast<std::uint32_t>(versions_.size());
  versions_.push_back(std::move(version));
  record->changed.push_back({wedge, id, version_[wedge]});  // Coarse to fine: before is coarse.
  version_[wedge] = id;
  return id;
}

void ObjectCollapse::update_loops(std::uint32_t keep, std::uint32_t gone) {
  for (const auto& [other, id] : loop_edges_[gone]) {
    std::erase_if(loop_edges_[other], [gone = gone](const auto& e) { return e.first == gone; });
    if (other == keep) {
      --loops_[id].count;
      continue;
    }
    loop_edges_[keep].push_back({other, id});
    loop_edges_[other].push_back({keep, id});
  }
  loop_edges_[gone].clear();
}

// Area and baked shade (occlusion by area) of a triangle, that of `without` left out.
ObjectCollapse::Shade ObjectCollapse::shade_of(std::uint32_t h, std::uint32_t without) const {
  const std::uint32_t e[3] = {h, next_in_triangle(h), prev_in_triangle(h)};
  const Vec3d& a = position_[mesh_.from[e[0]]];
  Shade out;
  out.area =
      0.5 * glm::length(cross(position_[mesh_.from[e[1]]] - a, position_[mesh_.from[e[2]]] - a));
  for (const std::uint32_t corner : e) {
    const auto occlusion = static_cast<double>(versions_[version_[wedge_[corner]]].occlusion);
    if (mesh_.from[corner] != without) out.sum += out.area / 3 * occlusion;
    out.low = std::min(out.low, occlusion);
    out.high = std::max(out.high, occlusion);
  }
  return out;
}

void ObjectCollapse::Shade::add(const Shade& other) {
  area += other.area;
  sum += other.sum;
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

// Gives what now stands at `keep` the shade with which the surroundings are as dark as `before`: a
// dark fold that triangles around it outgrow would darken all of them. Position and all else stay.
void ObjectCollapse::keep_shade(std::uint32_t keep, const Shade& before, SplitRecord* record) {
  if (!(before.high > before.low)) return;
  Shade after;
  mesh_.for_fan(keep, [&](std::uint32_t g) { after.add(shade_of(g, keep)); });
  if (!(after.area > 0.0) || !(before.area > 0.0)) return;
  const double wanted = before.sum / before.area * after.area;
  const auto shade = static_cast<float>(
      std::clamp(3 * (wanted - after.sum) / after.area, before.low, before.high));
  std::set<std::uint32_t> wedges;
  mesh_.for_fan(keep, [&](std::uint32_t g) { wedges.insert(wedge_[g]); });
  for (const SplitRecord::Change& c : record->changed) wedges.insert(c.slot);
  if (wedges.size() > 2) return;  // More than a record holds: where seams meet.
  for (const std::uint32_t wedge : wedges) {
    VertexVersion version = versions_[version_[wedge]];
    if (std::abs(version.occlusion - shade) < kLeastShade) continue;
    const bool made = std::any_of(record->changed.begin(), record->changed.end(),
                                  [wedge](const auto& c) { return c.slot == wedge; });
    if (made) {
      versions_[version_[wedge]].occlusion = shade;
      continue;
    }
    version.occlusion = shade;
    add_version(wedge, std::move(version), record);
  }
}

void ObjectCollapse::collapse(const Plan& plan) {
  const std::uint32_t h = plan.half_edge, back = mesh_.twin[h];
  const std::uint32_t keep = mesh_.from[h], gone = mesh_.to(h);
  SplitRecord record;
  record.cost = plan.cost;
  // Wedge pairs (keep, gone): left of the edge, and right of it where that is another chart.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs = {
      {wedge_[h], wedge_[next_in_triangle(h)]}};
  if (seam_edge(h)) pairs.push_back({wedge_[next_in_triangle(back)], wedge_[back]});
  Shade shade;
  for_edge_triangles(mesh_, h, [&](std::uint32_t g) { shade.add(shade_of(g, kNone)); });
  const double s = edge_parameter(h, plan.x);
  std::vector<VertexVersion> made;
  if (plan.kind == Kind::seam)
    for (const auto& [k, g] : pairs)
      made.push_back(blend_edge(versions_[version_[k]], versions_[version_[g]], s));
  if (plan.kind == Kind::free) {
    SurfacePoint best;
    for_edge_triangles(mesh_, h, [&](std::uint32_t g) {
      const std::uint32_t e[3] = {g, next_in_triangle(g), prev_in_triangle(g)};
      best.consider(
          plan.x,
          {position_[mesh_.from[e[0]]], position_[mesh_.from[e[1]]], position_[mesh_.from[e[2]]]},
          {version_[wedge_[e[0]]], version_[wedge_[e[1]]], version_[wedge_[e[2]]]});
    });
    made.push_back(blend_triangle(versions_, best));
  }
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i].position_m = Vec3(plan.x);
    add_version(pairs[i].first, std::move(made[i]), &record);
  }
  for (const auto& [k, g] : pairs) {
    record.added.push_back({k, version_[g]});
    gone_wedges_.push_back(g);
  }
  for (const std::uint32_t side : {h, back}) {
    if (side == kNoHalfEdge) continue;
    const std::uint32_t f = side - side % 3;
    record.triangles.push_back({wedge_[f], wedge_[f + 1], wedge_[f + 2]});
    record.moved.push_back(side / 3);  // For now: the triangle that disappears, see finish().
  }
  std::vector<std::uint32_t> moved;
  mesh_.collapse(h, &moved);
  for (const std::uint32_t g : moved) {
    for (const auto& [k, old] : pairs)
      if (wedge_[g] == old) {
        wedge_[g] = k;
        record.moved.push_back(g / 3);
        break;
      }
  }
  position_[keep] = Vec3d(Vec3(plan.x));  // What is stored is what later steps see.
  live_triangles_ -= static_cast<std::uint32_t>(record.triangles.size());
  update_loops(keep, gone);
  keep_shade(keep, shade, &record);
  records_.push_back(std::move(record));
  border_[keep] = mesh_.on_border(keep);
  classify(keep);
  mesh_.for_ring(keep, [&](std::uint32_t r) { classify(r); });
}

bool ObjectCollapse::valid(const Plan& plan) {
  return plan.kind != Kind::none && mesh_.link_condition(plan.half_edge, scratch_) &&
         keeps_shape(plan) && keeps_wedges(plan);
}

// Keeps on the plane what is on it: an edge along or across it ends on it, one that leaves it ends
// at its point there.
void ObjectCollapse::make_symmetric(Plan* plan) const {
  if (plan->kind == Kind::none || plan->kind == Kind::onto) return;
  const std::uint32_t a = mesh_.from[plan->half_edge], b = mesh_.to(plan->half_edge);
  const bool on_a = mirror_[a] == a, on_b = mirror_[b] == b;
  if ((on_a && on_b) || mirror_[a] == b) {
    plan->x.x = 0;
  } else if (on_a || on_b) {
    const std::uint32_t back = mesh_.twin[plan->half_edge];
    if (on_b && back == kNoHalfEdge) return;
    plan->half_edge = on_b ? back : plan->half_edge;
    plan->kind = seam_edge(plan->half_edge) ? Kind::seam : Kind::onto;
    plan->x = position_[on_a ? a : b];
  } else if (mirror_[a] != kNone && mirror_[b] != kNone) {
    // Close to the plane the new vertex and its mirror image would all but coincide.
    const double l2 = length2(position_[a] - position_[b]);
    if (plan->x.x * plan->x.x < 0.04 * l2) plan->kind = Kind::none;
  }
}

// The collapse, and that of the mirrored edge to the mirrored place. Where that may not be, both
// ends count as without a mirror from now on.
void ObjectCollapse::collapse_pair(const Plan& plan) {
  const std::uint32_t keep = mesh_.from[plan.half_edge], gone = mesh_.to(plan.half_edge);
  const std::uint32_t other = mirror_[keep], other_gone = mirror_[gone];
  collapse(plan);
  refresh_around(keep);
  if (other == keep && other_gone == gone) return;
  if (other == gone && other_gone == keep) {
    mirror_[keep] = std::abs(plan.x.x) <= kMirrorTolerance_m ? keep : kNone;
    return;
  }
  Plan second;
  if (other != kNone && other_gone != kNone && live_triangles_ > options_.base_triangles) {
    const std::uint32_t h = mesh_.find(other, other_gone);
    if (h != kNoHalfEdge) second = this->plan(h);
    // The mirrored edge may have locks of its own.
    const bool same =
        second.kind == plan.kind && (plan.kind != Kind::onto || second.half_edge == h);
    if (!same && (plan.kind != Kind::onto || second.kind != Kind::free)) second = {};
    if (second.kind != Kind::none) {
      second.half_edge = h;
      second.kind = plan.kind;
      second.x = plan.kind == Kind::onto ? position_[other] : mirrored(plan.x);
    }
  }
  if (valid(second)) {
    collapse(second);
    refresh_around(other);
    return;
  }
  mirror_[keep] = kNone;
  if (other != kNone) mirror_[other] = kNone;
  if (other_gone != kNone) mirror_[other_gone] = kNone;
}

ObjectHistory ObjectCollapse::run() {
  for (std::uint32_t h = 0; h < mesh_.from.size(); ++h)
    if (mesh_.twin[h] == kNoHalfEdge || h < mesh_.twin[h]) push(h);
  while (!queue_.empty() && live_triangles_ > options_.base_triangles) {
    const Candidate top = queue_.top();
    queue_.pop();
    const std::uint32_t twin = mesh_.twin[top.half_edge];
    if (!mesh_.alive(top.half_edge / 3) || serial_[top.half_edge] != top.serial ||
        (twin != kNoHalfEdge && twin < top.half_edge))
      continue;
    Plan p = plan(top.half_edge);
    make_symmetric(&p);
    if (valid(p)) collapse_pair(p);
  }
  return finish();
}

// Turns the records round and renumbers: slots, versions and triangles count from the coarse end.
ObjectHistory ObjectCollapse::finish() {
  ObjectHistory out;
  std::vector<std::uint32_t> slot(version_.size(), kNone), version(versions_.size(), kNone);
  std::vector<std::uint32_t> triangle(mesh_.from.size() / 3, kNone);
  std::uint32_t triangles = 0;
  const auto number_version = [&](std::uint32_t v) {
    version[v] = static_cast<std::uint32_t>(out.versions.size());
    out.versions.push_back(std::move(versions_[v]));
  };
  const auto number_slot = [&](std::uint32_t wedge) { slot[wedge] = out.max_vertex_count++; };
  TriangleList base;
  std::vector<std::uint32_t> base_ids;
  for (std::uint32_t t = 0; t < triangle.size(); ++t) {
    if (!mesh_.alive(t)) continue;
    base.push_back({wedge_[3 * t], wedge_[3 * t + 1], wedge_[3 * t + 2]});
    base_ids.push_back(t);
  }
  for (const std::uint32_t i : cache_order(base, static_cast<std::uint32_t>(version_.size()))) {
    triangle[base_ids[i]] = triangles++;
    for (std::uint32_t& wedge : base[i]) {
      if (slot[wedge] == kNone) {
        number_slot(wedge);
        number_version(version_[wedge]);
      }
      wedge = slot[wedge];
    }
    out.base_triangles.push_back(base[i]);
  }
  out.base_vertex_count = out.max_vertex_count;
  std::size_t gone = gone_wedges_.size();
  for (auto record = records_.rbegin(); record != records_.rend(); ++record) {
    SplitRecord& r = *record;
    gone -= r.added.size();
    for (std::size_t i = 0; i < r.added.size(); ++i) number_slot(gone_wedges_[gone + i]);
    for (SplitRecord::Change& c : r.changed) {
      number_version(c.version_after);
      c = {slot[c.slot], version[c.version_before], version[c.version_after]};
    }
    for (SplitRecord::Addition& a : r.added) {
      number_version(a.version);
      a = {slot[a.parent], version[a.version]};
    }
    for (std::size_t i = 0; i < r.triangles.size(); ++i) {
      triangle[r.moved[i]] = triangles++;
      for (std::uint32_t& wedge : r.triangles[i]) wedge = slot[wedge];
    }
    r.moved.erase(r.moved.begin(),
                  r.moved.begin() + static_cast<std::ptrdiff_t>(r.triangles.size()));
    for (std::uint32_t& t : r.moved) t = triangle[t];
    out.splits.push_back(std::move(r));
  }
  out.max_triangle_count = triangles;
  out.slot_of_vertex = std::move(slot);
  if (options_.vertex_cache_order) add_reorders(&out);
  return out;
}

}  // namespace

ObjectHistory simplify_object(const Object& object, const ObjectOptions& options) {
  return ObjectCollapse(object, options).run();
}

}  // namespace caryatid::bake
