#include "firmware-app/status.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace caryatid::app {
namespace {

// Appends formatted text; once something did not fit, the whole is empty.
class Text {
 public:
  explicit Text(std::span<char> out) : out_(out) {}
  __attribute__((format(printf, 2, 3))) void add(const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    const std::size_t left = out_.size() - size_;
    const int n = std::vsnprintf(out_.data() + size_, left, format, arguments);
    va_end(arguments);
    if (n < 0 || static_cast<std::size_t>(n) >= left) {
      fits_ = false;
    } else {
      size_ += static_cast<std::size_t>(n);
    }
  }
  std::string_view view() const { return fits_ ? std::string_view(out_.data(), size_) : ""; }

 private:
  std::span<char> out_;
  std::size_t size_ = 0;
  bool fits_ = true;
};

const char* boolean(bool value) { return value ? "true" : "false"; }
unsigned long long whole(std::uint64_t value) { return value; }

}  // namespace

std::string_view format_json(const KioskStatus& s, std::span<char> out) {
  Text t(out);
  t.add("{\"uptime_s\":%.1f,\"starts\":%llu,\"unclean_start\":%s,\"frames\":%llu,", s.uptime_s,
        whole(s.starts), boolean(s.unclean_start), whole(s.frames));
  if (s.start.picture_s >= 0.0) t.add("\"picture_s\":%.3f,", s.start.picture_s);
  if (s.start.person_s >= 0.0) t.add("\"person_s\":%.3f,", s.start.person_s);
  t.add("\"late_frames\":%llu,\"presses\":%llu,\"triangles\":%u,\"cpu_ms\":%.3f,",
        whole(s.late_frames), whole(s.presses), s.triangles, s.cpu_ms);
  t.add("\"emotion\":\"%s\",", emotion::kEmotionNames[emotion::index_of(s.emotion)].data());
  if (s.has_temperature)
    t.add("\"temperature_celsius\":%.1f,", s.temperature_celsius);
  else
    t.add("\"temperature_celsius\":null,");
  t.add("\"rejected_edges\":%llu,\"button_lost\":%s,", whole(s.rejected_edges),
        boolean(s.button_lost));
  t.add(
      "\"under_voltage\":%s,\"throttled\":%s,\"builtin_face\":%s,\"config_refused\":%s,\"heartbeat_"
      "late\":%s,",
      boolean(s.under_voltage), boolean(s.throttled), boolean(s.builtin_face),
      boolean(s.config_refused), boolean(s.heartbeat_late));
  t.add("\"resident_bytes\":%llu,\"arena_bytes\":%llu,\"allocations_since_seal\":%llu}",
        whole(s.resident_bytes), whole(s.arena_bytes), whole(s.allocations_since_seal));
  return t.view();
}

std::string_view format_prometheus(const KioskStatus& s, std::span<char> out) {
  Text t(out);
  const auto metric = [&t](const char* name, const char* kind, const char* help, double value) {
    t.add("# HELP caryatid_%s %s\n# TYPE caryatid_%s %s\ncaryatid_%s %.10g\n", name, help, name,
          kind, name, value);
  };
  const auto count = [&metric](const char* name, const char* help, std::uint64_t value) {
    metric(name, "counter", help, static_cast<double>(value));
  };
  const auto gauge = [&metric](const char* name, const char* help, double value) {
    metric(name, "gauge", help, value);
  };
  const auto yes = [&gauge](const char* name, const char* help, bool value) {
    gauge(name, help, value ? 1.0 : 0.0);
  };
  gauge("uptime_seconds", "Since the first frame.", s.uptime_s);
  count("starts_total", "Starts of the program on this board.", s.starts);
  count("frames_total", "Frames drawn.", s.frames);
  count("late_frames_total", "Frames that missed their refresh.", s.late_frames);
  count("presses_total", "Presses of buttons that mean something.", s.presses);
  count("rejected_edges_total", "Edges of buttons that were bounce.", s.rejected_edges);
  count("allocations_after_seal_total", "Heap calls of the frame loop; 0.",
        s.allocations_since_seal);
  if (s.start.picture_s >= 0.0)
    gauge("start_picture_seconds", "Process start to built-in picture.", s.start.picture_s);
  if (s.start.person_s >= 0.0)
    gauge("start_person_seconds", "Process start to the person.", s.start.person_s);
  gauge("triangles", "Of the person, as drawn last.", s.triangles);
  gauge("frame_cpu_seconds", "CPU time of the last frame.", s.cpu_ms * 1e-3);
  if (s.has_temperature)
    gauge("temperature_celsius", "Of the hottest zone.", s.temperature_celsius);
  yes("button_lost", "A device of buttons is away.", s.button_lost);
  yes("under_voltage", "The supply sags now.", s.under_voltage);
  yes("throttled", "The firmware slows the clock now.", s.throttled);
  yes("builtin_face", "The pack can't be used; out of order.", s.builtin_face);
  yes("config_refused", "kiosk.toml can't be used; another one is.", s.config_refused);
  yes("heartbeat_late", "Screen, input or sound stand still.", s.heartbeat_late);
  gauge("resident_bytes", "Memory of the process.", static_cast<double>(s.resident_bytes));
  gauge("arena_bytes", "Memory of the agent.", static_cast<double>(s.arena_bytes));
  return t.view();
}

ResidentMemory::ResidentMemory() : descriptor_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)) {}

ResidentMemory::~ResidentMemory() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t ResidentMemory::bytes() const {
  char text[128] = {};
  if (descriptor_ < 0 || ::pread(descriptor_, text, sizeof text - 1, 0) <= 0) return 0;
  char* second = nullptr;
  (void)std::strtoull(text, &second, 10);  // Of the address space; the second is resident pages.
  const unsigned long long pages = std::strtoull(second, nullptr, 10);
  return pages * static_cast<unsigned long long>(::sysconf(_SC_PAGESIZE));
}

}  // namespace caryatid::app
