#pragma once
// The service that turns a draw list into pixels. Backends: gles (OpenGL ES 2.0, more where the
// driver has it), null (counts, draws nothing; for soak tests).
//
// Memory: every buffer, texture and program is made at open() in its final size; drawing allocates
// nothing. Textures that still load are the exception: upload_texture() replaces one.
// Threads: the thread that opened the display.
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/status.h"
#include "core/pack/font.h"
#include "core/pack/view.h"
#include "core/scene/draw_list.h"
#include "platform/error_line.h"
#include "platform/render/caps.h"

namespace caryatid::platform {

using GlProc = void (*)();

struct RenderOptions {
  std::uint32_t width = 0, height = 0;  // Of the display, pixels.
  bool offscreen = false;               // The display has no surface: draw into an own framebuffer.
  bool scalable = false;      // Keep a framebuffer so that DrawList::render_scale may be below 1.
  std::uint32_t samples = 4;  // Wish for multisampling of own framebuffers.
  BoardGpu clamp = BoardGpu::none;                // Debug: behave as on this board.
  GlProc (*proc_address)(const char*) = nullptr;  // From the display; may be null: GLES 2.0 only.
};

enum class RenderFault : std::uint16_t {
  none,
  caps,         // The GPU is below GLES 2.0's own minima.
  program,      // A shader does not compile or link.
  framebuffer,  // Own framebuffer refused.
  memory,       // GL_OUT_OF_MEMORY while buffers and textures were made.
  texture,      // No such texture.
  draw_list,    // An item names an object, a material or bones that do not exist: it is skipped.
  read_back,    // Span too short.
  lost,         // The context was lost: open display and renderer again.
};

// Counters of the last draw().
struct FrameCost {
  std::uint32_t draw_calls = 0;
  std::uint32_t triangles = 0;       // Each pass counts.
  std::uint32_t uploaded_bytes = 0;  // Vertices and indices.
};

class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual const GpuCaps& caps() const = 0;
  virtual std::uint32_t width() const = 0;
  virtual std::uint32_t height() const = 0;

  // (Re)loads a texture of the pack: all levels, or those from Texture::base_level on.
  virtual Status upload_texture(std::uint16_t texture, bool all_levels) = 0;
  // The letters of DrawList::overlay, once, and its pictures (RGB565, powers of two, first row on
  // top). Without letters no overlay is drawn.
  virtual Status load_font(const pack::FontView& font) = 0;
  virtual Status load_picture(std::uint16_t index, std::uint16_t width, std::uint16_t height,
                              std::span<const std::uint16_t> rgb565) = 0;
  // New size of the display. Reallocates own framebuffers.
  virtual Status resize(std::uint32_t width, std::uint32_t height) = 0;
  // Uploads the patches and draws. device_lost (lost): see DisplayFault::context_lost.
  // invalid_argument (draw_list): what could be drawn was drawn.
  virtual Status draw(const scene::DrawList& list) = 0;
  // The last picture as sRGB bytes, first row on top. out_rgb: 3 * width() * height() long. Stalls
  // the GPU: for pictures and tests, never in the kiosk's loop.
  virtual Status read_back(std::span<std::uint8_t> out_rgb) = 0;
  virtual FrameCost last_cost() const = 0;
};

// `pack` is borrowed and must outlive the renderer; textures are loaded from base_level on
// (base_only) or whole. On failure `out` is empty and `out_error` holds one line.
Status open_gles_renderer(const pack::View& pack, bool base_only, const RenderOptions& options,
                          std::unique_ptr<Renderer>& out, ErrorLine& out_error);
// Never fails; draw() checks the list and counts. read_back() gives black.
Status open_null_renderer(const pack::View& pack, const RenderOptions& options,
                          std::unique_ptr<Renderer>& out);

// One picture on the whole surface of a display, before there is a renderer: a single small program
// and nothing else, so that it stands there at once. RGB565, first row on top; as high as the
// display, which cuts its sides or, where it is wider, repeats its outermost columns.
struct Still {
  std::uint16_t width = 0, height = 0;
  std::span<const std::uint16_t> rgb565;
};
// turn_degrees: of the picture, clockwise, by quarters. Waits until the GPU has drawn it.
// unsupported (program), out_of_capacity (memory), invalid_argument (texture): too few pixels.
Status draw_still(const Still& still, std::uint32_t display_width, std::uint32_t display_height,
                  std::uint32_t turn_degrees);

// Whether an item can be drawn: object, material and bones exist. Shared by the backends.
bool item_is_valid(const scene::DrawList& list, const pack::View& pack,
                   const scene::DrawItem& item);

}  // namespace caryatid::platform
