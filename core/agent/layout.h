#pragma once
// One arbiter for the screen: where the person stands, where the page's card and the captions lie.
// Nothing covers the face: what would is moved or left out.
#include "core/scene/overlay.h"

namespace caryatid::agent {

struct LayoutRequest {
  float width = 800, height = 480;  // Of the picture as the visitor sees it, pixels.
  bool card = false;                // The page is shown.
  bool large_text = false;
  bool mirrored = false;  // Landscape: the card stands left, the person right.
  bool captions = true;   // There are some now: the person, and large text, leave them room.
};

// Boxes in pixels. Landscape: the person left, the card right, captions below both. Portrait: the
// person above the card, captions below.
struct Layout {
  scene::Box person;   // The camera frames the person in it.
  scene::Box card;     // Empty without a card.
  scene::Box caption;  // Room for captions; their own box is as high as they need, from below.
  float text_px = 20, caption_px = 28, margin_px = 20;
  int caption_lines = 2;
};

// O(1).
Layout lay_out(const LayoutRequest& request);

// The caption's box for `lines` lines; where it would cover the head, at the picture's upper end;
// empty where it would cover it there, too: the camera is on its way. A head in Layout::person is
// free of it in any case.
scene::Box caption_box(const Layout& layout, int lines, float width_px, const scene::Box& head);

}  // namespace caryatid::agent
