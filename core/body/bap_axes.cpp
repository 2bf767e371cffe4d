#include "core/body/bap_axes.h"

#include <cassert>

namespace caryatid::body {
namespace {

constexpr Axis x = Axis::x, y = Axis::y, z = Axis::z;

// BAP 1..180 in order (ISO/IEC 14496-2 annex C; axes as decoders read them).
constexpr std::array<BapAxis, 180> kAxes = {{
    {HanimJoint::sacroiliac, x, -1},           // 1 sacroiliac_tilt
    {HanimJoint::sacroiliac, y, +1},           // 2 sacroiliac_torsion
    {HanimJoint::sacroiliac, z, +1},           // 3 sacroiliac_roll
    {HanimJoint::l_hip, x, -1},                // 4 l_hip_flexion
    {HanimJoint::r_hip, x, -1},                // 5 r_hip_flexion
    {HanimJoint::l_hip, z, +1},                // 6 l_hip_abduct
    {HanimJoint::r_hip, z, +1},                // 7 r_hip_abduct
    {HanimJoint::l_hip, y, -1},                // 8 l_hip_twisting
    {HanimJoint::r_hip, y, -1},                // 9 r_hip_twisting
    {HanimJoint::l_knee, x, -1},               // 10 l_knee_flexion
    {HanimJoint::r_knee, x, -1},               // 11 r_knee_flexion
    {HanimJoint::l_knee, y, -1},               // 12 l_knee_twisting
    {HanimJoint::r_knee, y, -1},               // 13 r_knee_twisting
    {HanimJoint::l_ankle, x, -1},              // 14 l_ankle_flexion
    {HanimJoint::r_ankle, x, -1},              // 15 r_ankle_flexion
    {HanimJoint::l_ankle, y, -1},              // 16 l_ankle_twisting
    {HanimJoint::r_ankle, y, -1},              // 17 r_ankle_twisting
    {HanimJoint::l_subtalar, z, +1},           // 18 l_subtalar_flexion
    {HanimJoint::r_subtalar, z, +1},           // 19 r_subtalar_flexion
    {HanimJoint::l_midtarsal, z, +1},          // 20 l_midtarsal_twisting
    {HanimJoint::r_midtarsal, z, +1},          // 21 r_midtarsal_twisting
    {HanimJoint::l_metatarsal, x, -1},         // 22 l_metatarsal_flexion
    {HanimJoint::r_metatarsal, x, -1},         // 23 r_metatarsal_flexion
    {HanimJoint::l_sternoclavicular, z, +1},   // 24 l_sternoclavicular_abduct
    {HanimJoint::r_sternoclavicular, z, +1},   // 25 r_sternoclavicular_abduct
    {HanimJoint::l_sternoclavicular, y, +1},   // 26 l_sternoclavicular_rotate
    {HanimJoint::r_sternoclavicular, y, +1},   // 27 r_sternoclavicular_rotate
    {HanimJoint::l_acromioclavicular, z, +1},  // 28 l_acromioclavicular_abduct
    {HanimJoint::r_acromioclavicular, z, +1},  // 29 r_acromioclavicular_abduct
    {HanimJoint::l_acromioclavicular, y, +1},  // 30 l_acromioclavicular_rotate
    {HanimJoint::r_acromioclavicular, y, +1},  // 31 r_acromioclavicular_rotate
    {HanimJoint::l_shoulder, x, -1},           // 32 l_shoulder_flexion
    {HanimJoint::r_shoulder, x, -1},           // 33 r_shoulder_flexion
    {HanimJoint::l_shoulder, z, +1},           // 34 l_shoulder_abduct
    {HanimJoint::r_shoulder, z, +1},           // 35 r_shoulder_abduct
    {HanimJoint::l_shoulder, y, -1},           // 36 l_shoulder_twisting
    {HanimJoint::r_shoulder, y, -1},           // 37 r_shoulder_twisting
    {HanimJoint::l_elbow, x, -1},              // 38 l_elbow_flexion
    {HanimJoint::r_elbow, x, -1},              // 39 r_elbow_flexion
    {HanimJoint::l_elbow, y, -1},              // 40 l_elbow_twisting
    {HanimJoint::r_elbow, y, -1},              // 41 r_elbow_twisting
    {HanimJoint::l_wrist, z, -1},              // 42 l_wrist_flexion
    {HanimJoint::r_wrist, z, -1},              // 43 r_wrist_flexion
    {HanimJoint::l_wrist, x, -1},              // 44 l_wrist_pivot
    {HanimJoint::r_wrist, x, -1},              // 45 r_wrist_pivot
    {HanimJoint::l_wrist, y, -1},              // 46 l_wrist_twisting
    {HanimJoint::r_wrist, y, -1},              // 47 r_wrist_twisting
    {HanimJoint::skullbase, z, +1},            // 48 skullbase_roll
    {HanimJoint::skullbase, y, +1},            // 49 skullbase_torsion
    {HanimJoint::skullbase, x, -1},            // 50 skullbase_tilt
    {HanimJoint::vc1, z, +1},                  // 51 vc1_roll
    {HanimJoint::vc1, y, +1},                  // 52 vc1_torsion
    {HanimJoint::vc1, x, -1},                  // 53 vc1_tilt
    {HanimJoint::vc2, z, +1},                  // 54 vc2_roll
    {HanimJoint::vc2, y, +1},                  // 55 vc2_torsion
    {HanimJoint::vc2, x, -1},                  // 56 vc2_tilt
    {HanimJoint::vc3, z, +1},                  // 57 vc3_roll
    {HanimJoint::vc3, y, +1},                  // 58 vc3_torsion
    {HanimJoint::vc3, x, -1},                  // 59 vc3_tilt
    {HanimJoint::vc4, z, +1},                  // 60 vc4_roll
    {HanimJoint::vc4, y, +1},                  // 61 vc4_torsion
    {HanimJoint::vc4, x, -1},                  // 62 vc4_tilt
    {HanimJoint::vc5, z, +1},                  // 63 vc5_roll
    {HanimJoint::vc5, y, +1},                  // 64 vc5_torsion
    {HanimJoint::vc5, x, -1},                  // 65 vc5_tilt
    {HanimJoint::vc6, z, +1},                  // 66 vc6_roll
    {HanimJoint::vc6, y, +1},                  // 67 vc6_torsion
    {HanimJoint::vc6, x, -1},                  // 68 vc6_tilt
    {HanimJoint::vc7, z, +1},                  // 69 vc7_roll
    {HanimJoint::vc7, y, +1},                  // 70 vc7_torsion
    {HanimJoint::vc7, x, -1},                  // 71 vc7_tilt
    {HanimJoint::vt1, z, +1},                  // 72 vt1_roll
    {HanimJoint::vt1, y, +1},                  // 73 vt1_torsion
    {HanimJoint::vt1, x, -1},                  // 74 vt1_tilt
    {HanimJoint::vt2, z, +1},                  // 75 vt2_roll
    {HanimJoint::vt2, y, +1},                  // 76 vt2_torsion
    {HanimJoint::vt2, x, -1},                  // 77 vt2_tilt
    {HanimJoint::vt3, z, +1},                  // 78 vt3_roll
    {HanimJoint::vt3, y, +1},                  // 79 vt3_torsion
    {HanimJoint::vt3, x, -1},                  // 80 vt3_tilt
    {HanimJoint::vt4, z, +1},                  // 81 vt4_roll
    {HanimJoint::vt4, y, +1},                  // 82 vt4_torsion
    {HanimJoint::vt4, x, -1},                  // 83 vt4_tilt
    {HanimJoint::vt5, z, +1},                  // 84 vt5_roll
    {HanimJoint::vt5, y, +1},                  // 85 vt5_torsion
    {HanimJoint::vt5, x, -1},                  // 86 vt5_tilt
    {HanimJoint::vt6, z, +1},                  // 87 vt6_roll
    {HanimJoint::vt6, y, +1},                  // 88 vt6_torsion
    {HanimJoint::vt6, x, -1},                  // 89 vt6_tilt
    {HanimJoint::vt7, z, +1},                  // 90 vt7_roll
    {HanimJoint::vt7, y, +1},                  // 91 vt7_torsion
    {HanimJoint::vt7, x, -1},                  // 92 vt7_tilt
    {HanimJoint::vt8, z, +1},                  // 93 vt8_roll
    {HanimJoint::vt8, y, +1},                  // 94 vt8_torsion
    {HanimJoint::vt8, x, -1},                  // 95 vt8_tilt
    {HanimJoint::vt9, z, +1},                  // 96 vt9_roll
    {HanimJoint::vt9, y, +1},                  // 97 vt9_torsion
    {HanimJoint::vt9, x, -1},                  // 98 vt9_tilt
    {HanimJoint::vt10, z, +1},                 // 99 vt10_roll
    {HanimJoint::vt10, y, +1},                 // 100 vt10_torsion
    {HanimJoint::vt10, x, -1},                 // 101 vt10_tilt
    {HanimJoint::vt11, z, +1},                 // 102 vt11_roll
    {HanimJoint::vt11, y, +1},                 // 103 vt11_torsion
    {HanimJoint::vt11, x, -1},                 // 104 vt11_tilt
    {HanimJoint::vt12, z, +1},                 // 105 vt12_roll
    {HanimJoint::vt12, y, +1},                 // 106 vt12_torsion
    {HanimJoint::vt12, x, -1},                 // 107 vt12_tilt
    {HanimJoint::vl1, z, +1},                  // 108 vl1_roll
    {HanimJoint::vl1, y, +1},                  // 109 vl1_torsion
    {HanimJoint::vl1, x, -1},                  // 110 vl1_tilt
    {HanimJoint::vl2, z, +1},                  // 111 vl2_roll
    {HanimJoint::vl2, y, +1},                  // 112 vl2_torsion
    {HanimJoint::vl2, x, -1},                  // 113 vl2_tilt
    {HanimJoint::vl3, z, +1},                  // 114 vl3_roll
    {HanimJoint::vl3, y, +1},                  // 115 vl3_torsion
    {HanimJoint::vl3, x, -1},                  // 116 vl3_tilt
    {HanimJoint::vl4, z, +1},                  // 117 vl4_roll
    {HanimJoint::vl4, y, +1},                  // 118 vl4_torsion
    {HanimJoint::vl4, x, -1},                  // 119 vl4_tilt
    {HanimJoint::vl5, z, +1},                  // 120 vl5_roll
    {HanimJoint::vl5, y, +1},                  // 121 vl5_torsion
    {HanimJoint::vl5, x, -1},                  // 122 vl5_tilt
    {HanimJoint::l_pinky0, z, -1},             // 123 l_pinky0_flexion
    {HanimJoint::r_pinky0, z, +1},             // 124 r_pinky0_flexion
    {HanimJoint::l_pinky1, z, -1},             // 125 l_pinky1_flexion
    {HanimJoint::r_pinky1, z, +1},             // 126 r_pinky1_flexion
    {HanimJoint::l_pinky1, x, -1},             // 127 l_pinky1_pivot
    {HanimJoint::r_pinky1, x, -1},             // 128 r_pinky1_pivot
    {HanimJoint::l_pinky1, y, -1},             // 129 l_pinky1_twisting
    {HanimJoint::r_pinky1, y, -1},             // 130 r_pinky1_twisting
    {HanimJoint::l_pinky2, z, -1},             // 131 l_pinky2_flexion
    {HanimJoint::r_pinky2, z, +1},             // 132 r_pinky2_flexion
    {HanimJoint::l_pinky3, z, -1},             // 133 l_pinky3_flexion
    {HanimJoint::r_pinky3, z, +1},             // 134 r_pinky3_flexion
    {HanimJoint::l_ring0, z, -1},              // 135 l_ring0_flexion
    {HanimJoint::r_ring0, z, +1},              // 136 r_ring0_flexion
    {HanimJoint::l_ring1, z, -1},              // 137 l_ring1_flexion
    {HanimJoint::r_ring1, z, +1},              // 138 r_ring1_flexion
    {HanimJoint::l_ring1, x, -1},              // 139 l_ring1_pivot
    {HanimJoint::r_ring1, x, -1},              // 140 r_ring1_pivot
    {HanimJoint::l_ring1, y, -1},              // 141 l_ring1_twisting
    {HanimJoint::r_ring1, y, -1},              // 142 r_ring1_twisting
    {HanimJoint::l_ring2, z, -1},              // 143 l_ring2_flexion
    {HanimJoint::r_ring2, z, +1},              // 144 r_ring2_flexion
    {HanimJoint::l_ring3, z, -1},              // 145 l_ring3_flexion
    {HanimJoint::r_ring3, z, +1},              // 146 r_ring3_flexion
    {HanimJoint::l_middle0, z, -1},            // 147 l_middle0_flexion
    {HanimJoint::r_middle0, z, +1},            // 148 r_middle0_flexion
    {HanimJoint::l_middle1, z, -1},            // 149 l_middle1_flexion
    {HanimJoint::r_middle1, z, +1},            // 150 r_middle1_flexion
    {HanimJoint::l_middle1, x, -1},            // 151 l_middle1_pivot
    {HanimJoint::r_middle1, x, -1},            // 152 r_middle1_pivot
    {HanimJoint::l_middle1, y, -1},            // 153 l_middle1_twisting
    {HanimJoint::r_middle1, y, -1},            // 154 r_middle1_twisting
    {HanimJoint::l_middle2, z, -1},            // 155 l_middle2_flexion
    {HanimJoint::r_middle2, z, +1},            // 156 r_middle2_flexion
    {HanimJoint::l_middle3, z, -1},            // 157 l_middle3_flexion
    {HanimJoint::r_middle3, z, +1},            // 158 r_middle3_flexion
    {HanimJoint::l_index0, z, -1},             // 159 l_index0_flexion
    {HanimJoint::r_index0, z, +1},             // 160 r_index0_flexion
    {HanimJoint::l_index1, z, -1},             // 161 l_index1_flexion
    {HanimJoint::r_index1, z, +1},             // 162 r_index1_flexion
    {HanimJoint::l_index1, x, -1},             // 163 l_index1_pivot
    {HanimJoint::r_index1, x, -1},             // 164 r_index1_pivot
    {HanimJoint::l_index1, y, -1},             // 165 l_index1_twisting
    {HanimJoint::r_index1, y, -1},             // 166 r_index1_twisting
    {HanimJoint::l_index2, z, -1},             // 167 l_index2_flexion
    {HanimJoint::r_index2, z, +1},             // 168 r_index2_flexion
    {HanimJoint::l_index3, z, -1},             // 169 l_index3_flexion
    {HanimJoint::r_index3, z, +1},             // 170 r_index3_flexion
    {HanimJoint::l_thumb1, x, -1},             // 171 l_thumb1_flexion
    {HanimJoint::r_thumb1, x, -1},             // 172 r_thumb1_flexion
    {HanimJoint::l_thumb1, z, +1},             // 173 l_thumb1_pivot
    {HanimJoint::r_thumb1, z, +1},             // 174 r_thumb1_pivot
    {HanimJoint::l_thumb1, y, -1},             // 175 l_thumb1_twisting
    {HanimJoint::r_thumb1, y, -1},             // 176 r_thumb1_twisting
    {HanimJoint::l_thumb2, x, -1},             // 177 l_thumb2_flexion
    {HanimJoint::r_thumb2, x, -1},             // 178 r_thumb2_flexion
    {HanimJoint::l_thumb3, x, -1},             // 179 l_thumb3_flexion
    {HanimJoint::r_thumb3, x, -1},             // 180 r_thumb3_flexion
}};

constexpr std::array<JointBaps, kHanimJointCount> make_joint_baps() {
  std::array<JointBaps, kHanimJointCount> table{};
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    for (std::int16_t& slot : table[index_of(kAxes[i].joint)].bap)
      if (slot == 0) {
        slot = static_cast<std::int16_t>(i + 1);
        break;
      }
  table[0] = {{184, 185, 186}};
  return table;
}
constexpr std::array<JointBaps, kHanimJointCount> kJointBaps = make_joint_baps();

}  // namespace

BapAxis bap_axis(int bap) {
  assert((bap >= 1 && bap <= 180) || (bap >= kFirstRootTurnBap && bap <= kBapCount));
  if (bap == 184) return {HanimJoint::humanoid_root, y, 1};
  if (bap == 185) return {HanimJoint::humanoid_root, z, 1};
  if (bap == 186) return {HanimJoint::humanoid_root, x, 1};
  return kAxes[static_cast<std::size_t>(bap - 1)];
}

JointBaps joint_baps(HanimJoint joint) { return kJointBaps[index_of(joint)]; }

}  // namespace caryatid::body
