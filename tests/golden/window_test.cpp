// The window display on an X server (Xvfb in CI): opens, draws, hears keys, resizes, closes.
#include "tests/golden/studio.h"

// Xlib names macros like everybody; so it comes last.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#undef Status

#include <cstring>

namespace caryatid::golden {
namespace {

class WindowStudio : public Studio {
 protected:
  void SetUp() override {
    x_ = XOpenDisplay(nullptr);
    if (x_ == nullptr) GTEST_SKIP() << "no X server here; run under xvfb-run";
    platform::ErrorLine error;
    platform::DisplayOptions options;
    options.kind = platform::DisplayKind::window;
    options.width = kWidth;
    options.height = kHeight;
    options.title = "caryatid window test";
    ASSERT_TRUE(platform::open_display(options, display_, error).ok()) << error.c_str();
    shared_display = display_.get();
    platform::RenderOptions r;
    r.width = display_->width();
    r.height = display_->height();
    r.proc_address = [](const char* name) { return shared_display->proc_address(name); };
    ASSERT_TRUE(platform::open_gles_renderer(pack_.view(), false, r, renderer_, error).ok())
        << error.c_str();
    window_ = find(DefaultRootWindow(x_), options.title);
    ASSERT_NE(window_, 0u);
  }
  void TearDown() override {
    Studio::TearDown();
    display_.reset();
    if (x_ != nullptr) XCloseDisplay(x_);
  }

  ::Window find(::Window at, const char* title) {
    char* name = nullptr;
    if (XFetchName(x_, at, &name) != 0 && name != nullptr) {
      const bool same = std::strcmp(name, title) == 0;
      XFree(name);
      if (same) return at;
    }
    ::Window root = 0, parent = 0, *children = nullptr, found = 0;
    unsigned count = 0;
    if (XQueryTree(x_, at, &root, &parent, &children, &count) == 0) return 0;
    for (unsigned i = 0; i < count && found == 0; ++i) found = find(children[i], title);
    if (children != nullptr) XFree(children);
    return found;
  }
  void send_key(KeySym key, int type) {
    XEvent event{};
    event.xkey.type = type;
    event.xkey.display = x_;
    event.xkey.window = window_;
    event.xkey.keycode = XKeysymToKeycode(x_, key);
    XSendEvent(x_, window_, False, type == KeyPress ? KeyPressMask : KeyReleaseMask, &event);
    XSync(x_, False);
  }
  platform::DisplayEvents poll() {
    platform::DisplayEvents events;
    EXPECT_TRUE(display_->poll(77, events).ok());
    return events;
  }

  // The window's pixels.
  Image seen() {
    XSync(x_, False);
    Image picture{kWidth, kHeight, {}};
    XImage* shot = XGetImage(x_, window_, 0, 0, kWidth, kHeight, AllPlanes, ZPixmap);
    if (shot == nullptr) return picture;
    for (int y = 0; y < static_cast<int>(kHeight); ++y)
      for (int x = 0; x < static_cast<int>(kWidth); ++x) {
        const unsigned long p = XGetPixel(shot, x, y);
        for (const unsigned shift : {16u, 8u, 0u})
          picture.rgb.push_back(static_cast<std::uint8_t>(p >> shift & 255u));
      }
    XDestroyImage(shot);
    return picture;
  }

  ::Display* x_ = nullptr;
  ::Window window_ = 0;
};

TEST_F(WindowStudio, ShowsWhatTheOffscreenRendererDraws) {
  ASSERT_TRUE(renderer_->draw(pack_.list()).ok());
  ASSERT_TRUE(display_->present().ok());
  expect_golden(seen(), "materials_per_pixel");
}

// A still of four quarters: black, green; red, blue. Its upper left corner goes clockwise, and it
// leaves the renderer's pictures as they were.
TEST_F(WindowStudio, AStillStandsAsItIsTurned) {
  constexpr std::uint16_t kBlack = 0, kGreen = 0x07e0, kRed = 0xf800, kBlue = 0x001f;
  const std::array<std::uint16_t, 4> texels{kBlack, kGreen, kRed, kBlue};
  const platform::Still still{2, 2, texels};
  const std::size_t near_x = 2, far_x = kWidth - 3, near_y = 2, far_y = kHeight - 3;
  const std::size_t black_at[4][2] = {
      {near_x, near_y}, {far_x, near_y}, {far_x, far_y}, {near_x, far_y}};
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    ASSERT_TRUE(platform::draw_still(still, kWidth, kHeight, 90 * quarter).ok());
    ASSERT_TRUE(display_->present().ok());
    const Image picture = seen();
    int black = 0;
    for (const auto& at : black_at) {
      const std::uint8_t* p = &picture.rgb[3 * (at[1] * kWidth + at[0])];
      if (p[0] + p[1] + p[2] > 8) continue;
      ++black;
      EXPECT_EQ(&at, &black_at[quarter]);
    }
    EXPECT_EQ(black, 1) << quarter;
  }
  EXPECT_FALSE(platform::draw_still({4, 4, texels}, kWidth, kHeight, 0).ok());
  ASSERT_TRUE(renderer_->draw(pack_.list()).ok());
  ASSERT_TRUE(display_->present().ok());
  expect_golden(seen(), "materials_per_pixel");
}

TEST_F(WindowStudio, DigitsAreButtons) {
  (void)poll();
  send_key(XK_3, KeyPress);
  send_key(XK_3, KeyRelease);
  const platform::DisplayEvents events = poll();
  ASSERT_EQ(events.buttons.size(), 2u);
  EXPECT_EQ(events.buttons[0].button, 3);
  EXPECT_TRUE(events.buttons[0].pressed);
  EXPECT_FALSE(events.buttons[1].pressed);
  EXPECT_EQ(events.buttons[0].time_us, 77);
}

TEST_F(WindowStudio, EscapeAsksToClose) {
  EXPECT_FALSE(poll().close_requested);
  send_key(XK_Escape, KeyPress);
  EXPECT_TRUE(poll().close_requested);
}

TEST_F(WindowStudio, TellsItsNewSize) {
  (void)poll();
  XResizeWindow(x_, window_, 320, 200);
  XSync(x_, False);
  EXPECT_TRUE(poll().resized);
  EXPECT_EQ(display_->width(), 320u);
  EXPECT_TRUE(renderer_->resize(display_->width(), display_->height()).ok());
  EXPECT_TRUE(renderer_->draw(pack_.list()).ok());
  EXPECT_TRUE(display_->present().ok());
}

}  // namespace
}  // namespace caryatid::golden
