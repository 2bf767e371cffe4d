#include "assets/bake/body/bdp.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

namespace caryatid::bake {
namespace {

using body::HanimJoint;

// Words, numbers, strings and brackets of VRML; commas and comments are space.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(name_ + ":" + std::to_string(line_) + ": " + what);
  }
  // Empty at the end.
  std::string_view next() {
    constexpr int kMost = 1'000'000;
    skip_space();
    if (at_ == text_.size()) return {};
    if (++count_ > kMost) fail("more than a million words");
    const std::size_t begin = at_;
    if (text_[at_] == '"') {
      while (++at_ < text_.size() && text_[at_] != '"') line_ += text_[at_] == '\n' ? 1 : 0;
      if (at_ == text_.size()) fail("a string without its end");
      ++at_;
    } else if (is_bracket(text_[at_])) {
      ++at_;
    } else {
      while (at_ < text_.size() && !is_space(text_[at_]) && !is_bracket(text_[at_]) &&
             text_[at_] != '"' && text_[at_] != '#')
        ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }
  float number(std::string_view word) const {
    float v = 0.0f;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), v);
    if (error != std::errc{} || stop != word.data() + word.size() || !(std::abs(v) < 1e6f))
      fail("'" + std::string(word.substr(0, std::min<std::size_t>(40, word.find('\n')))) +
           "' is no sensible number");
    return v;
  }
  float number() { return number(next()); }
  Vec3 vector() {
    const float x = number(), y = number();
    return {x, y, number()};
  }
  // [ 1 2 3 ]
  std::vector<float> numbers() {
    std::vector<float> out;
    if (next() != "[") fail("'[' expected before numbers");
    for (std::string_view word = next(); word != "]"; word = next()) {
      if (word.empty()) fail("']' is missing");
      out.push_back(number(word));
    }
    return out;
  }
  // Past the bracket that closes the one just read.
  void skip_block() {
    for (int depth = 1; depth > 0;) {
      const std::string_view word = next();
      if (word.empty()) fail("a bracket is not closed");
      depth += word == "{" || word == "[" ? 1 : (word == "}" || word == "]" ? -1 : 0);
    }
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
  }
  static bool is_bracket(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }
  void skip_space() {
    for (; at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '#'); ++at_) {
      if (text_[at_] == '#')
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      line_ += text_[at_] == '\n' ? 1 : 0;
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1, count_ = 0;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : words_(text, name) {}

  BodyDefinition read() {
    std::string_view before;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "PROTO" || word == "EXTERNPROTO") {
        skip_prototype(word == "PROTO");
      } else if (word == "{") {
        open_.push_back({before, open_.empty() ? kNone : open_.back().joint});
        named_ = has_center_ = false;
      } else if (word == "}") {
        close();
      } else {
        field(word);
      }
      before = word;
    }
    if (!open_.empty()) words_.fail("'}' is missing");
    if (out_.joints.empty()) words_.fail("no joint; is this an H-Anim humanoid?");
    return std::move(out_);
  }

 private:
  static constexpr HanimJoint kNone = HanimJoint::count;
  struct Node {
    std::string_view type;
    HanimJoint joint;  // That it moves with.
    bool is_joint() const {
      return type == "Joint" || type == "HAnimJoint" || type == "hanim_Joint";
    }
  };

  void skip_prototype(bool has_body) {
    words_.next();
    if (words_.next() != "[") words_.fail("'[' expected after the prototype's name");
    words_.skip_block();
    if (!has_body) return;
    if (words_.next() != "{") words_.fail("'{' expected for the prototype's body");
    words_.skip_block();
  }

  void field(std::string_view word) {
    if (open_.empty()) return;
    Node& node = open_.back();
    if (node.is_joint() && word == "name") {
      name_joint(words_.next());
    } else if (node.is_joint() && word == "center") {
      center_m_ = words_.vector();
      has_center_ = true;
      if (named_) out_.joints.back().center_m = center_m_;
    } else if (word == "diffuseColor") {
      color_ = words_.vector();
    } else if (word == "point" && node.type == "Coordinate") {
      points_ = words_.numbers();
    } else if (word == "coordIndex") {
      indices_ = words_.numbers();
    }
  }

  void name_joint(std::string_view quoted) {
    if (quoted.size() < 2 || quoted.front() != '"') words_.fail("a joint's name is a string");
    const std::string_view name = quoted.substr(1, quoted.size() - 2);
    const auto joint = body::find_hanim_joint(std::span<const char>(name.data(), name.size()));
    if (!joint.ok()) return;  // Of a later version; its parent moves what hangs on it.
    if (!seen_.insert(joint.value).second)
      words_.fail("joint '" + std::string(name) + "' stands twice");
    open_.back().joint = joint.value;
    out_.joints.push_back({joint.value, has_center_ ? center_m_ : Vec3{0}});
    named_ = true;
  }

  void close() {
    if (open_.empty()) words_.fail("'}' without '{'");
    if (open_.back().type == "IndexedFaceSet") add_faces();
    named_ = has_center_ = false;
    open_.pop_back();
  }

  void add_faces() {
    BodyDefinition::Segment segment;
    segment.color = color_;
    if (open_.back().joint != kNone) segment.joint = open_.back().joint;
    for (std::size_t i = 0; i + 2 < points_.size(); i += 3)
      segment.position_m.push_back({points_[i], points_[i + 1], points_[i + 2]});
    std::vector<std::uint32_t> face;
    for (const float index : indices_) {
      if (index >= 0.0f) {
        if (!(index < static_cast<float>(segment.position_m.size())))
          words_.fail("a face names a point that is not there");
        face.push_back(static_cast<std::uint32_t>(index));
        if (face.size() >= 3)
          segment.triangles.push_back({face[0], face[face.size() - 2], face.back()});
      } else {
        face.clear();
      }
    }
    if (!segment.triangles.empty()) out_.segments.push_back(std::move(segment));
    points_.clear();
    indices_.clear();
  }

  Words words_;
  std::vector<Node> open_;
  std::set<HanimJoint> seen_;
  // A centre belongs to the joint whose name stands beside it, before any child.
  bool named_ = false, has_center_ = false;
  Vec3 center_m_{0}, color_{0.7f};
  std::vector<float> points_, indices_;
  BodyDefinition out_;
};

}  // namespace

BodyDefinition read_bdp(std::string_view text, const std::string& file_name) {
  return Reader(text, file_name).read();
}

}  // namespace caryatid::bake
