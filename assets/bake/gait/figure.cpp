#include "assets/bake/gait/figure.h"

#include <cstdio>
#include <sstream>

#include "core/body/pose.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;

constexpr float kScale = 150.0f, kWide = 150.0f, kHigh = 310.0f, kFloor = 285.0f;

class Drawing {
 public:
  void line(Vec2 a, Vec2 b, const char* color, float width) {
    svg_ << "<line x1='" << a.x << "' y1='" << a.y << "' x2='" << b.x << "' y2='" << b.y
         << "' stroke='" << color << "' stroke-width='" << width << "' stroke-linecap='round'/>\n";
  }
  void circle(Vec2 c, float r, const char* color) {
    svg_ << "<circle cx='" << c.x << "' cy='" << c.y << "' r='" << r << "' fill='" << color
         << "'/>\n";
  }
  void text(Vec2 at, const std::string& words) {
    svg_ << "<text x='" << at.x << "' y='" << at.y << "' font-family='sans-serif' font-size='15'>"
         << words << "</text>\n";
  }
  std::string finish(float w, float h) const {
    std::ostringstream out;
    out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << w << "' height='" << h
        << "'><rect width='100%' height='100%' fill='white'/>\n"
        << svg_.str() << "</svg>\n";
    return out.str();
  }

 private:
  std::ostringstream svg_;
};

class Figure {
 public:
  Figure(const body::Skeleton& s, const body::BapFrame& frame, const FigureStrip& strip, Vec2 at)
      : s_(s), view_(strip.view), at_(at), pose_(body::kHanimJointCount) {
    // Turn and travel of the whole body are taken out, its height stays.
    body::BapFrame f = frame;
    f.set(182, 0.0f);
    f.set(183, 0.0f);
    f.set(184, 0.0f);
    const body::PoseJob job{
        .skeleton = &s, .baps = &f, .convention = strip.convention, .out = pose_};
    (void)job.run();
  }
  Vec2 screen(Vec3 p) const {
    return {at_.x + 0.5f * kWide + kScale * (view_ == FigureView::side ? p.z : p.x),
            at_.y + kFloor - kScale * p.y};
  }
  Vec2 at(HanimJoint j) const { return screen(body::joint_position(s_, pose_, j)); }
  Vec2 sole(HanimJoint j, Vec2 zy, bool left) const {
    const float x = s_.center(left ? HanimJoint::l_ankle : HanimJoint::r_ankle).x;
    return screen(pose_[index_of(j)].point({x, zy.y, zy.x}));
  }
  void draw(Drawing& d) const {
    for (const bool left : {false, true}) limbs(d, left);
    const HanimJoint spine[] = {HanimJoint::sacroiliac, HanimJoint::vl3, HanimJoint::vt10,
                                HanimJoint::vt6,        HanimJoint::vt1, HanimJoint::vc4,
                                HanimJoint::skullbase};
    for (std::size_t i = 1; i < std::size(spine); ++i)
      d.line(at(spine[i - 1]), at(spine[i]), "#333", 5);
    const Affine& skull = pose_[index_of(HanimJoint::skullbase)];
    const Vec3 base = s_.center(HanimJoint::skullbase);
    d.circle(screen(skull.point(base + Vec3{0, 0.05f, 0.02f})), 15, "#333");
    d.line(screen(skull.point(base + Vec3{0, 0.03f, 0.10f})),
           screen(skull.point(base + Vec3{0, 0.03f, 0.14f})), "#333", 4);
  }

 private:
  void limbs(Drawing& d, bool left) const {
    const char* color = left ? "#c33" : "#36c";
    const auto j = [&](HanimJoint l) { return at(left ? l : body::mirrored(l)); };
    const auto raw = [&](HanimJoint l) { return left ? l : body::mirrored(l); };
    d.line(at(HanimJoint::sacroiliac), j(HanimJoint::l_hip), color, 4);
    d.line(j(HanimJoint::l_hip), j(HanimJoint::l_knee), color, 6);
    d.line(j(HanimJoint::l_knee), j(HanimJoint::l_ankle), color, 5);
    const body::Sole& sole = s_.sole[left ? 0 : 1];
    const HanimJoint hind = raw(HanimJoint::l_midtarsal), toes = raw(HanimJoint::l_metatarsal);
    const Vec2 ball = sole_point(toes, sole.ball, left);
    d.line(j(HanimJoint::l_ankle), sole_point(hind, sole.heel_back, left), color, 3);
    d.line(sole_point(hind, sole.heel_back, left), sole_point(hind, sole.heel, left), color, 3);
    d.line(sole_point(hind, sole.heel, left), sole_point(hind, sole.ball, left), color, 3);
    d.line(j(HanimJoint::l_ankle), j(HanimJoint::l_metatarsal), color, 3);
    d.line(ball, sole_point(toes, sole.toe, left), color, 3);
    d.line(sole_point(toes, sole.toe, left), sole_point(toes, sole.toe_tip, left), color, 3);
    d.line(at(HanimJoint::vt1), j(HanimJoint::l_shoulder), color, 4);
    d.line(j(HanimJoint::l_shoulder), j(HanimJoint::l_elbow), color, 4);
    d.line(j(HanimJoint::l_elbow), j(HanimJoint::l_wrist), color, 3);
    d.line(j(HanimJoint::l_wrist), j(HanimJoint::l_middle1), color, 3);
    d.line(j(HanimJoint::l_middle1), j(HanimJoint::l_middle3), color, 2);
  }
  Vec2 sole_point(HanimJoint j, Vec2 zy, bool left) const { return sole(j, zy, left); }

  const body::Skeleton& s_;
  FigureView view_;
  Vec2 at_;
  std::vector<Affine> pose_;
};

}  // namespace

std::string figure_svg(const body::Skeleton& skeleton, std::span<const FigureStrip> strips) {
  Drawing d;
  std::size_t most = 1;
  float y = 0.0f;
  for (const FigureStrip& strip : strips) {
    most = std::max(most, strip.frames.size());
    const float width = kWide * static_cast<float>(strip.frames.size());
    d.line({0, y + kFloor}, {width, y + kFloor}, "#999", 1);
    d.text({6, y + 18}, strip.caption);
    for (std::size_t i = 0; i < strip.frames.size(); ++i)
      Figure(skeleton, strip.frames[i], strip, {kWide * static_cast<float>(i), y}).draw(d);
    y += kHigh;
  }
  return d.finish(kWide * static_cast<float>(most), y);
}

}  // namespace caryatid::bake
