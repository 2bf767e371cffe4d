#pragma once
// A Weston without a screen for one test: its socket lies in a folder of its own, to which the
// environment points while it lives.
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace caryatid::golden {

class Weston {
 public:
  // `shell`: desktop-shell.so shows windows; kiosk-shell.so sizes them to the screen, and without
  // a seat, as here, never shows them.
  explicit Weston(const std::string& shell) {
    char folder[] = "/tmp/caryatid-wayland-XXXXXX";  // Short: the name of a socket has 107 bytes.
    if (mkdtemp(folder) == nullptr) return;
    folder_ = folder;
    setenv("XDG_RUNTIME_DIR", folder, 1);
    setenv("WAYLAND_DISPLAY", "toy", 1);
    process_ = fork();
    if (process_ == 0) run(folder_ + "/log", "--shell=" + shell);
    using namespace std::chrono_literals;
    for (int i = 0; i < 1000 && process_ > 0; ++i) {
      if (std::filesystem::exists(folder_ + "/toy")) return;
      if (waitpid(process_, nullptr, WNOHANG) == process_) process_ = 0;
      std::this_thread::sleep_for(10ms);
    }
  }
  Weston(const Weston&) = delete;
  Weston& operator=(const Weston&) = delete;
  ~Weston() {
    stop();
    unsetenv("WAYLAND_DISPLAY");
    unsetenv("XDG_RUNTIME_DIR");
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }

  bool answers() const { return process_ > 0 && std::filesystem::exists(folder_ + "/toy"); }
  // As a crash: without a good-bye to anybody.
  void stop() {
    if (process_ <= 0) return;
    kill(-process_, SIGKILL);  // Weston's own helpers too.
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  [[noreturn]] static void run(const std::string& log, const std::string& shell) {
    setpgid(0, 0);
    unsetenv("WAYLAND_DISPLAY");  // This one is nobody's guest.
    unsetenv("DISPLAY");
    if (freopen(log.c_str(), "w", stdout) == nullptr || dup2(1, 2) < 0) _exit(127);
    execl(CARYATID_WESTON, "weston", "--backend=headless-backend.so", "--use-pixman",
          "--socket=toy", "--width=240", "--height=160", "--idle-time=0", "--no-config",
          shell.c_str(), nullptr);
    _exit(127);
  }

  std::string folder_;
  pid_t process_ = 0;
};

}  // namespace caryatid::golden
