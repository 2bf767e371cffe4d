#include "platform/inventory/inventory.h"

#include <dirent.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "platform/inventory/gpio_lines.h"

namespace caryatid::platform {
namespace {

// Names in a folder that begin with `prefix`, in the order of people: card2 before card10.
std::vector<std::string> names_in(const std::string& folder, const char* prefix) {
  std::vector<std::string> names;
  DIR* directory = ::opendir(folder.c_str());
  if (directory == nullptr) return names;
  while (const dirent* entry = ::readdir(directory))
    if (std::strncmp(entry->d_name, prefix, std::strlen(prefix)) == 0)
      names.emplace_back(entry->d_name);
  ::closedir(directory);
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return names;
}

// The file's text, its last newline cut off; "" when there is none.
std::string text_of(const std::string& path, std::size_t most = 4096) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return {};
  std::string text(most, '\0');
  text.resize(std::fread(text.data(), 1, most, file));
  std::fclose(file);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The value of KEY in a uevent file.
std::string value_of(const std::string& uevent, const std::string& key) {
  const std::size_t at = ("\n" + uevent).find("\n" + key + "=");
  return at == std::string::npos ? "" : first_line(uevent.substr(at + key.size() + 1));
}

std::string group_of(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return "its";
  const group* g = ::getgrgid(status.st_gid);
  return g != nullptr ? g->gr_name : std::to_string(status.st_gid);
}

// Says nothing when `path` can be opened for `mode`, else why not and who may.
void note_access(std::FILE* out, const std::string& path, int mode) {
  if (::access(path.c_str(), mode) == 0) return;
  if (errno == EACCES)
    std::fprintf(out, "    may not be opened; add the user to group %s\n", group_of(path).c_str());
  else
    std::fprintf(out, "    %s: %s\n", path.c_str(), std::strerror(errno));
}

void none(std::FILE* out, bool found, const char* cure) {
  if (!found) std::fprintf(out, "  none; %s\n", cure);
}

void list_screens(std::FILE* out, const DeviceRoots& roots) {
  std::fputs("screens (--display drm)\n", out);
  const std::string drm = std::string(roots.sys) + "/class/drm";
  bool found = false;
  for (const std::string& name : names_in(drm, "card")) {
    const std::string folder = drm + "/" + name;
    const bool is_card = name.find('-') == std::string::npos;
    if (is_card) {
      found = true;
      const std::string driver = value_of(text_of(folder + "/device/uevent"), "DRIVER");
      std::fprintf(out, "  %s/dri/%s  driver %s\n", roots.dev, name.c_str(),
                   driver.empty() ? "unknown" : driver.c_str());
      note_access(out, std::string(roots.dev) + "/dri/" + name, R_OK | W_OK);
      continue;
    }
    const std::string mode = first_line(text_of(folder + "/modes"));
    std::fprintf(out, "    %s: %s%s%s\n", name.c_str() + name.find('-') + 1,
                 text_of(folder + "/status").c_str(), mode.empty() ? "" : ", preferred ",
                 mode.c_str());
  }
  none(out, found, "enable the board's KMS driver (Raspberry Pi: dtoverlay=vc4-kms-v3d)");
}

void list_gpio(std::FILE* out, const DeviceRoots& roots) {
  std::fputs("GPIO (gpio = ... of a [[button]])\n", out);
  bool found = false;
  for (const std::string& name : names_in(roots.dev, "gpiochip")) {
    found = true;
    const std::string path = std::string(roots.dev) + "/" + name;
    if (list_gpio_lines(out, path.c_str()) == 0) continue;
    std::fprintf(out, "  %s\n", name.c_str());
    note_access(out, path, R_OK | W_OK);
  }
  none(out, found, "this machine has no GPIO; use HID buttons or --control");
}

// HID_ID=0003:000004D9:00000169 is bus, vendor, product (kernel, hid_uevent).
void list_hid(std::FILE* out, const DeviceRoots& roots) {
  std::fputs("HID ([[hid]])\n", out);
  const std::string hidraw = std::string(roots.sys) + "/class/hidraw";
  bool found = false;
  for (const std::string& name : names_in(hidraw, "hidraw")) {
    found = true;
    const std::string uevent = text_of(hidraw + "/" + name + "/device/uevent");
    unsigned bus = 0, vendor = 0, product = 0;
    (void)std::sscanf(value_of(uevent, "HID_ID").c_str(), "%x:%x:%x", &bus, &vendor, &product);
    std::fprintf(out, "  %s/%s  vendor = 0x%04x  product = 0x%04x  \"%s\"\n", roots.dev,
                 name.c_str(), vendor, product, value_of(uevent, "HID_NAME").c_str());
    note_access(out, std::string(roots.dev) + "/" + name, R_OK | W_OK);
  }
  none(out, found, "plug the device in; the kernel needs hidraw (CONFIG_HIDRAW)");
}

void list_sound(std::FILE* out, const DeviceRoots& roots) {
  std::fputs("sound\n", out);
  const std::string text = text_of(std::string(roots.proc) + "/asound/pcm");
  bool found = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string line = first_line(text.substr(at));
    at += line.size() + 1;
    if (line.find("playback") == std::string::npos) continue;
    unsigned card = 0, device = 0;
    if (std::sscanf(line.c_str(), "%u-%u", &card, &device) != 2) continue;
    found = true;
    const std::size_t name = std::min(line.find(": ") + 2, line.size());  // "01-00: NAME : ..."
    const std::size_t end = std::min(line.find(" : ", name), line.size());
    std::fprintf(out, "  hw:%u,%u  %s\n", card, device, line.substr(name, end - name).c_str());
    char node[64];
    std::snprintf(node, sizeof node, "/snd/pcmC%uD%up", card, device);
    note_access(out, std::string(roots.dev) + node, R_OK | W_OK);
  }
  none(out, found, "enable the board's audio, or plug in a USB sound device");
}

void list_board(std::FILE* out, const DeviceRoots& roots) {
  std::fputs("board\n", out);
  std::string model = text_of(std::string(roots.proc) + "/device-tree/model");
  model.erase(std::remove(model.begin(), model.end(), '\0'), model.end());
  std::fprintf(out, "  model: %s\n", model.empty() ? "unknown" : model.c_str());
  const std::string thermal = std::string(roots.sys) + "/class/thermal";
  for (const std::string& name : names_in(thermal, "thermal_zone")) {
    const std::string reading = text_of(thermal + "/" + name + "/temp");
    if (reading.empty()) continue;
    std::fprintf(out, "  %s %s: %.1f degrees Celsius\n", name.c_str(),
                 text_of(thermal + "/" + name + "/type").c_str(),
                 std::strtod(reading.c_str(), nullptr) / 1000.0);
  }
  for (const std::string& name : names_in(roots.dev, "watchdog")) {
    if (name == "watchdog") continue;
    std::fprintf(out, "  %s/%s  (RuntimeWatchdogSec= of systemd)\n", roots.dev, name.c_str());
  }
}

}  // namespace

void list_hardware(std::FILE* out, const DeviceRoots& roots) {
  list_board(out, roots);
  list_screens(out, roots);
  list_gpio(out, roots);
  list_hid(out, roots);
  list_sound(out, roots);
}

}  // namespace caryatid::platform
