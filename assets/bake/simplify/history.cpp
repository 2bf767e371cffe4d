#include "assets/bake/simplify/history.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "core/base/crc.h"

namespace caryatid::bake {

History record_history(Surface surface, CollapseOptions options, CollapseReport* report) {
  CollapseLog log;
  options.log = &log;
  const auto vertices = static_cast<std::uint32_t>(surface.position.size());
  const auto triangles = static_cast<std::uint32_t>(surface.triangles.size());
  History out;
  out.base = collapse_edges(std::move(surface), options, report);
  // Numbers from the coarse end: what is left keeps its order, then as the splits bring it back.
  std::vector<std::uint32_t> vertex(vertices, kNoHalfEdge), triangle(triangles, kNoHalfEdge);
  std::vector<bool> vertex_gone(vertices, false), triangle_gone(triangles, false);
  for (const CollapseRecord& r : log.records) {
    if (r.gone >= vertices || r.keep >= vertices)
      throw std::runtime_error("a history needs a surface without non-manifold vertices");
    vertex_gone[r.gone] = true;
    for (std::uint32_t i = 0; i < r.triangle_count; ++i) triangle_gone[r.triangle[i]] = true;
  }
  const auto add = [](std::uint32_t id, std::vector<std::uint32_t>* number,
                      std::vector<std::uint32_t>* origin) {
    (*number)[id] = static_cast<std::uint32_t>(origin->size());
    origin->push_back(id);
  };
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (!vertex_gone[v]) add(v, &vertex, &out.vertex_origin);
  for (std::uint32_t t = 0; t < triangles; ++t)
    if (!triangle_gone[t]) add(t, &triangle, &out.triangle_origin);
  if (out.vertex_origin.size() != out.base.position.size())
    throw std::runtime_error("a history needs a surface without unused vertices");
  for (auto r = log.records.rbegin(); r != log.records.rend(); ++r) {
    History::Split s;
    s.parent = vertex[r->keep];
    add(r->gone, &vertex, &out.vertex_origin);
    s.coarse = r->x;
    s.parent_x = r->old_keep;
    s.new_x = r->old_gone;
    s.triangle_count = r->triangle_count;
    for (std::uint32_t i = 0; i < r->triangle_count; ++i) {
      add(r->triangle[i], &triangle, &out.triangle_origin);
      for (std::size_t c = 0; c < 3; ++c) s.corners[i][c] = vertex[r->corners[i][c]];
    }
    s.first_moved = static_cast<std::uint32_t>(out.moved.size());
    s.moved_count = r->moved_count;
    for (std::uint32_t i = 0; i < r->moved_count; ++i) {
      const std::uint32_t m = log.moved[r->first_moved + i];
      out.moved.push_back(3 * triangle[m / 3] + m % 3);
    }
    out.splits.push_back(s);
  }
  return out;
}

HistoryCursor::HistoryCursor(const History& history)
    : history_(history), position_(history.base.position), triangles_(history.base.triangles) {
  vertex_count_ = static_cast<std::uint32_t>(position_.size());
  triangle_count_ = static_cast<std::uint32_t>(triangles_.size());
  position_.resize(history.vertex_origin.size());
  triangles_.resize(history.triangle_origin.size());
}

void HistoryCursor::apply(const History::Split& s) {
  position_[s.parent] = s.parent_x;
  position_[vertex_count_] = s.new_x;
  for (std::uint32_t i = 0; i < s.moved_count; ++i) {
    const std::uint32_t m = history_.moved[s.first_moved + i];
    triangles_[m / 3][m % 3] = vertex_count_;
  }
  for (std::uint32_t i = 0; i < s.triangle_count; ++i) triangles_[triangle_count_++] = s.corners[i];
  ++vertex_count_;
}

void HistoryCursor::undo(const History::Split& s) {
  position_[s.parent] = s.coarse;
  for (std::uint32_t i = 0; i < s.moved_count; ++i) {
    const std::uint32_t m = history_.moved[s.first_moved + i];
    triangles_[m / 3][m % 3] = s.parent;
  }
  triangle_count_ -= s.triangle_count;
  --vertex_count_;
}

void HistoryCursor::go_to(std::uint32_t triangles) {
  const auto& splits = history_.splits;
  while (cursor_ > 0 && triangle_count_ > triangles) undo(splits[--cursor_]);
  while (cursor_ < splits.size() && triangle_count_ + splits[cursor_].triangle_count <= triangles)
    apply(splits[cursor_++]);
}

Surface HistoryCursor::surface() const {
  const auto by_origin = [](const std::vector<std::uint32_t>& origin, std::uint32_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return origin[a] < origin[b]; });
    return order;
  };
  Surface out;
  std::vector<std::uint32_t> number(vertex_count_);
  for (const std::uint32_t v : by_origin(history_.vertex_origin, vertex_count_)) {
    number[v] = static_cast<std::uint32_t>(out.position.size());
    out.position.push_back(position_[v]);
  }
  for (const std::uint32_t t : by_origin(history_.triangle_origin, triangle_count_)) {
    const Triangle& c = triangles_[t];
    out.triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
  }
  return out;
}

namespace {

constexpr char kMagic[8] = {'C', 'A', 'R', 'Y', 'H', 'I', 'S', 'T'};
constexpr std::uint32_t kVersion = 1;

struct FileHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t base_vertices, base_triangles;
  std::uint32_t vertices, triangles, splits, moved;
  std::uint32_t base_crc, splits_crc;
  std::uint32_t header_crc;  // Of the 44 bytes before it.
};
static_assert(sizeof(FileHeader) == 48);
static_assert(sizeof(History::Split) == 112 && sizeof(Vec3d) == 24 && sizeof(Triangle) == 12);

template <class T>
void append(std::string* out, const std::vector<T>& items) {
  out->append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

template <class T>
void take(std::string_view* bytes, std::vector<T>* items) {
  if (!items->empty()) std::memcpy(items->data(), bytes->data(), items->size() * sizeof(T));
  bytes->remove_prefix(items->size() * sizeof(T));
}

std::uint32_t crc(std::string_view s) {
  return crc32c(std::as_bytes(std::span(s.data(), s.size())));
}

bool finite(const Vec3d& p) { return std::isfinite(p.x + p.y + p.z); }

bool permutation(const std::vector<std::uint32_t>& ids) {
  std::vector<bool> seen(ids.size(), false);
  for (const std::uint32_t id : ids) {
    if (id >= ids.size() || seen[id]) return false;
    seen[id] = true;
  }
  return true;
}

// Everything that apply() and undo() trust.
const char* fault_of(const History& h) {
  auto vertices = static_cast<std::uint32_t>(h.base.position.size());
  auto triangles = static_cast<std::uint32_t>(h.base.triangles.size());
  const auto below = [](const Triangle& t, std::uint32_t limit) {
    return t[0] < limit && t[1] < limit && t[2] < limit;
  };
  for (const Vec3d& p : h.base.position)
    if (!finite(p)) return "a base position is not a finite number";
  for (const Triangle& t : h.base.triangles)
    if (!below(t, vertices)) return "a base triangle names a vertex that is not there";
  for (const History::Split& s : h.splits) {
    if (s.parent >= vertices) return "a split names a vertex that is not there yet";
    if (s.triangle_count == 0 || s.triangle_count > 2) return "a split adds an odd triangle count";
    if (s.first_moved > h.moved.size() || s.moved_count > h.moved.size() - s.first_moved)
      return "a split reaches past the list of corners";
    if (!finite(s.coarse) || !finite(s.parent_x) || !finite(s.new_x))
      return "a position of a split is not a finite number";
    for (std::uint32_t i = 0; i < s.moved_count; ++i)
      if (h.moved[s.first_moved + i] / 3 >= triangles)
        return "a split names a triangle that is not there yet";
    ++vertices;
    triangles += s.triangle_count;
    if (triangles > h.triangle_origin.size()) return "the splits add more triangles than promised";
    for (std::uint32_t i = 0; i < s.triangle_count; ++i)
      if (!below(s.corners[i], vertices)) return "a new triangle names a vertex that is not there";
  }
  if (vertices != h.vertex_origin.size() || triangles != h.triangle_origin.size())
    return "the splits do not add up to the original";
  if (!permutation(h.vertex_origin) || !permutation(h.triangle_origin))
    return "the original numbering is not one";
  return nullptr;
}

}  // namespace

std::string format_history(const History& h) {
  std::string base, splits;
  append(&base, h.base.position);
  append(&base, h.base.triangles);
  append(&splits, h.splits);
  append(&splits, h.moved);
  append(&splits, h.vertex_origin);
  append(&splits, h.triangle_origin);
  FileHeader header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = kVersion;
  const auto count = [](const auto& items) { return static_cast<std::uint32_t>(items.size()); };
  header.base_vertices = count(h.base.position);
  header.base_triangles = count(h.base.triangles);
  header.vertices = count(h.vertex_origin);
  header.triangles = count(h.triangle_origin);
  header.splits = count(h.splits);
  header.moved = count(h.moved);
  header.base_crc = crc(base);
  header.splits_crc = crc(splits);
  std::string out(sizeof header, '\0');
  std::memcpy(out.data(), &header, sizeof header);
  header.header_crc = crc(std::string_view(out).substr(0, 44));
  std::memcpy(out.data(), &header, sizeof header);
  return out + base + splits;
}

History parse_history(std::string_view bytes, const std::string& name) {
  const auto fail = [&name](const char* what) -> void {
    throw std::runtime_error(name + ": " + what);
  };
  FileHeader header{};
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    fail("this is no history; make one with caryatid-tool simplify --history");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (crc(bytes.substr(0, 44)) != header.header_crc) fail("the header is damaged");
  if (header.version != kVersion) fail("it was written by another version; simplify again");
  const std::uint64_t base_bytes = 24ull * header.base_vertices + 12ull * header.base_triangles;
  const std::uint64_t split_bytes = 112ull * header.splits + 4ull * header.moved +
                                    4ull * header.vertices + 4ull * header.triangles;
  if (bytes.size() - sizeof header != base_bytes + split_bytes)
    fail("the file is not as long as its header says");
  bytes.remove_prefix(sizeof header);
  const auto base_end = static_cast<std::size_t>(base_bytes);  // Within the file, as just seen.
  if (crc(bytes.substr(0, base_end)) != header.base_crc) fail("the base mesh is damaged");
  if (crc(bytes.substr(base_end)) != header.splits_crc) fail("the splits are damaged");
  History h;
  h.base.position.resize(header.base_vertices);
  h.base.triangles.resize(header.base_triangles);
  h.splits.resize(header.splits);
  h.moved.resize(header.moved);
  h.vertex_origin.resize(header.vertices);
  h.triangle_origin.resize(header.triangles);
  take(&bytes, &h.base.position);
  take(&bytes, &h.base.triangles);
  take(&bytes, &h.splits);
  take(&bytes, &h.moved);
  take(&bytes, &h.vertex_origin);
  take(&bytes, &h.triangle_origin);
  if (const char* fault = fault_of(h); fault != nullptr) fail(fault);
  return h;
}

}  // namespace caryatid::bake
