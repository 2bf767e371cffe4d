#include "core/body/pose.h"

#include "core/base/trig.h"

namespace caryatid::body {
namespace {

constexpr float kRadPerUnit = 1e-5f;
constexpr float kMetrePerUnit = 1e-3f;

// The value within +-limit; 0 for what is not a number.
float tamed(float value, float limit) {
  if (!(value == value)) return 0.0f;
  return value < -limit ? -limit : (value > limit ? limit : value);
}

// m * R(axis, angle): mixes two columns.
void turn(Mat3& m, Axis axis, float angle_rad) {
  const SinCos sc = sin_cos(angle_rad);
  const int a = axis == Axis::x ? 1 : (axis == Axis::y ? 2 : 0);
  const int b = axis == Axis::x ? 2 : (axis == Axis::y ? 0 : 1);
  const Vec3 old_a = m[a];
  m[a] = old_a * sc.cos + m[b] * sc.sin;
  m[b] = m[b] * sc.cos - old_a * sc.sin;
}

// Rotation of one joint by its BAPs; false when it is the identity.
bool joint_rotation(const BapFrame& baps, HanimJoint joint, BapConvention convention, Mat3& out) {
  const JointBaps list = joint_baps(joint);
  const bool reversed = convention == BapConvention::signed_axes_reversed;
  bool any = false;
  for (int i = 0; i < 3; ++i) {
    const int bap = list.bap[reversed ? 2 - i : i];
    if (bap == 0) continue;
    const float value = tamed(baps.get(bap), 1e9f);
    if (value == 0.0f) continue;
    const BapAxis axis = bap_axis(bap);
    const float sign = convention == BapConvention::plain_axes ? 1.0f : float(axis.sign);
    if (!any) out = Mat3(1.0f);
    any = true;
    turn(out, axis.axis, sign * value * kRadPerUnit);
  }
  return any;
}

// T(center) R T(-center), with a translation added.
Affine about(const Mat3& r, Vec3 center, Vec3 translation) {
  const Vec3 t = center - r * center + translation;
  Affine out;
  for (int i = 0; i < 3; ++i) out.row[i] = {r[0][i], r[1][i], r[2][i], t[i]};
  return out;
}

}  // namespace

Status PoseJob::validate() const {
  if (skeleton == nullptr || baps == nullptr) return {Code::invalid_argument};
  if (!extra.empty() && extra.size() != kHanimJointCount) return {Code::invalid_argument};
  if (out.size() < kHanimJointCount) return {Code::out_of_capacity};
  return {};
}

Status PoseJob::run() const {
  CARYATID_TRY(validate());
  const auto translation = [&](int bap) { return tamed(baps->get(bap), 1e6f) * kMetrePerUnit; };
  const Vec3 root_m{translation(182), translation(181), translation(183)};
  for (std::size_t j = 0; j < kHanimJointCount; ++j) {
    const auto joint = static_cast<HanimJoint>(j);
    Mat3 r(1.0f);
    bool any = joint_rotation(*baps, joint, convention, r);
    if (!extra.empty() && extra[j] != Quat(1, 0, 0, 0)) {
      r = r * glm::mat3_cast(extra[j]);
      any = true;
    }
    if (j == 0) {
      out[0] = about(r, skeleton->center_m[0], root_m);
    } else {
      const Affine& parent = out[index_of(hanim_parent(joint))];
      out[j] = any ? parent * about(r, skeleton->center_m[j], Vec3(0.0f)) : parent;
    }
  }
  return {};
}

}  // namespace caryatid::body
