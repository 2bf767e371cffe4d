#include "assets/bake/gait/bvh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "core/body/ik.h"

namespace caryatid::bake {
namespace {

constexpr std::size_t kMaxJoints = 512, kMaxDepth = 64, kMaxValues = 20'000'000;

class Tokens {
 public:
  Tokens(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line_) + ": " + what);
  }
  std::string_view next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  bool done() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    return at_ == text_.size();
  }
  void expect(std::string_view word) {
    const std::string_view got = next();
    if (got != word)
      fail("expected " + std::string(word) + ", found '" + std::string(got.substr(0, 40)) +
           "'; is this a whole BVH file?");
  }
  float number() {
    const std::string_view t = next();
    float value = 0.0f;
    const char* begin = t.data() + (t.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, t.data() + t.size(), value);
    if (t.empty()) fail("the file ends where a number should be; it was cut");
    if (error != std::errc{} || end != t.data() + t.size() || !std::isfinite(value) ||
        std::abs(value) > 1e6f)
      fail("'" + std::string(t.substr(0, 40)) + "' is no sensible number");
    return value;
  }
  std::size_t count(std::size_t most, const char* what) {
    const float value = number();
    if (value < 0.0f || value > static_cast<float>(most) || value != std::floor(value))
      fail(std::string("the number of ") + what + " must be 0.." + std::to_string(most));
    return static_cast<std::size_t>(value);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void read_channels(Tokens& in, Bvh& bvh, BvhJoint& joint) {
  joint.first_channel = bvh.channel_count;
  const std::size_t count = in.count(6, "channels");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view name = in.next();
    if (name.size() < 9 || name[0] < 'X' || name[0] > 'Z')
      in.fail("unknown channel '" + std::string(name.substr(0, 40)) + "'");
    const std::string_view kind = name.substr(1);
    if (kind != "rotation" && kind != "position")
      in.fail("unknown channel '" + std::string(name.substr(0, 40)) + "'");
    joint.channels.push_back({kind == "rotation", name[0] - 'X'});
  }
  bvh.channel_count += count;
}

// The block after "ROOT name", "JOINT name" or "End Site".
void read_block(Tokens& in, Bvh& bvh, std::string name, int parent, std::size_t depth) {
  if (depth > kMaxDepth) in.fail("joints are nested too deep");
  if (bvh.joints.size() >= kMaxJoints) in.fail("too many joints");
  in.expect("{");
  const int self = static_cast<int>(bvh.joints.size());
  bvh.joints.push_back({.name = std::move(name), .parent = parent, .offset = {}, .channels = {}});
  for (;;) {
    const std::string_view word = in.next();
    if (word == "}") return;
    if (word == "OFFSET") {
      const float x = in.number(), y = in.number(), z = in.number();
      bvh.joints[static_cast<std::size_t>(self)].offset = {x, y, z};
    } else if (word == "CHANNELS") {
      BvhJoint& joint = bvh.joints[static_cast<std::size_t>(self)];
      if (!joint.channels.empty()) in.fail("a joint has two CHANNELS lines");
      read_channels(in, bvh, joint);
    } else if (word == "JOINT") {
      read_block(in, bvh, std::string(in.next()), self, depth + 1);
    } else if (word == "End") {
      in.expect("Site");
      read_block(in, bvh, "", self, depth + 1);
    } else {
      in.fail("unexpected '" + std::string(word.substr(0, 40)) + "' in the hierarchy");
    }
  }
}

std::string plain(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  std::string out(colon == std::string_view::npos ? name : name.substr(colon + 1));
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

}  // namespace

Bvh read_bvh(std::string_view text, const std::string& file_name) {
  Tokens in(text, file_name);
  Bvh bvh;
  in.expect("HIERARCHY");
  in.expect("ROOT");
  read_block(in, bvh, std::string(in.next()), -1, 0);
  in.expect("MOTION");
  in.expect("Frames:");
  bvh.frame_count = in.count(1'000'000, "frames");
  in.expect("Frame");
  in.expect("Time:");
  bvh.frame_s = in.number();
  if (bvh.frame_s < 1e-3f || bvh.frame_s > 1.0f) in.fail("the frame time must be 0.001..1 s");
  if (bvh.channel_count == 0) in.fail("no joint has channels");
  if (bvh.frame_count * bvh.channel_count > kMaxValues) in.fail("more values than are sensible");
  // Grows with what is there, not with what the header claims.
  for (std::size_t f = 0; f < bvh.frame_count; ++f)
    for (std::size_t c = 0; c < bvh.channel_count; ++c) bvh.values.push_back(in.number());
  if (!in.done()) in.fail("more values than the frames need");
  return bvh;
}

std::vector<Vec3> Bvh::positions(std::size_t frame) const {
  std::vector<Vec3> at(joints.size());
  std::vector<Mat3> turn(joints.size());
  const float* row = values.data() + frame * channel_count;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const BvhJoint& joint = joints[j];
    Vec3 move = joint.offset;
    Mat3 r(1.0f);
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const float value = row[joint.first_channel + c];
      const auto [rotation, axis] = joint.channels[c];
      if (!rotation) {
        move[axis] += value;
        continue;
      }
      const float rad = value * 0.0174532925f;
      r = r * (axis == 0   ? body::rotation_x(rad)
               : axis == 1 ? body::rotation_y(rad)
                           : body::rotation_z(rad));
    }
    const bool root = joint.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : joint.parent);
    at[j] = root ? move : at[p] + turn[p] * move;
    turn[j] = root ? r : turn[p] * r;
  }
  return at;
}

int Bvh::find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names)
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (plain(joints[j].name) == plain(name)) return static_cast<int>(j);
  return -1;
}

}  // namespace caryatid::bake
