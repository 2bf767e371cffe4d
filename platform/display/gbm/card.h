#pragma once
// The graphics card that has the screens. On split hardware (Raspberry Pi 4, Mali, Vivante) the
// renderer is a card without connectors; Mesa finds it by itself from the one opened here.
#include "core/base/status.h"
#include "platform/error_line.h"

namespace caryatid::platform::gbm {

// Owns the file descriptor of a card.
class Card {
 public:
  Card() = default;
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;
  ~Card() { close(); }

  // Opens, of the cards with connectors, the first that has a screen connected, else the first.
  // io (no_card): none, or none that may be opened; the line says which.
  // `legacy`: without atomic mode setting, for a driver that promises it and gets it wrong.
  Status open(ErrorLine& out_error, bool legacy = false);
  void close();

  int fd() const { return fd_; }
  bool atomic() const { return atomic_; }        // Else the calls of old: SetCrtc and PageFlip.
  bool modifiers() const { return modifiers_; }  // Framebuffers with layouts of the vendor's own.
  // Whether we may set modes. Tries to become master where nobody is.
  bool take_master();

 private:
  void use(int fd, bool legacy);

  int fd_ = -1;
  bool atomic_ = false, modifiers_ = false;
};

}  // namespace caryatid::platform::gbm
