#include "platform/display/gbm/console.h"

#include <linux/kd.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace caryatid::platform::gbm {
namespace {

// For the crash handler, which has no object.
int g_mode_before = KD_TEXT, g_keyboard_before = K_UNICODE;

// Only calls that are safe in a signal handler.
void put_back() {
  ioctl(STDIN_FILENO, KDSKBMODE, g_keyboard_before);
  ioctl(STDIN_FILENO, KDSETMODE, g_mode_before);
}

void on_crash(int signal_number) {
  put_back();
  raise(signal_number);  // Its own action is back (SA_RESETHAND): the process ends as it would.
}

void watch_crashes() {
  struct sigaction action {};
  action.sa_handler = on_crash;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    sigaction(crash, &action, nullptr);
}

}  // namespace

bool Console::take() {
  if (taken_) return true;
  if (ioctl(STDIN_FILENO, KDGETMODE, &g_mode_before) != 0) return false;
  if (ioctl(STDIN_FILENO, KDGKBMODE, &g_keyboard_before) != 0) g_keyboard_before = K_UNICODE;
  // A program that was killed hard has left these; nobody wants them back.
  if (g_mode_before == KD_GRAPHICS) g_mode_before = KD_TEXT;
  if (g_keyboard_before == K_OFF) g_keyboard_before = K_UNICODE;
  watch_crashes();
  taken_ = ioctl(STDIN_FILENO, KDSETMODE, KD_GRAPHICS) == 0;
  if (taken_) ioctl(STDIN_FILENO, KDSKBMODE, K_OFF);
  return taken_;
}

void Console::give_back() {
  if (taken_) put_back();
  taken_ = false;
}

}  // namespace caryatid::platform::gbm
