#include "tests/golden/sample_pack.h"

#include <cmath>

#include "core/base/trig.h"
#include "core/scene/camera.h"

namespace caryatid::golden {
namespace {

constexpr std::uint32_t kColumns = 32, kRows = 20, kTextureSize = 16;

template <class T>
void append(std::vector<std::byte>& out, const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

// Warm squares, 565: no alpha.
std::uint16_t warm(std::uint32_t x, std::uint32_t y) {
  return ((x / 4 + y / 4) & 1u) != 0 ? 0xDD2Eu : 0xC46Bu;
}
// Brown stripes, 4444, whose alpha falls off towards their edges.
std::uint16_t stripes(std::uint32_t x, std::uint32_t) {
  constexpr std::uint16_t kAlpha[4] = {2, 9, 15, 6};
  return static_cast<std::uint16_t>(0x8640u | kAlpha[x & 3u]);
}

template <class F>
pack::Texture add_plain(std::vector<std::byte>& texels, pack::TextureFormat format, F texel) {
  pack::Texture t{
      kTextureSize, kTextureSize, format, 5, static_cast<std::uint32_t>(texels.size()), 0, 2};
  for (std::uint32_t size = kTextureSize, step = 1; size > 0; size /= 2, step *= 2)
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t x = 0; x < size; ++x) append(texels, texel(x * step, y * step));
  t.texel_bytes = static_cast<std::uint32_t>(texels.size()) - t.texel_offset;
  return t;
}

// Individual mode; both halves one colour, modifiers of codeword 0, rows alternate.
pack::Texture add_etc1(std::vector<std::byte>& texels) {
  pack::Texture t{kTextureSize,
                  kTextureSize,
                  pack::TextureFormat::etc1,
                  5,
                  static_cast<std::uint32_t>(texels.size()),
                  0,
                  2};
  for (std::uint32_t size = kTextureSize; size > 0; size /= 2)
    for (std::uint32_t block = 0; block < ((size + 3) / 4) * ((size + 3) / 4); ++block) {
      const std::uint8_t bytes[8] = {0x44, 0x66, 0x99, 0x24, 0xAA, 0xAA, 0x55, 0x55};
      for (const std::uint8_t b : bytes) append(texels, b);
    }
  t.texel_bytes = static_cast<std::uint32_t>(texels.size()) - t.texel_offset;
  return t;
}

std::int8_t snorm(float x) { return static_cast<std::int8_t>(std::lround(127.0f * x)); }
std::uint16_t unorm(float x) { return static_cast<std::uint16_t>(std::lround(65535.0f * x)); }

}  // namespace

SamplePack::SamplePack() {
  add_textures();
  for (std::uint32_t r = 0; r <= kRows; ++r)
    for (std::uint32_t c = 0; c <= kColumns; ++c) {
      const float u = static_cast<float>(c) / kColumns, v = static_cast<float>(r) / kRows;
      fixed_.push_back({{unorm(u), unorm(v)}, {0, 1, 0, 0}, {0, 0, 0, 0}});
      // The left half hangs on bone 0, the right one on bone 1, with a soft border.
      const float right = 0.5f + 0.5f * std::clamp(4.0f * cos_of(2.0f * kPi * u), -1.0f, 1.0f);
      fixed_.back().weight[1] = static_cast<std::uint8_t>(std::lround(255.0f * right));
      fixed_.back().weight[0] = static_cast<std::uint8_t>(255 - fixed_.back().weight[1]);
    }
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::uint32_t a = r * (kColumns + 1) + c, b = a + kColumns + 1;
      for (const std::uint32_t i : {a, a + 1, b, a + 1, b + 1, b})
        indices_.push_back(static_cast<std::uint16_t>(i));
    }
  for (int kind = 0; kind < 6; ++kind) {
    const float x = static_cast<float>(kind % 3 - 1), y = kind < 3 ? 0.5f : -0.5f;
    add_sphere(static_cast<pack::MaterialKind>(kind), {x, y, 0});
  }
  view_.textures = textures_;
  view_.texels = texels_;
  view_.materials = materials_;
  view_.objects = objects_;
  compose();
}

void SamplePack::add_textures() {
  textures_.push_back(add_plain(texels_, pack::TextureFormat::rgb565, warm));
  textures_.push_back(add_plain(texels_, pack::TextureFormat::rgba4444, stripes));
  textures_.push_back(add_etc1(texels_));
}

void SamplePack::add_sphere(pack::MaterialKind kind, Vec3 center_m) {
  const std::size_t index = objects_.size();
  const bool alpha = kind == pack::MaterialKind::hair || kind == pack::MaterialKind::lash;
  pack::Material m{};
  m.kind = kind;
  m.flags = alpha ? pack::kAlphaBlend | pack::kTwoSided : 0;
  m.texture = alpha ? 1 : kind == pack::MaterialKind::cloth ? 2 : 0;
  m.detail = pack::kNoTexture;
  for (float& t : m.tint) t = 1.0f;
  m.gloss = 0.5f;
  m.shininess = 40.0f;
  materials_.push_back(m);
  for (std::uint32_t r = 0; r <= kRows; ++r)
    for (std::uint32_t c = 0; c <= kColumns; ++c) {
      const SinCos polar = sin_cos(kPi * static_cast<float>(r) / kRows);
      const SinCos around = sin_cos(2.0f * kPi * static_cast<float>(c) / kColumns);
      const Vec3 n{polar.sin * around.cos, polar.cos, -polar.sin * around.sin};
      // Closed towards the bottom: occlusion shows.
      const auto closed = static_cast<std::int8_t>(std::lround(60.0f * (0.5f - 0.5f * n.y)));
      dynamic_[index].push_back(
          {center_m + 0.42f * n, {snorm(n.x), snorm(n.y), snorm(n.z), closed}});
    }
  pack::Object o{};
  o.material = static_cast<std::uint16_t>(index);
  o.bone_count = 2;
  o.max_vertex_count = static_cast<std::uint32_t>(fixed_.size());
  o.max_triangle_count = static_cast<std::uint32_t>(indices_.size() / 3);
  objects_.push_back(o);
}

void SamplePack::compose() {
  for (std::size_t i = 0; i < objects_.size(); ++i)
    meshes_.push_back({dynamic_[i], fixed_, indices_, static_cast<std::uint32_t>(fixed_.size()),
                       static_cast<std::uint32_t>(indices_.size() / 3)});
  scene::Framing framing;
  framing.visible_height_m = 2.2f;
  framing.visible_width_m = 3.2f;
  list_.camera = scene::make_camera(framing, 1.5f);
  list_.key = {glm::normalize(Vec3{0.5f, 0.6f, 0.8f}), {0.8f, 0.75f, 0.7f}};
  list_.fill = {glm::normalize(Vec3{-0.8f, 0.1f, 0.6f}), {0.2f, 0.2f, 0.25f}};
  list_.rim = {glm::normalize(Vec3{-0.5f, 0.5f, -0.8f}), {0.5f, 0.5f, 0.5f}};
  list_.background_top = {0.1f, 0.1f, 0.1f};
  list_.background_bottom = {0.3f, 0.28f, 0.26f};
  (void)list_.floor_shadows.push({{0, -0.95f, 0.2f}, 1.4f, 0.6f, 0.6f});
  list_.meshes = meshes_;
  for (std::uint16_t i = 0; i < objects_.size(); ++i) {
    const auto vertices = static_cast<std::uint32_t>(fixed_.size());
    const auto indices = static_cast<std::uint32_t>(indices_.size());
    (void)list_.patches.push({i, {0, vertices}, {0, vertices}, {0, indices}});
    (void)list_.bones.push(Affine{});
    (void)list_.bones.push(Affine{});
    (void)list_.items.push({i, i, indices / 3, static_cast<std::uint16_t>(2 * i), 2});
  }
}

}  // namespace caryatid::golden
