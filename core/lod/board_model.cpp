#include "core/lod/board_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace caryatid::lod {
namespace {

// Public figures (peaks) that the profiles are computed from:
// - VideoCore IV, Pi 3 and Zero 2 W: 12 QPUs of 4 lanes at 300 MHz = 28.8 GFLOPS (sci-pi.org.uk,
//   bench/video); Broadcom's product brief of the BCM2835 gives 25 M triangles/s and 1 Gpixel/s at
//   250 MHz, that is 30 M/s (33 ns) and 1.2 Gpixel/s (0.83 ns) at 300 MHz. LPDDR2-900, 32 bit,
//   shared by CPU, GPU and scan-out: 3.6 GB/s peak.
// - VideoCore VI, Pi 4: 8 QPUs at 500 MHz = 32 GFLOPS (same page); 1 triangle per 9 clocks as VC4
//   is assumed: 55 M/s (18 ns). LPDDR4-3200, 32 bit: about 3 times the bandwidth of the Pi 3.
// - Mali-450: ARM gives 104 M triangles/s and 3.8 Gpixel/s for 8 fragment cores at 480 MHz
//   (tomshardware.com, 16059). Boards with it (Amlogic S905X) have 3 cores at about 650 MHz:
//   141 M/s (7 ns; one geometry core) and 1.9 Gpixel/s (0.52 ns). DDR3, about 2 times the Pi 3.
// - GC7000Lite, i.MX 8M: 267 M triangles/s (3.7 ns), 1.6 Gpixel/s (0.63 ns), 25.6 GFLOPS (i.MX 8M
//   reference manual, quoted at ridgerun.com IMX8/GPU and community.nxp.com 494325).
// - CPU: Whetstone, one thread, 64 bit (raspberrypi.org forum 44080, R. Longbottom): Pi 3B+
//   (A53, 1.4 GHz) 1152 MWIPS, Pi 4B (A72, 1.5 GHz) 2395. Per A53 GHz 823: Zero 2 W (1.0 GHz) is
//   1.0 here, Pi 3 (1.2) 1.2, S905X and i.MX 8M (A53, 1.5) 1.5, Pi 4 2.9.
//
// What a real scene gets of a peak is our estimate, to be replaced when a board has been measured:
// a triangle costs 4 times its peak (vertices are shaded twice, for binning and for rendering, and
// lit, and most triangles are smaller than a quad row); a fragment costs the larger of its ALU time
// (about 12, 24 and 48 operations by tier, at a half of the peak) and 1.5 times peak fill; a target
// pixel costs its 4 bytes stored and 4 scanned out at half of the memory's peak.
constexpr float kA53VertexNs = 60.0f;    // FAT deformation, normal, upload: ~60 clocks at 1 GHz.
constexpr float kA53RecordNs = 2000.0f;  // Goal of the mesh room is 1 us on a PC, ~6 times faster.
constexpr float kA53FixedUs = 2200.0f;   // ~40 draws of 25 us in Mesa, agent, mixing, pose.

constexpr std::array<BoardCosts, 5> kBoards{{
    {"pi-zero-2w",
     kA53FixedUs,
     kA53VertexNs,
     kA53RecordNs,
     700.0f,
     132.0f,
     2.2f,
     {1.25f, 1.67f, 3.3f}},
    {"pi3",
     kA53FixedUs / 1.2f,
     kA53VertexNs / 1.2f,
     kA53RecordNs / 1.2f,
     700.0f,
     132.0f,
     2.2f,
     {1.25f, 1.67f, 3.3f}},
    {"pi4",
     kA53FixedUs / 2.9f,
     kA53VertexNs / 2.9f,
     kA53RecordNs / 2.9f,
     400.0f,
     72.0f,
     0.8f,
     {0.8f, 1.5f, 3.0f}},
    {"mali450",
     kA53FixedUs / 1.5f,
     kA53VertexNs / 1.5f,
     kA53RecordNs / 1.5f,
     800.0f,
     28.0f,
     1.1f,
     {0.8f, 1.4f, 2.8f}},
    {"gc7000",
     kA53FixedUs / 1.5f,
     kA53VertexNs / 1.5f,
     kA53RecordNs / 1.5f,
     600.0f,
     15.0f,
     0.8f,
     {0.95f, 1.9f, 3.75f}},
}};

std::uint32_t to_us(float us) { return static_cast<std::uint32_t>(std::max(us, 0.0f) + 0.5f); }

}  // namespace

std::span<const BoardCosts> boards() { return kBoards; }

const BoardCosts* find_board(std::span<const char> name) {
  for (const BoardCosts& board : kBoards)
    if (std::strlen(board.name) == name.size() &&
        std::memcmp(board.name, name.data(), name.size()) == 0)
      return &board;
  return nullptr;
}

Terms cpu_terms(const BoardCosts& board, const Work& work) {
  return {board.cpu_fixed_us,
          board.cpu_vertex_ns * 1e-3f * static_cast<float>(work.vertices_deformed),
          board.cpu_record_ns * 1e-3f * static_cast<float>(work.records)};
}

Terms gpu_terms(const BoardCosts& board, const Work& work) {
  const auto tier = static_cast<std::size_t>(work.shading);
  Terms terms{board.gpu_fixed_us,
              board.gpu_triangle_ns * 1e-3f * static_cast<float>(work.triangles),
              board.gpu_target_px_ns * 1e-3f * work.target_px};
  terms[3 + tier] = board.gpu_shaded_px_ns[tier] * 1e-3f * work.shaded_px;
  return terms;
}

FrameSample VirtualBoard::run(const Work& work, std::uint8_t frame_divisor,
                              const Disturbance& disturbance) {
  const float cpu_us =
      sum(cpu_terms(*costs_, work)) * disturbance.cpu_factor + disturbance.spike_us;
  const float gpu_us = sum(gpu_terms(*costs_, work)) * disturbance.gpu_factor;
  const float period_us = 1e6f / costs_->refresh_hz;
  const auto needed = static_cast<std::uint16_t>(
      std::min(std::ceil((cpu_us + gpu_us + kFlipLeadUs) / period_us), 60000.0f));
  const auto planned = static_cast<std::uint16_t>(vblanks_per_frame_ * frame_divisor);
  FrameSample sample;
  sample.vblanks = std::max(needed, planned);
  vblank_count_ += sample.vblanks;
  sample.time_us = time_us();
  sample.cpu_us = to_us(cpu_us);
  sample.gpu_us = disturbance.has_fence ? to_us(gpu_us) : FrameSample::kUnknown;
  sample.thermal = disturbance.thermal;
  sample.other_load_percent = disturbance.other_load_percent;
  sample.drawn = work;
  return sample;
}

std::uint64_t VirtualBoard::time_us() const {
  return static_cast<std::uint64_t>(static_cast<double>(vblank_count_) * 1e6 /
                                    static_cast<double>(costs_->refresh_hz));
}

}  // namespace caryatid::lod
