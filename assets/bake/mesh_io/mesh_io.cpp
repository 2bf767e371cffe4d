#include "assets/bake/mesh_io/mesh_io.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

namespace caryatid::bake {
namespace {

constexpr std::size_t kMaxElements = std::size_t{1} << 30;  // Indices of half-edges are 32-bit.

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw MeshError(name + ":" + std::to_string(line) + ": " + what);
}

// Lines of a text and the words in them.
class Lines {
 public:
  Lines(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}
  bool next() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    if (const std::size_t hash = line_.find('#'); hash != std::string_view::npos)
      line_ = line_.substr(0, hash);
    at_ = end + 1;
    ++number_;
    return true;
  }
  // Next line with a word in it.
  bool next_full() {
    while (next()) {
      const std::string_view keep = line_;
      if (!word().empty()) {
        line_ = keep;
        return true;
      }
    }
    return false;
  }
  std::string_view word() {
    const std::size_t begin = line_.find_first_not_of(" \t\r\v\f");
    if (begin == std::string_view::npos) {
      line_ = {};
      return {};
    }
    const std::size_t end = std::min(line_.find_first_of(" \t\r\v\f", begin), line_.size());
    const std::string_view w = line_.substr(begin, end - begin);
    line_ = line_.substr(end);
    return w;
  }
  double number() {
    const std::string_view w = word();
    double value = 0;
    const char* first = w.data() + (!w.empty() && w[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(first, w.data() + w.size(), value);
    if (error != std::errc{} || end != w.data() + w.size() || !std::isfinite(value))
      fail("\"" + std::string(w.substr(0, 40)) + "\" is not a finite number");
    return value;
  }
  std::int64_t integer(std::string_view w) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error != std::errc{} || end != w.data() + w.size())
      fail("\"" + std::string(w.substr(0, 40)) + "\" is not a whole number");
    return value;
  }
  // A count of things that follow, of at least so many bytes each: on this line, or from the next
  // on.
  std::size_t count(std::size_t least_bytes, bool on_this_line = false) {
    const std::int64_t n = integer(word());
    const std::size_t left =
        on_this_line ? line_.size() : text_.size() - std::min(at_, text_.size());
    if (n < 0 || static_cast<std::size_t>(n) > std::min(kMaxElements, left / least_bytes + 1))
      fail("a count of " + std::to_string(n) + " is more than the file can hold");
    return static_cast<std::size_t>(n);
  }
  [[noreturn]] void fail(const std::string& what) const { bake::fail(name_, number_, what); }
  std::size_t offset() const { return at_; }
  std::size_t line_number() const { return number_; }

 private:
  std::string_view text_, line_;
  std::string name_;
  std::size_t at_ = 0, number_ = 0;
};

void add_polygon(const std::vector<std::uint32_t>& corners, Surface* out) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    out->triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

Surface parse_obj(std::string_view text, const std::string& name) {
  Surface out;
  std::vector<std::size_t> line_of_triangle;  // A face may name vertices that follow it.
  Lines lines(text, name);
  std::vector<std::uint32_t> corners;
  while (lines.next()) {
    const std::string_view keyword = lines.word();
    if (keyword == "v") {
      const double x = lines.number(), y = lines.number(), z = lines.number();
      out.position.push_back({x, y, z});
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view w = lines.word(); !w.empty(); w = lines.word()) {
        std::int64_t i = lines.integer(w.substr(0, w.find('/')));
        if (i < 0) i += static_cast<std::int64_t>(out.position.size()) + 1;
        if (i <= 0 || static_cast<std::size_t>(i) > kMaxElements)
          lines.fail("vertex " + std::string(w) + " is not there; vertices count from 1");
        corners.push_back(static_cast<std::uint32_t>(i - 1));
      }
      if (corners.size() < 3) lines.fail("a face needs at least three vertices");
      add_polygon(corners, &out);
      line_of_triangle.resize(out.triangles.size(), lines.line_number());
    }
  }
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    for (const std::uint32_t v : out.triangles[t])
      if (v >= out.position.size())
        fail(name, line_of_triangle[t],
             "vertex " + std::to_string(v + 1) + " is not there; the file has " +
                 std::to_string(out.position.size()));
  return out;
}

Surface parse_off(std::string_view text, const std::string& name) {
  Surface out;
  Lines lines(text, name);
  if (!lines.next_full()) fail(name, 1, "the file is empty");
  if (const std::string_view magic = lines.word(); magic != "OFF" && magic != "COFF")
    lines.fail("this is no OFF file; its first word must be OFF");
  std::string_view first = lines.word();
  if (first.empty() && !lines.next_full())
    lines.fail("the counts of vertices and faces are missing");
  if (!first.empty()) lines.fail("counts belong on a line of their own; put a line end after OFF");
  const std::size_t vertices = lines.count(6), faces = lines.count(8);
  out.position.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!lines.next_full())
      lines.fail("the file ends before vertex " + std::to_string(v) + " of " +
                 std::to_string(vertices));
    const double x = lines.number(), y = lines.number(), z = lines.number();
    out.position.push_back({x, y, z});
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    if (!lines.next_full())
      lines.fail("the file ends before face " + std::to_string(f) + " of " + std::to_string(faces));
    const std::size_t n = lines.count(2, true);
    corners.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const std::int64_t v = lines.integer(lines.word());
      if (v < 0 || static_cast<std::size_t>(v) >= vertices)
        lines.fail("face " + std::to_string(f) + " names vertex " + std::to_string(v) + " of " +
                   std::to_string(vertices));
      corners.push_back(static_cast<std::uint32_t>(v));
    }
    if (n < 3) lines.fail("face " + std::to_string(f) + " needs at least three vertices");
    add_polygon(corners, &out);
  }
  return out;
}

enum class Ply : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Ply> ply_type(std::string_view w) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (w == names[i][0] || w == names[i][1]) return static_cast<Ply>(i);
  return std::nullopt;
}

struct PlyProperty {
  std::string name;
  Ply type = Ply::float32;
  std::optional<Ply> list;  // Type of the length when it is a list.
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

// Values of the body, from text or binary.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, std::string name, Lines lines, bool text, bool swap)
      : bytes_(bytes), name_(std::move(name)), lines_(std::move(lines)), text_(text), swap_(swap) {}
  void start_element() {
    if (text_ && !lines_.next_full()) fail_short();
  }
  double value(Ply type) {
    if (text_) return lines_.number();
    constexpr std::array<std::size_t, 8> size = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t n = size[static_cast<std::size_t>(type)];
    if (bytes_.size() - at_ < n) fail_short();
    std::array<char, 8> raw{};
    for (std::size_t i = 0; i < n; ++i) raw[swap_ ? n - 1 - i : i] = bytes_[at_ + i];
    at_ += n;
    switch (type) {
      case Ply::int8:
        return as<std::int8_t>(raw);
      case Ply::uint8:
        return as<std::uint8_t>(raw);
      case Ply::int16:
        return as<std::int16_t>(raw);
      case Ply::uint16:
        return as<std::uint16_t>(raw);
      case Ply::int32:
        return as<std::int32_t>(raw);
      case Ply::uint32:
        return as<std::uint32_t>(raw);
      case Ply::float32:
        return static_cast<double>(as<float>(raw));
      case Ply::float64:
        return as<double>(raw);
    }
    return 0;
  }
  // A list's length: no list can be longer than what is left of the file.
  std::size_t length(Ply type) {
    const double n = value(type);
    if (!(n >= 0) || n != std::floor(n) || n > static_cast<double>(bytes_.size()))
      fail("a list has an impossible length");
    return static_cast<std::size_t>(n);
  }
  void set_where(const std::string& element, std::size_t index) {
    element_ = element;
    index_ = index;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw MeshError(name_ + ":" + std::to_string(text_ ? lines_.line_number() : 1) + ": " +
                    element_ + " " + std::to_string(index_) + ": " + what);
  }
  [[noreturn]] void fail_short() const { fail("the file ends before it"); }

 private:
  template <class T>
  static T as(const std::array<char, 8>& raw) {
    T v;
    std::memcpy(&v, raw.data(), sizeof v);
    return v;
  }
  std::string_view bytes_;
  std::string name_, element_;
  Lines lines_;
  bool text_, swap_;
  std::size_t at_ = 0, index_ = 0;
};

void read_ply_element(PlyBody& body, const PlyElement& element, Surface* out) {
  const bool vertex = element.name == "vertex", face = element.name == "face";
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
    body.set_where(element.name, i);
    body.start_element();
    Vec3d p{0};
    corners.clear();
    for (const PlyProperty& property : element.properties) {
      const bool indices = face && property.list &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
      const std::size_t n = property.list ? body.length(*property.list) : 1;
      for (std::size_t k = 0; k < n; ++k) {
        const double v = body.value(property.type);
        if (property.list) {
          if (!indices) continue;
          if (!(v >= 0) || v >= static_cast<double>(out->position.size()) || v != std::floor(v))
            body.fail("it names a vertex that is not there");
          corners.push_back(static_cast<std::uint32_t>(v));
        } else if (property.name.size() == 1 && property.name[0] >= 'x' &&
                   property.name[0] <= 'z') {
          p[property.name[0] - 'x'] = v;
        }
      }
    }
    if (vertex) {
      if (!std::isfinite(p.x + p.y + p.z)) body.fail("its position is not a finite number");
      out->position.push_back(p);
    }
    if (face) {
      if (corners.size() < 3) body.fail("it needs at least three vertices");
      add_polygon(corners, out);
    }
  }
}

Surface parse_ply(std::string_view bytes, const std::string& name) {
  Lines lines(bytes, name);
  if (!lines.next() || lines.word() != "ply") fail(name, 1, "this is no PLY file");
  std::string format;
  std::vector<PlyElement> elements;
  for (bool more = true; more;) {
    if (!lines.next()) lines.fail("the header has no end_header");
    const std::string_view keyword = lines.word();
    if (keyword == "format") {
      format = lines.word();
    } else if (keyword == "element") {
      const std::string element(lines.word());
      elements.push_back({element, lines.count(1), {}});
    } else if (keyword == "property") {
      if (elements.empty()) lines.fail("a property before the first element");
      PlyProperty p;
      std::string_view w = lines.word();
      if (w == "list") {
        p.list = ply_type(lines.word());
        if (!p.list) lines.fail("the type of a list length is unknown");
        w = lines.word();
      }
      const std::optional<Ply> type = ply_type(w);
      if (!type) lines.fail("the type " + std::string(w.substr(0, 40)) + " is unknown");
      p.type = *type;
      p.name = lines.word();
      elements.back().properties.push_back(p);
    } else if (keyword == "end_header") {
      more = false;
    }
  }
  const bool text = format == "ascii";
  if (!text && format != "binary_little_endian" && format != "binary_big_endian")
    lines.fail("the format " + format.substr(0, 40) + " is unknown");
  const bool big = format == "binary_big_endian";
  PlyBody body(bytes.substr(std::min(lines.offset(), bytes.size())), name, lines, text,
               big != (std::endian::native == std::endian::big));
  Surface out;
  for (const PlyElement& element : elements) {
    if (element.properties.empty() && element.count > 0)
      fail(name, 1, "element " + element.name + " has no properties");
    read_ply_element(body, element, &out);
  }
  return out;
}

void append_number(std::string* out, double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out->append(text.data(), end);
}

void append_row(std::string* out, const char* keyword, const Vec3d& p) {
  *out += keyword;
  for (int i = 0; i < 3; ++i) {
    if (i > 0 || *keyword != '\0') *out += ' ';
    append_number(out, p[i]);
  }
  *out += '\n';
}

std::string format_ply(const Surface& s) {
  static_assert(std::endian::native == std::endian::little);
  std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                    std::to_string(s.position.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(s.triangles.size()) +
                    "\nproperty list uchar uint vertex_indices\nend_header\n";
  out.append(reinterpret_cast<const char*>(s.position.data()), s.position.size() * sizeof(Vec3d));
  for (const Triangle& t : s.triangles) {
    out += '\3';
    out.append(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
  return out;
}

}  // namespace

MeshFormat format_of(const std::filesystem::path& path) {
  const std::string e = path.extension().string();
  if (e == ".obj" || e == ".OBJ") return MeshFormat::obj;
  if (e == ".off" || e == ".OFF") return MeshFormat::off;
  if (e == ".ply" || e == ".PLY") return MeshFormat::ply;
  throw MeshError(path.string() + ": the name must end in .obj, .off or .ply");
}

Surface parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name) {
  Surface s = format == MeshFormat::obj   ? parse_obj(bytes, name)
              : format == MeshFormat::off ? parse_off(bytes, name)
                                          : parse_ply(bytes, name);
  if (s.triangles.empty()) fail(name, 1, "the file has no faces");
  if (s.triangles.size() > kMaxElements) fail(name, 1, "the file has too many faces");
  return s;
}

Surface read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  return parse_mesh(read_file(path), format, path.string());
}

std::string format_mesh(const Surface& s, MeshFormat format) {
  if (format == MeshFormat::ply) return format_ply(s);
  const bool obj = format == MeshFormat::obj;
  std::string out;
  if (!obj)
    out = "OFF\n" + std::to_string(s.position.size()) + " " + std::to_string(s.triangles.size()) +
          " 0\n";
  for (const Vec3d& p : s.position) append_row(&out, obj ? "v" : "", p);
  for (const Triangle& t : s.triangles) {
    out += obj ? "f" : "3";
    for (const std::uint32_t v : t) out += " " + std::to_string(obj ? v + 1 : v);
    out += '\n';
  }
  return out;
}

}  // namespace caryatid::bake
