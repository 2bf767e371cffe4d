// Displays that cannot open say so in one line and leave nothing behind.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "platform/display/display.h"
#include "platform/display/gpu_timer.h"

namespace caryatid::platform {
namespace {

void expect_one_line(const ErrorLine& error) {
  EXPECT_GT(error.size(), 10u);
  EXPECT_EQ(std::strchr(error.c_str(), '\n'), nullptr);
}

TEST(Display, RefusesSenselessSizes) {
  for (const std::uint32_t width : {0u, 15u, 4097u}) {
    DisplayOptions options;
    options.kind = DisplayKind::surfaceless;
    options.width = width;
    std::unique_ptr<Display> display;
    ErrorLine error;
    EXPECT_EQ(open_display(options, display, error).code, Code::invalid_argument);
    EXPECT_EQ(display, nullptr);
    expect_one_line(error);
  }
}

TEST(Display, WindowWithoutAServerTellsWhatToDo) {
  const char* before = std::getenv("DISPLAY");
  const std::string kept = before != nullptr ? before : "";
  setenv("DISPLAY", ":987", 1);
  DisplayOptions options;
  options.kind = DisplayKind::window;
  std::unique_ptr<Display> display;
  ErrorLine error;
  EXPECT_FALSE(open_display(options, display, error).ok());
  EXPECT_EQ(display, nullptr);
  expect_one_line(error);
  // Automatic goes on without a window.
  options.kind = DisplayKind::automatic;
  if (open_display(options, display, error).ok()) {
    EXPECT_FALSE(display->has_surface());
  }
  display.reset();
  if (before != nullptr)
    setenv("DISPLAY", kept.c_str(), 1);
  else
    unsetenv("DISPLAY");
}

// What a display needs for the time of the GPU, llvmpipe has too: a fence behind the last draw.
TEST(Display, SurfacelessTimesTheGpuWhereAsked) {
  for (const bool asked : {true, false}) {
    DisplayOptions options;
    options.kind = DisplayKind::surfaceless;
    options.times_gpu = asked;
    std::unique_ptr<Display> display;
    ErrorLine error;
    ASSERT_TRUE(open_display(options, display, error).ok()) << error.c_str();
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_TRUE(display->present().ok());
      const Flip flip = display->last_flip();
      EXPECT_EQ(flip.count, 0u);
      EXPECT_EQ(flip.gpu_us != Flip::kNotTimed, asked);
    }
  }
}

// A sync file that is none: no time, and no crash.
TEST(GpuTimer, AskedAboutSomethingElseTheKernelCannotTell) {
  EXPECT_EQ(signalled_us(-1), -1);
  EXPECT_EQ(signalled_us(STDERR_FILENO), -1);
}

}  // namespace
}  // namespace caryatid::platform
