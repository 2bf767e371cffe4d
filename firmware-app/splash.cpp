#include "firmware-app/splash.h"

#include <string>

#include "core/agent/person.h"
#include "core/face/mixer.h"
#include "core/scene/camera.h"
#include "core/scene/compose.h"
#include "firmware-app/memory.h"
#include "firmware-app/pack_file.h"

namespace caryatid::app {
namespace {

// Some hundred kilobytes; lives for one picture.
struct BuiltinFace {
  Memory memory;
  PackFile file;
  pack::Loader loader;
  agent::Person person;
  scene::DrawList list;

  bool load();
  bool compose(float aspect, std::uint32_t turn_degrees);
};

bool BuiltinFace::load() {
  std::string ignored;
  if (!file.open_builtin(&ignored)) return false;
  const pack::PackHeader& h = file.header();
  if (!memory.map(std::max(h.arena_bytes, h.image_bytes) + 4096)) return false;
  const auto image = memory.arena().take<Vec4>((h.image_bytes + sizeof(Vec4) - 1) / sizeof(Vec4));
  if (!loader.begin(h, std::as_writable_bytes(image)).ok()) return false;
  while (!file.exhausted())
    if (!file.feed(65536, &loader).ok()) return false;
  return person.start(loader.view(), memory.arena()).ok() && person.refine(loader).ok();
}

bool BuiltinFace::compose(float aspect, std::uint32_t turn_degrees) {
  const pack::View& view = person.view();
  face::MixJob calm;
  calm.rest = &person.rest_face();
  calm.limits = &person.limits();
  person.show(calm.run(), body::BapFrame{}, Affine{}, 0.0f);
  scene::ComposeJob job;
  job.pack = &view;
  job.meshes = person.meshes();
  job.joints = person.joints();
  job.camera = scene::make_camera(scene::framing(scene::View::head, scene::subject_of(view)),
                                  aspect, turn_degrees);
  if (!job.run(&list).ok()) return false;
  person.collect_patches(&list.patches);
  return true;
}

}  // namespace

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

bool show_builtin_face(platform::Display& display, std::uint32_t turn_degrees) {
  const auto face = std::make_unique<BuiltinFace>();
  std::unique_ptr<platform::Renderer> renderer;
  platform::ErrorLine ignored;
  if (!face->load() ||
      !open_renderer(&display, face->person.view(), false, 0, 0, renderer, ignored).ok())
    return false;
  const float aspect =
      static_cast<float>(renderer->width()) / static_cast<float>(renderer->height());
  return face->compose(aspect, turn_degrees) && renderer->draw(face->list).ok() &&
         display.present().ok();
}

}  // namespace caryatid::app
