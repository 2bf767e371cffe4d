#pragma once
// The command line of caryatid. Names and meanings are a promise to scripts.
#include <cstdint>
#include <string>

namespace caryatid::app {

struct Options {
  std::string config;            // Empty: the built-in default programme.
  std::string pack;              // Empty: the built-in face.
  std::string display = "auto";  // auto, drm, window, surfaceless, none.
  std::uint32_t width = 800, height = 480;
  bool size_given = false;  // --size: a screen's own preference does not count.
  std::uint32_t rotate_degrees = 0;
  std::uint32_t target_fps = 30;
  std::string script;
  bool virtual_clock = false;
  std::int64_t now_s = 1795600800;  // --now: the virtual clock's start, local, as if it were UTC.
  std::string board = "pi-zero-2w";
  double duration_s = 0.0;  // 0: until told to stop.
  std::string frames_out;
  std::uint32_t frames_every = 1;
  std::string metrics;
  std::string play;
  std::string audio = "auto";  // auto, alsa, alsa:DEVICE, file:PATH, null.
  std::string voice;           // Path of caryatid-voice; empty: beside this program.
  std::string recordings;      // Folder of recorded texts; empty: none.
  std::string say;
  std::string language = "en";  // Of `say`.
  std::string lod = "auto";
  std::string view = "auto";  // auto, head, bust, body.
  std::string control;        // Empty: no control socket; so for the three files below.
  std::string status, prometheus;
  std::string state;  // A folder.
  std::uint64_t seed = 1;
  double sleep_s = 90.0;            // Without a visitor, until the person walks off.
  std::string bap_axes = "signed";  // Of what --play plays: signed, reversed or plain.
  bool joint_limits = false;
  bool check = false;
  bool test_faults = false;  // Signals bring on faults that no machine has at will.
  std::string compile;       // --compile-programme: that kiosk.toml goes compiled to stdout.
  bool list_hardware = false;
};

enum class Parsed { run, done, wrong };

// Reads argv. `done`: --help or --version was answered on stdout. `wrong`: one line went to stderr.
Parsed parse_options(int argc, char** argv, Options* out);

}  // namespace caryatid::app
