#include "firmware-app/metrics.h"

#include <algorithm>

namespace caryatid::app {
namespace {

void write_speech(std::FILE* file, const SpeechMetrics& m) {
  if (!m.speaking) return;
  const auto number = [file](const char* name, float value) {
    std::fprintf(file, "\"%s\":%.1f,", name, static_cast<double>(value));
  };
  std::fputs("\"speech\":{", file);
  number("heard_ms", m.heard_ms);
  number("strength_percent", 100.0f * m.strength);
  number("jaw", m.jaw);
  number("upper_lip", m.upper_lip);
  number("lower_lip", m.lower_lip);
  number("corner", m.corner);
  number("lower_thrust", m.lower_thrust);
  number("upper_thrust", m.upper_thrust);
  number("tongue_forward", m.tongue_forward);
  std::fprintf(file, "\"word\":%d},", m.word);
}

}  // namespace

bool MetricsFile::open(const char* path) {
  file_ = std::fopen(path, "w");
  if (file_ == nullptr) return false;
  return std::setvbuf(file_, buffer_, _IOFBF, sizeof buffer_) == 0;
}

bool MetricsFile::close() {
  const bool whole = file_ == nullptr || std::fclose(file_) == 0;
  file_ = nullptr;
  return whole;
}

bool MetricsFile::write(const FrameMetrics& m, const pack::View& pack) {
  if (file_ == nullptr) return true;
  std::fprintf(file_, "{\"time_s\":%.4f,\"frame_ms\":%.3f,\"cpu_ms\":%.3f,", m.time_s, m.frame_ms,
               m.cpu_ms);
  if (m.gpu_ms < 0.0)
    std::fputs("\"gpu_ms\":null,", file_);
  else
    std::fprintf(file_, "\"gpu_ms\":%.3f,", m.gpu_ms);
  if (m.reaction_ms >= 0.0) std::fprintf(file_, "\"reaction_ms\":%.3f,", m.reaction_ms);
  if (m.start.picture_s >= 0.0) std::fprintf(file_, "\"picture_s\":%.3f,", m.start.picture_s);
  if (m.start.person_s >= 0.0) std::fprintf(file_, "\"person_s\":%.3f,", m.start.person_s);
  std::fprintf(file_, "\"late\":%s,\"triangles\":%u,\"lod\":{", m.late ? "true" : "false",
               m.triangles);
  const std::size_t objects = std::min(m.lod.size(), pack.objects.size());
  for (std::size_t o = 0; o < objects; ++o)
    std::fprintf(file_, "%s\"%s\":%u", o > 0 ? "," : "", pack.objects[o].name, m.lod[o]);
  std::fprintf(file_, "},\"render_scale\":%.3f,\"shading\":%d,\"emotion\":\"%s\",\"viseme\":%d,",
               static_cast<double>(m.render_scale), m.shading,
               emotion::kEmotionNames[emotion::index_of(m.emotion)].data(), m.speech.viseme);
  write_speech(file_, m.speech);
  std::fprintf(file_, "\"allocations_since_seal\":%llu,\"arena_bytes_used\":%llu}\n",
               static_cast<unsigned long long>(m.allocations_since_seal),
               static_cast<unsigned long long>(m.arena_bytes_used));
  // Who watches a kiosk wants to see its last second, whatever the frame rate.
  if (m.time_s >= flush_s_) {
    std::fflush(file_);
    flush_s_ = m.time_s + 1.0;
  }
  if (std::ferror(file_) == 0) return true;
  (void)close();
  return false;
}

}  // namespace caryatid::app
