#include "assets/bake/simplify/edge_collapse.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>

#include "assets/bake/simplify/curve_order.h"
#include "assets/bake/simplify/fast_cost.h"
#include "assets/bake/simplify/neighbourhood.h"
#include "assets/bake/simplify/placement.h"
#include "assets/bake/simplify/vertex_queue.h"

namespace caryatid::bake {
namespace {

// A position further from the middle of the edge than this part of the mean distance of the ring
// (both squared) comes of planes that hardly meet: it would stand out as a spike.
constexpr double kFar = 0.3;
bool too_far(const Vec3d& x, const EdgeSums& sums) {
  return length2(x) * sums.ring_count > kFar * sums.ring_square;
}

// One cache line: all that the evaluation of an edge reads of its ends.
struct alignas(64) Node {
  Vec3d x{0};  // In working units, see EdgeCollapse::unit_.
  VertexQuadric quadric;
  // When its quadric changed; at a border or a lock; when its edges were evaluated; one was
  // refused.
  std::uint32_t changed : 15 = 0, slow : 1 = 0, seen : 15 = 0, has_blocked : 1 = 0;
};
static_assert(sizeof(Node) == 64);

// The surroundings of an edge between two inner vertices: a ring of vertices, of which the first
// `split` + 1 make triangles with the end a (ring[i], ring[i + 1], a), the others with b.
struct Surroundings {
  std::vector<std::uint32_t> ring;
  std::size_t split = 0;  // Triangles at a; ring[0] is left of the edge a -> b, ring[split] right.
  std::vector<Vec3d> at;  // Of the ring, relative to the middle of the edge.
  std::vector<Vec3d> n;   // Of the triangle from ring[i] to ring[i + 1].
  Vec3d a{0}, left{0}, right{0};  // a itself (b = -a); n of the triangles on the edge.
};

// The queue holds vertices; each stands for the cheapest of the edges that it owns, those to
// vertices of higher number. A collapse to v with ring R changes the cost of every edge at v or R.
// Those at v are evaluated at once; the others keep their place in the queue until they come up:
// costs rise nearly always as a surface gets coarser, and then the new cost decides.
class EdgeCollapse {
 public:
  EdgeCollapse(Surface surface, const CollapseOptions& options, CollapseReport* report);
  Surface run();

 private:
  // The cheapest edge found for one vertex.
  struct Offer {
    float cost = VertexQueue::kNever;
    std::uint32_t edge = kNoHalfEdge;
    void take(float c, std::uint32_t e) {
      if (c < cost || (c == cost && e < edge)) {
        cost = c;
        edge = e;
      }
    }
  };

  static constexpr std::size_t kNoSlot = ~std::size_t{0};

  void build(Surface surface);
  void choose_unit(const Surface& surface);
  bool is_locked(std::uint32_t v) const { return !locked_.empty() && locked_[v]; }
  std::uint32_t now() const { return collapses_ >> time_shift_; }
  Vec3d normal(std::uint32_t h) const {
    const Vec3d& a = node_[mesh_.from[h]].x;
    return cross(node_[mesh_.to(h)].x - a, node_[mesh_.opposite(h)].x - a);
  }
  std::optional<Vec3d> slow_position(std::uint32_t h, double* cost) const;
  void evaluate_slow(std::uint32_t h, std::size_t slot);
  template <class Slot>
  void evaluate_fan(std::uint32_t vertex, Slot&& slot_of);
  void flush();
  void evaluate_owned(std::uint32_t vertex);
  void look_again(std::uint32_t vertex);
  bool stale(std::uint32_t vertex) const;
  void block(std::uint32_t h);
  bool blocked(std::uint32_t h, std::uint32_t a, std::uint32_t b);
  bool look_around(std::uint32_t h);
  std::optional<Vec3d> best_inside();
  bool collapse_inside(std::uint32_t h);
  bool keeps_orientation(std::uint32_t h, const Vec3d& x) const;
  bool collapse_slow(std::uint32_t h);
  void merge(std::uint32_t h, const Vec3d& x);
  void refresh(std::uint32_t v, std::span<const std::uint32_t> ring);
  void wake(std::uint32_t vertex);
  Surface take_surface();

  const CollapseOptions& options_;
  CollapseReport* report_;
  double unit_ = 1;  // A power of two that makes the mean edge about 1: no bit is lost.
  HalfEdges mesh_;
  std::vector<Node> node_;
  std::vector<std::uint32_t> cheapest_;  // By vertex: the edge that it stands for.
  std::vector<bool> locked_;
  std::vector<std::uint32_t> vertex_of_, triangle_of_;  // In the input; only for a log.
  std::uint32_t live_triangles_ = 0;
  // Time in collapses, in steps of 2^time_shift_ so that 16 bits hold it.
  std::uint32_t collapses_ = 0, time_shift_ = 0;
  // Edges refused, with the time; they wait for a change at an end.
  std::unordered_map<std::uint32_t, std::uint32_t> blocked_;
  std::optional<VertexQueue> queue_;
  EdgeBatch batch_;
  std::uint32_t batch_size_ = 0;
  std::array<std::uint32_t, EdgeBatch::kWidth> lane_edge_{};
  std::array<std::size_t, EdgeBatch::kWidth> lane_slot_{};
  std::vector<Offer> offers_;
  Surroundings around_;
  std::vector<std::uint32_t> fan_, waking_, scratch_, moved_;
  std::vector<Vec3> fan_edge_;
};

double weight_of(double n2) { return static_cast<double>(area_weight(static_cast<float>(n2))); }

TriangleTerm term_of(const Vec3d& n) {
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

EdgeCollapse::EdgeCollapse(Surface surface, const CollapseOptions& options, CollapseReport* report)
    : options_(options), report_(report) {
  live_triangles_ = static_cast<std::uint32_t>(surface.triangles.size());
  build(std::move(surface));
  for (std::uint32_t h = 0; h < mesh_.from.size(); h += 3) {
    const TriangleTerm term = term_of(normal(h));
    for (std::uint32_t i = 0; i < 3; ++i) node_[mesh_.from[h + i]].quadric.add(term);
  }
  const auto vertices = static_cast<std::uint32_t>(node_.size());
  while (vertices >> time_shift_ > 0x7FFE) ++time_shift_;
  cheapest_.assign(vertices, kNoHalfEdge);
  queue_.emplace(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    node_[v].slow = mesh_.first[v] != kNoHalfEdge && (mesh_.on_border(v) || is_locked(v)) ? 1 : 0;
  }
  offers_.resize(1);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (mesh_.first[v] == kNoHalfEdge) continue;
    evaluate_owned(v);
    queue_->fill(v, offers_[0].cost);
    cheapest_[v] = offers_[0].edge;
  }
  queue_->start();
}

// Vertices and triangles in order of the curve; vectors go as soon as they have served, so that the
// peak of memory is that of the run itself.
void EdgeCollapse::build(Surface surface) {
  const auto count = static_cast<std::uint32_t>(surface.position.size());
  std::vector<std::uint32_t> order = curve_order(surface.position), number(count);
  for (std::uint32_t i = 0; i < count; ++i) number[order[i]] = i;
  choose_unit(surface);
  node_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) node_[i].x = unit_ * surface.position[order[i]];
  std::vector<Vec3d>().swap(surface.position);
  locked_.assign(options_.locked.empty() ? 0 : count, false);
  for (const std::uint32_t v : options_.locked) locked_[number[v]] = true;
  if (options_.log != nullptr) vertex_of_ = order;
  std::vector<std::uint32_t>().swap(order);
  std::vector<std::uint32_t> start(count + 1, 0);
  for (Triangle& t : surface.triangles) {
    for (std::uint32_t& v : t) v = number[v];
    ++start[std::min({t[0], t[1], t[2]}) + 1];
  }
  for (std::uint32_t v = 0; v < count; ++v) start[v + 1] += start[v];
  std::vector<std::uint32_t> corners(3 * surface.triangles.size());
  if (options_.log != nullptr) triangle_of_.resize(surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& c = surface.triangles[t];
    const std::uint32_t at = start[std::min({c[0], c[1], c[2]})]++;
    std::copy(c.begin(), c.end(), corners.begin() + std::ptrdiff_t{3} * at);
    if (options_.log != nullptr) triangle_of_[at] = t;
  }
  std::vector<Triangle>().swap(surface.triangles);
  std::vector<std::uint32_t>().swap(start);
  std::vector<std::uint32_t>& origin = number;
  mesh_ = build_half_edges(std::move(corners), count, &origin, &report_->repairs);
  for (std::uint32_t v = count; v < origin.size(); ++v) {
    node_.push_back(node_[origin[v]]);
    if (!locked_.empty()) locked_.push_back(locked_[origin[v]]);
    if (options_.log != nullptr) vertex_of_.push_back(v);
  }
}

// Only where every coordinate survives the way there and back.
void EdgeCollapse::choose_unit(const Surface& s) {
  double length = 0;
  for (const Triangle& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      length += glm::length(s.position[t[(i + 1) % 3]] - s.position[t[i]]);
  const double mean = length / (3.0 * static_cast<double>(s.triangles.size()));
  if (!std::isfinite(mean) || !(mean > 0)) return;
  unit_ = std::exp2(-std::round(std::log2(mean)));
  for (const Vec3d& p : s.position)
    if (!(p == (p * unit_) / unit_)) unit_ = 1;
}

void EdgeCollapse::flush() {
  if (batch_size_ == 0) return;
  batch_.evaluate();
  for (std::uint32_t i = 0; i < batch_size_; ++i)
    offers_[lane_slot_[i]].take(batch_.cost[i], lane_edge_[i]);
  batch_size_ = 0;
}

// The position of the collapse of an edge at a border or lock, with its cost: onto a locked end if
// there is one. The factor 72 takes the cost (lambda f_V, lambda = 1/2) to the scale of the fast
// one.
std::optional<Vec3d> EdgeCollapse::slow_position(std::uint32_t h, double* cost) const {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  const bool lock_a = is_locked(a), lock_b = is_locked(b);
  if (lock_a && lock_b) return std::nullopt;
  const Vec3d middle = 0.5 * (node_[a].x + node_[b].x);
  double n2_sum = 0, count = 0;
  EdgeSums sums = sums_of(
      mesh_, h, [&](std::uint32_t v) { return node_[v].x - middle; },
      [&](double n2) {
        n2_sum += n2;
        ++count;
        return weight_of(n2);
      });
  sums.border_weight = weight_of(n2_sum / count);
  std::optional<Vec3d> x;
  if (lock_a || lock_b)
    x = node_[lock_a ? a : b].x - middle;
  else
    x = best_position(sums);
  if (!x || (!lock_a && !lock_b && too_far(*x, sums))) return std::nullopt;
  if (cost != nullptr) {
    const Sym3& h2 = sums.volume.h;
    const double trace = h2.xx + h2.yy + h2.zz;
    *cost = 72.0 * collapse_cost(sums, *x) * (lock_a || lock_b ? 2.0 : 1.0) +
            static_cast<double>(kFlatFirst) * trace * sums.edge_length2 / 4.0;
  }
  if (lock_a || lock_b) return node_[lock_a ? a : b].x;
  return middle + *x;
}

void EdgeCollapse::evaluate_slow(std::uint32_t h, std::size_t slot) {
  double cost = 0;
  if (!slow_position(h, &cost)) return;
  offers_[slot].take(static_cast<float>(cost), h);
}

// Evaluates edges from the vertex to neighbours w for which slot_of(w) is a place in offers_, not
// kNoSlot. An edge is named by its half-edge from its owner, the end of lower number.
template <class Slot>
void EdgeCollapse::evaluate_fan(std::uint32_t vertex, Slot&& slot_of) {
  const Node& center = node_[vertex];
  fan_.clear();
  fan_edge_.clear();
  mesh_.for_fan(vertex, [&](std::uint32_t h) {
    fan_.push_back(h);
    fan_edge_.push_back(Vec3(node_[mesh_.to(h)].x - center.x));
  });
  const std::size_t count = fan_.size();
  const std::uint32_t in = prev_in_triangle(fan_.back());
  const bool open = mesh_.twin[in] == kNoHalfEdge;
  const auto visit = [&](std::uint32_t other, std::uint32_t h, std::uint32_t twin, std::size_t i) {
    const std::size_t slot = slot_of(other);
    if (slot == kNoSlot) return;
    const std::uint32_t edge = other < vertex && twin != kNoHalfEdge ? twin : h;
    if (blocked(edge, vertex, other)) return;
    if (center.slow || node_[other].slow) return evaluate_slow(edge, slot);
    const Vec3 &e = fan_edge_[i], &before = fan_edge_[i == 0 ? count - 1 : i - 1],
               &after = fan_edge_[i + 1 == count ? 0 : i + 1];
    const Vec3 left = cross(e, after), right = cross(before, e);
    const std::uint32_t lane = batch_size_;
    batch_.set_ends(lane, center.quadric, node_[other].quadric);
    for (int k = 0; k < 3; ++k) {
      batch_.half[k][lane] = 0.5f * e[k];
      batch_.left[k][lane] = left[k];
      batch_.right[k][lane] = right[k];
    }
    lane_edge_[lane] = edge;
    lane_slot_[lane] = slot;
    if (++batch_size_ == EdgeBatch::kWidth) flush();
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t h = fan_[i];
    const bool border = open && i == 0;
    visit(mesh_.to(h), h, border ? kNoHalfEdge : prev_in_triangle(fan_[i == 0 ? count - 1 : i - 1]),
          i);
  }
  if (open) visit(mesh_.from[in], in, kNoHalfEdge, 0);
}

// Leaves the cheapest edge that the vertex owns in offers_[0].
void EdgeCollapse::evaluate_owned(std::uint32_t vertex) {
  offers_[0] = {};
  evaluate_fan(vertex, [vertex](std::uint32_t other) { return other > vertex ? 0 : kNoSlot; });
  flush();
  node_[vertex].seen = now() & 0x7FFF;
}

void EdgeCollapse::look_again(std::uint32_t vertex) {
  evaluate_owned(vertex);
  cheapest_[vertex] = offers_[0].edge;
  queue_->set(vertex, offers_[0].cost);
}

bool EdgeCollapse::stale(std::uint32_t vertex) const {
  const Node& n = node_[vertex];
  if (n.changed > n.seen) return true;
  bool changed = false;
  mesh_.for_ring(vertex,
                 [&](std::uint32_t w) { changed |= w > vertex && node_[w].changed > n.seen; });
  return changed;
}

void EdgeCollapse::block(std::uint32_t h) {
  blocked_[h] = now();
  node_[mesh_.from[h]].has_blocked = node_[mesh_.to(h)].has_blocked = 1;
}

bool EdgeCollapse::blocked(std::uint32_t h, std::uint32_t a, std::uint32_t b) {
  if (!node_[a].has_blocked || !node_[b].has_blocked) return false;
  const auto i = blocked_.find(h);
  if (i == blocked_.end()) return false;
  if (std::max(node_[a].changed, node_[b].changed) <= i->second) return true;
  blocked_.erase(i);
  return false;
}

// Fills around_ for an edge between inner vertices. False where the ends share more neighbours
// than the two opposite ones, or nothing but a tetrahedron is there: the link condition.
bool EdgeCollapse::look_around(std::uint32_t h) {
  Surroundings& s = around_;
  const std::uint32_t twin = mesh_.twin[h];
  const Vec3d middle = 0.5 * (node_[mesh_.from[h]].x + node_[mesh_.to(h)].x);
  s.ring.clear();
  s.at.clear();
  const auto add_fan = [&](std::uint32_t start) {  // All but the edge itself and the last.
    for (std::uint32_t g = mesh_.turn(start);; g = mesh_.turn(g)) {
      if (mesh_.turn(g) == start) break;
      s.ring.push_back(mesh_.to(g));
    }
  };
  add_fan(h);
  s.split = s.ring.size();
  add_fan(twin);
  const auto middle_of = s.ring.begin() + static_cast<std::ptrdiff_t>(s.split);
  if (s.split == 0 || s.split == s.ring.size() || s.ring.size() < 3) return false;
  for (auto i = s.ring.begin(); i != middle_of; ++i)
    if (std::find(middle_of, s.ring.end(), *i) != s.ring.end()) return false;
  for (const std::uint32_t v : s.ring) s.at.push_back(node_[v].x - middle);
  s.a = node_[mesh_.from[h]].x - middle;
  return true;
}

std::optional<Vec3d> EdgeCollapse::best_inside() {
  Surroundings& s = around_;
  const Vec3d b = -s.a;
  EdgeSums sums;
  s.n.clear();
  const std::size_t count = s.ring.size();
  const auto add = [&sums](const Vec3d& n, const Vec3d& on) {
    sums.add_triangle(n, dot(n, on), weight_of(length2(n)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d &p = s.at[i], &q = s.at[i + 1 == count ? 0 : i + 1];
    const Vec3d& end = i < s.split ? s.a : b;
    s.n.push_back(cross(q - p, end - p));
    add(s.n.back(), end);
    sums.ring_sum += p;
    sums.ring_square += length2(p);
  }
  s.left = cross(s.at[0] - b, s.a - b);
  s.right = cross(s.at[s.split] - s.a, b - s.a);
  add(s.left, s.a);
  add(s.right, s.a);
  sums.ring_count = static_cast<double>(count);
  const std::optional<Vec3d> x = best_position(sums);
  if (!x || too_far(*x, sums)) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d &p = s.at[i], &q = s.at[i + 1 == count ? 0 : i + 1];
    if (!(dot(s.n[i], cross(q - p, *x - p)) > 0.0)) return std::nullopt;
  }
  return x;
}

bool EdgeCollapse::collapse_inside(std::uint32_t h) {
  if (!look_around(h)) return false;
  const std::optional<Vec3d> x = best_inside();
  if (!x) return false;
  const Surroundings& s = around_;
  const std::uint32_t keep = mesh_.from[h];
  const Vec3d middle = 0.5 * (node_[keep].x + node_[mesh_.to(h)].x);
  VertexQuadric quadric;
  for (std::size_t i = 0; i < s.ring.size(); ++i) {
    const std::size_t j = i + 1 == s.ring.size() ? 0 : i + 1;
    const TriangleTerm before = term_of(s.n[i]);
    const TriangleTerm after = term_of(cross(s.at[j] - s.at[i], *x - s.at[i]));
    for (const std::size_t end : {i, j}) {
      node_[s.ring[end]].quadric.remove(before);
      node_[s.ring[end]].quadric.add(after);
    }
    quadric.add(after);
  }
  node_[s.ring[0]].quadric.remove(term_of(s.left));
  node_[s.ring[s.split]].quadric.remove(term_of(s.right));
  merge(h, middle + *x);
  node_[keep].quadric = quadric;
  refresh(keep, s.ring);
  return true;
}

bool EdgeCollapse::keeps_orientation(std::uint32_t h, const Vec3d& x) const {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  for (const auto& [end, other] : {std::pair{a, b}, std::pair{b, a}}) {
    const std::uint32_t start = mesh_.first[end];
    std::uint32_t g = start;
    do {
      const std::uint32_t s = mesh_.to(g), t = mesh_.opposite(g);
      if (s != other && t != other) {
        const Vec3d& p = node_[s].x;
        const Vec3d side = node_[t].x - p;
        if (!(dot(cross(side, node_[end].x - p), cross(side, x - p)) > 0.0)) return false;
      }
      g = mesh_.turn(g);
    } while (g != start && g != kNoHalfEdge);
  }
  return true;
}

bool EdgeCollapse::collapse_slow(std::uint32_t h) {
  if (!mesh_.link_condition(h, scratch_)) return false;
  const std::optional<Vec3d> x = slow_position(h, nullptr);
  if (!x || !keeps_orientation(h, *x)) return false;
  const std::uint32_t keep = mesh_.from[h];
  for_edge_triangles(mesh_, h, [&](std::uint32_t g) {
    const TriangleTerm term = term_of(normal(g));
    for (const std::uint32_t v : {mesh_.from[g], mesh_.to(g), mesh_.opposite(g)})
      node_[v].quadric.remove(term);
  });
  merge(h, *x);
  node_[keep].quadric = {};
  mesh_.for_fan(keep, [&](std::uint32_t g) {
    const TriangleTerm term = term_of(normal(g));
    for (const std::uint32_t v : {keep, mesh_.to(g), mesh_.opposite(g)}) node_[v].quadric.add(term);
  });
  scratch_.clear();
  mesh_.for_ring(keep, [&](std::uint32_t r) { scratch_.push_back(r); });
  refresh(keep, scratch_);
  return true;
}

// The collapse itself: connectivity, position, and the record of it.
void EdgeCollapse::merge(std::uint32_t h, const Vec3d& x) {
  const std::uint32_t keep = mesh_.from[h], gone = mesh_.to(h);
  CollapseLog* log = options_.log;
  CollapseRecord record;
  if (log != nullptr) {
    record.keep = vertex_of_[keep];
    record.gone = vertex_of_[gone];
    record.old_keep = node_[keep].x / unit_;
    record.old_gone = node_[gone].x / unit_;
    record.x = x / unit_;
    for (const std::uint32_t side : {h, mesh_.twin[h]}) {
      if (side == kNoHalfEdge) continue;
      const std::uint32_t f = side - side % 3, i = record.triangle_count++;
      record.triangle[i] = triangle_of_[side / 3];
      for (std::uint32_t c = 0; c < 3; ++c) record.corners[i][c] = vertex_of_[mesh_.from[f + c]];
    }
  }
  moved_.clear();
  live_triangles_ -= mesh_.collapse(h, log != nullptr ? &moved_ : nullptr).triangle_count;
  if (log != nullptr) {
    record.first_moved = static_cast<std::uint32_t>(log->moved.size());
    record.moved_count = static_cast<std::uint32_t>(moved_.size());
    for (const std::uint32_t m : moved_) log->moved.push_back(3 * triangle_of_[m / 3] + m % 3);
    log->records.push_back(record);
  }
  if (is_locked(gone)) locked_[keep] = true;
  node_[keep].x = x;
  if (node_[gone].slow) node_[keep].slow = 1;
  node_[keep].has_blocked = 0;
  cheapest_[gone] = kNoHalfEdge;
  queue_->set(gone, VertexQueue::kNever);
  ++collapses_;
}

// After a collapse to v. Ring vertices whose cheapest edge is gone, or led to v, look for another.
void EdgeCollapse::refresh(std::uint32_t v, std::span<const std::uint32_t> ring) {
  const std::size_t own = ring.size();
  offers_.assign(own + 1, {});
  node_[v].changed = node_[v].seen = now() & 0x7FFF;
  for (std::size_t i = 0; i < own; ++i) node_[ring[i]].changed = now() & 0x7FFF;
  for (std::size_t i = 0; i < own; ++i) {
    const std::uint32_t r = ring[i], best = cheapest_[r];
    const bool lost = best == kNoHalfEdge || mesh_.from[best] == kNoHalfEdge ||
                      mesh_.from[best] == v || mesh_.to(best) == v;
    if (!lost) {
      offers_[i] = {queue_->key(r), best};
      continue;
    }
    evaluate_fan(r, [&](std::uint32_t other) { return other > r && other != v ? i : kNoSlot; });
    node_[r].seen = now() & 0x7FFF;
  }
  evaluate_fan(v, [&](std::uint32_t other) -> std::size_t {
    if (other > v) return own;
    return static_cast<std::size_t>(std::find(ring.begin(), ring.end(), other) - ring.begin());
  });
  flush();
  for (std::size_t i = 0; i <= own; ++i) {
    const std::uint32_t r = i == own ? v : ring[i];
    cheapest_[r] = offers_[i].edge;
    queue_->set(r, offers_[i].cost);
  }
  for (const std::uint32_t r : ring)
    if (node_[r].has_blocked) wake(r);
}

// A change at the vertex opens refused edges again: neighbours that wait for one look again.
void EdgeCollapse::wake(std::uint32_t vertex) {
  waking_.clear();
  mesh_.for_ring(vertex, [&](std::uint32_t w) {
    if (node_[w].has_blocked && cheapest_[w] == kNoHalfEdge) waking_.push_back(w);
  });
  for (const std::uint32_t w : waking_) look_again(w);
}

Surface EdgeCollapse::run() {
  while (live_triangles_ > options_.target_triangles && !queue_->empty()) {
    const std::uint32_t vertex = queue_->top();
    if (stale(vertex)) {
      look_again(vertex);
      continue;
    }
    const std::uint32_t h = cheapest_[vertex];
    const bool inside = !node_[mesh_.from[h]].slow && !node_[mesh_.to(h)].slow;
    if (inside ? collapse_inside(h) : collapse_slow(h)) {
      ++report_->collapses;
      continue;
    }
    ++report_->rejected;
    block(h);
    look_again(vertex);
  }
  return take_surface();
}

// In order of the curve, or with a log in that of the input.
Surface EdgeCollapse::take_surface() {
  queue_.reset();
  std::vector<std::uint32_t>().swap(mesh_.twin);
  std::vector<std::uint32_t>& number = cheapest_;
  std::vector<std::uint32_t> live, triangles;
  for (std::uint32_t v = 0; v < node_.size(); ++v)
    if (mesh_.first[v] != kNoHalfEdge) live.push_back(v);
  for (std::uint32_t t = 0; t < mesh_.from.size() / 3; ++t)
    if (mesh_.alive(t)) triangles.push_back(t);
  if (options_.log != nullptr) {
    const auto by = [](const std::vector<std::uint32_t>& input) {
      return [&input](std::uint32_t a, std::uint32_t b) { return input[a] < input[b]; };
    };
    std::sort(live.begin(), live.end(), by(vertex_of_));
    std::sort(triangles.begin(), triangles.end(), by(triangle_of_));
  }
  Surface out;
  out.position.reserve(live.size());
  out.triangles.reserve(triangles.size());
  for (const std::uint32_t v : live) {
    number[v] = static_cast<std::uint32_t>(out.position.size());
    out.position.push_back(node_[v].x / unit_);
  }
  for (const std::uint32_t t : triangles)
    out.triangles.push_back(
        {number[mesh_.from[3 * t]], number[mesh_.from[3 * t + 1]], number[mesh_.from[3 * t + 2]]});
  return out;
}

}  // namespace

Surface collapse_edges(Surface surface, const CollapseOptions& options, CollapseReport* report) {
  CollapseReport unused;
  return EdgeCollapse(std::move(surface), options, report != nullptr ? report : &unused).run();
}

}  // namespace caryatid::bake
