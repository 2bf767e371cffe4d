#include "core/body/bap_table.h"

#include <cassert>
#include <cstring>

namespace caryatid::body {
namespace {

constexpr BapUnit kAngle = BapUnit::angle_1e5_rad, kLength = BapUnit::length_mm;

// name, joint, unit, group, quantiser of visage, of the standard.
// clang-format off
constexpr BapInfo kBaps[kBapCount + 1] = {
    {"", "", BapUnit::none, 0, 1, 1},
    {"sacroiliac_tilt", "sacroiliac", kAngle, 1, 170, 64},
    {"sacroiliac_torsion", "sacroiliac", kAngle, 1, 170, 64},
    {"sacroiliac_roll", "sacroiliac", kAngle, 1, 170, 64},
    {"l_hip_flexion", "l_hip", kAngle, 2, 170, 128},
    {"r_hip_flexion", "r_hip", kAngle, 3, 170, 128},
    {"l_hip_abduct", "l_hip", kAngle, 2, 170, 128},
    {"r_hip_abduct", "r_hip", kAngle, 3, 170, 128},
    {"l_hip_twisting", "l_hip", kAngle, 4, 256, 256},
    {"r_hip_twisting", "r_hip", kAngle, 5, 256, 256},
    {"l_knee_flexion", "l_knee", kAngle, 2, 170, 128},
    {"r_knee_flexion", "r_knee", kAngle, 3, 170, 128},
    {"l_knee_twisting", "l_knee", kAngle, 4, 256, 256},
    {"r_knee_twisting", "r_knee", kAngle, 5, 256, 256},
    {"l_ankle_flexion", "l_ankle", kAngle, 2, 170, 128},
    {"r_ankle_flexion", "r_ankle", kAngle, 3, 170, 128},
    {"l_ankle_twisting", "l_ankle", kAngle, 4, 256, 256},
    {"r_ankle_twisting", "r_ankle", kAngle, 5, 256, 256},
    {"l_subtalar_flexion", "l_subtalar", kAngle, 4, 256, 256},
    {"r_subtalar_flexion", "r_subtalar", kAngle, 5, 256, 256},
    {"l_midtarsal_twisting", "l_midtarsal", kAngle, 4, 256, 256},
    {"r_midtarsal_twisting", "r_midtarsal", kAngle, 5, 256, 256},
    {"l_metatarsal_flexion", "l_metatarsal", kAngle, 4, 256, 256},
    {"r_metatarsal_flexion", "r_metatarsal", kAngle, 5, 256, 256},
    {"l_sternoclavicular_abduct", "l_sternoclavicular", kAngle, 8, 170, 128},
    {"r_sternoclavicular_abduct", "r_sternoclavicular", kAngle, 9, 170, 128},
    {"l_sternoclavicular_rotate", "l_sternoclavicular", kAngle, 8, 170, 128},
    {"r_sternoclavicular_rotate", "r_sternoclavicular", kAngle, 9, 170, 128},
    {"l_acromioclavicular_abduct", "l_acromioclavicular", kAngle, 8, 170, 128},
    {"r_acromioclavicular_abduct", "r_acromioclavicular", kAngle, 9, 170, 128},
    {"l_acromioclavicular_rotate", "l_acromioclavicular", kAngle, 8, 170, 128},
    {"r_acromioclavicular_rotate", "r_acromioclavicular", kAngle, 9, 170, 128},
    {"l_shoulder_flexion", "l_shoulder", kAngle, 6, 170, 64},
    {"r_shoulder_flexion", "r_shoulder", kAngle, 7, 170, 64},
    {"l_shoulder_abduct", "l_shoulder", kAngle, 6, 170, 64},
    {"r_shoulder_abduct", "r_shoulder", kAngle, 7, 170, 64},
    {"l_shoulder_twisting", "l_shoulder", kAngle, 6, 256, 256},
    {"r_shoulder_twisting", "r_shoulder", kAngle, 7, 256, 256},
    {"l_elbow_flexion", "l_elbow", kAngle, 6, 170, 64},
    {"r_elbow_flexion", "r_elbow", kAngle, 7, 170, 64},
    {"l_elbow_twisting", "l_elbow", kAngle, 8, 256, 256},
    {"r_elbow_twisting", "r_elbow", kAngle, 9, 256, 256},
    {"l_wrist_flexion", "l_wrist", kAngle, 6, 170, 128},
    {"r_wrist_flexion", "r_wrist", kAngle, 7, 170, 128},
    {"l_wrist_pivot", "l_wrist", kAngle, 8, 170, 128},
    {"r_wrist_pivot", "r_wrist", kAngle, 9, 170, 128},
    {"l_wrist_twisting", "l_wrist", kAngle, 8, 256, 256},
    {"r_wrist_twisting", "r_wrist", kAngle, 9, 256, 256},
    {"skullbase_roll", "skullbase", kAngle, 10, 170, 128},
    {"skullbase_torsion", "skullbase", kAngle, 10, 170, 128},
    {"skullbase_tilt", "skullbase", kAngle, 10, 170, 128},
    {"vc1_roll", "vc1", kAngle, 14, 256, 256},
    {"vc1_torsion", "vc1", kAngle, 14, 256, 256},
    {"vc1_tilt", "vc1", kAngle, 14, 256, 256},
    {"vc2_roll", "vc2", kAngle, 11, 170, 128},
    {"vc2_torsion", "vc2", kAngle, 11, 170, 128},
    {"vc2_tilt", "vc2", kAngle, 11, 170, 128},
    {"vc3_roll", "vc3", kAngle, 12, 256, 256},
    {"vc3_torsion", "vc3", kAngle, 12, 256, 256},
    {"vc3_tilt", "vc3", kAngle, 12, 256, 256},
    {"vc4_roll", "vc4", kAngle, 10, 170, 128},
    {"vc4_torsion", "vc4", kAngle, 10, 170, 128},
    {"vc4_tilt", "vc4", kAngle, 10, 170, 128},
    {"vc5_roll", "vc5", kAngle, 13, 256, 256},
    {"vc5_torsion", "vc5", kAngle, 13, 256, 256},
    {"vc5_tilt", "vc5", kAngle, 13, 256, 256},
    {"vc6_roll", "vc6", kAngle, 12, 256, 256},
    {"vc6_torsion", "vc6", kAngle, 12, 256, 256},
    {"vc6_tilt", "vc6", kAngle, 12, 256, 256},
    {"vc7_roll", "vc7", kAngle, 13, 256, 256},
    {"vc7_torsion", "vc7", kAngle, 13, 256, 256},
    {"vc7_tilt", "vc7", kAngle, 13, 256, 256},
    {"vt1_roll", "vt1", kAngle, 11, 170, 128},
    {"vt1_torsion", "vt1", kAngle, 11, 170, 128},
    {"vt1_tilt", "vt1", kAngle, 11, 170, 128},
    {"vt2_roll", "vt2", kAngle, 13, 256, 256},
    {"vt2_torsion", "vt2", kAngle, 13, 256, 256},
    {"vt2_tilt", "vt2", kAngle, 13, 256, 256},
    {"vt3_roll", "vt3", kAngle, 14, 256, 256},
    {"vt3_torsion", "vt3", kAngle, 14, 256, 256},
    {"vt3_tilt", "vt3", kAngle, 14, 256, 256},
    {"vt4_roll", "vt4", kAngle, 12, 256, 256},
    {"vt4_torsion", "vt4", kAngle, 12, 256, 256},
    {"vt4_tilt", "vt4", kAngle, 12, 256, 256},
    {"vt5_roll", "vt5", kAngle, 14, 256, 256},
    {"vt5_torsion", "vt5", kAngle, 14, 256, 256},
    {"vt5_tilt", "vt5", kAngle, 14, 256, 256},
    {"vt6_roll", "vt6", kAngle, 10, 170, 128},
    {"vt6_torsion", "vt6", kAngle, 10, 170, 128},
    {"vt6_tilt", "vt6", kAngle, 10, 170, 128},
    {"vt7_roll", "vt7", kAngle, 13, 256, 256},
    {"vt7_torsion", "vt7", kAngle, 13, 256, 256},
    {"vt7_tilt", "vt7", kAngle, 13, 256, 256},
    {"vt8_roll", "vt8", kAngle, 12, 256, 256},
    {"vt8_torsion", "vt8", kAngle, 12, 256, 256},
    {"vt8_tilt", "vt8", kAngle, 12, 256, 256},
    {"vt9_roll", "vt9", kAngle, 14, 256, 256},
    {"vt9_torsion", "vt9", kAngle, 14, 256, 256},
    {"vt9_tilt", "vt9", kAngle, 14, 256, 256},
    {"vt10_roll", "vt10", kAngle, 11, 170, 128},
    {"vt10_torsion", "vt10", kAngle, 11, 170, 128},
    {"vt10_tilt", "vt10", kAngle, 11, 170, 128},
    {"vt11_roll", "vt11", kAngle, 13, 256, 256},
    {"vt11_torsion", "vt11", kAngle, 13, 256, 256},
    {"vt11_tilt", "vt11", kAngle, 13, 256, 256},
    {"vt12_roll", "vt12", kAngle, 12, 256, 256},
    {"vt12_torsion", "vt12", kAngle, 12, 256, 256},
    {"vt12_tilt", "vt12", kAngle, 12, 256, 256},
    {"vl1_roll", "vl1", kAngle, 11, 170, 128},
    {"vl1_torsion", "vl1", kAngle, 11, 170, 128},
    {"vl1_tilt", "vl1", kAngle, 11, 170, 128},
    {"vl2_roll", "vl2", kAngle, 13, 256, 256},
    {"vl2_torsion", "vl2", kAngle, 13, 256, 256},
    {"vl2_tilt", "vl2", kAngle, 13, 256, 256},
    {"vl3_roll", "vl3", kAngle, 10, 170, 128},
    {"vl3_torsion", "vl3", kAngle, 10, 170, 128},
    {"vl3_tilt", "vl3", kAngle, 10, 170, 128},
    {"vl4_roll", "vl4", kAngle, 12, 256, 256},
    {"vl4_torsion", "vl4", kAngle, 12, 256, 256},
    {"vl4_tilt", "vl4", kAngle, 12, 256, 256},
    {"vl5_roll", "vl5", kAngle, 11, 170, 128},
    {"vl5_torsion", "vl5", kAngle, 11, 170, 128},
    {"vl5_tilt", "vl5", kAngle, 11, 170, 128},
    {"l_pinky0_flexion", "l_pinky0", kAngle, 17, 512, 512},
    {"r_pinky0_flexion", "r_pinky0", kAngle, 18, 512, 512},
    {"l_pinky1_flexion", "l_pinky1", kAngle, 15, 170, 128},
    {"r_pinky1_flexion", "r_pinky1", kAngle, 16, 170, 128},
    {"l_pinky1_pivot", "l_pinky1", kAngle, 17, 170, 128},
    {"r_pinky1_pivot", "r_pinky1", kAngle, 18, 170, 128},
    {"l_pinky1_twisting", "l_pinky1", kAngle, 17, 256, 256},
    {"r_pinky1_twisting", "r_pinky1", kAngle, 18, 256, 256},
    {"l_pinky2_flexion", "l_pinky2", kAngle, 15, 170, 128},
    {"r_pinky2_flexion", "r_pinky2", kAngle, 16, 170, 128},
    {"l_pinky3_flexion", "l_pinky3", kAngle, 15, 170, 128},
    {"r_pinky3_flexion", "r_pinky3", kAngle, 16, 170, 128},
    {"l_ring0_flexion", "l_ring0", kAngle, 17, 256, 256},
    {"r_ring0_flexion", "r_ring0", kAngle, 18, 256, 256},
    {"l_ring1_flexion", "l_ring1", kAngle, 15, 170, 128},
    {"r_ring1_flexion", "r_ring1", kAngle, 16, 170, 128},
    {"l_ring1_pivot", "l_ring1", kAngle, 17, 170, 128},
    {"r_ring1_pivot", "r_ring1", kAngle, 18, 170, 128},
    {"l_ring1_twisting", "l_ring1", kAngle, 17, 256, 256},
    {"r_ring1_twisting", "r_ring1", kAngle, 18, 256, 256},
    {"l_ring2_flexion", "l_ring2", kAngle, 15, 170, 128},
    {"r_ring2_flexion", "r_ring2", kAngle, 16, 170, 128},
    {"l_ring3_flexion", "l_ring3", kAngle, 15, 170, 128},
    {"r_ring3_flexion", "r_ring3", kAngle, 16, 170, 128},
    {"l_middle0_flexion", "l_middle0", kAngle, 17, 256, 256},
    {"r_middle0_flexion", "r_middle0", kAngle, 18, 256, 256},
    {"l_middle1_flexion", "l_middle1", kAngle, 15, 170, 128},
    {"r_middle1_flexion", "r_middle1", kAngle, 16, 170, 128},
    {"l_middle1_pivot", "l_middle1", kAngle, 17, 170, 128},
    {"r_middle1_pivot", "r_middle1", kAngle, 18, 170, 128},
    {"l_middle1_twisting", "l_middle1", kAngle, 17, 256, 256},
    {"r_middle1_twisting", "r_middle1", kAngle, 18, 256, 256},
    {"l_middle2_flexion", "l_middle2", kAngle, 15, 170, 128},
    {"r_middle2_flexion", "r_middle2", kAngle, 16, 170, 128},
    {"l_middle3_flexion", "l_middle3", kAngle, 15, 170, 128},
    {"r_middle3_flexion", "r_middle3", kAngle, 16, 170, 128},
    {"l_index0_flexion", "l_index0", kAngle, 17, 256, 256},
    {"r_index0_flexion", "r_index0", kAngle, 18, 256, 256},
    {"l_index1_flexion", "l_index1", kAngle, 15, 170, 128},
    {"r_index1_flexion", "r_index1", kAngle, 16, 170, 128},
    {"l_index1_pivot", "l_index1", kAngle, 17, 170, 128},
    {"r_index1_pivot", "r_index1", kAngle, 18, 170, 128},
    {"l_index1_twisting", "l_index1", kAngle, 17, 256, 256},
    {"r_index1_twisting", "r_index1", kAngle, 18, 256, 256},
    {"l_index2_flexion", "l_index2", kAngle, 15, 170, 128},
    {"r_index2_flexion", "r_index2", kAngle, 16, 170, 128},
    {"l_index3_flexion", "l_index3", kAngle, 15, 170, 128},
    {"r_index3_flexion", "r_index3", kAngle, 16, 170, 128},
    {"l_thumb1_flexion", "l_thumb1", kAngle, 15, 170, 128},
    {"r_thumb1_flexion", "r_thumb1", kAngle, 16, 170, 128},
    {"l_thumb1_pivot", "l_thumb1", kAngle, 15, 170, 128},
    {"r_thumb1_pivot", "r_thumb1", kAngle, 16, 170, 128},
    {"l_thumb1_twisting", "l_thumb1", kAngle, 17, 256, 256},
    {"r_thumb1_twisting", "r_thumb1", kAngle, 18, 256, 256},
    {"l_thumb2_flexion", "l_thumb2", kAngle, 15, 170, 128},
    {"r_thumb2_flexion", "r_thumb2", kAngle, 16, 170, 128},
    {"l_thumb3_flexion", "l_thumb3", kAngle, 15, 170, 128},
    {"r_thumb3_flexion", "r_thumb3", kAngle, 16, 170, 128},
    {"HumanoidRoot_tr_vertical", "HumanoidRoot", kLength, 19, 2, 64},
    {"HumanoidRoot_tr_lateral", "HumanoidRoot", kLength, 19, 2, 64},
    {"HumanoidRoot_tr_frontal", "HumanoidRoot", kLength, 19, 2, 64},
    {"HumanoidRoot_rt_body_turn", "HumanoidRoot", kAngle, 19, 170, 64},
    {"HumanoidRoot_rt_body_roll", "HumanoidRoot", kAngle, 19, 170, 64},
    {"HumanoidRoot_rt_body_tilt", "HumanoidRoot", kAngle, 19, 170, 64},
};
// clang-format on

// Extensions: five groups of 22; both quantisers are 1.
constexpr int kExtensionsPerGroup = 22;
constexpr BapInfo extension(int group) {
  return {"extension_bap", "", BapUnit::none, static_cast<std::uint8_t>(group), 1, 1};
}
constexpr BapInfo kExtensions[] = {extension(20), extension(21), extension(22), extension(23),
                                   extension(24)};

// All BAPs in the order of the stream, and where each group starts in it.
constexpr std::uint16_t kOrder[kBapCountExtended] = {
    1,   2,   3,   4,   6,   10,  14,  5,   7,   11,  15,  8,   12,  16,  18,  20,  22,  9,   13,
    17,  19,  21,  23,  32,  34,  36,  38,  42,  33,  35,  37,  39,  43,  24,  26,  28,  30,  40,
    44,  46,  25,  27,  29,  31,  41,  45,  47,  48,  49,  50,  60,  61,  62,  87,  88,  89,  114,
    115, 116, 54,  55,  56,  72,  73,  74,  99,  100, 101, 108, 109, 110, 120, 121, 122, 57,  58,
    59,  66,  67,  68,  81,  82,  83,  93,  94,  95,  105, 106, 107, 117, 118, 119, 63,  64,  65,
    69,  70,  71,  75,  76,  77,  90,  91,  92,  102, 103, 104, 111, 112, 113, 51,  52,  53,  78,
    79,  80,  84,  85,  86,  96,  97,  98,  125, 131, 133, 137, 143, 145, 149, 155, 157, 161, 167,
    169, 171, 173, 177, 179, 126, 132, 134, 138, 144, 146, 150, 156, 158, 162, 168, 170, 172, 174,
    178, 180, 123, 127, 129, 135, 139, 141, 147, 151, 153, 159, 163, 165, 175, 124, 128, 130, 136,
    140, 142, 148, 152, 154, 160, 164, 166, 176, 181, 182, 183, 184, 185, 186, 187, 188, 189, 190,
    191, 192, 193, 194, 195, 196, 197, 198, 199, 200, 201, 202, 203, 204, 205, 206, 207, 208, 209,
    210, 211, 212, 213, 214, 215, 216, 217, 218, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228,
    229, 230, 231, 232, 233, 234, 235, 236, 237, 238, 239, 240, 241, 242, 243, 244, 245, 246, 247,
    248, 249, 250, 251, 252, 253, 254, 255, 256, 257, 258, 259, 260, 261, 262, 263, 264, 265, 266,
    267, 268, 269, 270, 271, 272, 273, 274, 275, 276, 277, 278, 279, 280, 281, 282, 283, 284, 285,
    286, 287, 288, 289, 290, 291, 292, 293, 294, 295, 296};
constexpr std::uint16_t kGroupStart[kBapGroupCount + 1] = {
    0,   3,   7,   11,  17,  23,  28,  33,  40,  47,  59,  74, 92,
    110, 122, 138, 154, 167, 180, 186, 208, 230, 252, 274, 296};

}  // namespace

const BapInfo& bap_info(int bap) {
  assert(bap >= 1 && bap <= kBapCountExtended);
  if (bap <= kBapCount) return kBaps[bap];
  return kExtensions[(bap - kBapCount - 1) / kExtensionsPerGroup];
}

std::span<const std::uint16_t> bap_group(int group) {
  assert(group >= 1 && group <= kBapGroupCount);
  const std::uint16_t begin = kGroupStart[group - 1];
  return {kOrder + begin, static_cast<std::size_t>(kGroupStart[group] - begin)};
}

int find_bap(const char* name) {
  for (int bap = 1; bap <= kBapCount; ++bap)
    if (std::strcmp(kBaps[bap].name, name) == 0) return bap;
  return 0;
}

}  // namespace caryatid::body
