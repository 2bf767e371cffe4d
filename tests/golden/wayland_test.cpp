// The Wayland window on a real compositor: Weston without a screen.
#include <cstdlib>
#include <string>

#include "tests/golden/studio.h"
#include "tests/golden/weston.h"

namespace caryatid::golden {
namespace {

class WaylandStudio : public Studio {
 protected:
  void SetUp() override {
    unsetenv("DISPLAY");
    if (std::string(CARYATID_WESTON).empty()) GTEST_SKIP() << "weston is not installed";
  }
  void TearDown() override {
    Studio::TearDown();
    display_.reset();
  }
  void open_window(platform::DisplayKind kind = platform::DisplayKind::window) {
    platform::ErrorLine error;
    platform::DisplayOptions options;
    options.kind = kind;
    options.width = 320;
    options.height = 200;
    ASSERT_TRUE(platform::open_display(options, display_, error).ok()) << error.c_str();
    ASSERT_STREQ(display_->name(), "window (Wayland)");
    shared_display = display_.get();
    platform::RenderOptions r;
    r.width = display_->width();
    r.height = display_->height();
    r.proc_address = [](const char* name) { return shared_display->proc_address(name); };
    ASSERT_TRUE(platform::open_gles_renderer(pack_.view(), false, r, renderer_, error).ok())
        << error.c_str();
  }
  Status show_frame() {
    platform::DisplayEvents events;
    CARYATID_TRY(display_->poll(0, events));
    CARYATID_TRY(renderer_->draw(pack_.list()));
    return display_->present();
  }
};

TEST_F(WaylandStudio, ShowsFramesInTheSizeAskedFor) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window());
  EXPECT_EQ(display_->width(), 320u);
  EXPECT_EQ(display_->height(), 200u);
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(show_frame().ok()) << i;
}

TEST_F(WaylandStudio, AutomaticPrefersIt) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window(platform::DisplayKind::automatic));
  EXPECT_TRUE(show_frame().ok());
}

TEST_F(WaylandStudio, TakesTheScreensSizeAndIsNotBlockedWhileHidden) {
  const Weston weston("kiosk-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window());
  EXPECT_EQ(display_->width(), 240u);
  EXPECT_EQ(display_->height(), 160u);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(show_frame().ok()) << i;
}

TEST_F(WaylandStudio, ALostCompositorIsALostDevice) {
  Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window());
  ASSERT_TRUE(show_frame().ok());
  weston.stop();
  // What it had sent before comes first.
  Status status;
  for (int i = 0; i < 8 && status.ok(); ++i) status = show_frame();
  EXPECT_EQ(status.code, Code::device_lost);
  platform::DisplayEvents events;
  EXPECT_EQ(display_->poll(0, events).code, Code::device_lost);
  EXPECT_EQ(display_->present().code, Code::device_lost);
  Studio::TearDown();
  display_.reset();
  platform::ErrorLine error;
  platform::DisplayOptions options;
  options.kind = platform::DisplayKind::window;
  EXPECT_EQ(platform::open_display(options, display_, error).code, Code::io);
  EXPECT_GT(error.size(), 10u);
}

TEST_F(WaylandStudio, TheWholeProgramRunsInIt) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  const std::string command = std::string(CARYATID_PROGRAM) +
                              " --display window --duration 2 --pack " CARYATID_SOURCE_DIR
                              "/firmware-app/builtin_face.pack";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace caryatid::golden
