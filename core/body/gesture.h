#pragma once
// Gestures of the kiosk's person, laid over whatever the body does: standing, walking or a stream.
// They come and go smoothly, and touch only arms, shoulders and neck.
#include "core/base/vec.h"
#include "core/body/bap.h"
#include "core/body/hanim.h"

namespace caryatid::body {

enum class GestureKind : std::uint8_t { none, wave, point, nod, shake, shrug, beat };
const char* gesture_name(GestureKind kind);

struct Gesture {
  GestureKind kind = GestureKind::none;
  bool left = false;          // Which hand waves, points or beats.
  float size = 1.0f;          // 0.3 shy .. 1.5 grand; cut to that range.
  float hold_s = 1.5f;        // How long a pointing hand stays.
  Vec3 target_m{0, 1.2f, 2};  // Point: the place pointed at, in the space of the posed body.
};

// Plays one gesture at a time; a new one waits until the old has let go (0.3 s).
// Cost of apply(): one pose and two limbs, about 2 microseconds while a gesture is on; none else.
class GestureLayer {
 public:
  void start(const Gesture& gesture);
  void stop();  // Lets the present one go.
  void step(float dt_s);
  bool active() const { return weight_ > 0.0f || gesture_.kind != GestureKind::none; }
  GestureKind kind() const { return gesture_.kind; }

  // Blends the gesture over the frame. Head gestures add to what the neck does.
  void apply(const Skeleton& skeleton, BapFrame& io_frame) const;

 private:
  float duration_s() const;

  Gesture gesture_;
  Gesture next_;  // Waits until the present one has gone.
  float clock_s_ = 0.0f;
  float weight_ = 0.0f;  // 0 body, 1 gesture.
  bool stopping_ = false;
};

}  // namespace caryatid::body
