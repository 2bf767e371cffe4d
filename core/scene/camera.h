#pragma once
// Cameras that frame the person: portrait lenses, so that a face is not distorted.
#include "core/pack/view.h"
#include "core/scene/draw_list.h"

namespace caryatid::scene {

enum class View : std::uint8_t { head, bust, body, left, right, three_quarter, feet };

// What the camera frames, in world space.
struct Subject {
  Vec3 eyes_m{0, 1.6f, 0.1f};  // Midway between the eyes.
  float stature_m = 1.7f;
};

// Of a character at rest, from its feature points 3.5 and 3.6; defaults where the pack lacks them.
Subject subject_of(const pack::View& pack);

// A pose of the camera that can be blended with another: linear in all of its terms.
struct Framing {
  Vec3 target_m{0};
  Vec3 direction{0, 0, 1};      // From the target to the camera, unit.
  float visible_height_m = 1;   // At the target.
  float visible_width_m = 0.5;  // Kept in portrait formats too.
};
Framing framing(View view, const Subject& subject);
// t = 0 is a, 1 is b.
Framing blend(const Framing& a, const Framing& b, float t);

// The part of the visitor's picture in which the subject is framed; shares of its sides, from the
// upper left corner. The picture goes on around it.
struct Window {
  float x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};

// aspect: width over height of the picture. turn: 0, 90, 180, 270 degrees clockwise, for displays
// that are mounted turned; aspect is then that of the unturned panel.
Camera make_camera(const Framing& framing, float aspect, std::uint32_t turn_degrees = 0,
                   const Window& window = {});

// Where a point is seen, in pixels of the visitor's picture of this size, and how far from the
// camera; behind it the distance is negative.
Vec3 seen_at(const Camera& camera, Vec3 point_m, float width, float height,
             std::uint32_t turn_degrees = 0);

}  // namespace caryatid::scene
