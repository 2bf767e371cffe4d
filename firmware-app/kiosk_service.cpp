// The kiosk's side of --control, the status files and --list-hardware.
#include <algorithm>
#include <cstdio>

#include "firmware-app/allocations.h"
#include "firmware-app/command.h"
#include "firmware-app/kiosk.h"
#include "platform/clock/clock.h"
#include "platform/inventory/inventory.h"

namespace caryatid::app {
namespace {

void answer(platform::ControlReply& reply, std::string_view text) { reply.assign(text); }

void refuse(platform::ControlReply& reply, std::string_view why) {
  char line[256];
  const int n =
      std::snprintf(line, sizeof line, "error: %.*s", static_cast<int>(why.size()), why.data());
  reply.assign({line, std::min(static_cast<std::size_t>(n), sizeof line - 1)});
}

}  // namespace

bool Kiosk::press(std::string_view name, bool down) {
  const int index = config_.buttons.find(name);
  if (index < 0) return false;
  return events_.push({static_cast<std::uint16_t>(index + 1), down, platform::monotonic_us()});
}

void Kiosk::obey(std::string_view line, platform::ControlReply& reply) {
  const Command c = parse_command(line);
  switch (c.kind) {
    case CommandKind::press:
    case CommandKind::release:
      if (!press(c.text, c.kind == CommandKind::press))
        return refuse(reply, "no such button in kiosk.toml");
      return answer(reply, "ok");
    case CommandKind::feel:
      agent_->feel(c.emotion, c.strength);
      return answer(reply, "ok");
    case CommandKind::status: {
      KioskStatus s = status();
      service_.fill(&s);
      char text[1024];
      return answer(reply, format_json(s, text));
    }
    case CommandKind::help:
      return answer(reply, kCommands);
    case CommandKind::say:
      say_plain(c.text);
      return answer(reply, "ok");
    case CommandKind::play:
      return play(c.text, reply);
    case CommandKind::wrong:
      return refuse(reply, c.text);
  }
}

void Kiosk::play(std::string_view file, platform::ControlReply& reply) {
  if (file.empty()) {
    player_.stop_stream();
    return answer(reply, "ok");
  }
  if (player_.play_stream(file, last_time_s_)) return answer(reply, "ok");
  refuse(reply, "not an .fba stream that can be read; make one with caryatid-tool fba encode");
}

KioskStatus Kiosk::status() const {
  KioskStatus s;
  s.uptime_s = report_.seconds;
  s.start = start_times_;
  s.frames = frame_number_;
  s.late_frames = report_.late_frames;
  s.presses = presses_;
  s.rejected_edges = panel_.rejected_edges();
  s.button_lost = panel_.device_lost();
  s.triangles = person_.triangle_count();
  s.cpu_ms = sample_.cpu_us == lod::FrameSample::kUnknown ? 0.0 : sample_.cpu_us * 1e-3;
  s.emotion = agent_->emotion();
  s.has_temperature = heat_known_;
  s.temperature_celsius = heat_.temperature_mC * 1e-3;
  s.under_voltage = heat_.supply && heat_.supply->under_voltage;
  s.throttled = heat_.supply && heat_.supply->throttled;
  s.builtin_face = pack_refused_;
  s.config_refused = config_refused_;
  s.heartbeat_late = notifier_.withheld(platform::monotonic_us());
  s.arena_bytes = report_.arena_bytes;
  s.allocations_since_seal = allocations_since_seal();
  return s;
}

bool Kiosk::list_hardware(const Options& options) {
  platform::list_hardware(stdout);
  Kiosk kiosk(options);
  kiosk.options_.pack.clear();
  if (!kiosk.open_person() || !kiosk.open_display() || !kiosk.open_renderer()) return false;
  const platform::GpuCaps& caps = kiosk.renderer_->caps();
  std::printf("GPU by display %s\n  %s, %s%s\n", kiosk.display_ ? kiosk.display_->name() : "none",
              caps.renderer.c_str(), caps.version.c_str(),
              caps.software ? "  (software: no GPU driver is in use)" : "");
  std::printf(
      "  %u vertex and %u fragment uniform vectors, %u varyings, textures to %u, mediump of "
      "%u bits\n",
      caps.vertex_vectors, caps.fragment_vectors, caps.varying_vectors, caps.max_texture_size,
      caps.fragment_mantissa);
  std::printf("  ETC1 %s, %u samples offscreen, timer queries %s\n", caps.etc1 ? "yes" : "no",
              caps.max_samples, caps.timer ? "yes" : "no");
  return true;
}

}  // namespace caryatid::app
