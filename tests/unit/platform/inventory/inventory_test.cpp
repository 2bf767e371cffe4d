#include "platform/inventory/inventory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace caryatid::platform {
namespace {

namespace fs = std::filesystem;

// A board in files: what a Raspberry Pi with one screen, a USB keyboard and a USB sound stick
// shows.
class Board {
 public:
  Board() : root_(testing::TempDir() + "inventory_" + std::to_string(::getpid())) {
    fs::remove_all(root_);
    for (const char* folder : {"sys", "dev/dri", "proc"}) fs::create_directories(root_ / folder);
  }
  ~Board() { fs::remove_all(root_); }
  void write(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  std::string list() {
    const std::string sys = root_ / "sys", dev = root_ / "dev", proc = root_ / "proc";
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* out = ::open_memstream(&text, &size);
    list_hardware(out, {sys.c_str(), dev.c_str(), proc.c_str()});
    std::fclose(out);
    const std::string result(text, size);
    std::free(text);
    return result;
  }

 private:
  fs::path root_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Inventory, AnEmptyMachineSaysWhatIsMissingAndWhatToDo) {
  const std::string text = Board().list();
  for (const char* part : {"screens", "dtoverlay=vc4-kms-v3d", "no GPIO", "plug the device in",
                           "enable the board's audio", "model: unknown"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
}

TEST(Inventory, NamesWhatTheConfigurationWants) {
  Board board;
  board.write("sys/class/drm/card1/device/uevent", "DRIVER=vc4-drm\nOF_NAME=gpu\n");
  board.write("sys/class/drm/card1-HDMI-A-1/status", "connected\n");
  board.write("sys/class/drm/card1-HDMI-A-1/modes", "1920x1080\n1280x720\n");
  board.write("dev/dri/card1", "");
  board.write("sys/class/hidraw/hidraw0/device/uevent",
              "HID_ID=0003:000004D9:00000169\nHID_NAME=Holtek Keyboard\n");
  board.write("dev/hidraw0", "");
  board.write("proc/asound/pcm",
              "01-00: USB Audio : USB Audio : playback 1 : capture 1\n"
              "02-00: Mic : Mic : capture 1\n");
  board.write("dev/snd/pcmC1D0p", "");
  board.write("proc/device-tree/model", std::string("Raspberry Pi 4 Model B\0", 23));
  board.write("sys/class/thermal/thermal_zone0/temp", "48312\n");
  board.write("sys/class/thermal/thermal_zone0/type", "cpu-thermal\n");
  const std::string text = board.list();
  for (const char* part :
       {"dri/card1  driver vc4-drm", "HDMI-A-1: connected, preferred 1920x1080",
        "vendor = 0x04d9  product = 0x0169  \"Holtek Keyboard\"", "hw:1,0  USB Audio\n",
        "model: Raspberry Pi 4 Model B\n", "cpu-thermal: 48.3 degrees"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  EXPECT_FALSE(has(text, "Mic"));
}

TEST(Inventory, AChipThatIsNoneIsSaid) {
  Board board;
  board.write("dev/gpiochip0", "no chip");
  EXPECT_TRUE(has(board.list(), "gpiochip0"));
}

}  // namespace
}  // namespace caryatid::platform
