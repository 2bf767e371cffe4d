#pragma once
// --metrics: JSON lines, one a frame, for caryatid-tool plot and for whoever watches the kiosk.
#include <cstdint>
#include <cstdio>
#include <span>

#include "core/emotion/emotion.h"
#include "core/pack/view.h"
#include "firmware-app/start_times.h"

namespace caryatid::app {

// The mouth and what is heard with it; FAPs 3, 4, 5, 6, 16, 17 and 45 of the face that is shown.
struct SpeechMetrics {
  bool speaking = false;
  float heard_ms = 0.0f;  // Position in the utterance.
  int word = -1;
  int viseme = 0;  // That is shown the most, 0..14.
  float strength = 0.0f;
  float jaw = 0.0f, upper_lip = 0.0f, lower_lip = 0.0f, corner = 0.0f, lower_thrust = 0.0f,
        upper_thrust = 0.0f, tongue_forward = 0.0f;
};

struct FrameMetrics {
  double time_s = 0.0;
  double frame_ms = 0.0;  // From the frame before to this one.
  double cpu_ms = 0.0;
  double gpu_ms = -1.0;  // Negative: the driver has no timer; null in the file.
  bool late = false;
  // From the edge of a press (a GPIO line's: the kernel's time stamp) to the flip that first shows
  // it; negative: no press in this frame.
  double reaction_ms = -1.0;
  std::uint32_t triangles = 0;
  std::span<const std::uint32_t> lod;  // Triangles by object of the pack.
  float render_scale = 1.0f;
  int shading = 0;
  emotion::Emotion emotion = emotion::Emotion::calm;
  SpeechMetrics speech;
  StartTimes start;  // Told once; negative: not in this frame.
  std::uint64_t allocations_since_seal = 0;
  std::uint64_t arena_bytes_used = 0;
};

// Opened before memory is sealed; write() formats into a buffer of its own.
class MetricsFile {
 public:
  ~MetricsFile() { (void)close(); }
  bool open(const char* path);
  // False once, when the disk refuses; then writes nothing more.
  bool write(const FrameMetrics& m, const pack::View& pack);
  // False when what was left could not be written.
  bool close();

 private:
  std::FILE* file_ = nullptr;
  double flush_s_ = 0.0;
  char buffer_[65536];
};

}  // namespace caryatid::app
