#pragma once
// What a deployer's other programs see of the kiosk: control socket, status file, Prometheus text,
// and the state that outlives power cuts. Everything is opened before memory is sealed.
#include <string>

#include "firmware-app/last_state.h"
#include "firmware-app/options.h"
#include "firmware-app/status.h"
#include "platform/control/control.h"
#include "platform/files/background_writer.h"

namespace caryatid::app {

class Service {
 public:
  // False: `out_error` is one line. A state file that is missing or damaged is no error.
  bool open(const Options& options, std::string* out_error);

  platform::Control& control() { return control_; }
  // Of earlier runs, and what this one adds.
  LastState& state() { return state_; }
  bool unclean_start() const { return unclean_start_; }

  // True when the files are due: status every 5 s, state every 60 s where it changed.
  bool due(std::int64_t now_us) const { return now_us >= next_us_; }
  // Adds what the service knows itself.
  void fill(KioskStatus* status) const;
  // Writes the files that are due.
  void publish(std::int64_t now_us, const KioskStatus& status);
  // The goodbye: the next start is a clean one.
  void close();

 private:
  void put(std::size_t file, std::string_view content, const char* name);
  void save_state();

  platform::Control control_;
  platform::BackgroundWriter writer_;
  ResidentMemory memory_;
  std::string status_path_, prometheus_path_, state_path_;
  std::size_t status_file_ = kNone, prometheus_file_ = kNone, state_file_ = kNone;
  static constexpr std::size_t kNone = ~std::size_t{0};
  LastState state_;
  std::uint64_t saved_presses_ = 0;
  bool unclean_start_ = false;
  std::int64_t next_us_ = 0, next_state_us_ = 0;
  bool told_[platform::BackgroundWriter::kMaxFiles] = {};
  char text_[platform::BackgroundWriter::kMaxFileBytes];
};

}  // namespace caryatid::app
