#include "firmware-app/kiosk.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/emotion/profiles.h"
#include "core/face/mixer.h"
#include "core/scene/camera.h"
#include "core/scene/compose.h"
#include "firmware-app/allocations.h"
#include "firmware-app/levels.h"
#include "firmware-app/splash.h"
#include "platform/buttons/scripted/scripted.h"
#include "platform/clock/clock.h"
#include "platform/cpu.h"
#include "platform/log/log.h"

namespace caryatid::app {
namespace {

std::atomic<bool> g_stop{false};
std::atomic<bool> g_flips_stopped{false}, g_input_stopped{false}, g_gpu_reset{false};

// Bytes of the pack that are read between two frames while it still loads.
constexpr std::size_t kLoadBytesPerFrame = 512 * 1024;

using platform::Event;

// The program can't go on; always false.
bool refuse(const std::string& line) {
  platform::log(Event::start_refused, "%s", line.c_str());
  return false;
}

// A bust has the joints of a whole skeleton, but nothing of it reaches the floor.
bool has_legs(const pack::View& pack) {
  constexpr float kFoot_m = 0.1f;
  for (const pack::Object& o : pack.objects)
    for (const pack::Vertex& v : pack.versions.subspan(o.first_version, o.base_vertex_count))
      if (v.position_m[1] < kFoot_m) return true;
  return false;
}

scene::View view_of(const std::string& name) {
  if (name == "body") return scene::View::body;
  return name == "bust" ? scene::View::bust : scene::View::head;
}

body::BapConvention bap_axes_of(const std::string& name) {
  if (name == "plain") return body::BapConvention::plain_axes;
  return name == "reversed" ? body::BapConvention::signed_axes_reversed
                            : body::BapConvention::signed_axes;
}

}  // namespace

void Kiosk::request_stop() { g_stop = true; }
void Kiosk::stop_flips() { g_flips_stopped = true; }
void Kiosk::stop_input() { g_input_stopped = true; }
void Kiosk::reset_gpu() { g_gpu_reset = true; }

bool Kiosk::load_base(std::string* out_error) {
  const pack::PackHeader& h = pack_file_.header();
  // A damaged header could ask for anything; no board that we serve gives more than this.
  constexpr std::uint32_t kMostArenaBytes = 64u << 20;
  const std::uint32_t bytes = std::max(h.arena_bytes, h.image_bytes);
  if (bytes > kMostArenaBytes || !memory_.map(bytes + Desk::kArenaBytes + 4096)) {
    *out_error = describe_refusal(pack_file_.name(),
                                  {Code::out_of_capacity, std::uint16_t(pack::Refusal::too_large)});
    return false;
  }
  const auto image = memory_.arena().take<Vec4>((h.image_bytes + sizeof(Vec4) - 1) / sizeof(Vec4));
  Status status = loader_.begin(h, std::as_writable_bytes(image));
  while (status.ok() && !loader_.base_ready() && !pack_file_.exhausted())
    status = pack_file_.feed(4096, &loader_);
  if (!loader_.base_ready()) {
    if (status.ok()) status = {Code::corrupt_data, std::uint16_t(pack::Refusal::base_incomplete)};
    *out_error = describe_refusal(pack_file_.name(), status);
    return false;
  }
  person_.use(face::sum_moves_for(platform::has_neon()));
  status = person_.start(loader_.view(), memory_.arena());
  if (status.ok()) return true;
  *out_error =
      std::string(pack_file_.name()) + ": " +
      (status.code == Code::out_of_capacity ? "asks for less memory than it needs; bake it again"
                                            : "its meshes are damaged; bake it again");
  return false;
}

bool Kiosk::open_person() {
  std::string error;
  if (!options_.pack.empty()) {
    if (pack_file_.open(options_.pack, &error) && load_base(&error)) return true;
    platform::log(Event::pack_refused, "%s (the built-in face stands in, out of order)",
                  error.c_str());
    pack_refused_ = true;
  }
  if (pack_file_.open_builtin(&error) && load_base(&error)) return true;
  return refuse(error);
}

bool Kiosk::open_display() {
  if (options_.display == "none") return true;
  platform::ErrorLine error;
  platform::DisplayOptions d;
  d.width = options_.width;
  d.height = options_.height;
  d.insists_on_size = options_.size_given;
  d.times_gpu = !options_.virtual_clock;  // Then a model of the board says what it costs.
  d.legacy_kms = options_.display == "drm-legacy";
  if (options_.display == "drm" || d.legacy_kms) d.kind = platform::DisplayKind::drm;
  if (options_.display == "window") d.kind = platform::DisplayKind::window;
  if (options_.display == "surfaceless") d.kind = platform::DisplayKind::surfaceless;
  return platform::open_display(d, display_, error).ok() || refuse(error.c_str());
}

bool Kiosk::open_renderer() {
  platform::ErrorLine error;
  if (app::open_renderer(display_.get(), person_.view(), !loader_.complete(), options_.width,
                         options_.height, renderer_, error)
          .ok()) {
    const platform::GpuCaps& gpu = renderer_->caps();
    if (display_ && display_->has_surface() && gpu.software)
      platform::log(Event::software_gpu, "drawn by the CPU (%s): no driver of a GPU is in use",
                    gpu.renderer.c_str());
    return true;
  }
  return refuse(error.c_str());
}

// After a GPU reset or when the driver has lost its flips: the arena still holds all that the GPU
// had. Allocates, as every start does. A board that needs this again and again must start anew.
bool Kiosk::reopen_screen() {
  constexpr int kOften = 3;
  platform::log(Event::screen_lost, "the screen or the GPU was lost; opening it again");
  close_screen();
  if (++reopened_ > kOften || !open_display() || !open_renderer()) return false;
  for (std::size_t t = 0; t < person_.view().textures.size(); ++t)
    if (texture_whole_[t]) (void)renderer_->upload_texture(static_cast<std::uint16_t>(t), true);
  desk_.load(*renderer_, std::max(renderer_->width(), renderer_->height()));  // Letters, pictures.
  return true;
}

void Kiosk::close_screen() {
  renderer_.reset();  // Its objects live in the display's context.
  display_.reset();
}

bool Kiosk::open_outputs() {
  if (!options_.frames_out.empty()) {
    const double seconds = options_.duration_s > 0.0 ? options_.duration_s : 60.0;
    const double pictures = seconds * options_.target_fps / options_.frames_every + 1.0;
    if (!frames_out_.start(options_.frames_out, options_.frames_every, renderer_->width(),
                           renderer_->height(), static_cast<std::uint32_t>(pictures))) {
      return refuse(options_.frames_out + ": can't be made; name a folder that can be written");
    }
  }
  if (!options_.metrics.empty() && !metrics_.open(options_.metrics.c_str()))
    return refuse(options_.metrics + ": " + std::strerror(errno) +
                  "; name a file that can be written");
  return true;
}

void Kiosk::fix_levels() {
  fixed_ = options_.lod != "auto";
  if (fixed_) person_.set_levels({fixed_levels_.data(), person_.object_count()});
}

// Once for each: how long a visitor looked at nothing.
void Kiosk::tell_picture(const char* of_what, double* out_s) {
  if (options_.virtual_clock) return;
  *out_s = process_age_s();
  if (!display_ || !display_->has_surface()) return;
  timespec computing{};  // On a busy machine the smaller part.
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &computing);
  platform::log(
      Event::picture_shown,
      "%s on the screen %.2f s after the program's start, %.2f s of computing", of_what, *out_s,
      static_cast<double>(computing.tv_sec) + 1e-9 * static_cast<double>(computing.tv_nsec));
}

// A recorded run must not depend on what is wired to this machine.
bool Kiosk::open_devices() {
  if (options_.virtual_clock) return true;
  std::string error;
  if (!panel_.open(config_, &error)) return refuse(error);
  if (!notifier_.open().ok())
    platform::log(Event::unsupervised, "NOTIFY_SOCKET is no socket; running unsupervised");
  (void)thermal_.open();  // A board without sensors counts as cool.
  if (!options_.control.empty()) player_.reserve();
  return service_.open(options_, &error) || refuse(error);
}

bool Kiosk::start() {
  // Nothing comes before the first picture. A replay shows its own frames alone.
  if (!open_display()) return false;
  if (display_ && !options_.virtual_clock &&
      show_builtin_picture(*display_, options_.rotate_degrees))
    tell_picture("built-in face", &start_times_.picture_s);
  if (!read_config()) return false;
  std::string error;
  if (!options_.play.empty() && !player_.open(options_.play, &error)) return refuse(error);
  if (!open_person()) return false;
  player_.set_fit(person_.fit());
  if (!parse_levels(options_.lod, person_.view(), fixed_levels_, &error)) return refuse(error);
  if ((pack_refused_ && !desk_.open_notice(options_.config)) || !desk_.take_memory(memory_.arena()))
    return refuse("the built-in programme is damaged; build again");
  if (!open_renderer() || !open_outputs() || !open_devices()) return false;
  if (options_.virtual_clock) config_.screen.wander = 0.0f;  // Replays are compared by pixels.
  care_ = ScreenCare(config_.screen);
  agent_ = std::make_unique<agent::Agent>(options_.seed);
  open_speaker();
  desk_.load(*renderer_, std::max(renderer_->width(), renderer_->height()));
  set_stage();
  aim_camera(0.0f);
  const std::string& name = options_.board;
  const lod::BoardCosts* costs = lod::find_board({name.data(), name.size()});
  lod::LodConfig lod_config;
  float refresh_hz = costs != nullptr ? costs->refresh_hz : 60.0f;
  if (!options_.virtual_clock && display_ && display_->refresh_us() > 0)
    refresh_hz = 1e6f / static_cast<float>(display_->refresh_us());
  const float vblanks = refresh_hz / static_cast<float>(options_.target_fps);
  lod_config.vblank_us = 1e6f / refresh_hz;
  lod_config.vblanks_per_frame = static_cast<std::uint16_t>(std::max(vblanks + 0.5f, 1.0f));
  lod_config.prior = costs != nullptr ? *costs : lod::boards()[0];
  vblanks_per_frame_ = lod_config.vblanks_per_frame;
  budget_ = std::make_unique<lod::BudgetController>(lod_config);
  if (options_.virtual_clock && costs != nullptr)
    board_ = std::make_unique<lod::VirtualBoard>(*costs, lod_config.vblanks_per_frame);
  fix_levels();
  memory_.arena().seal();
  report_.arena_bytes = memory_.arena().used_bytes();
  seal_heap();
  return true;
}

bool Kiosk::run() {
  const double period_s = 1.0 / options_.target_fps;
  const std::int64_t began_us = platform::monotonic_us();
  std::int64_t due_us = began_us;
  double last_s = -period_s;
  bool ok = true;
  while (ok && !g_stop && !close_requested_) {
    const double now_s = options_.virtual_clock
                             ? static_cast<double>(frame_number_) * period_s
                             : static_cast<double>(platform::monotonic_us() - began_us) * 1e-6;
    if (options_.duration_s > 0.0 && now_s >= options_.duration_s - 1e-9) break;
    ok = frame({now_s, static_cast<float>(now_s - last_s), platform::monotonic_us()});
    if (ok && frame_number_ == 0) tell_picture("person", &start_times_.person_s);
    if (ok) watch();
    last_s = now_s;
    ++frame_number_;
    report_.seconds = now_s + period_s;
    if (!options_.virtual_clock) {
      due_us += static_cast<std::int64_t>(period_s * 1e6) * budget_->decision().frame_divisor;
      const std::int64_t now_us = platform::monotonic_us();
      if (due_us < now_us - 500000) due_us = now_us;  // A long stall is not caught up.
      platform::sleep_until_us(due_us);
    }
  }
  (void)notifier_.stopping();
  service_.close();
  report_.frames = frame_number_;
  report_.allocations = allocations_since_seal();
  if (!frames_out_.finish())
    platform::log(Event::file_refused, "%s: the contact sheet can't be written",
                  options_.frames_out.c_str());
  report_.metrics_lost = !metrics_.close() || report_.metrics_lost;
  return ok;
}

// The supervisor's heartbeat and the board's temperature; a replay has neither.
void Kiosk::watch() {
  if (options_.virtual_clock) return;
  const std::int64_t now_us = platform::monotonic_us();
  if (!told_ready_) told_ready_ = notifier_.ready().ok();
  (void)notifier_.beat(now_us, vitals_);
  if (service_.due(now_us)) {
    KioskStatus s = status();
    service_.fill(&s);
    service_.publish(now_us, s);
  }
  if (now_us < next_heat_us_) return;
  next_heat_us_ = now_us + 1'000'000;
  heat_known_ = thermal_.read(&heat_).ok() || heat_known_;
}

bool Kiosk::frame(const Tick& tick) {
  last_time_s_ = tick.time_s;
  vitals_ = {.flipped = false, .input_ran = false, .audio_moved = false};
  load_more();
  poll_buttons(tick);
  act(tick);
  const bool drawn = draw(tick);
  measure(tick);
  return drawn;
}

void Kiosk::load_more() {
  if (refinement_ended_) return;
  const Status status = pack_file_.feed(kLoadBytesPerFrame, &loader_);
  if (!status.ok()) {
    platform::log(Event::pack_damaged, "%s: %s (shown as far as it is whole)", pack_file_.name(),
                  pack::refusal_text(static_cast<pack::Refusal>(status.detail)));
    refinement_ended_ = true;
  }
  if (!person_.refine(loader_).ok())
    platform::log(Event::pack_damaged, "%s: a refinement is damaged (shown as far as it is whole)",
                  pack_file_.name());
  for (std::size_t t = 0; t < person_.view().textures.size(); ++t)
    if (!texture_whole_[t] && loader_.texture_complete(t)) {
      texture_whole_[t] = true;
      (void)renderer_->upload_texture(static_cast<std::uint16_t>(t), true);
    }
  if (loader_.complete()) refinement_ended_ = true;
  if (fixed_) fix_levels();
}

// The first press of this frame's events, on the monotonic clock.
void Kiosk::note_press(const platform::ButtonEvents& events, std::int64_t to_monotonic_us) {
  for (const ButtonEvent& e : events) {
    const std::int64_t time_us = e.time_us + to_monotonic_us;
    if (e.pressed && (pressed_us_ == 0 || time_us < pressed_us_)) pressed_us_ = time_us;
  }
}

void Kiosk::poll_buttons(const Tick& tick) {
  events_.clear();
  pressed_us_ = 0;
  if (g_input_stopped) return;
  const auto now_us = static_cast<std::int64_t>(tick.time_s * 1e6 + 0.5);
  const std::int64_t began_us = tick.start_us - now_us;
  panel_.poll(platform::monotonic_us(), events_);
  platform::ButtonEvents others;
  if (script_) (void)script_->poll(now_us, others);
  note_press(others, began_us);
  service_.control().poll(this, [](void* self, std::span<const char> line, auto& reply) {
    static_cast<Kiosk*>(self)->obey({line.data(), line.size()}, reply);
  });
  vitals_.input_ran = true;
  note_press(events_, 0);
  for (const ButtonEvent& e : others) (void)events_.push(e);
  if (!display_) return;
  platform::DisplayEvents from_display;
  if (!display_->poll(now_us, from_display).ok()) return;
  note_press(from_display.buttons, began_us);
  for (const ButtonEvent& e : from_display.buttons) (void)events_.push(e);
  close_requested_ = close_requested_ || from_display.close_requested;
  if (from_display.resized) (void)renderer_->resize(display_->width(), display_->height());
}

// Where the person stands and whether she walks; streams bring a body of their own.
void Kiosk::set_stage() {
  subject_ = scene::subject_of(person_.view());
  if (!has_legs(person_.view()) || player_.active()) return;
  const scene::Framing body = scene::framing(scene::View::body, subject_);
  const bool sideways = options_.rotate_degrees % 180 != 0;
  const float aspect = sideways ? 1.0f / picture_aspect() : picture_aspect();
  stage_ = std::make_unique<agent::Stage>(
      &person_.skeleton(),
      agent::StageSetup{
          .walks = options_.view == "auto",
          .half_width_m = 0.5f * std::max(body.visible_height_m * aspect, body.visible_width_m),
          .eyes_m = subject_.eyes_m,
          .sleep_s = static_cast<float>(options_.sleep_s),
          .seed = options_.seed});
}

float Kiosk::picture_aspect() const {
  return static_cast<float>(renderer_->width()) / static_cast<float>(renderer_->height());
}

// Known before the levels are chosen: a camera that moves in asks for more detail at once.
void Kiosk::aim_camera(float dt_s) {
  scene::Subject near_by = subject_;
  if (stage_) near_by.eyes_m = stage_->eyes_m();
  scene::Framing framing =
      scene::framing(view_of(options_.view), options_.view == "body" ? subject_ : near_by);
  if (stage_ && options_.view == "auto")
    framing =
        scene::blend(scene::framing(scene::View::body, subject_), framing, stage_->closeness());
  agent::SignboardInput seen = screen();
  if (stage_ && options_.view == "auto") seen.closeness = stage_->closeness();
  const scene::Box& box = desk_.stage(seen, dt_s);
  list_.camera = scene::make_camera(
      framing, picture_aspect(), options_.rotate_degrees,
      {box.x0 / seen.width, box.y0 / seen.height, box.x1 / seen.width, box.y1 / seen.height});
}

// Dims and wanders what draw() composes, and switches the screen.
void Kiosk::care_for_screen(float dt_s, const agent::Intentions& will) {
  const bool moving = stage_ && stage_->moving();
  // Closed, she leaves before it gets dark.
  care_.step(dt_s, will.busy || moving || player_.active(), pressed_us_ != 0,
             !will.asleep || moving);
  if (display_) display_->set_power(care_.screen_on());
  Mat4& p = list_.camera.projection;
  for (int column = 0; column < 4; ++column)
    for (int axis = 0; axis < 2; ++axis) p[column][axis] += care_.shift()[axis] * p[column][3];
}

void Kiosk::act(const Tick& tick) {
  follow_programme(tick);
  const SpeechFrame& spoken = speak(tick);
  obey_marks(spoken);
  const agent::Intentions& will = agent_->step(tick.dt_s);
  if (will.pressed) {
    ++presses_;
    ++service_.state().presses;
  }
  if (stage_) stage_->step(tick.dt_s, will, list_.camera.position_m);
  aim_camera(tick.dt_s);
  const face::FapFrame felt = emotion::expression(will.emotions);
  face::MixJob mix;
  mix.rest = &person_.rest_face();
  mix.emotion = &felt;
  mix.speech = &spoken.face;
  mix.speech_strength = spoken.mouth_strength;
  mix.idle = stage_ ? &stage_->idle_face() : &will.idle_face;
  mix.limits = &person_.limits();
  const body::BapFrame* baps = stage_ ? &stage_->body() : &will.body;
  if (player_.active()) {
    player_.seek(tick.time_s);
    if (player_.faps() != nullptr) mix = {.stream = player_.faps(), .limits = &person_.limits()};
    if (player_.baps() != nullptr) baps = player_.baps();
  }
  choose_levels(tick, will);
  care_for_screen(tick.dt_s, will);
  shown_ = mix.run();
  body::BapFrame breathing = *baps;
  if (spoken.breath > 0.0f) agent::inhale(spoken.breath, &breathing);
  keep_joints(
      baps == player_.baps() ? bap_axes_of(options_.bap_axes) : body::BapConvention::signed_axes,
      &breathing);
  person_.show(shown_, breathing, Affine{}, tick.dt_s);
}

void Kiosk::keep_joints(body::BapConvention axes, body::BapFrame* io_body) {
  person_.set_bap_convention(axes);
  if (!options_.joint_limits) return;
  const body::LimitReport limits = body::limit_joints(*io_body, axes);
  if (limits.bitten > 0) ++report_.limited_frames;
  if (limits.worst_excess_rad > report_.worst_limit.worst_excess_rad) report_.worst_limit = limits;
}

lod::SceneNeeds Kiosk::needs(bool busy) {
  for (std::size_t o = 0; o < person_.object_count(); ++o)
    object_needs_[o] = object_need(person_.view().objects[o], list_, person_, o, renderer_->width(),
                                   renderer_->height(), busy);
  lod::SceneNeeds n;
  n.objects = {object_needs_.data(), person_.object_count()};
  n.display_px = static_cast<float>(renderer_->width()) * static_cast<float>(renderer_->height());
  n.idle = !busy && !player_.active();
  return n;
}

// A decision that may wait is held back until the eyes shut or jump, or its time is over; then the
// meshes go towards it by as many records a frame as the budget allows.
void Kiosk::choose_levels(const Tick& tick, const agent::Intentions& will) {
  if (fixed_) return;
  const lod::SceneNeeds wanted = needs(will.busy || (stage_ && stage_->moving()));
  const bool first = frame_number_ == 0;
  const lod::LodDecision& d = first ? budget_->begin(wanted) : budget_->step(sample_, wanted);
  if (first || d.sequence != decision_seen_) {
    decision_wait_s_ += tick.dt_s;
    const bool over = decision_wait_s_ * 1000.0f >= static_cast<float>(d.cover_wait_ms);
    if (first || will.covers_change || over) {
      decision_seen_ = d.sequence;
      decision_wait_s_ = 0.0f;
      levels_ = d.triangles;
    }
  }
  person_.approach({levels_.data(), person_.object_count()}, d.max_records_per_frame,
                   static_cast<float>(d.morph_ms) * 1e-3f);
}

bool Kiosk::draw(const Tick& tick) {
  scene::ComposeJob job;
  job.pack = &person_.view();
  job.meshes = person_.meshes();
  job.joints = person_.joints();
  job.wrinkles = person_.wrinkles();
  job.camera = list_.camera;
  if (stage_) job.feet_m = {stage_->walker().place().x, 0.0f, stage_->walker().place().y};
  if (!fixed_) {
    job.render_scale = budget_->decision().render_scale;
    job.shading = budget_->decision().shading;
  }
  if (!job.run(&list_).ok()) return false;
  for (Vec3* light : {&list_.key.color, &list_.fill.color, &list_.rim.color, &list_.ambient_up,
                      &list_.ambient_down, &list_.background_top, &list_.background_bottom})
    *light *= care_.light();
  // Drawn for nobody, a board would only grow warm; what changed meanwhile stays collected.
  vitals_.flipped = !visible() || !display_;
  if (!visible()) return true;
  person_.collect_patches(&list_.patches);
  show_overlay(tick);
  const Status drawn = renderer_->draw(list_);
  if (drawn.code == Code::device_lost || g_gpu_reset.exchange(false)) return reopen_screen();
  if (frames_out_.wants(frame_number_)) {
    if (renderer_->read_back(frames_out_.buffer()).ok() &&
        !frames_out_.add(frame_number_, tick.time_s)) {
      platform::log(Event::file_refused, "%s: a picture can't be written; make room",
                    options_.frames_out.c_str());
      return false;
    }
  }
  if (!display_ || g_flips_stopped) return true;
  const Status shown = display_->present();
  if (shown.code == Code::device_lost) return reopen_screen();
  // Where the display counts its flips, only a new one is a sign of life.
  const std::uint64_t flips_before = flip_.count;
  flip_ = display_->last_flip();
  vitals_.flipped = shown.ok() && (flip_.count == 0 || flip_.count != flips_before);
  if (shown.ok() && flip_.count == 0) flip_.time_us = platform::monotonic_us();
  return shown.ok();
}

void Kiosk::measure(const Tick& tick) {
  const std::int64_t now_us = platform::monotonic_us();
  lod::Work work;
  work.triangles = renderer_->last_cost().triangles;
  work.vertices_deformed = person_.deformed_vertices();
  work.records = person_.records();
  const float scale = list_.render_scale;
  work.target_px = static_cast<float>(renderer_->width() * renderer_->height()) * scale * scale;
  work.shaded_px =
      shaded_pixels(person_, list_, renderer_->width(), renderer_->height()) * scale * scale;
  work.shading = list_.shading;
  if (board_) {
    sample_ = board_->run(work, budget_->decision().frame_divisor);
  } else {
    sample_ = {};
    sample_.time_us = static_cast<std::uint64_t>(flip_.count > 0 ? flip_.time_us : now_us);
    if (visible())
      sample_.cpu_us = static_cast<std::uint32_t>(now_us - tick.start_us) - flip_.waited_us;
    if (visible() && flip_.gpu_us != platform::Flip::kNotTimed) sample_.gpu_us = flip_.gpu_us;
    if (visible()) sample_.vblanks = flip_.vblanks;
    sample_.drawn = work;
    sample_.thermal = static_cast<lod::ThermalLevel>(heat_.heat);
  }
  const double period_us = 1e6 / options_.target_fps;
  FrameMetrics m;
  m.time_s = tick.time_s;
  m.cpu_ms = sample_.cpu_us == lod::FrameSample::kUnknown ? 0.0 : sample_.cpu_us * 1e-3;
  m.gpu_ms = sample_.gpu_us == lod::FrameSample::kUnknown ? -1.0 : sample_.gpu_us * 1e-3;
  const double cost_us = (m.cpu_ms + std::max(m.gpu_ms, 0.0)) * 1e3;
  // A flip is late by its display's count of refreshes; without one, when its work took too long.
  const unsigned due_vblanks = vblanks_per_frame_ * budget_->decision().frame_divisor;
  m.late = sample_.vblanks > 0 ? sample_.vblanks > due_vblanks : cost_us > period_us;
  m.frame_ms = board_ ? std::max(cost_us, period_us) * 1e-3 : static_cast<double>(tick.dt_s) * 1e3;
  m.triangles = person_.triangle_count();
  std::array<std::uint32_t, kMaxObjects> lod{};
  for (std::size_t o = 0; o < person_.object_count(); ++o)
    lod[o] = person_.meshes()[o].triangle_count;
  m.lod = {lod.data(), person_.object_count()};
  m.render_scale = list_.render_scale;
  m.shading = static_cast<int>(list_.shading);
  m.emotion = agent_->emotion();
  m.speech = speech_metrics();
  if (pressed_us_ != 0 && visible()) {
    // Under a virtual clock the frame is on the screen when the board's time for it is over.
    const auto frame_us = static_cast<std::int64_t>(m.frame_ms * 1e3);
    const std::int64_t shown_us = options_.virtual_clock ? tick.start_us + frame_us
                                  : display_             ? flip_.time_us
                                                         : now_us;
    m.reaction_ms = static_cast<double>(shown_us - pressed_us_) * 1e-3;
  }
  if (frame_number_ == 1) m.start = start_times_;
  m.allocations_since_seal = allocations_since_seal();
  m.arena_bytes_used = memory_.arena().used_bytes();
  report_.late_frames += m.late ? 1 : 0;
  if (metrics_.write(m, person_.view())) return;
  report_.metrics_lost = true;
  platform::log(Event::file_refused, "%s: can't be written any more; make room",
                options_.metrics.c_str());
}

}  // namespace caryatid::app
