// The Wayland window on a real compositor, Weston without a screen, and on one of our own that does
// what a test wants: keys, sizes, a look at the picture.
#include <linux/input-event-codes.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "tests/golden/studio.h"
#include "tests/golden/toy_compositor.h"
#include "tests/golden/weston.h"

namespace caryatid::golden {
namespace {

class WaylandStudio : public Studio {
 protected:
  void SetUp() override { unsetenv("DISPLAY"); }
  void TearDown() override {
    Studio::TearDown();
    display_.reset();
  }
  void open_window(std::uint32_t width, std::uint32_t height,
                   platform::DisplayKind kind = platform::DisplayKind::window) {
    platform::ErrorLine error;
    platform::DisplayOptions options;
    options.kind = kind;
    options.width = width;
    options.height = height;
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

class OnWeston : public WaylandStudio {
 protected:
  void SetUp() override {
    WaylandStudio::SetUp();
    if (std::string(CARYATID_WESTON).empty()) GTEST_SKIP() << "weston is not installed";
  }
};

TEST_F(OnWeston, ShowsFramesInTheSizeAskedFor) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window(320, 200));
  EXPECT_EQ(display_->width(), 320u);
  EXPECT_EQ(display_->height(), 200u);
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(show_frame().ok()) << i;
}

TEST_F(OnWeston, AutomaticPrefersIt) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window(320, 200, platform::DisplayKind::automatic));
  EXPECT_TRUE(show_frame().ok());
}

TEST_F(OnWeston, TakesTheScreensSizeAndIsNotBlockedWhileHidden) {
  const Weston weston("kiosk-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window(320, 200));
  EXPECT_EQ(display_->width(), 240u);
  EXPECT_EQ(display_->height(), 160u);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(show_frame().ok()) << i;
}

TEST_F(OnWeston, ALostCompositorIsALostDevice) {
  Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  ASSERT_NO_FATAL_FAILURE(open_window(320, 200));
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

TEST_F(OnWeston, TheWholeProgramRunsInIt) {
  const Weston weston("desktop-shell.so");
  ASSERT_TRUE(weston.answers());
  const std::string command = std::string(CARYATID_PROGRAM) +
                              " --display window --duration 2 --pack " CARYATID_SOURCE_DIR
                              "/firmware-app/builtin_face.pack";
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said;
  char piece[512];
  while (std::fgets(piece, sizeof piece, pipe) != nullptr) said += piece;
  EXPECT_EQ(pclose(pipe), 0) << said;
  // The built-in picture came first, and a renderer without a GPU is told.
  const std::size_t picture = said.find("built-in face on the screen"),
                    person = said.find("person on the screen");
  EXPECT_LT(picture, person) << said;
  EXPECT_NE(person, std::string::npos) << said;
  ASSERT_NO_FATAL_FAILURE(open_window(64, 48));
  EXPECT_EQ(said.find("drawn by the CPU") != std::string::npos, renderer_->caps().software) << said;
}

class OnToy : public WaylandStudio {
 protected:
  void SetUp() override {
    WaylandStudio::SetUp();
    ASSERT_NO_FATAL_FAILURE(open_window(kWidth, kHeight));
    ASSERT_TRUE(show_frame().ok());
    seen_ = await_picture(kWidth);  // After it, the compositor has heard all that came before.
    ASSERT_EQ(seen_.height, kHeight);
  }
  Image await_picture(std::uint32_t width) {
    using namespace std::chrono_literals;
    for (int i = 0; i < 2000 && toy_.picture().width != width; ++i)
      std::this_thread::sleep_for(1ms);
    return toy_.picture();
  }
  platform::DisplayEvents poll() {
    platform::DisplayEvents events;
    EXPECT_TRUE(display_->poll(77, events).ok());
    return events;
  }

  ToyCompositor toy_;
  Image seen_;
};

TEST_F(OnToy, ShowsWhatTheOffscreenRendererDraws) { expect_golden(seen_, "materials_per_pixel"); }

TEST_F(OnToy, DigitsOfBothRowsAreButtons) {
  toy_.press(KEY_3);
  toy_.press(KEY_KP7);
  toy_.press(KEY_0);
  const platform::DisplayEvents events = poll();
  ASSERT_EQ(events.buttons.size(), 4u);
  EXPECT_EQ(events.buttons[0].button, 3);
  EXPECT_TRUE(events.buttons[0].pressed);
  EXPECT_EQ(events.buttons[1].button, 3);
  EXPECT_FALSE(events.buttons[1].pressed);
  EXPECT_EQ(events.buttons[2].button, 7);
  EXPECT_EQ(events.buttons[0].time_us, 77);
  EXPECT_FALSE(events.close_requested);
  EXPECT_EQ(poll().buttons.size(), 0u);
}

TEST_F(OnToy, KeysHeardWhileAFrameIsShownAreKept) {
  toy_.press(KEY_1);
  ASSERT_TRUE(display_->present().ok());
  EXPECT_EQ(poll().buttons.size(), 2u);
}

TEST_F(OnToy, EscapeQAndTheCompositorAskToClose) {
  EXPECT_FALSE(poll().close_requested);
  toy_.press(KEY_ESC);
  EXPECT_TRUE(poll().close_requested);
  toy_.press(KEY_Q);
  EXPECT_TRUE(poll().close_requested);
  EXPECT_FALSE(poll().close_requested);
  toy_.close_window();
  EXPECT_TRUE(poll().close_requested);
}

TEST_F(OnToy, TellsItsNewSizeAndDrawsInIt) {
  (void)poll();
  toy_.resize(320, 200);
  EXPECT_TRUE(poll().resized);
  EXPECT_EQ(display_->width(), 320u);
  EXPECT_EQ(display_->height(), 200u);
  ASSERT_TRUE(renderer_->resize(display_->width(), display_->height()).ok());
  ASSERT_TRUE(show_frame().ok());
  EXPECT_EQ(await_picture(320).height, 200u);
  toy_.resize(0, 0);  // The size is ours to choose: it stays.
  EXPECT_FALSE(poll().resized);
  EXPECT_EQ(display_->width(), 320u);
}

TEST_F(OnToy, LivesOnWithoutItsKeyboard) {
  toy_.unplug_keyboard();
  EXPECT_EQ(poll().buttons.size(), 0u);
  EXPECT_TRUE(show_frame().ok());
}

}  // namespace
}  // namespace caryatid::golden
