#pragma once
#include <stdlib.h>

#include <filesystem>
#include <string>

namespace caryatid::golden {

// A folder for the socket of one compositor, named "toy", to which the environment points.
class RuntimeFolder {
 public:
  RuntimeFolder() {
    char folder[] = "/tmp/caryatid-wayland-XXXXXX";  // Short: a socket's name has 107 bytes.
    if (mkdtemp(folder) == nullptr) return;
    folder_ = folder;
    setenv("XDG_RUNTIME_DIR", folder, 1);
    setenv("WAYLAND_DISPLAY", "toy", 1);
  }
  RuntimeFolder(const RuntimeFolder&) = delete;
  RuntimeFolder& operator=(const RuntimeFolder&) = delete;
  ~RuntimeFolder() {
    unsetenv("WAYLAND_DISPLAY");
    unsetenv("XDG_RUNTIME_DIR");
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }
  std::string file(const char* name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

}  // namespace caryatid::golden
