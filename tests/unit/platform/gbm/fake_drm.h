#pragma once
// A graphics card without a card: the functions of libdrm that the display calls, linked in place
// of the library, over this small world. A card's file is a FIFO, through which its flip events
// come.
#include <xf86drm.h>
#include <xf86drmMode.h>

#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace caryatid::platform::testing {

struct FakeConnector {
  std::uint32_t id = 0;
  bool connected = false;        // As a forced probe finds it.
  bool known_connected = false;  // As the kernel knows it without one.
  std::vector<drmModeModeInfo> modes;
  std::uint32_t encoder = 0;  // Of the splash screen; 0: none.
};

struct FakeEncoder {
  std::uint32_t id = 0, crtc = 0, possible_crtcs = 0;
};

struct FakePlane {
  std::uint32_t id = 0, possible_crtcs = 0;
  std::uint64_t type = DRM_PLANE_TYPE_PRIMARY;
};

// What a commit or one of the older calls asked for.
struct Shown {
  enum class By { mode_set, flip, dark } by = By::flip;
  std::uint32_t fb = 0;
  bool atomic = false;
  std::string mode;
};

struct FakeCard {
  std::string path;
  std::vector<FakeConnector> connectors;
  std::vector<FakeEncoder> encoders;
  std::vector<std::uint32_t> crtcs;
  std::vector<FakePlane> planes;
  bool atomic = true, modifiers = false;
  bool master_taken = false;  // By another program.
  std::vector<std::uint64_t> linear_modifiers;
  std::uint32_t splash_fb = 0;  // What a CRTC shows at start.

  // How it behaves.
  int mode_errno = 0, flip_errno = 0;
  int events_to_lose = 0;
  bool counts_vblanks = true;
  std::int64_t flip_takes_us = 16667;

  // What it was asked.
  std::vector<Shown> shown;
  std::int64_t clock_us = 1'000'000;  // Stamps of its events.
  unsigned sequence = 100;
  std::map<std::uint32_t, std::string> blobs;
};

struct FakeDrm {
  std::list<FakeCard> cards;
  ~FakeDrm() { clear(); }
  FakeCard& add(const std::string& name);  // With a file of its own.
  FakeCard& at(int fd);
  void clear();
};

inline FakeDrm drm;

drmModeModeInfo mode(std::uint16_t width, std::uint16_t height, unsigned hz, bool preferred = false,
                     bool interlaced = false);

}  // namespace caryatid::platform::testing
