#pragma once
// How far long work is: a line on a terminal that is written over, elsewhere one every five
// seconds. Goes to stderr.
#include <chrono>
#include <string>

namespace caryatid::tool {

class Progress {
 public:
  Progress() = default;
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // What is under way from now on.
  void step(const std::string& what);
  // "what 3 of 10".
  void step(const std::string& what, std::size_t done, std::size_t total);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now(), said_ = began_;
  bool shown_ = false;
};

}  // namespace caryatid::tool
