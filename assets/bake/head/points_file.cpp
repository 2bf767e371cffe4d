#include "assets/bake/head/points_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace caryatid::bake::foreign {
namespace {

constexpr std::size_t kMostShown = 40;  // Characters of the user's text in a message.

// Points a group has, by group.
constexpr std::array<int, 12> kPointsOfGroup = {0, 0, 14, 14, 6, 4, 4, 1, 10, 15, 10, 6};

class Line {
 public:
  Line(std::string_view text, const std::string& name, std::size_t number)
      : text_(text.substr(0, text.find('#'))), name_(name), number_(number) {}

  std::string_view word() {
    const std::size_t begin = text_.find_first_not_of(" \t\r\v\f");
    if (begin == std::string_view::npos) return text_ = {};
    const std::size_t end = std::min(text_.find_first_of(" \t\r\v\f", begin), text_.size());
    const std::string_view w = text_.substr(begin, end - begin);
    text_ = text_.substr(end);
    return w;
  }
  template <class T>
  bool read(std::string_view w, T* out) const {
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), *out);
    return error == std::errc{} && end == w.data() + w.size();
  }
  double number(std::string_view w) const {
    double value = 0;
    if (!read(w, &value) || !std::isfinite(value))
      fail("\"" + shown(w) + "\" is not a finite number; write POINT VERTEX or POINT X Y Z");
    return value;
  }
  static std::string shown(std::string_view w) {
    std::string out(w.substr(0, kMostShown));
    for (char& c : out)
      if (c < ' ' || c > '~') c = '?';
    return out;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(name_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  std::string_view text_;
  const std::string& name_;
  std::size_t number_;
};

PointId read_id(const Line& line, std::string_view w) {
  PointId id;
  const std::size_t dot = w.find('.');
  if (dot == std::string_view::npos || !line.read(w.substr(0, dot), &id.first) ||
      !line.read(w.substr(dot + 1), &id.second))
    line.fail("\"" + Line::shown(w) + "\" is no feature point; write one such as 2.10");
  if (!is_feature_point(id))
    line.fail("the standard has no feature point " + name_of(id) + "; take it out");
  return id;
}

GivenPoint read_point(Line& line, PointId id, std::int64_t first, std::size_t number) {
  GivenPoint point{id, {}, Vec3d(0), number};
  const std::string_view a = line.word(), b = line.word(), c = line.word();
  if (a.empty()) line.fail("point " + name_of(id) + " needs a vertex or x y z");
  if (b.empty()) {
    std::int64_t vertex = 0;
    if (!line.read(a, &vertex))
      line.fail("\"" + Line::shown(a) + "\" is not a vertex number; write a whole number or x y z");
    if (vertex < first || vertex - first > 0xFFFFFFFE)
      line.fail("vertex " + Line::shown(a) + " can't be; vertices count from " +
                std::to_string(first) + " (a line `count 0` or `count 1` changes that)");
    point.vertex = static_cast<std::uint32_t>(vertex - first);
  } else {
    if (c.empty()) line.fail("point " + name_of(id) + " needs one vertex, or x y z");
    point.position = {line.number(a), line.number(b), line.number(c)};
  }
  if (!line.word().empty())
    line.fail("there is more on the line than point " + name_of(id) +
              " needs; start a comment with #");
  return point;
}

}  // namespace

std::string name_of(PointId id) {
  return std::to_string(id.first) + "." + std::to_string(id.second);
}

bool is_feature_point(PointId id) {
  return id.first > 0 && static_cast<std::size_t>(id.first) < kPointsOfGroup.size() &&
         id.second > 0 && id.second <= kPointsOfGroup[static_cast<std::size_t>(id.first)];
}

const GivenPoint* PointList::find(PointId id) const {
  for (const GivenPoint& p : points)
    if (p.id == id) return &p;
  return nullptr;
}

void PointList::fail(const GivenPoint* point, const std::string& what) const {
  throw std::runtime_error(file + (point ? ":" + std::to_string(point->line) : "") + ": " + what);
}

PointList parse_points(std::string_view text, const std::string& name) {
  PointList out{name, {}};
  std::int64_t first = 1;
  for (std::size_t at = 0, number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    Line line(text.substr(at, end - at), name, number);
    at = end + 1;
    const std::string_view w = line.word();
    if (w.empty()) continue;
    if (w == "count") {
      if (!line.read(line.word(), &first) || (first != 0 && first != 1) || !line.word().empty())
        line.fail("vertices count from 0 or from 1; write `count 0` or `count 1`");
      continue;
    }
    const PointId id = read_id(line, w);
    if (const GivenPoint* before = out.find(id))
      line.fail("point " + name_of(id) + " is there already, on line " +
                std::to_string(before->line) + "; take one out");
    out.points.push_back(read_point(line, id, first, number));
  }
  if (out.points.empty())
    throw std::runtime_error(name + ": there is no point in it; write lines such as `3.1 1234`");
  return out;
}

}  // namespace caryatid::bake::foreign
