#include "firmware-app/options.h"

#include <getopt.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>

namespace caryatid::app {
namespace {

constexpr char kHelp[] =
    R"(caryatid: an information-kiosk agent. A button is pressed, a person answers.

usage: caryatid [OPTIONS]

what is shown
  --config FILE          kiosk.toml: buttons, pages, texts (default: the built-in programme)
  --pack FILE            the person, made by caryatid-tool bake (default: a built-in face)
  --display KIND         auto, drm, window, surfaceless or none (default auto); drm-legacy is drm
                         without atomic mode setting, for a driver that gets it wrong
  --size WxH             pixels of a window or surfaceless picture (default 800x480), or the
                         screen's mode (default: what the screen prefers)
  --rotate DEGREES       0, 90, 180 or 270: how the screen is mounted
  --target-fps N         frames a second, 1..120 (default 30)
  --view NAME            auto (the person walks in and the camera comes to the head), or stay at
                         head, bust or body (default auto; a face without legs: head)
  --lod auto|N|OBJECT=N,...   triangles: chosen by the frame budget, of the whole person, or by
                         object (head, body, hair, clothes, eye, mouth, brow, lash)
  --sleep S              without a visitor for S seconds the person walks off (default 90); she
                         comes again at a press, or after 30 seconds
  --seed N               another idle life (default 1)

what is heard
  --audio KIND           auto, alsa, alsa:DEVICE, file:PATH.wav or null (default auto: ALSA's
                         default device, else null; under --virtual-clock null)
  --voice PATH           the program that speaks (default: caryatid-voice beside this one)
  --recordings DIR       texts that caryatid-tool speech bake or time has put there are played,
                         not synthesised
  --say TEXT             speak this at the start
  --language TAG         its language: en, el, de, pt-br, ... (default en)

as a service
  --check                look at config and pack, say what is wrong, and exit
  --list-hardware        what screens, GPIO lines, HID and sound devices there are, and the GPU
  --control PATH         listen at a Unix socket, one line a command: press NAME, release NAME,
                         feel EMOTION [0..1], say TEXT, play FILE.fba, play, status, help
  --status FILE          the kiosk's state as one line of JSON, every 5 s
  --prometheus FILE      the same as Prometheus text, for node_exporter's textfile collector
  --state DIR            a folder for what outlives a power cut (default: $STATE_DIRECTORY)
  --metrics FILE         JSON lines, one a frame: times, triangles, emotion, mouth, and in the
                         frame of a press its time to the screen (reaction_ms)

to try and to test
  --script FILE          recorded button events, one a line: SECONDS NAME down|up
  --duration S           stop after S seconds (default 0: never)
  --frames-out DIR       write PNG pictures and a contact sheet
  --frames-every N       of each N-th frame (default 1)
  --play FILE            play a .fap, .bap or .fba (also a pipe, or -) in place of the programme
  --bap-axes NAME        how --play's body stream turns joints: signed (default), reversed (signed,
                         in the opposite order) or plain (all about the positive axes)
  --joint-limits         keeps every joint within human limits and says which were exceeded
  --virtual-clock        time advances by one frame period a frame: same input, same output
  --now DATE             date and time at which that clock starts, YYYY-MM-DDThh:mm (default
                         2026-11-25T10:00)
  --board NAME           whose costs the frame budget sees under that clock: pi-zero-2w (default),
                         pi3, pi4, mali450, gc7000
  --test-faults          SIGUSR1 stops the page flips, SIGRTMIN the input loop, SIGUSR2 is a GPU
                         reset
  --compile-programme FILE   compile a kiosk.toml and its texts to stdout (the kiosk does this by
                         itself, in a child process, when a text changes while it runs)
  --help, --version

Keys 1 to 9 of a window stand for the buttons in their order. Exit codes: 0 done, 1 failed (a line
says why), 2 wrong usage. Under systemd each line is in the journal with its event's name:
journalctl CARYATID_EVENT=button-lost.

examples: caryatid --pack woman.pack
          caryatid --check --config kiosk.toml --pack woman.pack
          caryatid --pack woman.pack --display surfaceless --virtual-clock \
                   --script default.script --duration 20 --frames-out out --frames-every 5
)";

enum Id : int {
  kConfig = 256,
  kPack,
  kDisplay,
  kSize,
  kRotate,
  kFps,
  kScript,
  kVirtual,
  kNow,
  kBoard,
  kDuration,
  kFramesOut,
  kFramesEvery,
  kMetrics,
  kPlay,
  kAudio,
  kVoice,
  kRecordings,
  kSay,
  kLanguage,
  kLod,
  kView,
  kSeed,
  kControl,
  kStatus,
  kPrometheus,
  kState,
  kListHardware,
  kSleep,
  kBapAxes,
  kJointLimits,
  kCheck,
  kTestFaults,
  kCompile,
  kHelpId,
  kVersion,
};

constexpr option kLong[] = {
    {"config", required_argument, nullptr, kConfig},
    {"pack", required_argument, nullptr, kPack},
    {"display", required_argument, nullptr, kDisplay},
    {"size", required_argument, nullptr, kSize},
    {"rotate", required_argument, nullptr, kRotate},
    {"target-fps", required_argument, nullptr, kFps},
    {"script", required_argument, nullptr, kScript},
    {"virtual-clock", no_argument, nullptr, kVirtual},
    {"now", required_argument, nullptr, kNow},
    {"board", required_argument, nullptr, kBoard},
    {"duration", required_argument, nullptr, kDuration},
    {"frames-out", required_argument, nullptr, kFramesOut},
    {"frames-every", required_argument, nullptr, kFramesEvery},
    {"metrics", required_argument, nullptr, kMetrics},
    {"play", required_argument, nullptr, kPlay},
    {"audio", required_argument, nullptr, kAudio},
    {"voice", required_argument, nullptr, kVoice},
    {"recordings", required_argument, nullptr, kRecordings},
    {"say", required_argument, nullptr, kSay},
    {"language", required_argument, nullptr, kLanguage},
    {"lod", required_argument, nullptr, kLod},
    {"view", required_argument, nullptr, kView},
    {"seed", required_argument, nullptr, kSeed},
    {"control", required_argument, nullptr, kControl},
    {"status", required_argument, nullptr, kStatus},
    {"prometheus", required_argument, nullptr, kPrometheus},
    {"state", required_argument, nullptr, kState},
    {"list-hardware", no_argument, nullptr, kListHardware},
    {"sleep", required_argument, nullptr, kSleep},
    {"bap-axes", required_argument, nullptr, kBapAxes},
    {"joint-limits", no_argument, nullptr, kJointLimits},
    {"check", no_argument, nullptr, kCheck},
    {"test-faults", no_argument, nullptr, kTestFaults},
    {"compile-programme", required_argument, nullptr, kCompile},
    {"help", no_argument, nullptr, kHelpId},
    {"version", no_argument, nullptr, kVersion},
    {nullptr, 0, nullptr, 0},
};

bool wrong(const char* name, const char* value, const char* wanted) {
  std::fprintf(stderr, "caryatid: --%s %s: wanted %s; see caryatid --help\n", name, value, wanted);
  return false;
}

bool number(const char* name, const char* text, double low, double high, double* out) {
  char* end = nullptr;
  *out = std::strtod(text, &end);
  if (end != text && *end == '\0' && *out >= low && *out <= high) return true;
  char wanted[64];
  std::snprintf(wanted, sizeof wanted, "a number from %g to %g", low, high);
  return wrong(name, text, wanted);
}

bool whole(const char* name, const char* text, double low, double high, std::uint32_t* out) {
  double value = 0.0;
  if (!number(name, text, low, high, &value)) return false;
  *out = static_cast<std::uint32_t>(value);
  return static_cast<double>(*out) == value || wrong(name, text, "a whole number");
}

bool one_of(const char* name, const char* text, std::initializer_list<const char*> names,
            std::string* out) {
  std::string wanted = "one of";
  for (const char* n : names) {
    if (std::strcmp(n, text) == 0) {
      *out = text;
      return true;
    }
    wanted += std::string(" ") + n;
  }
  return wrong(name, text, wanted.c_str());
}

bool size_of(const char* text, Options* out) {
  unsigned w = 0, h = 0;
  char rest = '\0';
  if (std::sscanf(text, "%ux%u%c", &w, &h, &rest) != 2 || w < 16 || h < 16 || w > 4096 || h > 4096)
    return wrong("size", text, "WIDTHxHEIGHT, each from 16 to 4096");
  out->width = w;
  out->height = h;
  out->size_given = true;
  return true;
}

bool audio_kind(const char* text, Options* out) {
  out->audio = text;
  const bool named = out->audio.starts_with("alsa:") || out->audio.starts_with("file:");
  if (named && out->audio.size() > 5) return true;
  return one_of("audio", text, {"auto", "alsa", "alsa:DEVICE", "file:PATH", "null"}, &out->audio);
}

bool date_of(const char* text, Options* out) {
  std::tm t{};
  char rest = '\0';
  if (std::sscanf(text, "%4d-%2d-%2dT%2d:%2d%c", &t.tm_year, &t.tm_mon, &t.tm_mday, &t.tm_hour,
                  &t.tm_min, &rest) != 5 ||
      t.tm_year < 1970 || t.tm_mon < 1 || t.tm_mon > 12 || t.tm_mday < 1 || t.tm_mday > 31 ||
      t.tm_hour > 23 || t.tm_min > 59)
    return wrong("now", text, "a date and time as 2026-11-25T10:00");
  t.tm_year -= 1900;
  --t.tm_mon;
  out->now_s = timegm(&t);
  return true;
}

bool rotation(const char* text, Options* out) {
  std::string r;
  if (!one_of("rotate", text, {"0", "90", "180", "270"}, &r)) return false;
  out->rotate_degrees = static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
  return true;
}

bool take_body(int id, const char* text, Options* o) {
  switch (id) {
    case kSleep:
      return number("sleep", text, 1, 1e6, &o->sleep_s);
    case kBapAxes:
      return one_of("bap-axes", text, {"signed", "reversed", "plain"}, &o->bap_axes);
    case kJointLimits:
      o->joint_limits = true;
      return true;
    default:
      return false;
  }
}

// Options that are a path and nothing more.
bool take_path(int id, const char* text, Options* o) {
  switch (id) {
    case kControl:
      o->control = text;
      return true;
    case kStatus:
      o->status = text;
      return true;
    case kPrometheus:
      o->prometheus = text;
      return true;
    case kState:
      o->state = text;
      return true;
    case kConfig:
      o->config = text;
      return true;
    case kPack:
      o->pack = text;
      return true;
    case kCompile:
      o->compile = text;
      return true;
    default:
      return take_body(id, text, o);
  }
}

// Options without a value. False: it is none of them.
bool take_flag(int id, Options* o) {
  switch (id) {
    case kVirtual:
      return o->virtual_clock = true;
    case kTestFaults:
      return o->test_faults = true;
    case kCheck:
      return o->check = true;
    case kListHardware:
      return o->list_hardware = true;
    default:
      return false;
  }
}

bool take(int id, const char* text, Options* o) {
  if (take_flag(id, o)) return true;
  double value = 0.0;
  switch (id) {
    case kDisplay:
      return one_of("display", text, {"auto", "drm", "drm-legacy", "window", "surfaceless", "none"},
                    &o->display);
    case kSize:
      return size_of(text, o);
    case kRotate:
      return rotation(text, o);
    case kFps:
      return whole("target-fps", text, 1, 120, &o->target_fps);
    case kScript:
      o->script = text;
      return true;
    case kNow:
      return date_of(text, o);
    case kBoard:
      return one_of("board", text, {"pi-zero-2w", "pi3", "pi4", "mali450", "gc7000"}, &o->board);
    case kDuration:
      return number("duration", text, 0, 1e9, &o->duration_s);
    case kFramesOut:
      o->frames_out = text;
      return true;
    case kFramesEvery:
      return whole("frames-every", text, 1, 1e6, &o->frames_every);
    case kMetrics:
      o->metrics = text;
      return true;
    case kPlay:
      o->play = text;
      return true;
    case kAudio:
      return audio_kind(text, o);
    case kVoice:
      o->voice = text;
      return true;
    case kRecordings:
      o->recordings = text;
      return true;
    case kSay:
      o->say = text;
      return true;
    case kLanguage:
      o->language = text;
      return true;
    case kLod:
      o->lod = text;
      return true;
    case kView:
      return one_of("view", text, {"auto", "head", "bust", "body"}, &o->view);
    case kSeed:
      if (!number("seed", text, 0, 9e15, &value)) return false;
      o->seed = static_cast<std::uint64_t>(value);
      return true;
    default:
      return take_path(id, text, o);
  }
}

// Other programs live by the real clock; a run of a virtual one is over before they look.
bool fits_the_clock(const Options& o) {
  const std::pair<const char*, const std::string*> real[] = {{"control", &o.control},
                                                             {"status", &o.status},
                                                             {"prometheus", &o.prometheus},
                                                             {"state", &o.state}};
  for (const auto& [name, path] : real)
    if (o.virtual_clock && !path->empty()) {
      std::fprintf(stderr, "caryatid: --%s does nothing under --virtual-clock; leave one out\n",
                   name);
      return false;
    }
  return true;
}

}  // namespace

Parsed parse_options(int argc, char** argv, Options* out) {
  opterr = 0;
  optind = 1;
  for (;;) {
    const int id = getopt_long(argc, argv, ":", kLong, nullptr);
    if (id == -1) break;
    if (id == kHelpId) {
      std::fputs(kHelp, stdout);
      return Parsed::done;
    }
    if (id == kVersion) {
      std::puts("caryatid " CARYATID_VERSION);
      return Parsed::done;
    }
    if (id == ':' || id == '?') {
      std::fprintf(stderr, "caryatid: %s: %s; see caryatid --help\n", argv[optind - 1],
                   id == ':' ? "a value is missing" : "no such option");
      return Parsed::wrong;
    }
    if (!take(id, optarg, out)) return Parsed::wrong;
  }
  if (!fits_the_clock(*out)) return Parsed::wrong;
  const char* folder = std::getenv("STATE_DIRECTORY");  // systemd's StateDirectory=.
  if (out->state.empty() && folder != nullptr && !out->virtual_clock) out->state = folder;
  if (optind < argc) {
    std::fprintf(stderr, "caryatid: %s: not an option; see caryatid --help\n", argv[optind]);
    return Parsed::wrong;
  }
  return Parsed::run;
}

}  // namespace caryatid::app
