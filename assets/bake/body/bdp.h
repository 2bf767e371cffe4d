#pragma once
// Body definition parameters (BDP): the body that a sender describes, as the H-Anim humanoid in
// VRML that an MPEG-4 BDP node carries (bodySceneGraph), and what a terminal makes of it.
#include <string>
#include <string_view>
#include <vector>

#include "assets/bake/model.h"
#include "core/body/hanim.h"

namespace caryatid::bake {

// What is done with a sent body.
enum class BdpProfile : std::uint8_t {
  simple,       // Nothing: body animation drives our own.
  calibration,  // Our body takes on its joint centres: limbs scale, skin and clothes follow.
  predictable,  // It replaces ours: its joints and its own surfaces.
};

struct BodyDefinition {
  std::vector<body::JointCenter> joints;
  // Surfaces that move with one joint, in the space of the standing body.
  struct Segment {
    body::HanimJoint joint = body::HanimJoint::humanoid_root;
    std::vector<Vec3> position_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Vec3 color{0.7f};
  };
  std::vector<Segment> segments;
};

// Reads VRML 97 or X3D classic text: nodes Joint, HAnimJoint or hanim_Joint with name and center;
// beneath them IndexedFaceSet with its points, coordIndex, and the diffuseColor before it. Other
// nodes and all prototypes are passed over. Throws std::runtime_error "FILE:LINE: ..." for brackets
// that do not match, numbers that are none, faces that name no point, a joint named twice, more
// than a million words or no joint at all.
BodyDefinition read_bdp(std::string_view text, const std::string& file_name);

// Calibration: moves skin, clothes, feature points and joints of a built character to the sent
// centres; heads keep their shape and scale with the stature. Call before what is derived from the
// standing figure (soles, face animation, occlusion). Throws std::runtime_error when
// body::calibrate() refuses the centres.
void calibrate_character(const BodyDefinition& sent, Character* character);

// Predictable: a character of the sent joints and surfaces alone, rigid segments. Joints that were
// not sent keep their place beside their parents. Throws std::runtime_error without surfaces.
Character character_of(const BodyDefinition& sent, const std::string& name);

}  // namespace caryatid::bake
