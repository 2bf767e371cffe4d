#include "assets/bake/pack/quantise.h"

#include <algorithm>
#include <cmath>

namespace caryatid::bake {
namespace {

template <class T>
T rounded(float value, float low, float high) {
  return static_cast<T>(std::lround(std::clamp(value, low, high)));
}

}  // namespace

pack::Vertex quantise(const VertexVersion& v, std::span<const std::uint16_t> palette) {
  pack::Vertex out{};
  for (int i = 0; i < 3; ++i) {
    out.position_m[i] = v.position_m[i];
    out.normal[i] = rounded<std::int8_t>(127.0f * v.normal[i], -127.0f, 127.0f);
  }
  out.normal[3] = rounded<std::int8_t>(127.0f * v.occlusion, 0.0f, 127.0f);
  for (int i = 0; i < 2; ++i)
    out.uv[i] = rounded<std::uint16_t>(65535.0f * v.uv[i], 0.0f, 65535.0f);
  int left = 255;
  std::size_t heaviest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto bone = std::find(palette.begin(), palette.end(), v.influence.joint[i]);
    const bool used = v.influence.weight[i] > 0.0f && bone != palette.end();
    out.bone[i] = used ? static_cast<std::uint8_t>(bone - palette.begin()) : std::uint8_t{0};
    out.weight[i] = used ? rounded<std::uint8_t>(255.0f * v.influence.weight[i], 0.0f, 255.0f)
                         : std::uint8_t{0};
    left -= out.weight[i];
    if (out.weight[i] > out.weight[heaviest]) heaviest = i;
  }
  out.weight[heaviest] = static_cast<std::uint8_t>(std::clamp(out.weight[heaviest] + left, 0, 255));
  return out;
}

pack::Move quantise(const VertexVersion::ChannelMove& move) {
  pack::Move out{};
  out.channel = move.channel;
  for (int i = 0; i < 3; ++i) {
    out.d[i] =
        rounded<std::int16_t>(move.displacement_m[i] / pack::kMoveStep_m, -32767.0f, 32767.0f);
    out.normal[i] = rounded<std::int8_t>(127.0f * move.normal_change[i], -127.0f, 127.0f);
  }
  return out;
}

}  // namespace caryatid::bake
