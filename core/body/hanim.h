#pragma once
// The skeleton of every body: the joints of H-Anim (ISO/IEC 19774, level of articulation 3) as
// MPEG-4 uses them. Frame: right-handed, metres, +X to the figure's left, +Y up, +Z forward, origin
// on the floor between the feet. Rest pose: standing, arms down, palms to the thighs; all BAPs 0.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/base/vec.h"

namespace caryatid::body {

// In an order where every parent stands before its children; the index of a joint is the same for
// every body, so a skeleton is no more than a table of centres.
enum class HanimJoint : std::uint8_t {
  humanoid_root,
  sacroiliac,
  l_hip,
  r_hip,
  l_knee,
  r_knee,
  l_ankle,
  r_ankle,
  l_subtalar,
  r_subtalar,
  l_midtarsal,
  r_midtarsal,
  l_metatarsal,
  r_metatarsal,
  vl5,
  vl4,
  vl3,
  vl2,
  vl1,
  vt12,
  vt11,
  vt10,
  vt9,
  vt8,
  vt7,
  vt6,
  vt5,
  vt4,
  vt3,
  vt2,
  vt1,
  vc7,
  vc6,
  vc5,
  vc4,
  vc3,
  vc2,
  vc1,
  skullbase,
  l_eyeball_joint,
  r_eyeball_joint,
  l_eyelid_joint,
  r_eyelid_joint,
  l_eyebrow_joint,
  r_eyebrow_joint,
  temporomandibular,
  l_sternoclavicular,
  r_sternoclavicular,
  l_acromioclavicular,
  r_acromioclavicular,
  l_shoulder,
  r_shoulder,
  l_elbow,
  r_elbow,
  l_wrist,
  r_wrist,
  l_thumb1,
  r_thumb1,
  l_thumb2,
  r_thumb2,
  l_thumb3,
  r_thumb3,
  l_index0,
  r_index0,
  l_index1,
  r_index1,
  l_index2,
  r_index2,
  l_index3,
  r_index3,
  l_middle0,
  r_middle0,
  l_middle1,
  r_middle1,
  l_middle2,
  r_middle2,
  l_middle3,
  r_middle3,
  l_ring0,
  r_ring0,
  l_ring1,
  r_ring1,
  l_ring2,
  r_ring2,
  l_ring3,
  r_ring3,
  l_pinky0,
  r_pinky0,
  l_pinky1,
  r_pinky1,
  l_pinky2,
  r_pinky2,
  l_pinky3,
  r_pinky3,
  count
};
inline constexpr std::size_t kHanimJointCount = static_cast<std::size_t>(HanimJoint::count);
static_assert(kHanimJointCount <= kMaxJoints);
constexpr std::size_t index_of(HanimJoint joint) { return static_cast<std::size_t>(joint); }

struct HanimInfo {
  const char* name;                 // H-Anim 1.1 spelling.
  HanimJoint parent;                // HanimJoint::count for the root.
  Vec3 center_m;                    // Of the public default figure, 1.7504 m tall.
  std::uint8_t articulation_level;  // Lowest level of articulation (1..3) that has the joint.
};
const HanimInfo& hanim_info(HanimJoint joint);
inline HanimJoint hanim_parent(HanimJoint joint) { return hanim_info(joint).parent; }

// The joint of that name: H-Anim 1.1 spelling or the snake-case root of ISO 19774.
// invalid_argument when no joint has it.
Result<HanimJoint> find_hanim_joint(std::span<const char> name);

// Outline of a foot sole in the sagittal plane: z and y in rest space (y up from the floor). The
// hind part turns with the ankle, the last two points with the metatarsal joint.
struct Sole {
  Vec2 heel_back{0};  // Stands when the foot is tipped back onto its rounded heel: raised at rest.
  Vec2 heel{0};       // Rearmost point that stands on the floor.
  Vec2 ball{0};       // On the floor beneath the metatarsal joint.
  Vec2 toe{0};        // Foremost point that stands on the floor.
  Vec2 toe_tip{0};    // Stands when the foot is tipped far forward: raised at rest.
};

// One body: joint centres in rest pose and the shape of the soles ([0] left, [1] right).
struct Skeleton {
  std::array<Vec3, kHanimJointCount> center_m{};
  std::array<Sole, 2> sole{};

  Vec3 center(HanimJoint joint) const { return center_m[index_of(joint)]; }
};

// The figure of the standard as published. Its legs are bent at rest (thigh 4 degrees forward,
// shank 14 backward), so a zero pose is no anatomical zero.
Skeleton default_skeleton();
// The same figure on straight legs: hip, knee and ankle on one vertical. Our generic body.
Skeleton upright_skeleton();

// Soles of usual proportions for the given ankles and metatarsals, for bodies whose mesh was not
// measured: heel and toe tip where the sites of the default figure are, scaled by foot length.
void derive_soles(Skeleton& skeleton);

// Finds the soles in the vertices of feet and shoes, which are added one after the other: the
// points on which a foot stands, rolls over its heel and rolls over its toes.
class SoleFitter {
 public:
  // `rest_m` in rest space, anywhere; what is not near the floor does not count.
  void add(Vec3 rest_m);
  // Replaces a side's sole when at least 12 points of it were near the floor.
  void finish(Skeleton& skeleton) const;

 private:
  struct Side {
    std::array<float, 4> height_m{1e9f, 1e9f, 1e9f, 1e9f};  // Of the tangents, at z = 0.
    int count = 0;
  };
  std::array<Side, 2> side_;
};

// A centre as a body definition (BDP) sends it.
struct JointCenter {
  HanimJoint joint = HanimJoint::count;
  Vec3 center_m{0};
};
struct CalibrationReport {
  std::uint16_t given = 0;      // Joints whose centre was sent.
  std::uint16_t derived = 0;    // Joints placed by proportion between those.
  float smallest_scale = 1.0f;  // Of the segments between given joints, new length over old.
  float largest_scale = 1.0f;
};

// Calibration profile: `generic` takes on the given joint centres; joints between and beyond them
// follow by proportion. Errors: invalid_argument, when a joint is named twice or unknown, a number
// is not finite, stature would leave 1.0..2.4 m, or a segment would scale by less than 0.3 or more
// than 3; `out` is then unchanged. Cost: O(joints).
Status calibrate(const Skeleton& generic, std::span<const JointCenter> given, Skeleton& out,
                 CalibrationReport& report);

// Name of left/right pairs: the joint on the other side, or the joint itself on the midline.
HanimJoint mirrored(HanimJoint joint);

}  // namespace caryatid::body
