#include "assets/tool/studio.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "assets/bake/files/files.h"
#include "assets/tool/command_line.h"
#include "assets/tool/numbers.h"
#include "assets/tool/wire.h"
#include "core/emotion/profiles.h"
#include "core/face/mixer.h"
#include "core/scene/compose.h"

namespace caryatid::tool {
namespace {

void require(Status status, const std::string& path) {
  if (!status.ok())
    throw std::runtime_error(path + ": " +
                             pack::refusal_text(static_cast<pack::Refusal>(status.detail)));
}

}  // namespace

Studio::Studio(const std::string& path, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height) {
  const std::string bytes = bake::read_file(path);
  const auto file = std::as_bytes(std::span(bytes));
  const Result<pack::PackHeader> header = pack::read_header(file);
  require(header.status, path);
  image_.resize(header.value.image_bytes / sizeof(Vec4) + 1);
  loader_ = std::make_unique<pack::Loader>();
  require(loader_->begin(header.value, std::as_writable_bytes(std::span(image_))), path);
  require(loader_->feed(std::span(file).subspan(sizeof(pack::PackHeader))), path);
  require(loader_->end(), path);
  memory_.resize(agent::Person::arena_bytes(loader_->view()));
  Arena arena(memory_);
  person_ = std::make_unique<agent::Person>();
  if (!person_->start(loader_->view(), arena).ok() || !person_->refine(*loader_).ok())
    throw std::runtime_error(path + ": its meshes are damaged; bake it again");
  platform::ErrorLine error;
  platform::DisplayOptions d;
  d.kind = platform::DisplayKind::surfaceless;
  d.width = 2 * width;
  d.height = 2 * height;
  if (!platform::open_display(d, display_, error).ok()) throw std::runtime_error(error.c_str());
  static platform::Display* display;  // The context's look-up has no place for a receiver.
  display = display_.get();
  platform::RenderOptions r;
  r.width = 2 * width;
  r.height = 2 * height;
  r.offscreen = true;
  r.proc_address = [](const char* name) { return display->proc_address(name); };
  if (!platform::open_gles_renderer(person_->view(), false, r, renderer_, error).ok())
    throw std::runtime_error(error.c_str());
  list_ = std::make_unique<scene::DrawList>();
}

Picture Studio::picture(const Pose& pose) {
  std::vector<std::uint32_t> levels;
  std::uint64_t sum = 0;
  for (const pack::Object& o : person_->view().objects) sum += o.max_triangle_count;
  for (const pack::Object& o : person_->view().objects)
    levels.push_back(pose.lod == 0 ? o.max_triangle_count
                                   : static_cast<std::uint32_t>(std::uint64_t{pose.lod} *
                                                                o.max_triangle_count / sum));
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (pose.head_lod != 0 && person_->view().objects[i].role == pack::ObjectRole::head)
      levels[i] = pose.head_lod;
  person_->set_levels(levels);
  face::MixJob mix;
  mix.limits = &person_->limits();
  if (pose.absolute) {
    mix.stream = &pose.faps;
  } else {
    mix.rest = &person_->rest_face();
    mix.emotion = &pose.faps;
    if (pose.speech_strength > 0.0f) mix.speech = &pose.speech;
    mix.speech_strength = pose.speech_strength;
  }
  person_->set_bap_convention(pose.bap_axes);
  person_->show(mix.run(), pose.baps, Affine{}, 0.0f);
  const scene::Subject subject = scene::subject_of(person_->view());
  scene::ComposeJob job;
  job.pack = &person_->view();
  job.meshes = person_->meshes();
  job.joints = person_->joints();
  job.wrinkles = person_->wrinkles();
  job.camera = scene::make_camera(pose.framing ? *pose.framing : scene::framing(pose.view, subject),
                                  static_cast<float>(width_) / static_cast<float>(height_));
  if (pose.wire) return wire_picture(*person_, job.camera, width_, height_);
  if (!job.run(list_.get()).ok())
    throw std::runtime_error("the scene does not fit; this is a fault");
  person_->collect_patches(&list_->patches);
  if (!renderer_->draw(*list_).ok()) throw std::runtime_error("the renderer refused the picture");
  Picture large(renderer_->width(), renderer_->height());
  if (!renderer_->read_back(large.rgb).ok())
    throw std::runtime_error("no picture can be read back");
  return halved(large);
}

scene::View view_named(const std::string& name) {
  constexpr std::pair<const char*, scene::View> kViews[] = {
      {"front", scene::View::head},  {"left", scene::View::left},
      {"right", scene::View::right}, {"three-quarter", scene::View::three_quarter},
      {"bust", scene::View::bust},   {"body", scene::View::body},
      {"feet", scene::View::feet}};
  for (const auto& [n, view] : kViews)
    if (name == n) return view;
  throw UsageError("--view " + name +
                   ": wanted front, left, right, three-quarter, bust, body or feet");
}

void set_lod(const std::string& text, Pose* pose) {
  const bool head = text.starts_with("head=");
  const std::string number = text.substr(head ? 5 : 0);
  std::uint32_t& value = head ? pose->head_lod : pose->lod;
  const char* end = number.data() + number.size();
  const auto [at, error] = std::from_chars(number.data(), end, value);
  if (error != std::errc{} || at != end || value == 0)
    throw UsageError("--lod " + text + ": wanted triangles as N or head=N, from 1");
}

face::FapFrame emotion_named(const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  float strength = 1.0f;
  bool ok = true;
  if (name.size() < text.size()) {
    const auto value = number_within(text.substr(name.size() + 1), 0, 1);
    ok = value.has_value();
    strength = static_cast<float>(value.value_or(0.0));
  }
  const auto& names = emotion::kEmotionNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (!ok || found == names.end())
    throw UsageError("--emotion " + text +
                     ": wanted NAME or NAME:0..1 with calm, joy, "
                     "sadness, anger, fear, disgust, surprise");
  emotion::Weights weights{};
  weights[static_cast<std::size_t>(found - names.begin())] = name == "calm" ? 0.0f : strength;
  return emotion::expression(weights);
}

}  // namespace caryatid::tool
