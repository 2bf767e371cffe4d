#include "core/agent/layout.h"

#include <algorithm>

namespace caryatid::agent {
namespace {

// Shares of the picture's shorter side. At 480 pixels: letters of 21, captions of 29.
constexpr float kText = 0.044f, kCaption = 0.060f, kMargin = 0.042f;
constexpr float kLarger = 1.4f;  // Large-text mode.
constexpr float kSmallestText_px = 14.0f;
constexpr float kLineHeight = 1.32f;                      // Of the letters' size.
constexpr float kPadding = 0.55f;                         // Around captions, of their size.
constexpr float kCardWidth = 0.46f, kCardHeight = 0.40f;  // Landscape, portrait.

float caption_height(const Layout& l, int lines) {
  return l.caption_px * (kLineHeight * static_cast<float>(lines) + 2.0f * kPadding);
}

}  // namespace

Layout lay_out(const LayoutRequest& request) {
  const float w = request.width, h = request.height, side = std::min(w, h);
  const bool portrait = h > w;
  const float larger = request.large_text ? kLarger : 1.0f;
  Layout out;
  out.text_px = std::max(kText * side, kSmallestText_px) * larger;
  out.caption_px = std::max(kCaption * side, kSmallestText_px * 1.2f) * larger;
  out.margin_px = kMargin * side;
  out.caption_lines = portrait && !request.large_text ? 3 : 2;
  const float m = out.margin_px;
  const float caption = caption_height(out, out.caption_lines);
  out.caption = {m, h - m - caption, w - m, h - m};
  out.person = {0, 0, w, h};
  if (!request.card) {
    if (request.captions) out.person.y1 = out.caption.y0;
    return out;
  }
  const bool whole = request.large_text && !request.captions;
  const float top_of_caption = whole ? h - m : out.caption.y0 - m;
  if (portrait) {
    const float card = kCardHeight * h;
    out.card = {m, out.caption.y0 - m - card, w - m, top_of_caption};
    out.person = {0, 0, w, out.card.y0};
  } else {
    const float card = kCardWidth * w * (request.large_text ? 1.1f : 1.0f);
    const float x = request.mirrored ? m : w - m - card;
    out.card = {x, m, x + card, top_of_caption};
    out.person = {0, 0, out.card.x0, out.caption.y0};
    if (request.mirrored) out.person = {out.card.x1, 0, w, out.caption.y0};
  }
  return out;
}

scene::Box caption_box(const Layout& layout, int lines, float width_px, const scene::Box& head) {
  const float pad = kPadding * layout.caption_px;
  const float half = std::min(0.5f * width_px + 1.4f * pad, 0.5f * layout.caption.width());
  const float middle = 0.5f * (layout.caption.x0 + layout.caption.x1);
  const float height = caption_height(layout, lines);
  scene::Box box{middle - half, layout.caption.y1 - height, middle + half, layout.caption.y1};
  if (!box.overlaps(head)) return box;
  box.y0 = layout.margin_px;
  box.y1 = box.y0 + height;
  return box.overlaps(head) ? scene::Box{} : box;
}

}  // namespace caryatid::agent
