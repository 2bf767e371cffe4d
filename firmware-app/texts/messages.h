#pragma once
// What is wrong with a deployer's files, one line each: "FILE:LINE: what; cure".
#include <cstddef>
#include <string>
#include <vector>

namespace caryatid::app {

enum class Severity {
  note,   // Something is left out or replaced; the rest stands.
  wrong,  // Not what the author can have meant: a reload is refused, a start falls back.
};

struct Message {
  Severity severity = Severity::note;
  std::string line;
};

class Messages {
 public:
  static constexpr std::size_t kMost = 50;

  void add(Severity severity, const std::string& file, std::size_t line, const std::string& what) {
    wrong_ = wrong_ || severity == Severity::wrong;
    if (all_.size() == kMost) return;
    const std::string place = line > 0 ? file + ":" + std::to_string(line) : file;
    all_.push_back({severity, place + ": " + what});
    for (char& c : all_.back().line)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  void note(const std::string& file, std::size_t line, const std::string& what) {
    add(Severity::note, file, line, what);
  }
  void wrong(const std::string& file, std::size_t line, const std::string& what) {
    add(Severity::wrong, file, line, what);
  }
  bool any_wrong() const { return wrong_; }
  const std::vector<Message>& all() const { return all_; }

 private:
  std::vector<Message> all_;
  bool wrong_ = false;
};

}  // namespace caryatid::app
