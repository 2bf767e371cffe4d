#pragma once
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/golden/runtime_folder.h"

namespace caryatid::golden {

// A Weston without a screen for one test.
class Weston {
 public:
  // `shell`: desktop-shell.so shows windows; kiosk-shell.so sizes them to the screen, and without
  // a seat, as here, never shows them.
  explicit Weston(const std::string& shell) {
    process_ = fork();
    if (process_ == 0) run(folder_.file("log"), "--shell=" + shell);
    using namespace std::chrono_literals;
    for (int i = 0; i < 1000 && process_ > 0 && !answers(); ++i) {
      if (waitpid(process_, nullptr, WNOHANG) == process_) process_ = 0;
      std::this_thread::sleep_for(10ms);
    }
  }
  Weston(const Weston&) = delete;
  Weston& operator=(const Weston&) = delete;
  ~Weston() { stop(); }

  bool answers() const { return process_ > 0 && std::filesystem::exists(folder_.file("toy")); }
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
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // A test that crashes leaves none behind.
    unsetenv("WAYLAND_DISPLAY");       // This one is nobody's guest.
    unsetenv("DISPLAY");
    if (freopen(log.c_str(), "w", stdout) == nullptr || dup2(1, 2) < 0) _exit(127);
    execl(CARYATID_WESTON, "weston", "--backend=headless-backend.so", "--use-pixman",
          "--socket=toy", "--width=240", "--height=160", "--idle-time=0", "--no-config",
          shell.c_str(), nullptr);
    _exit(127);
  }

  RuntimeFolder folder_;
  pid_t process_ = 0;
};

}  // namespace caryatid::golden
