#pragma once
// What passes between the agent and the budget controller: plain data, no behaviour.
// Units: microseconds, pixels, triangles. Nothing here is owned or borrowed beyond the call.
#include <array>
#include <cstdint>
#include <span>

#include "core/base/limits.h"
#include "core/scene/draw_list.h"

namespace caryatid::lod {

using scene::Shading;

// Four steps, with several degrees of hysteresis in platform/thermal (board-practice: the board's
// own trip points). warm: no refinement. hot: throttling is about to come or is here.
// critical: hold still at 10 Hz.
enum class ThermalLevel : std::uint8_t { normal, warm, hot, critical };

// What one frame asked of the board: the regressors of the cost model.
struct Work {
  std::uint32_t triangles = 0;          // Drawn, all objects.
  std::uint32_t vertices_deformed = 0;  // Moved by the CPU (FAT, CPU skinning) and uploaded.
  std::uint32_t records = 0;            // Collapse records applied or undone in this frame.
  float target_px = 0.0f;               // Pixels of the render target: display * render_scale^2.
  float shaded_px = 0.0f;               // Fragments shaded, overdraw included, at that scale.
  Shading shading = Shading::per_pixel;
};

// Only what a board shows. One sample a frame, given after the frame's flip.
//
// How cost is measured under vsync, where no driver here has timer queries (VC4, Lima, etnaviv):
// - cpu_us: monotonic clock from the start of the frame to the return of the last GL call. Wall
//   time, not thread time, so that other processes' load shows.
// - gpu_us: the loop is serial (frame n+1 starts at the flip of frame n), so the thread has nothing
//   to do until the flip; it puts a fence behind the last draw and takes the time when the fence
//   signals: with EGL_ANDROID_native_fence_sync (VC4, V3D, Lima, etnaviv) the kernel's own time
//   stamp from SYNC_IOC_FILE_INFO, read after the flip; with EGL_KHR_fence_sync alone the first of
//   the looks, 250 us apart, that finds it. gpu_us is that minus the time of the last GL call
//   (the swap): platform/display/gpu_timer.h.
// - vblanks: from the sequence numbers of the page-flip events, never from the return of swap.
//   Quantised: "in time" only says cpu + gpu <= deadline, "late" only says more than it. Where
//   there is no fence the controller learns from these bounds alone (see StageModel).
struct FrameSample {
  static constexpr std::uint32_t kUnknown = 0xffffffffu;

  std::uint64_t time_us = 0;        // Monotonic, of the flip. Jumps either way are tolerated.
  std::uint32_t cpu_us = kUnknown;  // kUnknown: nothing was measured, nothing is learnt.
  std::uint32_t gpu_us = kUnknown;  // kUnknown: no fence.
  std::uint16_t vblanks = 0;        // Periods between the last two flips; 0: no flip, or unknown.
  ThermalLevel thermal = ThermalLevel::normal;
  std::uint8_t other_load_percent = 0;  // CPU taken by others, of one core; 0 when unknown.
  Work drawn;
};

// One object (head, body, hair, a garment) as scene sees it for the coming frame.
struct ObjectNeed {
  std::uint32_t min_triangles = 0;      // Base mesh of the progressive mesh.
  std::uint32_t max_triangles = 0;      // Full mesh, >= min_triangles.
  float screen_px = 0.0f;               // Area covered on the display at render scale 1; 0: unseen.
  float overdraw = 1.0f;                // Fragments shaded per covered pixel; hair layers: 2..3.
  float axis_closeness = 1.0f;          // 1 on the optical axis, 0 in the corner of the view.
  float expression = 0.0f;              // 0 still .. 1 fully moving: speech, emotion, gesture.
  float importance = 1.0f;              // The author's weight; face 1, shoes 0.2. 0: may be coarse.
  float deformed_per_triangle = 0.55f;  // Vertices that the CPU moves, per triangle; 0: GPU skins.
};

// What the coming frame must show. More than kMaxObjects objects: the rest is ignored.
struct SceneNeeds {
  std::span<const ObjectNeed> objects;
  float display_px = 0.0f;  // Width * height of the display.
  bool idle = false;        // Nobody is there and nothing is said: the frame rate may fall.
};

// Why the decision differs from the one before.
enum class Change : std::uint8_t { none, refine, reshare, reduce };

// How the coming frames shall be drawn.
struct LodDecision {
  std::array<std::uint32_t, kMaxObjects> triangles{};  // Target by object, within its min and max.
  std::uint32_t object_count = 0;
  float render_scale = 1.0f;             // 1.0 down to 0.5, of width and of height.
  Shading shading = Shading::per_pixel;  // per_pixel, per_vertex, cheapest.
  std::uint8_t frame_divisor = 1;        // Draw every n-th frame of the target rate.

  // How to get there. `sequence` grows by one with every change. A change that may wait is held
  // back until a blink or a saccade covers it, at most cover_wait_ms, and is then geomorphed over
  // morph_ms; 0 and 0: at once, the frame rate is at stake.
  std::uint32_t sequence = 0;
  Change change = Change::none;              // Of this step; none when it repeats the last one.
  std::uint16_t cover_wait_ms = 0;           // 0..2000
  std::uint16_t morph_ms = 0;                // 0, or 200..500
  std::uint32_t max_records_per_frame = 64;  // So that the change itself is not late. >= 64.

  float predicted_us = 0.0f;  // CPU + GPU of a frame drawn as decided.
  float limit_us = 0.0f;      // What the controller plans for: the deadline less its noise margin.
};

}  // namespace caryatid::lod
