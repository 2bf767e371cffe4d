#include <algorithm>

#include "platform/render/render.h"

namespace caryatid::platform {
namespace {

class NullRenderer final : public Renderer {
 public:
  NullRenderer(const pack::View& pack, const RenderOptions& options)
      : pack_(pack), width_(options.width), height_(options.height) {}

  const GpuCaps& caps() const override { return caps_; }
  std::uint32_t width() const override { return width_; }
  std::uint32_t height() const override { return height_; }
  Status upload_texture(std::uint16_t texture, bool) override {
    if (texture < pack_.textures.size()) return {};
    return {Code::invalid_argument, static_cast<std::uint16_t>(RenderFault::texture)};
  }
  Status load_font(const pack::FontView&) override { return {}; }
  Status load_picture(std::uint16_t, std::uint16_t, std::uint16_t,
                      std::span<const std::uint16_t>) override {
    return {};
  }
  Status resize(std::uint32_t width, std::uint32_t height) override {
    width_ = width;
    height_ = height;
    return {};
  }
  Status draw(const scene::DrawList& list) override {
    cost_ = {};
    bool all_valid = true;
    for (const scene::DrawItem& item : list.items) {
      const bool valid = item_is_valid(list, pack_, item);
      all_valid = all_valid && valid;
      if (!valid) continue;
      ++cost_.draw_calls;
      cost_.triangles += item.triangle_count;
    }
    if (all_valid) return {};
    return {Code::invalid_argument, static_cast<std::uint16_t>(RenderFault::draw_list)};
  }
  Status read_back(std::span<std::uint8_t> out_rgb) override {
    if (out_rgb.size() < std::size_t{3} * width_ * height_)
      return {Code::out_of_capacity, static_cast<std::uint16_t>(RenderFault::read_back)};
    std::fill(out_rgb.begin(), out_rgb.end(), std::uint8_t{0});
    return {};
  }
  FrameCost last_cost() const override { return cost_; }

 private:
  pack::View pack_;
  GpuCaps caps_;
  FrameCost cost_;
  std::uint32_t width_, height_;
};

}  // namespace

Status open_null_renderer(const pack::View& pack, const RenderOptions& options,
                          std::unique_ptr<Renderer>& out) {
  out = std::make_unique<NullRenderer>(pack, options);
  return {};
}

}  // namespace caryatid::platform
