#include "assets/bake/simplify/cache_order.h"

#include <algorithm>
#include <deque>

namespace caryatid::bake {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFFu;

class Tipsify {
 public:
  Tipsify(const TriangleList& triangles, std::uint32_t vertex_count, std::uint32_t cache_size)
      : triangles_(triangles), cache_size_(cache_size), start_(vertex_count + 1, 0) {
    for (const auto& t : triangles)
      for (const std::uint32_t v : t) ++start_[v + 1];
    for (std::uint32_t v = 0; v < vertex_count; ++v) start_[v + 1] += start_[v];
    std::vector<std::uint32_t> fill(start_.begin(), start_.end() - 1);
    around_.resize(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (const std::uint32_t v : triangles[t]) around_[fill[v]++] = t;
    live_.resize(vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) live_[v] = start_[v + 1] - start_[v];
    entered_.assign(vertex_count, 0);
    done_.assign(triangles.size(), false);
    time_ = cache_size + 1;
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t fan = next_untouched(); fan != kNobody;) {
      std::vector<std::uint32_t> candidates;
      for (std::uint32_t i = start_[fan]; i < start_[fan + 1]; ++i)
        if (!done_[around_[i]]) emit(around_[i], &order, &candidates);
      fan = best_of(candidates);
      if (fan == kNobody) fan = skip_dead_end();
    }
    return order;
  }

 private:
  void emit(std::uint32_t t, std::vector<std::uint32_t>* order,
            std::vector<std::uint32_t>* candidates) {
    done_[t] = true;
    order->push_back(t);
    for (const std::uint32_t v : triangles_[t]) {
      recent_.push_back(v);
      candidates->push_back(v);
      --live_[v];
      if (time_ - entered_[v] > cache_size_) entered_[v] = time_++;
    }
  }
  // The oldest vertex that is still in the cache after its own fan has passed through.
  std::uint32_t best_of(const std::vector<std::uint32_t>& candidates) const {
    std::uint32_t best = kNobody;
    std::int64_t best_age = -1;
    for (const std::uint32_t v : candidates) {
      if (live_[v] == 0) continue;
      const std::uint32_t age = time_ - entered_[v];
      const std::int64_t priority = age + 2 * live_[v] <= cache_size_ ? age : 0;
      if (priority > best_age) {
        best_age = priority;
        best = v;
      }
    }
    return best;
  }
  std::uint32_t skip_dead_end() {
    while (!recent_.empty()) {
      const std::uint32_t v = recent_.back();
      recent_.pop_back();
      if (live_[v] > 0) return v;
    }
    return next_untouched();
  }
  std::uint32_t next_untouched() {
    for (; cursor_ < live_.size(); ++cursor_)
      if (live_[cursor_] > 0) return cursor_;
    return kNobody;
  }

  const TriangleList& triangles_;
  std::uint32_t cache_size_;
  std::vector<std::uint32_t> start_, around_;  // Triangles around each vertex.
  std::vector<std::uint32_t> live_;            // Of which so many are not yet in the order.
  std::vector<std::uint32_t> entered_;         // When the vertex last entered the cache.
  std::vector<std::uint32_t> recent_;
  std::vector<bool> done_;
  std::uint32_t time_ = 0, cursor_ = 0;
};

}  // namespace

std::vector<std::uint32_t> cache_order(const TriangleList& triangles, std::uint32_t vertex_count,
                                       std::uint32_t cache_size) {
  return Tipsify(triangles, vertex_count, cache_size).run();
}

double misses_per_triangle(const TriangleList& triangles, std::uint32_t cache_size) {
  std::deque<std::uint32_t> cache;
  std::size_t misses = 0;
  for (const auto& t : triangles)
    for (const std::uint32_t v : t) {
      if (std::find(cache.begin(), cache.end(), v) != cache.end()) continue;
      ++misses;
      cache.push_back(v);
      if (cache.size() > cache_size) cache.pop_front();
    }
  return triangles.empty() ? 0.0
                           : static_cast<double>(misses) / static_cast<double>(triangles.size());
}

}  // namespace caryatid::bake
