#pragma once
#include <gtest/gtest.h>

#include "platform/display/display.h"
#include "platform/render/render.h"
#include "tests/golden/image.h"
#include "tests/golden/sample_pack.h"

namespace caryatid::golden {

inline constexpr std::uint32_t kWidth = 240, kHeight = 160;

// A surfaceless display with a renderer on it. Without EGL the test is skipped, in one clear line.
class Studio : public testing::Test {
 protected:
  void SetUp() override {
    platform::ErrorLine error;
    platform::DisplayOptions options;
    options.kind = platform::DisplayKind::surfaceless;
    options.width = kWidth;
    options.height = kHeight;
    if (!platform::open_display(options, display_, error).ok())
      GTEST_SKIP() << "no surfaceless display here: " << error.c_str();
    shared_display = display_.get();
  }
  void TearDown() override { renderer_.reset(); }  // Before its context.

  void open(platform::RenderOptions options = {}, bool base_only = false) {
    options.width = kWidth;
    options.height = kHeight;
    options.offscreen = true;
    options.proc_address = [](const char* name) { return shared_display->proc_address(name); };
    platform::ErrorLine error;
    ASSERT_TRUE(
        platform::open_gles_renderer(pack_.view(), base_only, options, renderer_, error).ok())
        << error.c_str();
  }
  Image shoot() {
    EXPECT_TRUE(renderer_->draw(pack_.list()).ok());
    Image out{renderer_->width(), renderer_->height(), {}};
    out.rgb.resize(std::size_t{3} * out.width * out.height);
    EXPECT_TRUE(renderer_->read_back(out.rgb).ok());
    return out;
  }

  static inline platform::Display* shared_display = nullptr;
  std::unique_ptr<platform::Display> display_;
  SamplePack pack_;
  std::unique_ptr<platform::Renderer> renderer_;
};

}  // namespace caryatid::golden
