#include "platform/display/gbm/card.h"

#include <fcntl.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "platform/display/egl_context.h"

namespace caryatid::platform::gbm {
namespace {

constexpr int kMaxCards = 8;

enum class Rank { useless, has_connectors, has_screen };

// Asks the driver anew, since nobody may have looked since power-on.
Rank rank(int fd) {
  drmModeRes* const resources = drmModeGetResources(fd);
  if (resources == nullptr) return Rank::useless;
  Rank found = resources->count_connectors > 0 ? Rank::has_connectors : Rank::useless;
  for (int i = 0; i < resources->count_connectors; ++i) {
    drmModeConnector* const c = drmModeGetConnector(fd, resources->connectors[i]);
    if (c == nullptr) continue;
    if (c->connection == DRM_MODE_CONNECTED && c->count_modes > 0) found = Rank::has_screen;
    drmModeFreeConnector(c);
  }
  drmModeFreeResources(resources);
  return found;
}

Status complain(int error, const char* node, ErrorLine& out_error) {
  std::array<char, 200> line{};
  if (error == EACCES || error == EPERM)
    std::snprintf(line.data(), line.size(), "%s may not be opened; add the user to the group video",
                  node);
  else
    std::snprintf(line.data(), line.size(),
                  "no graphics card with screen connectors under /dev/dri; is its driver loaded?");
  set_error(out_error, line.data());
  return {Code::io, static_cast<std::uint16_t>(DisplayFault::no_card)};
}

}  // namespace

Status Card::open(ErrorLine& out_error, bool legacy) {
  close();
  std::array<drmDevice*, kMaxCards> devices{};
  const int count = drmGetDevices2(0, devices.data(), kMaxCards);
  int best_fd = -1, error = 0;
  Rank best = Rank::useless;
  std::array<char, 64> refused{};
  for (int i = 0; i < count; ++i) {
    const drmDevice& device = *devices[static_cast<std::size_t>(i)];
    if ((device.available_nodes & (1 << DRM_NODE_PRIMARY)) == 0) continue;
    int fd = ::open(device.nodes[DRM_NODE_PRIMARY], O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) {
      error = errno;
      std::snprintf(refused.data(), refused.size(), "%s", device.nodes[DRM_NODE_PRIMARY]);
      continue;
    }
    const Rank its = rank(fd);
    if (its > best) {
      best = its;
      std::swap(fd, best_fd);
    }
    if (fd >= 0) ::close(fd);
  }
  if (count > 0) drmFreeDevices(devices.data(), count);
  if (best_fd < 0) return complain(error, refused.data(), out_error);
  use(best_fd, legacy);
  return {};
}

void Card::use(int fd, bool legacy) {
  fd_ = fd;
  atomic_ = !legacy && drmSetClientCap(fd, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) == 0 &&
            drmSetClientCap(fd, DRM_CLIENT_CAP_ATOMIC, 1) == 0;
  std::uint64_t value = 0;
  modifiers_ = atomic_ && drmGetCap(fd, DRM_CAP_ADDFB2_MODIFIERS, &value) == 0 && value != 0;
}

void Card::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

bool Card::take_master() { return drmIsMaster(fd_) != 0 || drmSetMaster(fd_) == 0; }

}  // namespace caryatid::platform::gbm
