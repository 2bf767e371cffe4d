#pragma once
// The built-in picture on the screen before anything else is done: no black gap after power-on.
#include <cstdint>
#include <memory>

#include "core/base/status.h"
#include "platform/display/display.h"
#include "platform/render/render.h"

namespace caryatid::app {

// Opens a renderer for a pack on `display` (nullptr: the null renderer of `width` x `height`).
// base_only: the pack's finer textures are still to come.
Status open_renderer(platform::Display* display, const pack::View& pack, bool base_only,
                     std::uint32_t width, std::uint32_t height,
                     std::unique_ptr<platform::Renderer>& out, platform::ErrorLine& out_error);

// Draws the built-in picture of her face and presents it; all that this took is given back. It
// costs one small program, where a person costs dozens and her pack. False: there is no surface, or
// it could not be drawn, which the person's own renderer will explain better.
bool show_builtin_picture(platform::Display& display, std::uint32_t turn_degrees);

}  // namespace caryatid::app
