#include "tests/unit/platform/gbm/fake_drm.h"

#include <drm_fourcc.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace caryatid::platform::testing;

namespace caryatid::platform::testing {

namespace {

// Properties have the same ids on every object.
constexpr const char* kNames[] = {"",       "CRTC_ID", "ACTIVE", "MODE_ID", "FB_ID",
                                  "SRC_X",  "SRC_Y",   "SRC_W",  "SRC_H",   "CRTC_X",
                                  "CRTC_Y", "CRTC_W",  "CRTC_H", "type",    "IN_FORMATS"};
constexpr std::uint32_t kFormatsBlob = 900;

std::uint32_t id_of(const char* name) {
  for (std::uint32_t i = 1; i < std::size(kNames); ++i)
    if (std::strcmp(kNames[i], name) == 0) return i;
  return 0;
}

// An event as it travels through the FIFO.
struct Event {
  unsigned sequence, s, us;
  void* user;
};

int refuse(int error) {
  errno = error;
  return -1;
}

int do_flip(FakeCard& card, int fd, std::uint32_t fb, bool atomic, void* user) {
  if (card.master_taken) return refuse(EACCES);
  if (card.flip_errno != 0) return refuse(card.flip_errno);
  card.shown.push_back({Shown::By::flip, fb, atomic, {}});
  card.clock_us += card.flip_takes_us;
  card.sequence += static_cast<unsigned>((card.flip_takes_us + 8000) / 16667);
  if (card.events_to_lose > 0) {
    --card.events_to_lose;
    return 0;
  }
  const Event event{card.counts_vblanks ? card.sequence : 0,
                    static_cast<unsigned>(card.clock_us / 1'000'000),
                    static_cast<unsigned>(card.clock_us % 1'000'000), user};
  return ::write(fd, &event, sizeof event) == sizeof event ? 0 : -1;
}

int do_mode(FakeCard& card, std::uint32_t fb, bool atomic, const std::string& name) {
  if (card.master_taken) return refuse(EACCES);
  if (card.mode_errno != 0) return refuse(card.mode_errno);
  card.shown.push_back({fb != 0 ? Shown::By::mode_set : Shown::By::dark, fb, atomic, name});
  return 0;
}

}  // namespace

FakeCard& FakeDrm::add(const std::string& name) {
  static int number = 0;
  FakeCard& card = cards.emplace_back();
  card.path =
      "/tmp/caryatid-" + name + "-" + std::to_string(getpid()) + "-" + std::to_string(++number);
  if (mkfifo(card.path.c_str(), 0600) != 0) std::abort();
  return card;
}

FakeCard& FakeDrm::at(int fd) {
  struct stat its {};
  struct stat other {};
  for (FakeCard& card : cards)
    if (fstat(fd, &its) == 0 && stat(card.path.c_str(), &other) == 0 && its.st_ino == other.st_ino)
      return card;
  std::abort();
}

void FakeDrm::clear() {
  for (const FakeCard& card : cards) ::unlink(card.path.c_str());
  cards.clear();
}

drmModeModeInfo mode(std::uint16_t width, std::uint16_t height, unsigned hz, bool preferred,
                     bool interlaced) {
  drmModeModeInfo m{};
  m.hdisplay = width;
  m.vdisplay = height;
  m.htotal = static_cast<std::uint16_t>(width + 100);
  m.vtotal = static_cast<std::uint16_t>(height + 20);
  m.clock = (m.htotal * m.vtotal * hz + 500) / 1000;
  m.type = preferred ? DRM_MODE_TYPE_PREFERRED : 0;
  m.flags = interlaced ? DRM_MODE_FLAG_INTERLACE : 0;
  std::snprintf(m.name, sizeof m.name, "%ux%u@%u", width, height, hz);
  return m;
}

}  // namespace caryatid::platform::testing

// What an atomic request holds.
struct _drmModeAtomicReq {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> values;
};

extern "C" {

int drmGetDevices2(std::uint32_t, drmDevicePtr devices[], int max) {
  int count = 0;
  for (const FakeCard& card : drm.cards) {
    if (count == max) break;
    auto* device = new drmDevice{};
    device->available_nodes = 1 << DRM_NODE_PRIMARY;
    device->nodes = new char* [DRM_NODE_MAX] {};
    device->nodes[DRM_NODE_PRIMARY] = strdup(card.path.c_str());
    devices[count++] = device;
  }
  return count;
}

void drmFreeDevices(drmDevicePtr devices[], int count) {
  for (int i = 0; i < count; ++i) {
    std::free(devices[i]->nodes[DRM_NODE_PRIMARY]);
    delete[] devices[i]->nodes;
    delete devices[i];
  }
}

int drmSetClientCap(int fd, std::uint64_t what, std::uint64_t) {
  return what != DRM_CLIENT_CAP_ATOMIC || drm.at(fd).atomic ? 0 : refuse(EOPNOTSUPP);
}

int drmGetCap(int fd, std::uint64_t what, std::uint64_t* value) {
  *value = what == DRM_CAP_ADDFB2_MODIFIERS && drm.at(fd).modifiers;
  return 0;
}

int drmIsMaster(int fd) { return drm.at(fd).master_taken ? 0 : 1; }
int drmSetMaster(int fd) { return drm.at(fd).master_taken ? refuse(EBUSY) : 0; }

drmModeResPtr drmModeGetResources(int fd) {
  FakeCard& card = drm.at(fd);
  if (card.connectors.empty() && card.crtcs.empty()) return nullptr;  // A card that only renders.
  auto* r = new drmModeRes{};
  r->count_connectors = static_cast<int>(card.connectors.size());
  r->connectors = new std::uint32_t[card.connectors.size() + 1];
  for (std::size_t i = 0; i < card.connectors.size(); ++i) r->connectors[i] = card.connectors[i].id;
  r->count_crtcs = static_cast<int>(card.crtcs.size());
  r->crtcs = card.crtcs.data();
  return r;
}

void drmModeFreeResources(drmModeResPtr r) {
  if (r != nullptr) delete[] r->connectors;
  delete r;
}

namespace {
drmModeConnectorPtr get_connector(int fd, std::uint32_t id, bool probe) {
  for (FakeConnector& c : drm.at(fd).connectors) {
    if (c.id != id) continue;
    if (probe) c.known_connected = c.connected;
    auto* out = new drmModeConnector{};
    out->connector_id = id;
    out->connector_type = DRM_MODE_CONNECTOR_HDMIA;
    out->connector_type_id = id;
    out->connection = c.known_connected ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
    out->count_modes = c.known_connected ? static_cast<int>(c.modes.size()) : 0;
    out->modes = c.modes.data();
    out->encoder_id = c.encoder;
    out->count_encoders = static_cast<int>(drm.at(fd).encoders.size());
    out->encoders = new std::uint32_t[drm.at(fd).encoders.size() + 1];
    for (std::size_t e = 0; e < drm.at(fd).encoders.size(); ++e)
      out->encoders[e] = drm.at(fd).encoders[e].id;
    return out;
  }
  return nullptr;
}
}  // namespace

drmModeConnectorPtr drmModeGetConnector(int fd, std::uint32_t id) {
  return get_connector(fd, id, true);
}
drmModeConnectorPtr drmModeGetConnectorCurrent(int fd, std::uint32_t id) {
  return get_connector(fd, id, false);
}
void drmModeFreeConnector(drmModeConnectorPtr c) {
  if (c != nullptr) delete[] c->encoders;
  delete c;
}
const char* drmModeGetConnectorTypeName(std::uint32_t) { return "HDMI-A"; }

drmModeEncoderPtr drmModeGetEncoder(int fd, std::uint32_t id) {
  for (const FakeEncoder& e : drm.at(fd).encoders)
    if (e.id == id) return new drmModeEncoder{id, 0, e.crtc, e.possible_crtcs, 0};
  return nullptr;
}
void drmModeFreeEncoder(drmModeEncoderPtr e) { delete e; }

drmModePlaneResPtr drmModeGetPlaneResources(int fd) {
  FakeCard& card = drm.at(fd);
  auto* r = new drmModePlaneRes{};
  r->count_planes = static_cast<std::uint32_t>(card.planes.size());
  r->planes = new std::uint32_t[card.planes.size() + 1];
  for (std::size_t i = 0; i < card.planes.size(); ++i) r->planes[i] = card.planes[i].id;
  return r;
}
void drmModeFreePlaneResources(drmModePlaneResPtr r) {
  delete[] r->planes;
  delete r;
}
drmModePlanePtr drmModeGetPlane(int fd, std::uint32_t id) {
  for (const FakePlane& p : drm.at(fd).planes)
    if (p.id == id) {
      auto* out = new drmModePlane{};
      out->plane_id = id;
      out->possible_crtcs = p.possible_crtcs;
      return out;
    }
  return nullptr;
}
void drmModeFreePlane(drmModePlanePtr p) { delete p; }

drmModeObjectPropertiesPtr drmModeObjectGetProperties(int fd, std::uint32_t object, std::uint32_t) {
  auto* list = new drmModeObjectProperties{};
  constexpr std::uint32_t count = std::size(kNames) - 1;
  list->count_props = count;
  list->props = new std::uint32_t[count];
  list->prop_values = new std::uint64_t[count]{};
  for (std::uint32_t i = 0; i < count; ++i) list->props[i] = i + 1;
  for (const FakePlane& p : drm.at(fd).planes)
    if (p.id == object) list->prop_values[id_of("type") - 1] = p.type;
  list->prop_values[id_of("IN_FORMATS") - 1] = kFormatsBlob;
  return list;
}
void drmModeFreeObjectProperties(drmModeObjectPropertiesPtr list) {
  delete[] list->props;
  delete[] list->prop_values;
  delete list;
}
drmModePropertyPtr drmModeGetProperty(int, std::uint32_t id) {
  auto* p = new drmModePropertyRes{};
  p->prop_id = id;
  std::snprintf(p->name, sizeof p->name, "%s", kNames[id]);
  return p;
}
void drmModeFreeProperty(drmModePropertyPtr p) { delete p; }

int drmModeCreatePropertyBlob(int fd, const void* data, std::size_t, std::uint32_t* id) {
  FakeCard& card = drm.at(fd);
  *id = 500 + static_cast<std::uint32_t>(card.blobs.size());
  card.blobs[*id] = static_cast<const drmModeModeInfo*>(data)->name;
  return 0;
}
int drmModeDestroyPropertyBlob(int, std::uint32_t) { return 0; }
drmModePropertyBlobPtr drmModeGetPropertyBlob(int fd, std::uint32_t) {
  const auto& modifiers = drm.at(fd).linear_modifiers;
  const std::uint32_t formats[2] = {DRM_FORMAT_RGB565, DRM_FORMAT_XRGB8888};
  drm_format_modifier_blob head{};
  head.count_formats = 2;
  head.formats_offset = sizeof head;
  head.count_modifiers = static_cast<std::uint32_t>(modifiers.size());
  head.modifiers_offset = sizeof head + sizeof formats;
  auto* blob = new drmModePropertyBlobRes{};
  blob->length = static_cast<std::uint32_t>(head.modifiers_offset +
                                            modifiers.size() * sizeof(drm_format_modifier));
  auto* bytes = static_cast<char*>(std::malloc(blob->length));
  std::memcpy(bytes, &head, sizeof head);
  std::memcpy(bytes + head.formats_offset, formats, sizeof formats);
  for (std::size_t m = 0; m < modifiers.size(); ++m) {
    // Even ones suit both formats, odd ones RGB565 alone.
    const drm_format_modifier entry{m % 2 == 0 ? 3u : 1u, 0, 0, modifiers[m]};
    std::memcpy(bytes + head.modifiers_offset + m * sizeof entry, &entry, sizeof entry);
  }
  blob->data = bytes;
  return blob;
}
void drmModeFreePropertyBlob(drmModePropertyBlobPtr blob) {
  std::free(blob->data);
  delete blob;
}

drmModeAtomicReqPtr drmModeAtomicAlloc(void) { return new _drmModeAtomicReq; }
void drmModeAtomicFree(drmModeAtomicReqPtr request) { delete request; }
int drmModeAtomicAddProperty(drmModeAtomicReqPtr request, std::uint32_t object,
                             std::uint32_t property, std::uint64_t value) {
  request->values[{object, property}] = value;
  return 1;
}
int drmModeAtomicCommit(int fd, const drmModeAtomicReqPtr request, std::uint32_t flags,
                        void* user) {
  FakeCard& card = drm.at(fd);
  std::uint32_t fb = 0;
  std::string name;
  for (const auto& [key, value] : request->values) {
    if (key.second == id_of("FB_ID")) fb = static_cast<std::uint32_t>(value);
    if (key.second == id_of("MODE_ID")) name = card.blobs[static_cast<std::uint32_t>(value)];
  }
  if ((flags & DRM_MODE_ATOMIC_ALLOW_MODESET) != 0) return do_mode(card, fb, true, name);
  return do_flip(card, fd, fb, true, user);
}

drmModeCrtcPtr drmModeGetCrtc(int fd, std::uint32_t id) {
  auto* crtc = new drmModeCrtc{};
  crtc->crtc_id = id;
  crtc->buffer_id = drm.at(fd).splash_fb;
  crtc->mode_valid = drm.at(fd).splash_fb != 0;
  std::snprintf(crtc->mode.name, sizeof crtc->mode.name, "splash");
  return crtc;
}
void drmModeFreeCrtc(drmModeCrtcPtr crtc) { delete crtc; }
int drmModeSetCrtc(int fd, std::uint32_t, std::uint32_t fb, std::uint32_t, std::uint32_t,
                   std::uint32_t*, int, drmModeModeInfoPtr m) {
  return do_mode(drm.at(fd), fb, false, m != nullptr ? m->name : "");
}
int drmModePageFlip(int fd, std::uint32_t, std::uint32_t fb, std::uint32_t, void* user) {
  return do_flip(drm.at(fd), fd, fb, false, user);
}

int drmHandleEvent(int fd, drmEventContextPtr context) {
  Event event{};
  if (::read(fd, &event, sizeof event) != sizeof event) return -1;
  context->page_flip_handler2(fd, event.sequence, event.s, event.us, 0, event.user);
  return 0;
}

}  // extern "C"
