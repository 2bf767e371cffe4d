#pragma once
// --control: a Unix socket through which other programs of the deployer drive the person, one line
// a command, one line an answer. Never blocks, never allocates after open(); what a client sends
// too fast, too long or in pieces costs that client and nobody else.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/status.h"
#include "platform/error_line.h"

namespace caryatid::platform {

using ControlReply = FixedString<1023>;  // One line, without its newline.

class Control {
 public:
  static constexpr std::size_t kMaxClients = 4;
  static constexpr std::size_t kMaxLineBytes = 1024;
  static constexpr int kMaxLinesPerPoll = 16;  // Of all clients: a flood takes no frame.

  // `line` is without its newline and any carriage return before it.
  using Handler = void (*)(void* receiver, std::span<const char> line, ControlReply& reply);

  Control() = default;
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  // Listens at `path` (mode 0660, so that the folder's group may connect). A socket that nobody
  // listens at any more is replaced; a living one or any other file is left alone.
  // io, invalid_argument (too long): `out_error` says what and what to do.
  Status open(const char* path, ErrorLine& out_error);
  bool active() const { return listener_ >= 0; }
  // Accepts, reads and answers what has come. Once a frame.
  void poll(void* receiver, Handler handle);

 private:
  struct Client {
    int descriptor = -1;
    std::size_t size = 0;
    bool skipping = false;    // Inside a line that is too long.
    std::uint64_t heard = 0;  // The poll in which something came last.
    std::array<char, kMaxLineBytes> line{};
  };
  void accept_new();
  bool read(Client& client, void* receiver, Handler handle, int* lines_left);
  bool take_lines(Client& client, void* receiver, Handler handle, int* lines_left);
  static bool answer(Client& client, const ControlReply& reply);

  int listener_ = -1;
  std::uint64_t polls_ = 0;
  FixedString<107> path_;  // As long as sockaddr_un::sun_path.
  std::array<Client, kMaxClients> clients_{};
};

}  // namespace caryatid::platform
