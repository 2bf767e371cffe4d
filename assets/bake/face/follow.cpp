#include "assets/bake/face/follow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace caryatid::bake::fat {
namespace {

Carrier nearest(const Head& head, Vec3 p, const std::vector<std::uint32_t>& candidates) {
  std::array<std::pair<float, std::uint32_t>, 4> best;
  best.fill({1e9f, 0});
  for (const std::uint32_t v : candidates) {
    const float d = glm::length(head.skin.position_m[v] - p);
    if (d >= best[3].first) continue;
    best[3] = {d, v};
    std::sort(best.begin(), best.end());
  }
  Carrier carrier;
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    carrier.skin[i] = best[i].second;
    const float d = best[i].first + 2e-4f;
    sum += carrier.weight[i] = best[i].first < 1e8f ? 1.0f / (d * d) : 0.0f;
  }
  for (float& w : carrier.weight) w /= sum;
  return carrier;
}

// Connected parts of a mesh: the label of each vertex. Vertices at one place count as one.
std::vector<std::uint32_t> components(const Mesh& mesh) {
  std::vector<std::uint32_t> label(mesh.position_m.size());
  std::iota(label.begin(), label.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (label[v] != v) v = label[v] = label[label[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 1; i < 3; ++i) label[root(t[i])] = root(t[0]);
  for (std::uint32_t v = 0; v < label.size(); ++v) label[v] = root(v);
  return label;
}

float angle_of(Vec3 p, Vec3 center) { return std::atan2(p.y - center.y, p.z - center.z); }

}  // namespace

Carriers carriers_of_brow(const Head& head, const Mesh& mesh) {
  std::vector<std::uint32_t> outside;
  for (std::uint32_t v = 0; v < head.skin.size(); ++v)
    if (!head.eye[0].inside[v] && !head.eye[1].inside[v]) outside.push_back(v);
  Carriers out;
  for (const Vec3& p : mesh.position_m) out.push_back(nearest(head, p, outside));
  return out;
}

Carriers carriers_of_lash(const Head& head, const Mesh& mesh) {
  const std::vector<std::uint32_t> part = components(mesh);
  // A strip of lashes belongs to the lid that its closest vertex touches.
  struct Owner {
    float distance_m = 1e9f;
    int eye = 0;
    bool upper = true;
  };
  std::vector<Owner> owner(mesh.position_m.size());
  for (std::uint32_t i = 0; i < part.size(); ++i)
    for (int e = 0; e < kSides; ++e)
      for (const bool upper : {true, false}) {
        const Eye& eye = head.eye[static_cast<std::size_t>(e)];
        for (const std::uint32_t v : upper ? eye.upper : eye.lower) {
          const float d = glm::length(head.skin.position_m[v] - mesh.position_m[i]);
          if (d < owner[part[i]].distance_m) owner[part[i]] = {d, e, upper};
        }
      }
  Carriers out;
  for (std::uint32_t i = 0; i < part.size(); ++i) {
    const Owner& of = owner[part[i]];
    const Eye& eye = head.eye[static_cast<std::size_t>(of.eye)];
    // Beside it along X: tips stand far from the rim.
    const auto& rim = of.upper ? eye.upper : eye.lower;
    const float x = mesh.position_m[i].x;
    std::size_t right = 0;
    while (right < rim.size() && head.skin.position_m[rim[right]].x < x) ++right;
    const std::size_t a = right == 0 ? 0 : right - 1;
    const std::size_t b = std::min(right, rim.size() - 1);
    const float xa = head.skin.position_m[rim[a]].x, xb = head.skin.position_m[rim[b]].x;
    const float t = xb > xa ? std::clamp((x - xa) / (xb - xa), 0.0f, 1.0f) : 0.0f;
    Carrier carrier;
    carrier.skin = {rim[a], rim[b], rim[a], rim[a]};
    carrier.weight = {1.0f - t, t, 0.0f, 0.0f};
    carrier.eye = of.eye;
    out.push_back(carrier);
  }
  return out;
}

Vec3 followed(const Head& head, const Carrier& carrier, Vec3 position_m,
              const std::vector<Vec3>& displacement) {
  Vec3 shift{0};
  for (std::size_t i = 0; i < 4; ++i) shift += carrier.weight[i] * displacement[carrier.skin[i]];
  if (carrier.eye < 0) return shift;
  // A lash turns with its rim about the eyeball's axis and keeps its distance from the rim.
  const Vec3 center = head.eye[static_cast<std::size_t>(carrier.eye)].center_m;
  Vec3 root{0};
  for (std::size_t i = 0; i < 4; ++i)
    root += carrier.weight[i] * head.skin.position_m[carrier.skin[i]];
  const float turn = angle_of(root + shift, center) - angle_of(root, center);
  const Vec3 arm = position_m - root;
  const float c = std::cos(turn), s = std::sin(turn);
  const Vec3 turned{arm.x, c * arm.y + s * arm.z, c * arm.z - s * arm.y};
  return shift + turned - arm;
}

}  // namespace caryatid::bake::fat
