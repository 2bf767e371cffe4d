#pragma once
// One direction of one FAP as the bake makes it: where every skin vertex is at equal steps from
// neutral to the end of the FAP's reach. Between the steps the FAT is linear.
#include <functional>
#include <vector>

#include "assets/bake/face/head.h"

namespace caryatid::bake::fat {

struct Movement {
  int fap = 0;
  float reach = 0;                        // FAP value of the last frame; the sign is the direction.
  std::vector<std::vector<Vec3>> frames;  // Displacements by skin vertex; frames[k] at
                                          // (k + 1) / size of reach.
  // A correction that is only there while `partner` is away from 0 (full at partner_to).
  int partner = 0;
  float partner_to = 0;
};

// What one direction of a FAP does to an object that is not skin: tongue, irises.
struct PartMove {
  std::uint32_t object = 0;
  pack::Channel channel{};
  std::vector<Move> moves;  // Vertices ascending.
};

// Metres for one unit of the FAP on this head: FAPU / 1024.
float metres_per_unit(const Head& head, int fap);

// Both directions of a FAP from a function of its value in metres along the FAP's axis.
// `displace(amount_m)` gives the field; it is called at every step.
using Field = std::function<std::vector<Vec3>(float amount_m)>;
struct Range {
  float low = 0, high = 0;  // Reach in FAP units.
};
void add_movements(const Head& head, int fap, Range reach, int steps, const Field& displace,
                   std::vector<Movement>& out);

// Weight 1 at the vertex, falling smoothly to 0 at `radius_m`, on the part of the skin that can be
// reached from it within 1.6 radii along edges.
std::vector<float> bump(const Head& head, std::uint32_t at, float radius_m);

// `direction` pressed into the surface at a vertex, scaled so that its part along `direction` stays
// 1; steep places keep at most 1.5 of length.
Vec3 along_surface(Vec3 normal, Vec3 direction);

// Builders by part of the face. `reach` looks up a FAP's range; all throw std::runtime_error when
// the head lacks a feature point.
using ReachOf = std::function<Range(int fap)>;
void add_lids(const Head& head, const ReachOf& reach, std::vector<Movement>& out);
void add_brows(const Head& head, const ReachOf& reach, std::vector<Movement>& out);
void add_lips(const Head& head, const ReachOf& reach, std::vector<Movement>& out);
// How much of a vertex belongs to the lips: 1 on their contours, 0 where no lip FAP reaches. The
// jaw takes the rest, so that jaw and lower lip together move the chin as one.
std::vector<float> lip_share(const Head& head);
void add_jaw(const Head& head, const ReachOf& reach, std::vector<Movement>& out);
void add_bumps(const Head& head, const ReachOf& reach, std::vector<Movement>& out);

}  // namespace caryatid::bake::fat
