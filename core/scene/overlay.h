#pragma once
// What lies over the picture of the person: letters, boxes and pictures as plain quads, drawn in
// one call after the scene, at the display's full resolution.
//
// Frame: pixels of the picture as the visitor sees it (turned displays too), origin in the upper
// left corner, y downwards.
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/pack/font.h"
#include "core/scene/text.h"

namespace caryatid::scene {

struct Box {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  float width() const { return x1 - x0; }
  float height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool overlaps(const Box& b) const {
    return !empty() && !b.empty() && x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1;
  }
  Box inset(float by) const { return {x0 + by, y0 + by, x1 - by, y1 - by}; }
  friend bool operator==(const Box&, const Box&) = default;
};

// sRGB and opacity, as bytes.
struct Ink {
  std::uint8_t r = 255, g = 255, b = 255, a = 255;
  Ink faded(float opacity) const {
    return {r, g, b, static_cast<std::uint8_t>(static_cast<float>(a) * opacity + 0.5f)};
  }
  friend bool operator==(const Ink&, const Ink&) = default;
};

struct OverlayQuad {
  Box at;                        // Pixels.
  float u0, v0, u1, v1;          // In the font's atlas, or in the picture: 0..1, v downwards.
  Ink ink;                       // A picture takes its opacity alone.
  std::uint8_t threshold = 128;  // Of the distance field: where the edge lies. Lower is bolder.
  std::uint8_t sharpness = 4;    // Of that edge, in quarters: field units a pixel, 1 / (4 * n).
  std::uint8_t is_picture = 0;
  std::uint8_t reserved = 0;
};

struct Overlay {
  std::span<const OverlayQuad> quads;  // In drawing order.
  std::uint32_t version = 0;           // Changes with the quads.
  std::uint16_t picture = 0xFFFF;      // The one that picture quads show; 0xFFFF: none.
  float width = 0, height = 0;         // Of the picture as the visitor sees it, in pixels.
  std::uint32_t turn_degrees = 0;      // As scene::make_camera's.
};

// How letters look.
struct TextStyle {
  float size_px = 20;
  Ink ink;
  float weight = 0.0f;      // 0 regular .. 1 bold.
  Ink outline{0, 0, 0, 0};  // Transparent: none.
  float outline_px = 0.0f;
};

// Writes quads into a vector of fixed size; what does not fit is left out.
class Pen {
 public:
  Pen(const pack::FontView& font, FixedVector<OverlayQuad, kMaxOverlayQuads>* out)
      : font_(font), out_(out) {}

  // A box with round corners. O(1), nine quads.
  void box(const Box& at, float radius_px, Ink ink);
  void picture(const Box& at, float opacity);
  // One line of runs. x: its left end; baseline_px: y of the letters' feet. inks: one a run, or
  // empty for the style's own. O(glyphs).
  void line(std::span<const Run> runs, float x, float baseline_px, const TextStyle& style,
            std::span<const Ink> inks = {});

 private:
  void glyphs(const Run& run, float x, float baseline_px, const TextStyle& style, Ink ink,
              float grow_px);

  const pack::FontView& font_;
  FixedVector<OverlayQuad, kMaxOverlayQuads>* out_;
};

}  // namespace caryatid::scene
