#include "core/body/hanim.h"

#include <cassert>
#include <cstring>

namespace caryatid::body {
namespace {

// Centres: the public X3D example figure "HAnim 1 Specification LOA3" (Beitler, Williams,
// Brutzman, after Badler), metres, stature 1.7504 m.
constexpr std::array<HanimInfo, kHanimJointCount> kJoints = {{
    {"HumanoidRoot", HanimJoint::count, {0.0f, 0.824f, 0.0277f}, 1},
    {"sacroiliac", HanimJoint::humanoid_root, {0.0f, 0.9149f, 0.0016f}, 1},
    {"l_hip", HanimJoint::sacroiliac, {0.0961f, 0.9124f, -0.0001f}, 1},
    {"r_hip", HanimJoint::sacroiliac, {-0.0961f, 0.9124f, -0.0001f}, 1},
    {"l_knee", HanimJoint::l_hip, {0.104f, 0.4867f, 0.0308f}, 1},
    {"r_knee", HanimJoint::r_hip, {-0.104f, 0.4867f, 0.0308f}, 1},
    {"l_ankle", HanimJoint::l_knee, {0.1101f, 0.0656f, -0.0736f}, 1},
    {"r_ankle", HanimJoint::r_knee, {-0.1101f, 0.0656f, -0.0736f}, 1},
    {"l_subtalar", HanimJoint::l_ankle, {0.1086f, 0.0001f, -0.0368f}, 2},
    {"r_subtalar", HanimJoint::r_ankle, {-0.1086f, 0.0001f, -0.0368f}, 2},
    {"l_midtarsal", HanimJoint::l_subtalar, {0.1086f, 0.0001f, 0.0368f}, 1},
    {"r_midtarsal", HanimJoint::r_subtalar, {-0.1086f, 0.0001f, 0.0368f}, 1},
    {"l_metatarsal", HanimJoint::l_midtarsal, {0.1086f, 0.0f, 0.0762f}, 2},
    {"r_metatarsal", HanimJoint::r_midtarsal, {-0.1086f, 0.0f, 0.0762f}, 2},
    {"vl5", HanimJoint::humanoid_root, {0.0028f, 1.0568f, -0.0776f}, 1},
    {"vl4", HanimJoint::vl5, {0.0035f, 1.0925f, -0.0787f}, 3},
    {"vl3", HanimJoint::vl4, {0.0041f, 1.1276f, -0.0796f}, 2},
    {"vl2", HanimJoint::vl3, {0.0045f, 1.1546f, -0.08f}, 3},
    {"vl1", HanimJoint::vl2, {0.0048f, 1.1912f, -0.0805f}, 2},
    {"vt12", HanimJoint::vl1, {0.0051f, 1.2278f, -0.0808f}, 3},
    {"vt11", HanimJoint::vt12, {0.0053f, 1.2679f, -0.081f}, 3},
    {"vt10", HanimJoint::vt11, {0.0056f, 1.2848f, -0.0822f}, 2},
    {"vt9", HanimJoint::vt10, {0.0057f, 1.3126f, -0.0838f}, 3},
    {"vt8", HanimJoint::vt9, {0.0057f, 1.3382f, -0.0845f}, 3},
    {"vt7", HanimJoint::vt8, {0.0058f, 1.3625f, -0.0833f}, 3},
    {"vt6", HanimJoint::vt7, {0.0059f, 1.3866f, -0.08f}, 2},
    {"vt5", HanimJoint::vt6, {0.006f, 1.4102f, -0.0745f}, 3},
    {"vt4", HanimJoint::vt5, {0.0061f, 1.432f, -0.0675f}, 3},
    {"vt3", HanimJoint::vt4, {0.0062f, 1.4583f, -0.057f}, 3},
    {"vt2", HanimJoint::vt3, {0.0063f, 1.4761f, -0.0484f}, 3},
    {"vt1", HanimJoint::vt2, {0.0065f, 1.4951f, -0.0387f}, 2},
    {"vc7", HanimJoint::vt1, {0.0066f, 1.5132f, -0.0301f}, 3},
    {"vc6", HanimJoint::vc7, {0.0066f, 1.5357f, -0.0143f}, 3},
    {"vc5", HanimJoint::vc6, {0.0066f, 1.552f, -0.0082f}, 3},
    {"vc4", HanimJoint::vc5, {0.0066f, 1.5662f, -0.0084f}, 2},
    {"vc3", HanimJoint::vc4, {0.0066f, 1.58f, -0.0103f}, 3},
    {"vc2", HanimJoint::vc3, {0.0066f, 1.5928f, -0.0103f}, 2},
    {"vc1", HanimJoint::vc2, {0.0066f, 1.6144f, -0.0034f}, 3},
    {"skullbase", HanimJoint::vc1, {0.0044f, 1.6209f, 0.0236f}, 1},
    {"l_eyeball_joint", HanimJoint::skullbase, {0.0336f, 1.6332f, 0.0502f}, 3},
    {"r_eyeball_joint", HanimJoint::skullbase, {-0.0336f, 1.6332f, 0.0502f}, 3},
    {"l_eyelid_joint", HanimJoint::skullbase, {0.0336f, 1.6332f, 0.0502f}, 3},
    {"r_eyelid_joint", HanimJoint::skullbase, {-0.0336f, 1.6332f, 0.0502f}, 3},
    {"l_eyebrow_joint", HanimJoint::skullbase, {0.0336f, 1.635f, 0.0506f}, 3},
    {"r_eyebrow_joint", HanimJoint::skullbase, {-0.0336f, 1.635f, 0.0506f}, 3},
    {"temporomandibular", HanimJoint::skullbase, {0.0f, 1.63f, 0.015f}, 3},
    {"l_sternoclavicular", HanimJoint::vt1, {0.082f, 1.4488f, -0.0353f}, 2},
    {"r_sternoclavicular", HanimJoint::vt1, {-0.082f, 1.4488f, -0.0353f}, 2},
    {"l_acromioclavicular", HanimJoint::l_sternoclavicular, {0.0962f, 1.4269f, -0.0424f}, 2},
    {"r_acromioclavicular", HanimJoint::r_sternoclavicular, {-0.0962f, 1.4269f, -0.0424f}, 2},
    {"l_shoulder", HanimJoint::l_acromioclavicular, {0.2029f, 1.4376f, -0.0387f}, 1},
    {"r_shoulder", HanimJoint::r_acromioclavicular, {-0.2029f, 1.4376f, -0.0387f}, 1},
    {"l_elbow", HanimJoint::l_shoulder, {0.2014f, 1.1357f, -0.0682f}, 1},
    {"r_elbow", HanimJoint::r_shoulder, {-0.2014f, 1.1357f, -0.0682f}, 1},
    {"l_wrist", HanimJoint::l_elbow, {0.1984f, 0.8663f, -0.0583f}, 1},
    {"r_wrist", HanimJoint::r_elbow, {-0.1984f, 0.8663f, -0.0583f}, 1},
    {"l_thumb1", HanimJoint::l_wrist, {0.1924f, 0.8472f, -0.0534f}, 2},
    {"r_thumb1", HanimJoint::r_wrist, {-0.1924f, 0.8472f, -0.0534f}, 2},
    {"l_thumb2", HanimJoint::l_thumb1, {0.1951f, 0.8226f, 0.0246f}, 2},
    {"r_thumb2", HanimJoint::r_thumb1, {-0.1951f, 0.8226f, 0.0246f}, 2},
    {"l_thumb3", HanimJoint::l_thumb2, {0.1955f, 0.8159f, 0.0464f}, 2},
    {"r_thumb3", HanimJoint::r_thumb2, {-0.1955f, 0.8159f, 0.0464f}, 2},
    {"l_index0", HanimJoint::l_wrist, {0.1983f, 0.8024f, -0.028f}, 3},
    {"r_index0", HanimJoint::r_wrist, {-0.1983f, 0.8024f, -0.028f}, 3},
    {"l_index1", HanimJoint::l_index0, {0.1983f, 0.7815f, -0.028f}, 2},
    {"r_index1", HanimJoint::r_index0, {-0.1983f, 0.7815f, -0.028f}, 2},
    {"l_index2", HanimJoint::l_index1, {0.2017f, 0.7363f, -0.0248f}, 2},
    {"r_index2", HanimJoint::r_index1, {-0.2017f, 0.7363f, -0.0248f}, 2},
    {"l_index3", HanimJoint::l_index2, {0.2028f, 0.7139f, -0.0236f}, 2},
    {"r_index3", HanimJoint::r_index2, {-0.2028f, 0.7139f, -0.0236f}, 2},
    {"l_middle0", HanimJoint::l_wrist, {0.1987f, 0.8029f, -0.053f}, 3},
    {"r_middle0", HanimJoint::r_wrist, {-0.1987f, 0.8029f, -0.053f}, 3},
    {"l_middle1", HanimJoint::l_middle0, {0.1987f, 0.7818f, -0.053f}, 2},
    {"r_middle1", HanimJoint::r_middle0, {-0.1987f, 0.7818f, -0.053f}, 2},
    {"l_middle2", HanimJoint::l_middle1, {0.2013f, 0.7273f, -0.0503f}, 2},
    {"r_middle2", HanimJoint::r_middle1, {-0.2013f, 0.7273f, -0.0503f}, 2},
    {"l_middle3", HanimJoint::l_middle2, {0.2026f, 0.7011f, -0.0494f}, 2},
    {"r_middle3", HanimJoint::r_middle2, {-0.2026f, 0.7011f, -0.0494f}, 2},
    {"l_ring0", HanimJoint::l_wrist, {0.1956f, 0.8019f, -0.0794f}, 3},
    {"r_ring0", HanimJoint::r_wrist, {-0.1956f, 0.8019f, -0.0794f}, 3},
    {"l_ring1", HanimJoint::l_ring0, {0.1956f, 0.7815f, -0.0794f}, 2},
    {"r_ring1", HanimJoint::r_ring0, {-0.1956f, 0.7815f, -0.0794f}, 2},
    {"l_ring2", HanimJoint::l_ring1, {0.1973f, 0.7287f, -0.0777f}, 2},
    {"r_ring2", HanimJoint::r_ring1, {-0.1973f, 0.7287f, -0.0777f}, 2},
    {"l_ring3", HanimJoint::l_ring2, {0.1983f, 0.7045f, -0.0767f}, 2},
    {"r_ring3", HanimJoint::r_ring2, {-0.1983f, 0.7045f, -0.0767f}, 2},
    {"l_pinky0", HanimJoint::l_wrist, {0.1925f, 0.8066f, -0.1036f}, 3},
    {"r_pinky0", HanimJoint::r_wrist, {-0.1925f, 0.8066f, -0.1036f}, 3},
    {"l_pinky1", HanimJoint::l_pinky0, {0.1925f, 0.7866f, -0.1036f}, 2},
    {"r_pinky1", HanimJoint::r_pinky0, {-0.1925f, 0.7866f, -0.1036f}, 2},
    {"l_pinky2", HanimJoint::l_pinky1, {0.1938f, 0.7452f, -0.1024f}, 2},
    {"r_pinky2", HanimJoint::r_pinky1, {-0.1938f, 0.7452f, -0.1024f}, 2},
    {"l_pinky3", HanimJoint::l_pinky2, {0.1948f, 0.7277f, -0.1017f}, 2},
    {"r_pinky3", HanimJoint::r_pinky2, {-0.1948f, 0.7277f, -0.1017f}, 2},
}};

constexpr bool parents_come_first() {
  for (std::size_t j = 1; j < kHanimJointCount; ++j)
    if (index_of(kJoints[j].parent) >= j) return false;
  return kJoints[0].parent == HanimJoint::count;
}
static_assert(parents_come_first());

bool same(std::span<const char> text, const char* name) {
  return std::strlen(name) == text.size() && std::memcmp(text.data(), name, text.size()) == 0;
}

}  // namespace

const HanimInfo& hanim_info(HanimJoint joint) {
  assert(joint < HanimJoint::count);
  return kJoints[index_of(joint)];
}

Result<HanimJoint> find_hanim_joint(std::span<const char> name) {
  if (same(name, "humanoid_root")) return {{}, HanimJoint::humanoid_root};
  for (std::size_t j = 0; j < kHanimJointCount; ++j)
    if (same(name, kJoints[j].name)) return {{}, static_cast<HanimJoint>(j)};
  return {{Code::invalid_argument}, HanimJoint::count};
}

HanimJoint mirrored(HanimJoint joint) {
  // Pairs stand next to each other, left first.
  const char* name = hanim_info(joint).name;
  const std::size_t j = index_of(joint);
  if (name[0] == 'l' && name[1] == '_') return static_cast<HanimJoint>(j + 1);
  if (name[0] == 'r' && name[1] == '_') return static_cast<HanimJoint>(j - 1);
  return joint;
}

}  // namespace caryatid::body
