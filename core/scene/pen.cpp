#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/overlay.h"

namespace caryatid::scene {
namespace {

constexpr float kBold_em = 0.018f;  // How far a stem's edges move out for bold letters.
constexpr float kSharpest = 255.0f;

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f * (value < 255.0f));
}

}  // namespace

void Pen::box(const Box& at, float radius_px, Ink ink) {
  if (at.empty() || ink.a == 0) return;
  const pack::FontGlyph& disc = font_.glyphs[font_.header->box_glyph];
  const float w = font_.header->atlas_width, h = font_.header->atlas_height;
  const float r = std::clamp(radius_px, 1.0f, 0.5f * std::min(at.width(), at.height()));
  // Texels of the disc: its edge stands a quarter in, its middle is the box's inside.
  const float us[3] = {disc.x / w, (disc.x + 0.5f * disc.width) / w, (disc.x + disc.width) / w};
  const float vs[3] = {disc.y / h, (disc.y + 0.5f * disc.height) / h, (disc.y + disc.height) / h};
  const float xs[4] = {at.x0 - r, at.x0 + r, at.x1 - r, at.x1 + r};
  const float ys[4] = {at.y0 - r, at.y0 + r, at.y1 - r, at.y1 + r};
  constexpr int kFrom[3] = {0, 1, 1}, kTo[3] = {1, 1, 2};
  OverlayQuad q{};
  q.ink = ink;
  q.threshold = 128;
  q.sharpness = byte_of(std::min(4.0f * r / 0.498f, kSharpest));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      q.at = {xs[column], ys[row], xs[column + 1], ys[row + 1]};
      if (q.at.empty()) continue;
      q.u0 = us[kFrom[column]];
      q.u1 = us[kTo[column]];
      q.v0 = vs[kFrom[row]];
      q.v1 = vs[kTo[row]];
      (void)out_->push(q);
    }
}

void Pen::picture(const Box& at, float opacity) {
  OverlayQuad q{};
  q.at = at;
  q.u1 = q.v1 = 1.0f;
  q.ink = Ink{}.faded(opacity);
  q.is_picture = 1;
  (void)out_->push(q);
}

// grow_px: how far the edges move outwards.
void Pen::glyphs(const Run& run, float x, float baseline_px, const TextStyle& style, Ink ink,
                 float grow_px) {
  const float unit = style.size_px / pack::kUnitsPerEm;
  const float texel = style.size_px / static_cast<float>(font_.header->em_px);  // In pixels.
  // Field units a pixel: 127 of 255 over spread_px texels.
  const float slope = 0.498f / (static_cast<float>(font_.header->spread_px) * texel);
  const float w = font_.header->atlas_width, h = font_.header->atlas_height;
  OverlayQuad q{};
  q.ink = ink;
  q.threshold = byte_of(255.0f * std::max(0.502f - grow_px * slope, 0.06f));
  q.sharpness = byte_of(std::min(4.0f / slope, kSharpest));
  for (const ShapedGlyph& g : run.glyphs) {
    const pack::FontGlyph& place = font_.glyphs[g.glyph];
    if (place.width > 0) {
      q.at.x0 = x + static_cast<float>(g.dx + place.left) * unit;
      q.at.y0 = baseline_px - static_cast<float>(g.dy + place.top) * unit;
      q.at.x1 = q.at.x0 + static_cast<float>(place.width) * texel;
      q.at.y1 = q.at.y0 + static_cast<float>(place.height) * texel;
      q.u0 = place.x / w;
      q.v0 = place.y / h;
      q.u1 = static_cast<float>(place.x + place.width) / w;
      q.v1 = static_cast<float>(place.y + place.height) / h;
      (void)out_->push(q);
    }
    x += static_cast<float>(g.advance) * unit;
  }
}

void Pen::line(std::span<const Run> runs, float x, float baseline_px, const TextStyle& style,
               std::span<const Ink> inks) {
  constexpr std::size_t kMostRuns = 256;
  std::array<std::uint16_t, kMostRuns> order;
  runs = runs.first(std::min(runs.size(), kMostRuns));
  visual_order(runs, order);
  // Outlines first, so that no letter's rim lies over its neighbour.
  for (int pass = style.outline.a > 0 ? 0 : 1; pass < 2; ++pass) {
    float at = x;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Run& run = runs[order[i]];
      const Ink ink = inks.empty() ? style.ink : inks[order[i]];
      const float bold = std::max(style.weight, run.emphasis ? 1.0f : 0.0f);
      const float grow = bold * kBold_em * style.size_px;
      if (pass == 0)
        glyphs(run, at, baseline_px, style, style.outline, grow + style.outline_px);
      else
        glyphs(run, at, baseline_px, style, ink, grow);
      at += static_cast<float>(run.width) * style.size_px / pack::kUnitsPerEm;
    }
  }
}

}  // namespace caryatid::scene
