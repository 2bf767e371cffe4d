#include "assets/bake/human/preview.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/bake/texture/image.h"

namespace caryatid::bake {
namespace {

constexpr std::uint32_t kSamples = 2;  // Supersampling a side.

struct Fragment {
  float depth_m;
  Vec4 color;
};

// Where a point falls: x, y in samples, z the distance from the eye.
class Camera {
 public:
  explicit Camera(const PreviewView& view)
      : width_(static_cast<float>(view.width * kSamples)),
        height_(static_cast<float>(view.height * kSamples)),
        distance_m_(view.distance_m),
        scale_(height_ / view.height_m * view.distance_m),
        target_m_(view.target_m) {
    const float cy = std::cos(view.yaw_rad), sy = std::sin(view.yaw_rad);
    const float cp = std::cos(view.pitch_rad), sp = std::sin(view.pitch_rad);
    right_ = {cy, 0, -sy};
    back_ = {sy * cp, sp, cy * cp};
    up_ = glm::cross(back_, right_);
  }
  Vec3 project(Vec3 p) const {
    const Vec3 d = p - target_m_;
    const float z = distance_m_ - glm::dot(d, back_);
    return {0.5f * width_ + scale_ * glm::dot(d, right_) / z,
            0.5f * height_ - scale_ * glm::dot(d, up_) / z, z};
  }
  Vec3 to_eye() const { return back_; }
  Vec3 turn(Vec3 v) const { return v.x * right_ + v.y * up_ + v.z * back_; }

 private:
  float width_, height_, distance_m_, scale_;
  Vec3 target_m_, right_{}, up_{}, back_{};
};

Vec3 shade(Vec3 albedo, Vec3 n, const Camera& camera, const pack::Material& material) {
  const Vec3 key = glm::normalize(camera.turn({-0.5f, 0.6f, 0.7f}));
  const Vec3 fill = glm::normalize(camera.turn({0.8f, 0.1f, 0.6f}));
  const bool skin = material.kind == pack::MaterialKind::skin;
  const float wrap = skin ? 0.35f : 0.15f;
  const auto lambert = [&](Vec3 l) {
    return std::max(0.0f, (glm::dot(n, l) + wrap) / (1.0f + wrap));
  };
  const float sky = 0.5f + 0.5f * n.y;
  Vec3 light = Vec3{1.0f, 0.97f, 0.92f} * (0.95f * lambert(key)) +
               Vec3{0.85f, 0.92f, 1.0f} * (0.30f * lambert(fill)) +
               Vec3{0.9f, 0.95f, 1.0f} * (0.22f * sky + 0.06f);
  const Vec3 half = glm::normalize(key + camera.to_eye());
  const float specular =
      material.gloss * std::pow(std::max(0.0f, glm::dot(n, half)), material.shininess);
  return albedo * light + Vec3{specular};
}

struct Surface {
  const Mesh* mesh;
  const pack::Material* material;
  const LinearImage* texture;
  Vec4 tint;
};

class Raster {
 public:
  Raster(const PreviewView& view, const Camera& camera)
      : width_(view.width * kSamples),
        height_(view.height * kSamples),
        camera_(camera),
        depth_(std::size_t{width_} * height_, std::numeric_limits<float>::max()),
        color_(width_, height_, Vec4{0.16f, 0.18f, 0.21f, 1}),
        layers_(std::size_t{width_} * height_) {}

  void draw(const Surface& surface, bool blended) {
    for (const auto& triangle : surface.mesh->triangles) draw(surface, triangle, blended);
  }

  // Blends the layers of hair and lashes, far to near.
  Image resolve(std::uint32_t width, std::uint32_t height) {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      auto& list = layers_[i];
      std::sort(list.begin(), list.end(),
                [](const Fragment& a, const Fragment& b) { return a.depth_m > b.depth_m; });
      for (const Fragment& f : list)
        if (f.depth_m < depth_[i] + 1e-4f)
          color_.texel[i] = glm::mix(color_.texel[i], Vec4{Vec3{f.color}, 1}, f.color.w);
    }
    return to_srgb(resize(color_, width, height), "preview");
  }
  bool visible(Vec3 s, float slack_m) const {
    const int x = static_cast<int>(s.x), y = static_cast<int>(s.y);
    if (x < 0 || y < 0 || x >= static_cast<int>(width_) || y >= static_cast<int>(height_))
      return false;
    return s.z <
           depth_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)] + slack_m;
  }

 private:
  void draw(const Surface& surface, const std::array<std::uint32_t, 3>& t, bool blended) {
    const Mesh& m = *surface.mesh;
    const Vec3 a = camera_.project(m.position_m[t[0]]), b = camera_.project(m.position_m[t[1]]),
               c = camera_.project(m.position_m[t[2]]);
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const bool back = area > 0;  // y runs downwards.
    if (std::abs(area) < 1e-9f || (back && !(surface.material->flags & pack::kTwoSided))) return;
    const auto clampi = [](float v, std::uint32_t n) {
      return static_cast<std::uint32_t>(std::clamp(v, 0.0f, static_cast<float>(n)));
    };
    const std::uint32_t x0 = clampi(std::min({a.x, b.x, c.x}), width_),
                        x1 = clampi(std::max({a.x, b.x, c.x}) + 1, width_),
                        y0 = clampi(std::min({a.y, b.y, c.y}), height_),
                        y1 = clampi(std::max({a.y, b.y, c.y}) + 1, height_);
    for (std::uint32_t y = y0; y < y1; ++y)
      for (std::uint32_t x = x0; x < x1; ++x) {
        const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
        const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        const float wa = 1 - wb - wc;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const float z = 1.0f / (wa / a.z + wb / b.z + wc / c.z);
        const std::size_t i = std::size_t{y} * width_ + x;
        if (z >= depth_[i]) continue;
        const float pa = wa * z / a.z, pb = wb * z / b.z, pc = wc * z / c.z;
        Vec4 albedo = surface.tint;
        if (surface.texture)
          albedo *= sample_bilinear(*surface.texture,
                                    pa * m.uv[t[0]] + pb * m.uv[t[1]] + pc * m.uv[t[2]]);
        if (blended ? albedo.w < 0.02f : albedo.w < 0.5f) continue;
        Vec3 n = glm::normalize(pa * m.normal[t[0]] + pb * m.normal[t[1]] + pc * m.normal[t[2]]);
        if (back) n = -n;
        const Vec4 lit{shade(Vec3{albedo}, n, camera_, *surface.material), albedo.w};
        if (blended && albedo.w < 0.95f) {
          layers_[i].push_back({z, lit});
        } else {
          depth_[i] = z;
          color_.texel[i] = Vec4{Vec3{lit}, 1};
        }
      }
  }

  std::uint32_t width_, height_;
  const Camera& camera_;
  std::vector<float> depth_;
  LinearImage color_;
  std::vector<std::vector<Fragment>> layers_;
};

// Digits and the dot as 3x5 bits, top row first.
constexpr std::uint16_t kGlyphs[11] = {075557, 026227, 071747, 071717, 055711, 074717,
                                       074757, 071111, 075757, 075717, 000002};

void draw_label(Image& image, int x, int y, const std::string& label, Vec3 rgb) {
  const auto put = [&](int px, int py) {
    if (px < 0 || py < 0 || px >= static_cast<int>(image.width) ||
        py >= static_cast<int>(image.height))
      return;
    std::uint8_t* p = image.rgba.data() + 4 * (static_cast<std::size_t>(py) * image.width +
                                               static_cast<std::size_t>(px));
    for (int k = 0; k < 3; ++k) p[k] = static_cast<std::uint8_t>(rgb[k] * 255.0f);
  };
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i)
      if (i * i + j * j <= 4) put(x + i, y + j);
  x += 4;
  for (const char c : label) {
    const std::uint16_t glyph = kGlyphs[c == '.' ? 10 : c - '0'];
    for (int bit = 0; bit < 15; ++bit)
      if (glyph >> (14 - bit) & 1)
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 2; ++i) put(x + 2 * (bit % 3) + i, y - 5 + 2 * (bit / 3) + j);
    x += c == '.' ? 5 : 8;
  }
}

}  // namespace

Image render_preview(const Character& character, const PreviewView& view) {
  const Camera camera(view);
  Raster raster(view, camera);
  std::vector<LinearImage> textures;
  for (const Image& image : character.images) textures.push_back(to_linear(image));
  for (const bool blended : {false, true})
    for (const Object& object : character.objects) {
      const pack::Material& material = character.materials[object.material];
      if (material.flags & pack::kCornea) continue;  // Clear; it only shines.
      if (((material.flags & pack::kAlphaBlend) != 0) != blended) continue;
      if (std::find(view.hide.begin(), view.hide.end(), object.name) != view.hide.end()) continue;
      const bool textured = view.textures && material.texture != pack::kNoTexture;
      raster.draw({&object.mesh, &material, textured ? &textures[material.texture] : nullptr,
                   Vec4{material.tint[0], material.tint[1], material.tint[2], material.tint[3]}},
                  blended);
    }
  Image out = raster.resolve(view.width, view.height);
  if (view.number_feature_points)
    for (const FeaturePoint& point : character.feature_points) {
      const Vec3 s = camera.project(point.position_m);
      if (!raster.visible(s, 0.006f)) continue;
      draw_label(out, static_cast<int>(s.x) / static_cast<int>(kSamples),
                 static_cast<int>(s.y) / static_cast<int>(kSamples),
                 std::to_string(point.group) + "." + std::to_string(point.index),
                 {0.9f, 1.0f, 0.1f});
    }
  return out;
}

}  // namespace caryatid::bake
