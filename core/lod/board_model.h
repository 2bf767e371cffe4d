#pragma once
// Cost profiles of the boards that Caryatid is made for, and a board that runs on them in virtual
// time. The program uses it under --virtual-clock, the tests and the benchmark for simulation; the
// controller takes a profile as the prior of its own fit. Deterministic: no clock, no randomness.
#include <cstdint>
#include <span>

#include "core/lod/frame.h"

namespace caryatid::lod {

// Cost of one frame = CPU (fixed + vertices + records) then GPU (fixed + triangles + pixels).
// Where the numbers come from stands in board_model.cpp: peak rates are public, the share of the
// peak that a real scene gets is an estimate until a board has been measured.
struct BoardCosts {
  const char* name = "";
  float cpu_fixed_us = 0;       // Agent, mixing, draw list, GL driver.
  float cpu_vertex_ns = 0;      // Deform one vertex and upload it.
  float cpu_record_ns = 0;      // Apply or undo one collapse record, with its upload.
  float gpu_fixed_us = 0;       // Start of binning and rendering, fence and interrupt latency.
  float gpu_triangle_ns = 0;    // Vertex shading, binning and set-up.
  float gpu_target_px_ns = 0;   // Clear, tile store and scaling, by pixel of the target.
  float gpu_shaded_px_ns[3]{};  // A fragment, by Shading: cheapest, per_vertex, per_pixel.
  std::uint16_t display_width = 1920, display_height = 1080;
  float refresh_hz = 60.0f;
};

// pi-zero-2w (first, the default), pi3, pi4, mali450, gc7000.
std::span<const BoardCosts> boards();
// By name; nullptr when there is none.
const BoardCosts* find_board(std::span<const char> name);

// The terms of one stage, in microseconds.
inline constexpr std::size_t kTermCount = 6;
using Terms = std::array<float, kTermCount>;
Terms cpu_terms(const BoardCosts& board, const Work& work);  // fixed, vertices, records
Terms gpu_terms(const BoardCosts& board,
                const Work& work);  // fixed, triangles, target, shaded by tier
inline float sum(const Terms& t) { return t[0] + t[1] + t[2] + t[3] + t[4] + t[5]; }

// A flip must be queued this long before the vblank that shall show it: commit, interrupt and wake.
inline constexpr float kFlipLeadUs = 200.0f;

// What disturbs a frame; the defaults disturb nothing.
struct Disturbance {
  float cpu_factor = 1.0f;  // Throttled clock, other processes.
  float gpu_factor = 1.0f;
  float spike_us = 0.0f;  // Once, on the CPU.
  ThermalLevel thermal = ThermalLevel::normal;
  std::uint8_t other_load_percent = 0;
  bool has_fence = true;  // false: gpu_us is kUnknown.
};

// A board in virtual time, with a serial frame loop: a frame starts at the flip of the one before,
// the GPU starts when the CPU is done, the flip comes at the first vblank after both, but not
// before vblanks_per_frame * divisor. Holds 24 bytes; O(1) a frame.
class VirtualBoard {
 public:
  // `costs` is borrowed. vblanks_per_frame: 1 for 60 frames/s on a 60 Hz display, 2 for 30.
  VirtualBoard(const BoardCosts& costs, std::uint16_t vblanks_per_frame)
      : costs_(&costs), vblanks_per_frame_(vblanks_per_frame) {}

  // Draws `work`; time moves on to its flip.
  FrameSample run(const Work& work, std::uint8_t frame_divisor = 1,
                  const Disturbance& disturbance = {});
  std::uint64_t time_us() const;

 private:
  const BoardCosts* costs_;
  std::uint16_t vblanks_per_frame_;
  std::uint64_t vblank_count_ = 0;
};

}  // namespace caryatid::lod
