#include "assets/bake/human/repose.h"

#include <cmath>
#include <string>

namespace caryatid::bake {
namespace {

// The smallest turn that brings direction `from` to direction `to`.
Quat turn_between(Vec3 from, Vec3 to) {
  const Vec3 a = glm::normalize(from), b = glm::normalize(to);
  const Vec3 axis = glm::cross(a, b);
  return glm::normalize(Quat{1.0f + glm::dot(a, b), axis.x, axis.y, axis.z});
}

Quat turn_about(Vec3 axis, float angle_rad) {
  const float s = std::sin(0.5f * angle_rad);
  return {std::cos(0.5f * angle_rad), axis.x * s, axis.y * s, axis.z * s};
}

// How far `q` turns about `axis`.
float twist_rad(const Quat& q, Vec3 axis) {
  return 2.0f * std::atan2(glm::dot(Vec3{q.x, q.y, q.z}, axis), q.w);
}

// Turns of single bones; the others take over their parent's.
class Poser {
 public:
  Poser(const BaseHuman& base, std::span<const Vec3> base_m)
      : base_(base), base_m_(base_m), turn_(base.bones().size()), set_(base.bones().size()) {}

  Vec3 head(const std::string& bone) const { return base_.head(base_m_, bone); }
  Vec3 along(const std::string& bone) const { return base_.tail(base_m_, bone) - head(bone); }
  void set(const std::string& bone, const Quat& turn) {
    turn_[base_.bone(bone)] = turn;
    set_[base_.bone(bone)] = true;
  }

  std::vector<BoneMotion> motions() const {
    std::vector<BoneMotion> out(turn_.size());
    std::vector<bool> done(turn_.size());
    for (std::size_t i = 0; i < out.size(); ++i) resolve(i, out, done);
    return out;
  }

 private:
  void resolve(std::size_t i, std::vector<BoneMotion>& out, std::vector<bool>& done) const {
    if (done[i]) return;
    done[i] = true;
    const Bone& bone = base_.bones()[i];
    out[i].head_from_m = out[i].head_to_m = BaseHuman::mean(base_m_, bone.head_vertices);
    if (bone.parent != kNone) {
      resolve(bone.parent, out, done);
      out[i].turn = out[bone.parent].turn;
      out[i].head_to_m = out[bone.parent].point(out[i].head_from_m);
    }
    if (set_[i]) out[i].turn = turn_[i];
  }

  const BaseHuman& base_;
  std::span<const Vec3> base_m_;
  std::vector<Quat> turn_;
  std::vector<bool> set_;
};

// Columns: along the middle finger, towards the thumb, out of the palm's back. `side` +1 left.
Mat3 hand_frame(const Poser& poser, const std::string& s, float side) {
  const Vec3 along = glm::normalize(poser.head("finger3-1." + s) - poser.head("wrist." + s));
  const Vec3 across = poser.head("finger2-1." + s) - poser.head("finger5-1." + s);
  const Vec3 back = glm::normalize(side * glm::cross(across, along));
  return {along, glm::cross(back, along), back};
}

// How a hand hangs: its turn, and the directions along the forearm, towards the thumb and out of
// the back of the hand.
struct Hand {
  Quat turn;
  Vec3 fore, thumb, out;
};

// Fingers side by side and a little bent; the thumb beside them.
void pose_fingers(Poser& poser, const std::string& s, const Hand& hand) {
  for (int finger = 2; finger <= 5; ++finger) {
    const std::string name = "finger" + std::to_string(finger) + "-";
    // Index to little finger fan out by a few degrees.
    const float fan = 0.05f * (3.4f - static_cast<float>(finger));
    Quat turn = hand.turn;
    float bend = 0;
    for (int bone = 1; bone <= 3; ++bone) {
      bend += kFingerCurl_rad[bone - 1];
      const std::string here = name + std::to_string(bone) + "." + s;
      const Vec3 to = std::cos(bend) * (std::cos(fan) * hand.fore + std::sin(fan) * hand.thumb) -
                      std::sin(bend) * hand.out;
      turn = turn_between(turn * poser.along(here), to) * turn;
      poser.set(here, turn);
    }
  }
  const std::string thumb = "finger1-1." + s;
  const Vec3 to = 0.80f * hand.fore + 0.55f * hand.thumb - 0.22f * hand.out;
  poser.set(thumb, turn_between(hand.turn * poser.along(thumb), to) * hand.turn);
}

void pose_arm(Poser& poser, const std::string& s, float side, const ArmHang& hang) {
  const auto hanging = [&](float angle) {
    return Vec3{side * std::sin(angle), -std::cos(angle), 0.0f};
  };
  const Quat clavicle = turn_about({0, 0, 1}, -side * hang.clavicle_drop_rad);
  poser.set("clavicle." + s, clavicle);

  const Vec3 elbow = poser.head("lowerarm01." + s), wrist = poser.head("wrist." + s);
  const Vec3 upper = elbow - poser.head("upperarm01." + s);
  const Quat arm = turn_between(clavicle * upper, hanging(hang.upper_arm_rad)) * clavicle;
  poser.set("upperarm01." + s, arm);

  const Vec3 fore = hanging(hang.forearm_rad);
  const Quat forearm = turn_between(arm * (wrist - elbow), fore) * arm;
  // Fingers down, thumb forward, back of the hand outwards.
  const Mat3 from = hand_frame(poser, s, side);
  const Vec3 out = glm::normalize(Vec3{side, 0, 0} - fore * (side * fore.x));
  const Mat3 to{fore, glm::cross(out, fore), out};
  const Quat hand = glm::normalize(glm::quat_cast(to * glm::transpose(from)));
  // The forearm's two bones wind up towards the hand's twist.
  float twist = twist_rad(hand * glm::conjugate(forearm), fore);
  if (twist > 3.14159265f) twist -= 6.2831853f;
  if (twist < -3.14159265f) twist += 6.2831853f;
  poser.set("lowerarm01." + s, turn_about(fore, 0.25f * twist) * forearm);
  poser.set("lowerarm02." + s, turn_about(fore, 0.65f * twist) * forearm);
  poser.set("wrist." + s, hand);
  pose_fingers(poser, s, {hand, fore, {0, 0, 1}, out});
}

void pose_leg(Poser& poser, const std::string& s, float sole_pitch_rad) {
  constexpr Vec3 kDown{0, -1, 0};
  const Vec3 hip = poser.head("upperleg01." + s), knee = poser.head("lowerleg01." + s);
  const Vec3 ankle = poser.head("foot." + s);
  const Quat thigh = turn_between(knee - hip, kDown);
  poser.set("upperleg01." + s, thigh);
  poser.set("lowerleg01." + s, turn_between(thigh * (ankle - knee), kDown) * thigh);
  // The foot points forward and its sole is levelled; the toes keep their own slope.
  const Vec3 toe = poser.head("toe2-1." + s) - ankle;
  const Quat forward = turn_about({0, 1, 0}, -std::atan2(toe.x, toe.z));
  poser.set("foot." + s, turn_about({1, 0, 0}, -sole_pitch_rad) * forward);
  for (int i = 1; i <= 5; ++i) poser.set("toe" + std::to_string(i) + "-1." + s, forward);
}

}  // namespace

std::vector<BoneMotion> rest_pose_motions(const BaseHuman& base, std::span<const Vec3> base_m,
                                          const ArmHang& hang, float sole_pitch_rad) {
  Poser poser(base, base_m);
  pose_arm(poser, "L", 1.0f, hang);
  pose_arm(poser, "R", -1.0f, hang);
  pose_leg(poser, "L", sole_pitch_rad);
  pose_leg(poser, "R", sole_pitch_rad);
  return poser.motions();
}

void apply_motions(std::span<const BoneMotion> motions, std::span<const Influence> influence,
                   std::span<Vec3> inout_m) {
  for (std::size_t i = 0; i < inout_m.size(); ++i) {
    Quat real{0, 0, 0, 0}, dual{0, 0, 0, 0};
    const Quat& lead = motions[influence[i].joint[0]].turn;
    for (std::size_t k = 0; k < 4; ++k) {
      float w = influence[i].weight[k];
      if (w == 0) continue;
      const BoneMotion& motion = motions[influence[i].joint[k]];
      if (glm::dot(lead, motion.turn) < 0) w = -w;  // The nearer of q and -q.
      const Vec3 t = motion.head_to_m - motion.turn * motion.head_from_m;
      real = real + w * motion.turn;
      dual = dual + (0.5f * w) * (Quat{0, t.x, t.y, t.z} * motion.turn);
    }
    const float length = glm::length(real);
    real = real / length;
    dual = dual / length;
    const Quat t = 2.0f * (dual * glm::conjugate(real));
    inout_m[i] = real * inout_m[i] + Vec3{t.x, t.y, t.z};
  }
}

}  // namespace caryatid::bake
