#pragma once
// The 186 body animation parameters and the 110 extension parameters as data: which H-Anim joint
// each moves, about which axis, and how a stream codes it. Sources: ISO/IEC 14496-2 annex C (names,
// joints, groups), and two deployed decoders for what annex C leaves to the reader: signs of axes
// and quantisers, both of which differ between real tools and are therefore settings.
// Immutable, in read-only memory; every look-up is O(1) unless said otherwise.
#include <cstdint>
#include <span>

#include "core/base/vec.h"
#include "core/body/bap.h"

namespace caryatid::body {

enum class BapUnit : std::uint8_t {
  none,           // Extension parameters: their meaning comes with the body definition.
  angle_1e5_rad,  // 1e-5 rad.
  length_mm,      // Millimetres: the root's translation, BAPs 181..183.
};

// Axis of a positive value in the figure's frame (+X left, +Y up, +Z forward), right-hand rule; for
// a length, the direction of the translation.
enum class BapAxis : std::uint8_t { none, plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

// Whose signs. No stream or text file says which it means.
enum class BapConvention : std::uint8_t {
  visage,  // Flexions and tilts about -X, so a positive hip, shoulder or elbow flexion goes
           // forward. The default: most bodies found in the wild (VREng's greetings) are made with
           // it.
  greta,  // Every axis positive; fingers flex about Z and pivot about X.
};

// Whose base steps. The stream does not say either.
enum class BapQuantisers : std::uint8_t {
  visage,    // 170, 256, 512 and 2 for BAPs 181..183: what the deployed codec was built with.
  standard,  // 64, 128, 256, 512: in the same codec, marked as the standard's, switched off.
};

struct BapInfo {
  const char* name;   // As the standard spells it; "extension_bap" for 187..296.
  const char* joint;  // H-Anim 1.1 joint name; "" for extensions.
  BapUnit unit;
  BapAxis axis_visage;
  BapAxis axis_greta;
  std::uint8_t group;  // 1..24, coding group of the stream.
  std::uint16_t quantiser_visage;
  std::uint16_t quantiser_standard;

  BapAxis axis(BapConvention c) const {
    return c == BapConvention::visage ? axis_visage : axis_greta;
  }
  int quantiser(BapQuantisers q) const {
    return q == BapQuantisers::visage ? quantiser_visage : quantiser_standard;
  }
};

inline constexpr int kBapGroupCount = 24;

// `bap` 1..296, else it asserts.
const BapInfo& bap_info(int bap);
// The BAPs of coding group 1..24 in the order in which a stream carries them; asserts otherwise.
std::span<const std::uint16_t> bap_group(int group);
// Number of the BAP of this name (the standard's spelling), 0 when there is none. O(186).
int find_bap(const char* name);
// Unit vector in the figure's frame; zero for none.
Vec3 axis_vector(BapAxis axis);

}  // namespace caryatid::body
