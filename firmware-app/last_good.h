#pragma once
// The configuration that worked last, kept as copies of its files, so that a wrong edit of
// kiosk.toml costs the edit and not the kiosk. Host side of the start: may allocate.
#include <string>
#include <vector>

namespace caryatid::app {

class LastGood {
 public:
  // state: the folder of --state; empty: nothing is kept.
  explicit LastGood(std::string state) : state_(std::move(state)) {}

  // Keeps `files` (full names; those outside the folder of `config`, or unreadable, are left out).
  // Copies only when something changed, whole: a power cut leaves the old or the new ones. False:
  // the disk refuses.
  bool keep(const std::string& config, const std::vector<std::string>& files) const;
  // Path of the kept kiosk.toml, or "" when there is none.
  std::string config() const;

 private:
  std::string state_;
};

}  // namespace caryatid::app
