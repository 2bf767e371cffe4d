#pragma once
// --list-hardware: what this board has and what of it this user may open, as text for a person.
// Reads sysfs, /dev and /proc alone, so it works before anything is configured and without the
// libraries of the services.
#include <cstdio>

namespace caryatid::platform {

// Where the kernel shows its devices; tests give folders of their own.
struct DeviceRoots {
  const char* sys = "/sys";
  const char* dev = "/dev";
  const char* proc = "/proc";
};

// Screens, GPIO chips with their lines, HID devices, sound devices, watchdogs, temperatures: each
// with the name that kiosk.toml or the command line wants. A device that may not be opened names
// the group that may.
void list_hardware(std::FILE* out, const DeviceRoots& roots = {});

}  // namespace caryatid::platform
