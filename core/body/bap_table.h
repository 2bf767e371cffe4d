#pragma once
// The 186 body animation parameters and the 110 extension parameters as data: the name, joint and
// unit of each, and how a stream codes it (axes and signs: bap_axes.h). Sources: ISO/IEC 14496-2
// annex C, and for groups and quantisers a deployed codec (visage), as real streams are written by.
// Immutable, in read-only memory; every look-up is O(1) unless said otherwise.
#include <cstdint>
#include <span>

#include "core/body/bap.h"

namespace caryatid::body {

enum class BapUnit : std::uint8_t {
  none,           // Extension parameters: their meaning comes with the body definition.
  angle_1e5_rad,  // 1e-5 rad.
  length_mm,      // Millimetres: the root's translation, BAPs 181..183.
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
  std::uint8_t group;  // 1..24, coding group of the stream.
  std::uint16_t quantiser_visage;
  std::uint16_t quantiser_standard;

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

}  // namespace caryatid::body
