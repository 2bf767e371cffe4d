#include "core/body/joint_limits.h"

#include <array>
#include <cstdint>

#include "core/base/trig.h"
#include "core/body/ik.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kMargin = 5.0f * kDegree;

// About the positive axis at rest, degrees; a part of the spine is limited as a whole.
struct Limit {
  HanimJoint first, last;
  Axis axis;
  float low_deg, high_deg;
  bool mirrored;  // The right side's range is the negative of the left's.
};

// Thesis axes: X lateral = x; Y antero-posterior = z; Z along the limb = y (table 4-1). Abduction
// and outward turns are given there for one side; the left limb abducts about +z. Of the hand,
// flexion is about z as palms face the body, and turns add to the forearm's.
constexpr std::array kLimits = {
    Limit{HanimJoint::l_hip, HanimJoint::l_hip, Axis::x, -120, 20, false},
    Limit{HanimJoint::l_hip, HanimJoint::l_hip, Axis::z, -31, 53, true},
    Limit{HanimJoint::l_hip, HanimJoint::l_hip, Axis::y, -30, 31, true},
    Limit{HanimJoint::l_knee, HanimJoint::l_knee, Axis::x, 0, 113, false},
    Limit{HanimJoint::l_ankle, HanimJoint::l_ankle, Axis::x, -35, 38, false},
    Limit{HanimJoint::l_ankle, HanimJoint::l_ankle, Axis::y, -35, 43, true},
    Limit{HanimJoint::l_subtalar, HanimJoint::l_subtalar, Axis::z, -24, 23, true},
    Limit{HanimJoint::l_metatarsal, HanimJoint::l_metatarsal, Axis::x, -45, 10, false},
    Limit{HanimJoint::l_shoulder, HanimJoint::l_shoulder, Axis::x, -188, 61, false},
    Limit{HanimJoint::l_shoulder, HanimJoint::l_shoulder, Axis::z, -48, 134, true},
    Limit{HanimJoint::l_elbow, HanimJoint::l_elbow, Axis::x, -142, 0, false},
    Limit{HanimJoint::l_wrist, HanimJoint::l_wrist, Axis::x, -27, 47, false},
    Limit{HanimJoint::l_wrist, HanimJoint::l_wrist, Axis::z, -99, 90, true},
    Limit{HanimJoint::vl5, HanimJoint::vl1, Axis::x, -17, 29, false},
    Limit{HanimJoint::vl5, HanimJoint::vl1, Axis::z, -18, 18, false},
    Limit{HanimJoint::vl5, HanimJoint::vl1, Axis::y, -6, 6, false},
    Limit{HanimJoint::vt12, HanimJoint::vt7, Axis::x, -12, 24, false},
    Limit{HanimJoint::vt12, HanimJoint::vt7, Axis::z, -25, 25, false},
    Limit{HanimJoint::vt12, HanimJoint::vt7, Axis::y, -6, 6, false},
    Limit{HanimJoint::vt6, HanimJoint::vt1, Axis::x, -5, 10, false},
    Limit{HanimJoint::vt6, HanimJoint::vt1, Axis::z, -20, 20, false},
    Limit{HanimJoint::vt6, HanimJoint::vt1, Axis::y, -31, 31, false},
    Limit{HanimJoint::vc7, HanimJoint::skullbase, Axis::x, -61, 60, false},
    Limit{HanimJoint::vc7, HanimJoint::skullbase, Axis::z, -41, 41, false},
    Limit{HanimJoint::vc7, HanimJoint::skullbase, Axis::y, -79, 79, false}};

// x, or a value that approaches `limit` from kMargin below it on.
float eased(float x, float limit) {
  const float over = x - (limit - kMargin);
  return over <= 0.0f ? x : limit - kMargin * kMargin / (kMargin + over);
}

class Layer {
 public:
  explicit Layer(BapFrame& io) : io_(io) {}

  // Joints first, first + stride, .. last turn about the axis together.
  void apply(std::size_t first, std::size_t last, std::size_t stride, Axis axis, float low,
             float high) {
    float sum = 0.0f;
    for (std::size_t j = first; j <= last; j += stride) sum += turn(j, axis);
    // A range that begins at rest (knee, elbow) eases at its far end only.
    float wanted = low == 0.0f ? (sum < 0.0f ? 0.0f : sum) : -eased(-sum, -low);
    wanted = high == 0.0f ? (wanted > 0.0f ? 0.0f : wanted) : eased(wanted, high);
    const float excess = sum > high ? sum - high : (sum < low ? low - sum : 0.0f);
    if (wanted == sum) return;
    if (excess > 0.0f) ++report_.bitten;
    if (excess > report_.worst_excess_rad) {
      report_.worst_excess_rad = excess;
      report_.worst_bap = turn_bap(static_cast<HanimJoint>(first), axis);
    }
    const bool flat = sum > -1e-6f && sum < 1e-6f;
    for (std::size_t j = first; j <= last; j += stride)
      set_turn(io_, static_cast<HanimJoint>(j), axis, flat ? 0.0f : turn(j, axis) * (wanted / sum));
  }
  const LimitReport& report() const { return report_; }

 private:
  float turn(std::size_t joint, Axis axis) const {
    return get_turn(io_, static_cast<HanimJoint>(joint), axis);
  }
  BapFrame& io_;
  LimitReport report_;
};

}  // namespace

namespace {

// From plain_axes to signed_axes and back.
void flip_signs(BapFrame& io) {
  for (int bap = 1; bap < kFirstTranslationBap; ++bap)
    if (bap_axis(bap).sign < 0) io.value[static_cast<std::size_t>(bap)] *= -1.0f;
}

}  // namespace

LimitReport limit_joints(BapFrame& io, BapConvention convention) {
  constexpr float kWild = 1e8f;  // 1000 rad: sums stay finite.
  for (float& v : io.value) {
    if (!(v == v)) v = 0.0f;
    v = v < -kWild ? -kWild : (v > kWild ? kWild : v);
  }
  const bool plain = convention == BapConvention::plain_axes;
  if (plain) flip_signs(io);
  Layer layer(io);
  for (const Limit& l : kLimits) {
    const std::size_t first = index_of(l.first), last = index_of(l.last);
    const bool paired = mirrored(l.first) != l.first;
    layer.apply(first, last, 1, l.axis, l.low_deg * kDegree, l.high_deg * kDegree);
    if (!paired) continue;
    const std::size_t right = first + 1;
    const float low = l.mirrored ? -l.high_deg : l.low_deg;
    const float high = l.mirrored ? -l.low_deg : l.high_deg;
    layer.apply(right, right, 1, l.axis, low * kDegree, high * kDegree);
  }
  if (plain) flip_signs(io);
  return layer.report();
}

}  // namespace caryatid::body
