#include "platform/display/gbm/output.h"

#include <drm_fourcc.h>
#include <xf86drm.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>

#include "platform/display/display.h"

namespace caryatid::platform::gbm {
namespace {

template <auto Free>
struct Freer {
  template <class T>
  void operator()(T* p) const {
    Free(p);
  }
};
using Resources = std::unique_ptr<drmModeRes, Freer<drmModeFreeResources>>;
using Connector = std::unique_ptr<drmModeConnector, Freer<drmModeFreeConnector>>;
using Encoder = std::unique_ptr<drmModeEncoder, Freer<drmModeFreeEncoder>>;
using PlaneList = std::unique_ptr<drmModePlaneRes, Freer<drmModeFreePlaneResources>>;
using Plane = std::unique_ptr<drmModePlane, Freer<drmModeFreePlane>>;
using Properties = std::unique_ptr<drmModeObjectProperties, Freer<drmModeFreeObjectProperties>>;
using Property = std::unique_ptr<drmModePropertyRes, Freer<drmModeFreeProperty>>;
using Blob = std::unique_ptr<drmModePropertyBlobRes, Freer<drmModeFreePropertyBlob>>;

constexpr Status no_screen(Code code) {
  return {code, static_cast<std::uint16_t>(DisplayFault::no_screen)};
}

// Calls visit(name, id, value) for every property of an object.
template <class Visit>
void each_property(int card, std::uint32_t object, std::uint32_t kind, Visit visit) {
  const Properties list(drmModeObjectGetProperties(card, object, kind));
  for (std::uint32_t i = 0; list && i < list->count_props; ++i)
    if (const Property p{drmModeGetProperty(card, list->props[i])})
      visit(p->name, list->props[i], list->prop_values[i]);
}

std::uint32_t property_id(int card, std::uint32_t object, std::uint32_t kind, const char* name) {
  std::uint32_t id = 0;
  each_property(card, object, kind, [&](const char* its, std::uint32_t its_id, std::uint64_t) {
    if (std::strcmp(its, name) == 0) id = its_id;
  });
  return id;
}

bool is_primary(int card, std::uint32_t plane) {
  bool primary = false;
  each_property(card, plane, DRM_MODE_OBJECT_PLANE,
                [&](const char* name, std::uint32_t, std::uint64_t value) {
                  if (std::strcmp(name, "type") == 0) primary = value == DRM_PLANE_TYPE_PRIMARY;
                });
  return primary;
}

// Of the encoder that drives it now, so that a splash screen's picture stays until ours is there;
// else the first that any of its encoders can use.
bool choose_crtc(int card, const drmModeRes& resources, const drmModeConnector& connector,
                 std::size_t& out_index) {
  std::uint32_t possible = 0;
  for (int e = 0; e < connector.count_encoders; ++e)
    if (const Encoder encoder{drmModeGetEncoder(card, connector.encoders[e])}) {
      possible |= encoder->possible_crtcs;
      for (int c = 0; c < resources.count_crtcs; ++c)
        if (encoder->encoder_id == connector.encoder_id && encoder->crtc_id != 0 &&
            encoder->crtc_id == resources.crtcs[c]) {
          out_index = static_cast<std::size_t>(c);
          return true;
        }
    }
  for (int c = 0; c < resources.count_crtcs; ++c)
    if ((possible & (1u << c)) != 0) {
      out_index = static_cast<std::size_t>(c);
      return true;
    }
  return false;
}

std::uint32_t choose_plane(int card, std::size_t crtc_index) {
  const PlaneList list(drmModeGetPlaneResources(card));
  for (std::uint32_t i = 0; list && i < list->count_planes; ++i) {
    const Plane plane(drmModeGetPlane(card, list->planes[i]));
    if (plane && (plane->possible_crtcs & (1u << crtc_index)) != 0 &&
        is_primary(card, list->planes[i]))
      return list->planes[i];
  }
  return 0;
}

// The blob IN_FORMATS: formats, and for each modifier a mask of the formats it goes with.
void read_modifiers(int card, std::uint64_t blob_id, Output& out) {
  const Blob blob(drmModeGetPropertyBlob(card, static_cast<std::uint32_t>(blob_id)));
  if (!blob || blob->length < sizeof(drm_format_modifier_blob)) return;
  const auto bytes = std::span(static_cast<const std::byte*>(blob->data), blob->length);
  drm_format_modifier_blob head{};
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::uint64_t formats_end = head.formats_offset + 4ull * head.count_formats;
  const std::uint64_t modifiers_end =
      head.modifiers_offset + sizeof(drm_format_modifier) * std::uint64_t{head.count_modifiers};
  if (formats_end > bytes.size() || modifiers_end > bytes.size()) return;
  for (std::uint32_t m = 0; m < head.count_modifiers; ++m) {
    drm_format_modifier entry{};
    std::memcpy(&entry, bytes.data() + head.modifiers_offset + m * sizeof entry, sizeof entry);
    for (std::uint32_t bit = 0; bit < 64; ++bit) {
      const std::uint64_t index = std::uint64_t{entry.offset} + bit;
      if ((entry.formats >> bit & 1) == 0 || index >= head.count_formats) continue;
      std::uint32_t format = 0;
      std::memcpy(&format, bytes.data() + head.formats_offset + index * 4, 4);
      if (format == DRM_FORMAT_XRGB8888) (void)out.modifiers.push(entry.modifier);
    }
  }
}

bool find_ids(int card, Output& out) {
  const auto plane = [&](const char* name) {
    return property_id(card, out.plane, DRM_MODE_OBJECT_PLANE, name);
  };
  PropertyIds& ids = out.ids;
  ids.connector_crtc = property_id(card, out.connector, DRM_MODE_OBJECT_CONNECTOR, "CRTC_ID");
  ids.crtc_active = property_id(card, out.crtc, DRM_MODE_OBJECT_CRTC, "ACTIVE");
  ids.crtc_mode = property_id(card, out.crtc, DRM_MODE_OBJECT_CRTC, "MODE_ID");
  ids.plane_fb = plane("FB_ID");
  ids.plane_crtc = plane("CRTC_ID");
  constexpr const char* kSource[] = {"SRC_X", "SRC_Y", "SRC_W", "SRC_H"};
  constexpr const char* kTarget[] = {"CRTC_X", "CRTC_Y", "CRTC_W", "CRTC_H"};
  bool whole = ids.connector_crtc != 0 && ids.crtc_active != 0 && ids.crtc_mode != 0 &&
               ids.plane_fb != 0 && ids.plane_crtc != 0;
  for (std::size_t i = 0; i < 4; ++i) {
    ids.plane_source[i] = plane(kSource[i]);
    ids.plane_target[i] = plane(kTarget[i]);
    whole = whole && ids.plane_source[i] != 0 && ids.plane_target[i] != 0;
  }
  return whole;
}

Status plan(int card, bool atomic, const drmModeRes& resources, const drmModeConnector& connector,
            const ModeWish& wish, Output& out) {
  out = {};
  out.connector = connector.connector_id;
  const char* const type = drmModeGetConnectorTypeName(connector.connector_type);
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%s-%u", type != nullptr ? type : "screen",
                connector.connector_type_id);
  out.name.assign({name.data(), std::strlen(name.data())});
  const auto count = static_cast<std::size_t>(connector.count_modes);
  out.mode = connector.modes[choose_mode({connector.modes, count}, wish)];
  std::size_t crtc_index = 0;
  if (!choose_crtc(card, resources, connector, crtc_index)) return no_screen(Code::unsupported);
  out.crtc = resources.crtcs[crtc_index];
  if (!atomic) return {};
  out.plane = choose_plane(card, crtc_index);
  if (out.plane == 0 || !find_ids(card, out)) return no_screen(Code::unsupported);
  each_property(card, out.plane, DRM_MODE_OBJECT_PLANE,
                [&](const char* its, std::uint32_t, std::uint64_t value) {
                  if (std::strcmp(its, "IN_FORMATS") == 0) read_modifiers(card, value, out);
                });
  return {};
}

}  // namespace

Status find_output(int card, bool atomic, const ModeWish& wish, Output& out) {
  const Resources resources(drmModeGetResources(card));
  if (!resources) return {Code::io, static_cast<std::uint16_t>(DisplayFault::no_card)};
  Status status = no_screen(Code::not_ready);
  for (int i = 0; i < resources->count_connectors; ++i) {
    const Connector connector(drmModeGetConnector(card, resources->connectors[i]));
    if (!connector || connector->connection != DRM_MODE_CONNECTED || connector->count_modes == 0)
      continue;
    status = plan(card, atomic, *resources, *connector, wish, out);
    if (status.ok()) return status;
  }
  return status;
}

bool still_connected(int card, std::uint32_t connector) {
  const Connector c(drmModeGetConnectorCurrent(card, connector));
  return c && c->connection == DRM_MODE_CONNECTED;
}

}  // namespace caryatid::platform::gbm
