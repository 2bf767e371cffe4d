#pragma once
// Photographs of a pack's person: the kiosk's own renderer without a screen.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/tool/picture.h"
#include "core/agent/person.h"
#include "core/scene/camera.h"
#include "platform/display/display.h"
#include "platform/render/render.h"

namespace caryatid::tool {

// What a picture shows. Values of `faps` are added to the calm face unless `absolute`.
struct Pose {
  face::FapFrame faps;
  face::FapFrame speech;         // For face::MixJob::speech.
  float speech_strength = 0.0f;  // 0: the mouth is the mood's.
  bool absolute = false;         // A stream's frame: replaces the calm face.
  body::BapFrame baps;
  body::BapConvention bap_axes = body::BapConvention::signed_axes;
  scene::View view = scene::View::head;
  std::optional<scene::Framing> framing = std::nullopt;  // In place of `view`.
  std::uint32_t lod = 0;                                 // Triangles of the whole person; 0: all.
  std::uint32_t head_lod = 0;  // Triangles of the head alone; 0: by `lod`.
  bool wire = false;           // The edges of the triangles in place of surfaces.
};

class Studio {
 public:
  // Loads the whole pack. Throws std::runtime_error, one line.
  Studio(const std::string& pack_path, std::uint32_t width, std::uint32_t height);

  Picture picture(const Pose& pose);
  const agent::Person& person() const { return *person_; }
  agent::Person& person() { return *person_; }

 private:
  std::uint32_t width_, height_;
  std::vector<Vec4> image_;
  std::vector<std::byte> memory_;
  std::unique_ptr<pack::Loader> loader_;
  std::unique_ptr<agent::Person> person_;
  std::unique_ptr<platform::Display> display_;
  std::unique_ptr<platform::Renderer> renderer_;
  std::unique_ptr<scene::DrawList> list_;
};

// The names of --view: front left right three-quarter body feet (and bust). Throws on others.
scene::View view_named(const std::string& name);
// "joy" or "joy:0.7"; throws on others. Weight 1 is the peak face.
face::FapFrame emotion_named(const std::string& text);
// --lod: "5000" for the whole person, "head=680" for the head alone; throws on others.
void set_lod(const std::string& text, Pose* pose);

}  // namespace caryatid::tool
