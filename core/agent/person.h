#pragma once
// The person that a pack describes, alive: meshes at their present level of detail, skeleton, face
// tables. Takes the frame's FAPs and BAPs and gives what the scene needs to draw.
//
// Order of a frame: refine() as bytes arrive -> set_levels() or approach() -> show() -> meshes(),
// joints(), collect_patches() for the draw list.
#include <array>
#include <span>

#include "core/base/arena.h"
#include "core/body/pose.h"
#include "core/face/fat.h"
#include "core/face/fit.h"
#include "core/face/move_sum.h"
#include "core/face/transforms.h"
#include "core/face/wrinkles.h"
#include "core/mesh/progressive.h"
#include "core/pack/loader.h"
#include "core/scene/draw_list.h"

namespace caryatid::agent {

class Person {
 public:
  // Bytes that start() takes from the arena at most, the image not counted. O(objects).
  static std::size_t arena_bytes(const pack::View& view);

  // Builds the base level of every object; the pack's base part must be loaded. `view` is copied,
  // its image borrowed. out_of_capacity: the arena is too small. corrupt_data: a base mesh is
  // broken.
  Status start(const pack::View& view, Arena& arena);

  // Takes over splits that have arrived since the last call. corrupt_data: a record is broken; the
  // object stays at the last good level and takes no more. O(new words).
  Status refine(const pack::Loader& loader);

  std::size_t object_count() const { return view_.objects.size(); }
  std::uint32_t triangle_count() const;  // Live, of all objects.
  // Finest level of every object within its number of triangles, at once.
  void set_levels(std::span<const std::uint32_t> triangles);
  // One step towards these levels, of about `max_records` collapse records at most, object by
  // object: at once (duration_s 0) or by geomorphs, of which each object has one at a time. Call
  // every frame; does nothing once they are reached.
  void approach(std::span<const std::uint32_t> triangles, std::uint32_t max_records,
                float duration_s);

  // Deforms and poses. `faps` comes from face::MixJob; `place` moves the posed body in the world.
  // Geomorphs advance by dt_s. O(live vertices + moves + joints).
  void show(const face::FapFrame& faps, const body::BapFrame& baps, const Affine& place,
            float dt_s);

  // How the BAPs given to show() turn joints; signed_axes until told otherwise.
  void set_bap_convention(body::BapConvention convention) { convention_ = convention; }

  // What to draw. Valid until the next call that changes the person.
  std::span<const scene::MeshView> meshes() const { return {mesh_views_.data(), object_count()}; }
  std::span<const Affine> joints() const { return {joints_.data(), view_.joints.size()}; }
  const face::Wrinkles& wrinkles() const { return wrinkles_; }
  // Ranges that changed since the last call, one patch for every object that did.
  void collect_patches(FixedVector<scene::MeshPatch, kMaxObjects>* out);

  const pack::View& view() const { return view_; }
  // Joint centres and soles of this body, for its walk.
  const body::Skeleton& skeleton() const { return skeleton_; }
  const face::FapLimits& limits() const { return limits_; }
  // The calm face beneath every emotion.
  // How this person's face completes a stream that leaves FAPs out; from the pack.
  std::span<const face::FitRule> fit() const { return face::fit_or_default(view_.fit); }
  const face::FapFrame& rest_face() const { return rest_face_; }
  // Where a feature point is now, in the world; rest position when the pack lacks it.
  Vec3 feature_point_m(int group, int index) const;
  // The deformation's inner loop, by what the CPU has; the bits are the same.
  void use(face::SumMoves sum) { sum_moves_ = sum; }
  // Vertices that show() deformed in the last frame, for the cost model.
  std::uint32_t deformed_vertices() const { return deformed_; }
  // Collapse records applied or undone between the last two collect_patches(), for the cost model.
  std::uint32_t records() const { return records_; }

 private:
  struct Part {
    mesh::LiveMesh mesh;
    mesh::MeshSource source;
    mesh::SplitChecker checker;
    mesh::DirtyRange dirty;  // Of the dynamic vertices, by deformation.
    std::uint32_t checked = 0;
    std::uint32_t applied = 0;  // Splits, at the last collect_patches().
    bool broken = false;
    bool deforms = false;  // Has moves at all.
  };

  void pose(const face::FapFrame& faps, const body::BapFrame& baps, const Affine& place);
  void deform(const face::FapFrame& faps);
  void refresh_views();

  pack::View view_;
  std::array<Part, kMaxObjects> parts_;
  std::array<scene::MeshView, kMaxObjects> mesh_views_;
  std::span<std::uint16_t> index_scratch_;
  std::span<float> channel_weights_;
  body::BapConvention convention_ = body::BapConvention::signed_axes;
  body::Skeleton skeleton_;
  std::array<Affine, kMaxJoints> joints_;
  face::FapLimits limits_;
  face::FapFrame rest_face_;
  face::TransformGeometry geometry_;
  face::Wrinkles wrinkles_;
  std::uint32_t deformed_ = 0;
  face::SumMoves sum_moves_ = face::sum_moves;
  std::uint32_t records_ = 0;
};

}  // namespace caryatid::agent
