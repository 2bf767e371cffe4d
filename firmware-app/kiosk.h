#pragma once
// The kiosk: wires core to platform and runs the frame loop.
//
// A frame, always in this order: buttons -> agent -> face mixer and pose -> level of detail ->
// deform -> draw list -> renderer -> flip; its timings go back to the level of detail.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/agent/agent.h"
#include "core/agent/person.h"
#include "core/agent/stage.h"
#include "core/body/joint_limits.h"
#include "core/lod/board_model.h"
#include "core/lod/controller.h"
#include "core/scene/camera.h"
#include "core/scene/draw_list.h"
#include "firmware-app/config.h"
#include "firmware-app/desk.h"
#include "firmware-app/memory.h"
#include "firmware-app/metrics.h"
#include "firmware-app/options.h"
#include "firmware-app/pack_file.h"
#include "firmware-app/panel.h"
#include "firmware-app/player.h"
#include "firmware-app/png_writer.h"
#include "firmware-app/screen_care.h"
#include "firmware-app/service.h"
#include "firmware-app/speaker.h"
#include "firmware-app/start_times.h"
#include "platform/buttons/buttons.h"
#include "platform/display/display.h"
#include "platform/render/render.h"
#include "platform/thermal/thermal.h"
#include "platform/watchdog/notify.h"

namespace caryatid::app {

// What a run came to, for the closing line and the exit code.
struct RunReport {
  std::uint64_t frames = 0, late_frames = 0;
  double seconds = 0.0;
  std::uint64_t allocations = 0;
  std::size_t arena_bytes = 0;
  bool metrics_lost = false;         // --metrics could not be written to its end.
  std::uint64_t limited_frames = 0;  // --joint-limits: with joints beyond their range,
  body::LimitReport worst_limit;     // and the farthest beyond of all.
};

class Kiosk {
 public:
  explicit Kiosk(const Options& options) : options_(options) {}

  // Opens everything that may allocate, then seals memory. False: a line was logged and there is
  // nothing to run; a pack that can't be used is no such case, the built-in face stands in.
  bool start();
  // Runs until the duration ends, the window closes or request_stop(). False on a lost display.
  bool run();
  const RunReport& report() const { return report_; }
  // The screen as it was found. The last call.
  void close_screen();

  // --check: configuration and pack alone. True when both are sound.
  static bool check(const Options& options);
  // --list-hardware: devices and GPU to stdout. False when no GL context can be had.
  static bool list_hardware(const Options& options);
  // Async-signal-safe.
  static void request_stop();
  // --test-faults; async-signal-safe. Two last, the reset happens once.
  static void stop_flips();
  static void stop_input();
  static void reset_gpu();

 private:
  struct Tick {
    double time_s;
    float dt_s;
    std::int64_t start_us;
  };

  bool read_config();
  bool use_config(const std::string& config);
  bool load_config(std::string* out_error);
  bool read_script();
  bool open_person();
  bool load_base(std::string* out_error);
  bool open_display();
  bool open_renderer();
  bool reopen_screen();
  bool open_devices();
  void tell_picture(const char* of_what, double* out_s);
  bool open_outputs();
  void open_speaker();
  SayOptions say_options(std::string_view language) const;
  void say_programme();
  void say_plain(std::string_view text);
  bool frame(const Tick& tick);
  void poll_buttons(const Tick& tick);
  void note_press(const platform::ButtonEvents& events, std::int64_t to_monotonic_us);
  void load_more();
  void set_stage();
  float picture_aspect() const;
  void care_for_screen(float dt_s, const agent::Intentions& will);
  void aim_camera(float dt_s);
  agent::SignboardInput screen() const;
  scene::Box head_box() const;
  void show_overlay(const Tick& tick);
  void act(const Tick& tick);
  void keep_joints(body::BapConvention axes, body::BapFrame* io_body);
  const SpeechFrame& speak(const Tick& tick);
  SpeechMetrics speech_metrics() const;
  agent::Moment local_time(const Tick& tick) const;
  void follow_programme(const Tick& tick);
  void obey_marks(const SpeechFrame& spoken);
  void choose_levels(const Tick& tick, const agent::Intentions& will);
  bool draw(const Tick& tick);
  void measure(const Tick& tick);
  void watch();
  void obey(std::string_view line, platform::ControlReply& reply);
  bool press(std::string_view name, bool down);
  void play(std::string_view file, platform::ControlReply& reply);
  KioskStatus status() const;
  bool visible() const { return !display_ || display_->visible(); }
  void print_memory();
  bool check_pack(std::string* out_error);
  void fix_levels();
  lod::SceneNeeds needs(bool busy);

  Options options_;
  Config config_;
  Desk desk_;
  Memory memory_;
  PackFile pack_file_;
  pack::Loader loader_;
  agent::Person person_;
  std::unique_ptr<agent::Agent> agent_;
  std::unique_ptr<agent::Stage> stage_;  // None where the person has no legs, or a stream plays.
  scene::Subject subject_;               // At rest.
  Player player_;
  Speaker speaker_;
  bool told_trouble_ = false;  // Of the speaker, on the log.
  face::FapFrame shown_;       // The face of the last frame, mixed.
  std::unique_ptr<platform::Display> display_;
  std::unique_ptr<platform::Renderer> renderer_;
  std::unique_ptr<platform::Buttons> script_;
  Panel panel_;
  ScreenCare care_;
  platform::Notifier notifier_;
  Service service_;
  platform::Thermal thermal_;
  platform::ThermalReading heat_;
  std::int64_t next_heat_us_ = 0;
  bool heat_known_ = false, pack_refused_ = false, config_refused_ = false;
  bool told_ready_ = false;
  std::unique_ptr<lod::BudgetController> budget_;
  std::unique_ptr<lod::VirtualBoard> board_;
  FramesOut frames_out_;
  MetricsFile metrics_;

  scene::DrawList list_;
  platform::ButtonEvents events_;
  std::array<lod::ObjectNeed, kMaxObjects> object_needs_{};
  std::array<std::uint32_t, kMaxObjects> fixed_levels_{};
  bool fixed_ = false;
  std::array<std::uint32_t, kMaxObjects> levels_{};  // Of the decision that is being carried out.
  unsigned vblanks_per_frame_ = 1;
  std::uint32_t decision_seen_ = 0;
  float decision_wait_s_ = 0.0f;
  lod::FrameSample sample_;
  platform::Flip flip_;          // Of this frame.
  platform::Vitals vitals_;      // Of this frame.
  std::int64_t pressed_us_ = 0;  // The first edge of a press that this frame shows; 0: none.
  int reopened_ = 0;
  std::array<bool, kMaxTextures> texture_whole_{};
  bool refinement_ended_ = false;
  bool close_requested_ = false;
  std::uint64_t frame_number_ = 0, presses_ = 0;
  double last_time_s_ = 0.0;
  std::int64_t last_frame_us_ = 0;
  StartTimes start_times_;
  RunReport report_;
};

}  // namespace caryatid::app
