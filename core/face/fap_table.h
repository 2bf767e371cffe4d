#pragma once
// The 68 face animation parameters as data: what each moves, in which unit and direction, and how a
// stream codes it. Sources: ISO/IEC 14496-2 annex C, table C-1 (names, units, directions, groups,
// feature points), and the ranges and quantisers of a deployed MPEG-4 codec (visage), which are the
// ones that real streams are written with; where they are wider than annex C (FAPs 3, 14, 47), the
// codec's stand here. Immutable, in read-only memory; every look-up is O(1) unless said otherwise.
#include <cstdint>

#include "core/base/vec.h"
#include "core/face/fap.h"

namespace caryatid::face {

// Unit of a FAP value. A FAPU is 1/1024 of a distance in the neutral face (14496-2 annex C):
// mns mouth to nose, mw mouth width, ens eyes to nose, es between the pupils, irisd iris diameter
// (= upper to lower lid). au is an angle of 1e-5 rad. none: the fields of FAPs 1 and 2.
enum class FapUnit : std::uint8_t { none, mns, mw, ens, es, irisd, au };

// Which way a positive value goes, seen from the figure ("left" is the figure's own left, +X).
// Of the rotations, `left`, `right`, `up` and `down` tell where the front of the part goes.
enum class FapDirection : std::uint8_t {
  none,
  up,
  down,
  left,
  right,
  forward,
  growing,         // Pupils.
  concave_upward,  // Tongue roll: the edges rise.
};

// Feature point GROUP.INDEX of the facial definition parameters; 0.0 means none.
struct FeaturePoint {
  std::uint8_t group = 0;
  std::uint8_t index = 0;
  friend bool operator==(const FeaturePoint&, const FeaturePoint&) = default;
};

struct FapInfo {
  const char* name;  // As the standard spells it; "" for number 0.
  FapUnit unit;
  bool bidirectional;  // False: the standard knows values >= 0 only; streams still differ.
  FapDirection positive;
  std::uint8_t group;       // 1..10, coding group of the stream.
  FeaturePoint point;       // FAP 47 also bends 6.4; 48..50 turn about 7.1; 23..30 have none in
                            // annex C and name the eye's centre here.
  std::uint16_t quantiser;  // Base step in units; a stream's step is this times fap_quant.
  std::int16_t intra_max;   // Coding range +-, in base steps. The value limit of a stream with
  std::int16_t inter_max;   // quantiser 1 is intra_max * quantiser units.
  std::uint8_t partner;     // The same FAP of the other side; 0: a centre FAP.
};

// FAPs first..last of a coding group of the stream.
struct FapGroup {
  std::uint8_t first;
  std::uint8_t last;
};
inline constexpr int kFapGroupCount = 10;

// `fap` 1..68, else it asserts.
const FapInfo& fap_info(int fap);
// `group` 1..10, else it asserts.
FapGroup fap_group(int group);
// Number of the FAP of this name (the standard's spelling), 0 when there is none. O(68).
int find_fap(const char* name);
// Unit vector in the figure's frame (+X left, +Y up, +Z forward); zero for growing, concave_upward
// and none.
Vec3 direction_vector(FapDirection direction);
// True for the eight FAPs that turn something: 23..26 eyeballs, 47 tongue, 48..50 head.
inline bool is_rotation(const FapInfo& info) { return info.unit == FapUnit::au; }
// Largest magnitude that a stream can carry with quantiser 1, in the FAP's unit; wider than any
// face. FAPs 1 and 2: 0.
inline float coding_limit(const FapInfo& info) {
  return static_cast<float>(info.intra_max) * static_cast<float>(info.quantiser);
}

}  // namespace caryatid::face
