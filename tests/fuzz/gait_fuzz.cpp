// Captured motion of others (BVH, CSV, BAP) and sent bodies (BDP): any bytes end in frames or one
// refusal that names the line, and whatever was read poses a body of finite size and can be
// analysed.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "assets/bake/body/bdp.h"
#include "assets/bake/gait/analyse.h"
#include "core/body/helper_joints.h"
#include "core/body/joint_limits.h"
#include "core/body/pose.h"
#include "core/stream/bap_text.h"

namespace {

using namespace caryatid;

void require(bool ok) {
  if (!ok) std::abort();
}

void analyse(const bake::Motion& motion) {
  for (const bake::MotionFrame& f : motion.frames)
    require(std::isfinite(f.pelvis.x + f.pelvis.y + f.pelvis.z));
  const bake::GaitAnalysis a = bake::analyse_gait(motion);
  require(!a.strides.empty() && !bake::report_json(a).empty());
}

void pose(std::string_view text) {
  stream::BapTextReader reader(text);
  const body::Skeleton s = body::upright_skeleton();
  std::vector<Affine> joints(body::kSkinJointCount);
  body::BapFrame frame;
  for (int i = 0; i < 64 && reader.next(&frame).ok(); ++i)
    for (const auto axes : {body::BapConvention::signed_axes, body::BapConvention::plain_axes}) {
      body::BapFrame limited = frame;
      (void)body::limit_joints(limited, axes);
      for (const body::BapFrame* f : {&frame, &limited}) {
        require(
            body::PoseJob{.skeleton = &s, .baps = f, .convention = axes, .out = joints}.run().ok());
        require(body::pose_helpers(s, joints).ok());
        const Vec3 root = joint_position(s, joints, body::HanimJoint::humanoid_root);
        for (const Affine& j : joints) {
          const Vec3 p = j.point(s.center(body::HanimJoint::l_wrist));
          require(glm::distance(p, root) < 4.0f);  // False for NaN, too.
        }
      }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > 32768) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] == 'v') analyse(bake::motion_of(bake::read_bvh(text, "x.bvh")));
    if (data[0] == 'c') analyse(bake::motion_of_csv(text, "x.csv"));
    if (data[0] == 'b') pose(text);
    if (data[0] == 'd') (void)bake::read_bdp(text, "x.wrl");
  } catch (const std::runtime_error& refusal) {
    require(std::strchr(refusal.what(), '\n') == nullptr);
  }
  return 0;
}
