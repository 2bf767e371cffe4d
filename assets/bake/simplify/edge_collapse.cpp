#include "assets/bake/simplify/edge_collapse.h"

#include <algorithm>

#include "assets/bake/simplify/fast_cost.h"
#include "assets/bake/simplify/neighbourhood.h"
#include "assets/bake/simplify/placement.h"
#include "assets/bake/simplify/vertex_queue.h"

namespace caryatid::bake {
namespace {

// The queue holds vertices; each stands for the cheapest of the edges that it owns, those to
// vertices of higher number. A collapse to v with ring R changes the cost of every edge at v or R.
class EdgeCollapse {
 public:
  EdgeCollapse(Surface surface, const CollapseOptions& options, CollapseReport* report);
  Surface run();

 private:
  bool slow(std::uint32_t a, std::uint32_t b) const {
    return mesh_.on_border(a) || mesh_.on_border(b) ||
           (!locked_.empty() && (locked_[a] || locked_[b]));
  }
  // Twice the area vector, in the units of the fast cost.
  Vec3d normal(std::uint32_t h) const {
    const Vec3d &a = position_[mesh_.from[h]], &b = position_[mesh_.to(h)];
    return scale_ * scale_ * cross(b - a, position_[mesh_.opposite(h)] - a);
  }
  void add_normal(std::uint32_t vertex, const Vec3d& n, float sign) {
    quadric_[vertex].add(static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
                         sign);
  }
  std::optional<Vec3d> exact_position(std::uint32_t h, double* cost) const;
  void evaluate(std::uint32_t h);
  void flush();
  void offer(std::uint32_t h, float cost);
  void evaluate_owned(std::uint32_t vertex);
  void reopen(std::uint32_t vertex);
  bool keeps_orientation(std::uint32_t h, const Vec3d& x) const;
  void collapse(std::uint32_t h, const Vec3d& x);
  void change_quadrics(std::uint32_t h, float sign);
  void refresh(std::uint32_t v);
  void look_again(std::uint32_t vertex);
  Surface take_surface();

  const CollapseOptions& options_;
  CollapseReport* report_;
  HalfEdges mesh_;
  std::vector<Vec3d> position_;
  double scale_ = 1;  // Makes the mean edge 1 in the fast cost.
  std::vector<VertexQuadric> quadric_;
  std::vector<std::uint32_t> cheapest_;  // By vertex: its cheapest owned edge.
  std::vector<float> key_;               // Its cost while it is being refreshed.
  std::vector<bool> blocked_;            // By half-edge: collapse refused until something changes.
  std::vector<bool> dirty_;  // By vertex: its cheapest edge may have another cost by now.
  std::vector<bool> locked_;
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0, live_triangles_ = 0;
  std::optional<VertexQueue> queue_;
  EdgeBatch batch_;
  std::uint32_t batch_size_ = 0;
  std::array<std::uint32_t, EdgeBatch::kWidth> batch_edge_{};
  std::vector<std::uint32_t> ring_, moved_;
};

EdgeCollapse::EdgeCollapse(Surface surface, const CollapseOptions& options, CollapseReport* report)
    : options_(options), report_(report), position_(std::move(surface.position)) {
  std::vector<std::uint32_t> corners(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    std::copy_n(surface.triangles[t].begin(), 3,
                corners.begin() + static_cast<std::ptrdiff_t>(3 * t));
  live_triangles_ = static_cast<std::uint32_t>(surface.triangles.size());
  std::vector<Triangle>().swap(surface.triangles);
  std::vector<std::uint32_t> origin;
  mesh_ = build_half_edges(std::move(corners), static_cast<std::uint32_t>(position_.size()),
                           &origin, &report_->repairs);
  if (!options.locked.empty() || origin.size() > position_.size()) {
    locked_.assign(origin.size(), false);
    for (const std::uint32_t v : options.locked) locked_[v] = true;
    for (std::size_t v = position_.size(); v < origin.size(); ++v) {
      position_.push_back(position_[origin[v]]);
      locked_[v] = locked_[origin[v]];
    }
  }
  std::vector<std::uint32_t>().swap(origin);
  const std::size_t vertices = position_.size();
  quadric_.resize(vertices);
  cheapest_.assign(vertices, kNoHalfEdge);
  key_.assign(vertices, VertexQueue::kNever);
  mark_.assign(vertices, 0);
  blocked_.assign(mesh_.from.size(), false);
  dirty_.assign(vertices, false);
  double length = 0;
  for (std::uint32_t h = 0; h < mesh_.from.size(); ++h)
    length += glm::length(position_[mesh_.to(h)] - position_[mesh_.from[h]]);
  if (length > 0) scale_ = static_cast<double>(mesh_.from.size()) / length;
  for (std::uint32_t h = 0; h < mesh_.from.size(); h += 3) {
    const Vec3d n = normal(h);
    for (std::uint32_t i = 0; i < 3; ++i) add_normal(mesh_.from[h + i], n, 1.0f);
  }
  for (std::uint32_t h = 0; h < mesh_.from.size(); ++h)
    if (mesh_.twin[h] == kNoHalfEdge || h < mesh_.twin[h]) evaluate(h);
  flush();
  queue_.emplace(key_);
}

// The position of the collapse of h in double, with its cost: onto a locked end if there is one.
std::optional<Vec3d> EdgeCollapse::exact_position(std::uint32_t h, double* cost) const {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  const Vec3d middle = 0.5 * (position_[a] + position_[b]);
  const EdgeSums sums = sums_of(mesh_, h, [&](std::uint32_t v) { return position_[v] - middle; });
  const bool lock_a = !locked_.empty() && locked_[a], lock_b = !locked_.empty() && locked_[b];
  if (lock_a && lock_b) return std::nullopt;
  std::optional<Vec3d> x;
  if (lock_a || lock_b)
    x = position_[lock_a ? a : b] - middle;
  else
    x = best_position(sums);
  if (!x) return std::nullopt;
  if (cost != nullptr) *cost = collapse_cost(sums, *x) * (lock_a || lock_b ? 2.0 : 1.0);
  if (lock_a || lock_b) return position_[lock_a ? a : b];
  return middle + *x;
}

void EdgeCollapse::offer(std::uint32_t h, float cost) {
  const std::uint32_t owner = std::min(mesh_.from[h], mesh_.to(h));
  if (cost < key_[owner] || (cost == key_[owner] && h < cheapest_[owner])) {
    key_[owner] = cost;
    cheapest_[owner] = h;
  }
}

void EdgeCollapse::flush() {
  if (batch_size_ == 0) return;
  batch_.evaluate();
  for (std::uint32_t i = 0; i < batch_size_; ++i) offer(batch_edge_[i], batch_.cost[i]);
  batch_size_ = 0;
}

// Offers the edge to its owner, at once or with the next flush(). The factor 72 takes the exact
// cost (lambda f_V, lambda = 1/2) to the scale of the fast one.
void EdgeCollapse::evaluate(std::uint32_t h) {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  if (slow(a, b)) {
    double cost = 0;
    if (exact_position(h, &cost)) {
      const Vec3d edge = scale_ * (position_[b] - position_[a]);
      const auto& q = quadric_[a].a;
      const double flat = 1e-7 * static_cast<double>(q[0] + q[3] + q[5]) * length2(edge) / 4;
      const double volume = scale_ * scale_ * scale_;
      offer(h, static_cast<float>(72.0 * volume * volume * cost + flat));
    }
    return;
  }
  const std::uint32_t lane = batch_size_;
  batch_.set_ends(lane, quadric_[a], quadric_[b]);
  const Vec3d& origin = position_[a];
  const Vec3d edge = scale_ * (position_[b] - origin);
  const Vec3d left = scale_ * cross(edge, position_[mesh_.opposite(h)] - origin);
  const Vec3d right = scale_ * cross(position_[mesh_.opposite(mesh_.twin[h])] - origin, edge);
  for (int i = 0; i < 3; ++i) {
    batch_.half[i][lane] = static_cast<float>(0.5 * edge[i]);
    batch_.left[i][lane] = static_cast<float>(left[i]);
    batch_.right[i][lane] = static_cast<float>(right[i]);
  }
  batch_edge_[lane] = h;
  if (++batch_size_ == EdgeBatch::kWidth) flush();
}

// Offers all edges that the vertex owns but those that are blocked.
void EdgeCollapse::evaluate_owned(std::uint32_t vertex) {
  std::uint32_t last = kNoHalfEdge;
  const auto visit = [&](std::uint32_t h, std::uint32_t other) {
    if (other > vertex && !blocked_[h]) evaluate(h);
  };
  mesh_.for_fan(vertex, [&](std::uint32_t h) {
    visit(h, mesh_.to(h));
    last = h;
  });
  const std::uint32_t in = prev_in_triangle(last);
  if (mesh_.twin[in] == kNoHalfEdge) visit(in, mesh_.from[in]);
}

bool EdgeCollapse::keeps_orientation(std::uint32_t h, const Vec3d& x) const {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  for (const auto& [end, other] : {std::pair{a, b}, std::pair{b, a}}) {
    const std::uint32_t start = mesh_.first[end];
    std::uint32_t g = start;
    do {
      const std::uint32_t s = mesh_.to(g), t = mesh_.opposite(g);
      if (s != other && t != other) {
        const Vec3d side = position_[t] - position_[s];
        const Vec3d before = cross(side, position_[end] - position_[s]);
        const Vec3d after = cross(side, x - position_[s]);
        if (!(dot(before, after) > 0.0)) return false;
      }
      g = mesh_.turn(g);
    } while (g != start && g != kNoHalfEdge);
  }
  return true;
}

// Adds or removes, at the ring, what the triangles around the edge say.
void EdgeCollapse::change_quadrics(std::uint32_t h, float sign) {
  const std::uint32_t a = mesh_.from[h], b = mesh_.to(h);
  for_edge_triangles(mesh_, h, [&](std::uint32_t g) {
    const Vec3d n = normal(g);
    for (const std::uint32_t v : {mesh_.from[g], mesh_.to(g), mesh_.opposite(g)})
      if (v != a && v != b) add_normal(v, n, sign);
  });
}

void EdgeCollapse::collapse(std::uint32_t h, const Vec3d& x) {
  const std::uint32_t keep = mesh_.from[h], gone = mesh_.to(h);
  change_quadrics(h, -1.0f);
  CollapseRecord record;
  if (options_.log != nullptr) {
    record = {keep, gone, position_[keep], position_[gone], x, 0, {}, {}, 0, 0};
    for (const std::uint32_t side : {h, mesh_.twin[h]}) {
      if (side == kNoHalfEdge) continue;
      const std::uint32_t t = side / 3, i = record.triangle_count++;
      record.triangle[i] = t;
      record.corners[i] = {mesh_.from[3 * t], mesh_.from[3 * t + 1], mesh_.from[3 * t + 2]};
    }
  }
  moved_.clear();
  live_triangles_ -= mesh_.collapse(h, options_.log != nullptr ? &moved_ : nullptr).triangle_count;
  if (options_.log != nullptr) {
    record.first_moved = static_cast<std::uint32_t>(options_.log->moved.size());
    record.moved_count = static_cast<std::uint32_t>(moved_.size());
    options_.log->moved.insert(options_.log->moved.end(), moved_.begin(), moved_.end());
    options_.log->records.push_back(record);
  }
  if (!locked_.empty() && locked_[gone]) locked_[keep] = true;
  position_[keep] = x;
  quadric_[keep] = {};
  mesh_.for_fan(keep, [&](std::uint32_t g) {
    const Vec3d n = normal(g);
    for (const std::uint32_t v : {keep, mesh_.to(g), mesh_.opposite(g)}) add_normal(v, n, 1.0f);
  });
  cheapest_[gone] = kNoHalfEdge;
  queue_->set(gone, VertexQueue::kNever);
}

// Everything at the vertex may be tried again; what it owns is looked at when its turn comes, or at
// once where it has nothing in the queue.
void EdgeCollapse::reopen(std::uint32_t vertex) {
  std::uint32_t last = kNoHalfEdge;
  const auto visit = [&](std::uint32_t h, std::uint32_t other) {
    blocked_[h] = false;
    if (mesh_.twin[h] != kNoHalfEdge) blocked_[mesh_.twin[h]] = false;
    if (other > vertex || dirty_[other]) return;
    dirty_[other] = true;
    if (cheapest_[other] == kNoHalfEdge) ring_.push_back(other);
  };
  mesh_.for_fan(vertex, [&](std::uint32_t h) {
    visit(h, mesh_.to(h));
    last = h;
  });
  const std::uint32_t in = prev_in_triangle(last);
  if (mesh_.twin[in] == kNoHalfEdge) visit(in, mesh_.from[in]);
}

// After a collapse to v the cost of every edge at v or its ring has changed. Those at v are
// evaluated now. The others keep their place in the queue until they come up: costs rise nearly
// always as a surface gets coarser, and then the new cost decides (run() looks again).
void EdgeCollapse::refresh(std::uint32_t v) {
  ring_.clear();
  mesh_.for_ring(v, [&](std::uint32_t r) { ring_.push_back(r); });
  const std::size_t ring_size = ring_.size();
  for (std::size_t i = 0; i < ring_size; ++i) {
    const std::uint32_t r = ring_[i], best = cheapest_[r];
    dirty_[r] = true;
    const bool lost = best == kNoHalfEdge || mesh_.from[best] == kNoHalfEdge ||
                      mesh_.from[best] == v || mesh_.to(best) == v;
    key_[r] = lost ? VertexQueue::kNever : queue_->key(r);
    if (lost) cheapest_[r] = kNoHalfEdge;
  }
  for (std::size_t i = 0; i < ring_size; ++i) reopen(ring_[i]);
  ring_.push_back(v);
  key_[v] = VertexQueue::kNever;
  cheapest_[v] = kNoHalfEdge;
  for (const std::uint32_t r : ring_)
    if (cheapest_[r] == kNoHalfEdge) {
      key_[r] = VertexQueue::kNever;
      dirty_[r] = false;
      if (r != v) evaluate_owned(r);
    }
  reopen(v);
  std::uint32_t last = kNoHalfEdge;
  mesh_.for_fan(v, [&](std::uint32_t h) {
    evaluate(h);
    last = h;
  });
  const std::uint32_t in = prev_in_triangle(last);
  if (mesh_.twin[in] == kNoHalfEdge) evaluate(in);
  flush();
  for (const std::uint32_t r : ring_) queue_->set(r, key_[r]);
}

void EdgeCollapse::look_again(std::uint32_t vertex) {
  key_[vertex] = VertexQueue::kNever;
  cheapest_[vertex] = kNoHalfEdge;
  evaluate_owned(vertex);
  flush();
  queue_->set(vertex, key_[vertex]);
}

Surface EdgeCollapse::run() {
  while (live_triangles_ > options_.target_triangles && !queue_->empty()) {
    const std::uint32_t vertex = queue_->top();
    if (dirty_[vertex]) {
      dirty_[vertex] = false;
      look_again(vertex);
      continue;
    }
    const std::uint32_t h = cheapest_[vertex];
    std::optional<Vec3d> x;
    if (mesh_.link_condition(h, mark_, stamp_)) x = exact_position(h, nullptr);
    if (x && keeps_orientation(h, *x)) {
      const std::uint32_t keep = mesh_.from[h];
      collapse(h, *x);
      refresh(keep);
      ++report_->collapses;
      continue;
    }
    ++report_->rejected;
    blocked_[h] = true;
    if (mesh_.twin[h] != kNoHalfEdge) blocked_[mesh_.twin[h]] = true;
    look_again(vertex);
  }
  return take_surface();
}

Surface EdgeCollapse::take_surface() {
  std::vector<VertexQuadric>().swap(quadric_);
  queue_.reset();
  Surface out;
  out.triangles.reserve(live_triangles_);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < position_.size(); ++v) {
    if (mesh_.first[v] == kNoHalfEdge) continue;
    position_[count] = position_[v];
    mark_[v] = count++;
  }
  for (std::uint32_t t = 0; t < mesh_.from.size() / 3; ++t)
    if (mesh_.alive(t))
      out.triangles.push_back(
          {mark_[mesh_.from[3 * t]], mark_[mesh_.from[3 * t + 1]], mark_[mesh_.from[3 * t + 2]]});
  position_.resize(count);
  out.position = std::move(position_);
  return out;
}

}  // namespace

Surface collapse_edges(Surface surface, const CollapseOptions& options, CollapseReport* report) {
  CollapseReport unused;
  return EdgeCollapse(std::move(surface), options, report != nullptr ? report : &unused).run();
}

}  // namespace caryatid::bake
