#include "firmware-app/splash.h"

#include <string>

#include "firmware-app/builtin.h"
#include "firmware-app/pictures.h"

namespace caryatid::app {

Status open_renderer(platform::Display* display, const pack::View& pack, bool base_only,
                     std::uint32_t width, std::uint32_t height,
                     std::unique_ptr<platform::Renderer>& out, platform::ErrorLine& out_error) {
  platform::RenderOptions options;
  options.width = width;
  options.height = height;
  options.offscreen = true;
  options.scalable = true;
  if (display == nullptr) return platform::open_null_renderer(pack, options, out);
  // The look-up of GL functions has no place for a receiver; there is one display.
  static platform::Display* its;
  its = display;
  options.width = display->width();
  options.height = display->height();
  options.offscreen = !display->has_surface();
  options.proc_address = [](const char* name) { return its->proc_address(name); };
  return platform::open_gles_renderer(pack, base_only, options, out, out_error);
}

bool show_builtin_picture(platform::Display& display, std::uint32_t turn_degrees) {
  Picture picture;
  std::string ignored;
  if (!display.has_surface() || !decode_picture(builtin_picture(), 1024, &picture, &ignored))
    return false;
  const platform::Still still{picture.texture_width, picture.texture_height, picture.texels};
  return platform::draw_still(still, display.width(), display.height(), turn_degrees).ok() &&
         display.present().ok();
}

}  // namespace caryatid::app
