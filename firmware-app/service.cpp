#include "firmware-app/service.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "platform/log/log.h"

namespace caryatid::app {
namespace {

constexpr std::int64_t kStatusPeriod_us = 5'000'000, kStatePeriod_us = 60'000'000;

std::string read_small(const std::string& path) {
  std::string text;
  if (std::FILE* file = std::fopen(path.c_str(), "rb")) {
    char piece[kLastStateBytes + 1];
    text.assign(piece, std::fread(piece, 1, sizeof piece, file));
    std::fclose(file);
  }
  return text;
}

// 0, or the errno that the first write of `path` would meet: told at the start, not after 5 s.
int why_unwritable(const std::string& path) {
  struct stat there = {};
  if (::stat(path.c_str(), &there) == 0 && S_ISDIR(there.st_mode)) return EISDIR;
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

}  // namespace

bool Service::open(const Options& options, std::string* out_error) {
  status_path_ = options.status;
  prometheus_path_ = options.prometheus;
  const auto add = [this](const std::string& path, bool durable, std::size_t* file) {
    if (path.empty()) return true;
    if (const int error = why_unwritable(path))
      platform::log(platform::Event::file_refused, "%s: %s; the kiosk goes on without it",
                    path.c_str(), std::strerror(error));
    const Result<std::size_t> added = writer_.add(path.c_str(), durable);
    *file = added.value;
    return added.ok();
  };
  bool ok = add(status_path_, false, &status_file_);
  ok = ok && add(prometheus_path_, false, &prometheus_file_);
  if (!options.state.empty()) {
    state_path_ = options.state + "/state";
    ok = ok && add(state_path_, true, &state_file_);
    struct stat folder = {};
    if (::stat(options.state.c_str(), &folder) != 0 || !S_ISDIR(folder.st_mode)) {
      *out_error = options.state + ": not a folder; make it, or name one for the state";
      return false;
    }
    const std::string text = read_small(state_path_);
    if (!text.empty() && !parse_state(text, &state_))
      platform::log(platform::Event::state_refused, "%s: damaged; starting with a fresh one",
                    state_path_.c_str());
  }
  if (!ok) {
    *out_error = "--status, --prometheus or --state: a path is too long; name shorter ones";
    return false;
  }
  unclean_start_ = state_.running;
  ++state_.starts;
  state_.running = true;
  saved_presses_ = state_.presses;
  const bool writes = status_file_ != kNone || prometheus_file_ != kNone || state_file_ != kNone;
  if (writes && !writer_.start().ok()) {
    *out_error = "no thread for the status files; raise TasksMax of the service";
    return false;
  }
  save_state();
  platform::ErrorLine error;
  if (options.control.empty() || control_.open(options.control.c_str(), error).ok()) return true;
  *out_error = error.c_str();
  return false;
}

void Service::put(std::size_t file, std::string_view content, const char* name) {
  if (file == kNone) return;
  const Status status = writer_.put(file, content);
  if (!status.ok() && !told_[file])
    platform::log(platform::Event::file_refused, "%s: %s; the kiosk goes on without it", name,
                  std::strerror(status.detail));
  told_[file] = !status.ok();
}

void Service::save_state() {
  char text[kLastStateBytes];
  put(state_file_, format_state(state_, text), state_path_.c_str());
  saved_presses_ = state_.presses;
}

void Service::fill(KioskStatus* status) const {
  status->starts = state_.starts;
  status->unclean_start = unclean_start_;
  status->resident_bytes = memory_.bytes();
}

void Service::publish(std::int64_t now_us, const KioskStatus& status) {
  next_us_ = now_us + kStatusPeriod_us;
  put(status_file_, format_json(status, text_), status_path_.c_str());
  put(prometheus_file_, format_prometheus(status, text_), prometheus_path_.c_str());
  if (now_us < next_state_us_ || state_.presses == saved_presses_) return;
  next_state_us_ = now_us + kStatePeriod_us;
  save_state();
}

void Service::close() {
  state_.running = false;
  save_state();
  writer_.stop();
}

}  // namespace caryatid::app
