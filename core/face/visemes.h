#pragma once
// The 15 visemes of MPEG-4 (FAP 1) as sets of low-level FAPs, and the blend of two of them.
#include "core/face/fap.h"

namespace caryatid::face {

// 0 none; 1 p b m; 2 f v; 3 T D; 4 t d; 5 k g; 6 tS dZ S; 7 s z; 8 n l; 9 r; 10 A:; 11 e; 12 I;
// 13 Q; 14 U (SAMPA; ISO/IEC 14496-2 annex C).
inline constexpr int kVisemeCount = 15;

// Mouth and tongue FAPs of a viseme, outer lips and quarter points included (fill_from_partners).
// An unknown number is viseme 0: every mouth FAP present and 0, lips shut.
FapFrame viseme_frame(int viseme);

// blend/63 of the first + (1 - blend/63) of the second; void when both are 0 (nothing present).
FapFrame blend_visemes(const VisemeField& field);

// Replaces FAP 1 of `frame` by low-level FAPs. A mouth FAP that the frame holds itself wins.
void expand_viseme(FapFrame& frame);

}  // namespace caryatid::face
