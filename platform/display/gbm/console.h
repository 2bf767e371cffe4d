#pragma once
// The text console behind the kiosk. Where standard input is a virtual terminal, it is ours: its
// cursor and its keyboard must not show through. systemd's unit gives one by StandardInput=tty.
namespace caryatid::platform::gbm {

class Console {
 public:
  Console() = default;
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console() { give_back(); }

  // False: standard input is no virtual terminal, and nothing was changed.
  bool take();
  // Text and keyboard as they were. Also done when the program crashes.
  void give_back();

 private:
  bool taken_ = false;
};

}  // namespace caryatid::platform::gbm
