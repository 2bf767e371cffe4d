#pragma once
// The six archetypal expressions as FAP profiles: mean and standard deviation of thesis table 8-4
// with MPEG-4 signs, the qualitative FAPs of table 8-3 beside them. Values are in the FAP's own
// FAPU/1024.
#include <span>

#include "core/emotion/emotion.h"
#include "core/face/fap.h"

namespace caryatid::emotion {

struct ProfileEntry {
  std::uint8_t fap;
  float mean;
  float deviation;    // Of the measured sample; for qualitative FAPs our own margin.
  bool measured;      // Table 8-4; otherwise table 8-3 with an amplitude of ours.
  float lean = 1.0f;  // Shown at the mean + so many deviations away from zero, -1..1.
};

// FAPs of one emotion, ascending. Empty for calm.
std::span<const ProfileEntry> profile(Emotion e);

// What the face at full strength shows of an entry: within mean +- one deviation.
float shown_value(const ProfileEntry& entry);

// The face of one emotion at full strength, at the place within the measured spread where it is
// read best. FAPs that the profile leaves out and that follow from others (outer lips, quarter
// points) are filled in.
face::FapFrame peak_face(Emotion e);

// The sum of all emotions' peak faces by weight. O(emotions up * 68).
face::FapFrame expression(const Weights& weights);

// Replaces FAP 2 of `frame` by low-level FAPs: each selected expression at intensity/63 of its peak
// face, both added. FAPs that the frame holds itself win.
void expand_expression(face::FapFrame& frame);

}  // namespace caryatid::emotion
