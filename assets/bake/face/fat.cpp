#include "assets/bake/face/fat.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/bake/face/follow.h"
#include "assets/bake/face/movement.h"
#include "assets/bake/face/pupils.h"
#include "assets/bake/face/tongue.h"
#include "core/face/fat.h"

namespace caryatid::bake {
namespace {

using namespace fat;

constexpr float kLeastMove_m = 5e-6f;        // Below this nothing shows: a pixel is 100 times more.
constexpr float kLeastNormalChange = 0.02f;  // About a degree.
constexpr float kMostNormalChange = 1.0f;    // The pack holds +-1.

Range reach_of(const WorkingRanges& ranges, int fap) {
  const auto i = static_cast<std::size_t>(fap);
  return {ranges.low[i] * face::kReach, ranges.high[i] * face::kReach};
}

pack::Channel channel_of(const Movement& movement, std::size_t step) {
  const auto steps = static_cast<float>(movement.frames.size());
  pack::Channel channel{};
  channel.fap = static_cast<std::uint16_t>(movement.fap);
  channel.from = movement.reach * static_cast<float>(step) / steps;
  channel.to = movement.reach * static_cast<float>(step + 1) / steps;
  channel.partner = static_cast<std::uint16_t>(movement.partner);
  channel.partner_to = movement.partner_to;
  return channel;
}

void add_move(std::vector<Move>& moves, std::uint32_t vertex, Vec3 displacement, Vec3 normal) {
  if (glm::length(displacement) < kLeastMove_m && glm::length(normal) < kLeastNormalChange) return;
  moves.push_back({vertex, displacement, normal});
}

class Tables {
 public:
  Tables(Character& character, const Head& head) : character_(character), head_(head) {
    for (std::size_t o = 0; o < character.objects.size(); ++o) {
      Object& object = character.objects[o];
      object.moves.clear();
      if (object.role == pack::ObjectRole::brow) carriers_[o] = carriers_of_brow(head, object.mesh);
      if (object.role == pack::ObjectRole::lash) carriers_[o] = carriers_of_lash(head, object.mesh);
    }
  }

  void add(const Movement& movement) {
    const std::vector<Vec3> rest(head_.skin.size(), Vec3(0));
    const std::vector<Vec3>* before = &rest;
    std::vector<Vec3> normal_before = head_.normal;
    for (std::size_t k = 0; k < movement.frames.size(); ++k) {
      const std::vector<Vec3>& after = movement.frames[k];
      std::vector<Vec3> normal_after = normals_after(movement, k, normal_before);
      const std::size_t channel = add_channel(channel_of(movement, k));
      for (std::size_t o = 0; o < character_.objects.size(); ++o) {
        Object& object = character_.objects[o];
        std::vector<Move>& moves = object.moves[channel];
        if (object.role == pack::ObjectRole::head)
          move_skin(object.mesh, *before, after, normal_before, normal_after, moves);
        else if (const auto found = carriers_.find(o);
                 found != carriers_.end() && follows(object.role, movement.fap))
          move_part(object.mesh, found->second, *before, after, moves);
      }
      before = &after;
      normal_before = std::move(normal_after);
    }
  }

  // A channel that moves nothing by itself tells the FAP's limits.
  std::size_t add_channel(const pack::Channel& channel) {
    character_.channels.push_back(channel);
    for (Object& object : character_.objects) object.moves.emplace_back();
    return character_.channels.size() - 1;
  }

 private:
  // Shading at the end of an interval. Where FAPs of neighbouring points add up (lips, brows) their
  // changes must too, so theirs is the slope at the start, drawn on; what turns far (jaw, lids)
  // has the true one.
  std::vector<Vec3> normals_after(const Movement& movement, std::size_t k,
                                  const std::vector<Vec3>& normal_before) const {
    const bool turns = movement.fap == 3 || (movement.fap >= 19 && movement.fap <= 22);
    const std::vector<Vec3>& after = movement.frames[k];
    const auto steps = static_cast<float>(movement.frames.size());
    const float part = turns ? 1.0f : 0.15f / steps;
    std::vector<Vec3> place = head_.skin.position_m;
    for (std::size_t v = 0; v < place.size(); ++v) place[v] += part * after[v];
    std::vector<Vec3> out = normals(head_.skin, place);
    if (turns) return out;
    for (std::size_t v = 0; v < out.size(); ++v) {
      Vec3 change = head_.normal[v] + (out[v] - head_.normal[v]) / part - normal_before[v];
      const float length = glm::length(change);
      if (length > kMostNormalChange) change *= kMostNormalChange / length;
      out[v] = normal_before[v] + change;
    }
    return out;
  }

  // Brows lie on bone: no lid takes them along.
  static bool follows(pack::ObjectRole role, int fap) {
    return role != pack::ObjectRole::brow || fap < 19 || fap > 22;
  }

  void move_skin(const Mesh& mesh, const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                 const std::vector<Vec3>& normal_before, const std::vector<Vec3>& normal_after,
                 std::vector<Move>& moves) const {
    for (std::uint32_t i = 0; i < mesh.position_m.size(); ++i) {
      const std::uint32_t base = mesh.base_vertex[i];
      const std::uint32_t v = base == kNone ? kNone : head_.skin.of_base[base];
      if (v == kNone || head_.border[v]) continue;
      add_move(moves, i, after[v] - before[v], normal_after[v] - normal_before[v]);
    }
  }

  void move_part(const Mesh& mesh, const Carriers& carriers, const std::vector<Vec3>& before,
                 const std::vector<Vec3>& after, std::vector<Move>& moves) const {
    for (std::uint32_t i = 0; i < mesh.position_m.size(); ++i) {
      const Vec3 p = mesh.position_m[i];
      add_move(moves, i,
               followed(head_, carriers[i], p, after) - followed(head_, carriers[i], p, before),
               Vec3(0));
    }
  }

  Character& character_;
  const Head& head_;
  std::map<std::size_t, Carriers> carriers_;
};

// Lid rims and lip contours keep their line at every level: eyes and mouth close by them.
void set_loops(const Head& head, Object* skin) {
  constexpr std::uint32_t kLeastOfRim = 16, kLeastOfContour = 20, kLeastOfRed = 16;
  std::map<std::uint32_t, std::uint32_t> of_base;  // One of the vertices of a texture seam will do.
  for (std::uint32_t i = 0; i < skin->mesh.base_vertex.size(); ++i)
    of_base.emplace(skin->mesh.base_vertex[i], i);
  const auto add = [&](const char* name, const std::vector<std::uint32_t>& line,
                       std::uint32_t least) {
    Object::Loop loop{name, {}, least};
    for (const std::uint32_t v : line) {
      // A coarse head's lips have fewer vertices than the grid has columns.
      const std::uint32_t at = of_base.at(head.skin.base[v]);
      if (loop.vertices.empty() || loop.vertices.back() != at) loop.vertices.push_back(at);
    }
    skin->loops.push_back(std::move(loop));
  };
  skin->loops.clear();
  add("left lid rim", head.eye[0].rim, kLeastOfRim);
  add("right lid rim", head.eye[1].rim, kLeastOfRim);
  // Inner and outer contour, and the red between them, or the mouth's shade would reach over it.
  enum Line { inner, red, outer };
  for (const Line which : {inner, red, outer}) {
    std::vector<std::uint32_t> line;
    const auto at = [&](std::size_t side, std::size_t column) {
      const Lips& lips = head.lips[side];
      const bool upper = column <= kLipCorner;
      const std::size_t from = upper ? lips.upper_inner : lips.lower_inner;
      const std::size_t to = upper ? lips.upper_outer : lips.lower_outer;
      return lips.row[which == inner ? from : which == outer ? to : (from + to) / 2][column];
    };
    for (std::size_t c = 0; c < kLipColumns; ++c) line.push_back(at(0, c));
    for (std::size_t c = kLipColumns - 2; c > 0; --c) line.push_back(at(1, c));
    // Around the corners the shade of the mouth must not spread over the cheek.
    if (which != red)
      for (const std::size_t side : {0u, 1u})
        for (const std::uint32_t v : head.skin.neighbours[at(side, kLipCorner)])
          skin->locked.push_back(of_base.at(head.skin.base[v]));
    constexpr const char* kNames[] = {"inner lip contour", "lip red", "outer lip contour"};
    add(kNames[which], line, which == red ? kLeastOfRed : kLeastOfContour);
  }
}

}  // namespace

void build_fat(Character& character, const BaseHuman& base, const WorkingRanges& ranges) {
  build_fat(character, make_head(character, base), ranges);
}

void build_fat(Character& character, const Head& head, const WorkingRanges& ranges) {
  const ReachOf reach = [&](int fap) { return reach_of(ranges, fap); };
  std::vector<Movement> movements;
  add_brows(head, reach, movements);
  add_lids(head, reach, movements);
  add_lips(head, reach, movements);
  add_jaw(head, reach, movements);
  add_bumps(head, reach, movements);
  std::stable_sort(movements.begin(), movements.end(),
                   [](const Movement& a, const Movement& b) { return a.fap < b.fap; });
  for (Object& object : character.objects)
    if (object.role == pack::ObjectRole::head) set_loops(head, &object);
  character.channels.clear();
  Tables tables(character, head);
  for (const Movement& movement : movements) tables.add(movement);
  for (const PartMove& move : tongue_moves(character, head, reach))
    character.objects[move.object].moves[tables.add_channel(move.channel)] = move.moves;
  const std::vector<PartMove> pupils = pupil_moves(character, head, reach);
  for (const PartMove& move : pupils)
    character.objects[move.object].moves[tables.add_channel(move.channel)] = move.moves;
  // Turned, not deformed: eyeballs and head; pupils where there are no eyes.
  for (const auto& [first, last] : {std::pair{23, pupils.empty() ? 30 : 28}, std::pair{48, 50}})
    for (int fap = first; fap <= last; ++fap)
      for (const float end : {reach(fap).low, reach(fap).high})
        if (end != 0.0f)
          tables.add_channel({static_cast<std::uint16_t>(fap), 0, 0.0f, end, 0.0f, 0.0f});
}

}  // namespace caryatid::bake
