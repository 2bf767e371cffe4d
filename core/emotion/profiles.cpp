#include "core/emotion/profiles.h"

#include <array>

#include "core/face/fap_fill.h"

namespace caryatid::emotion {
namespace {

constexpr bool kMeasured = true, kQualitative = false;

// Split of lid features F12, F13: 70 % upper, 30 % lower lid; of F14 and F15: half a side.
// `lean` was set by looking at both characters. Anger: table 8-3 says raise_i_eyebrow(+), but table
// 8-4 measures lowered inner brows; minus it is.
constexpr std::array kAnger = {
    ProfileEntry{4, -73, 51, kMeasured, -1},     ProfileEntry{5, 60, 40, kQualitative, 0},
    ProfileEntry{12, -60, 30, kQualitative, 1},  ProfileEntry{13, -60, 30, kQualitative, 1},
    ProfileEntry{16, -50, 20, kQualitative, 1},  ProfileEntry{17, -40, 20, kQualitative, 1},
    ProfileEntry{18, 60, 30, kQualitative, 1},   ProfileEntry{19, -120, 40, kQualitative, 1},
    ProfileEntry{20, -120, 40, kQualitative, 1}, ProfileEntry{31, -83, 48, kMeasured, 0.4f},
    ProfileEntry{32, -85, 51, kMeasured, 0.4f},  ProfileEntry{33, -149, 40, kMeasured, 1},
    ProfileEntry{34, -144, 39, kMeasured, 1},    ProfileEntry{35, -66, 35, kMeasured, 0},
    ProfileEntry{36, -70, 38, kMeasured, 0},     ProfileEntry{37, 57, 28, kMeasured, 1},
    ProfileEntry{38, 58, 31, kMeasured, 1},      ProfileEntry{61, 30, 15, kQualitative, 1},
    ProfileEntry{62, 30, 15, kQualitative, 1},
};

constexpr std::array kSadness = {
    ProfileEntry{4, 0, 20, kQualitative, 0},
    ProfileEntry{5, 30, 20, kQualitative, 1},
    ProfileEntry{12, -130, 60, kQualitative, 1},
    ProfileEntry{13, -130, 60, kQualitative, 1},
    ProfileEntry{16, 40, 30, kQualitative, 1},
    ProfileEntry{18, 70, 40, kQualitative, 1},
    ProfileEntry{19, 107.1f, 78.4f, kMeasured, 0.5f},
    ProfileEntry{20, 112.7f, 76.3f, kMeasured, 0.5f},
    ProfileEntry{21, 45.9f, 33.6f, kMeasured, 0.5f},
    ProfileEntry{22, 48.3f, 32.7f, kMeasured, 0.5f},
    ProfileEntry{31, 85, 55, kMeasured, 1},
    ProfileEntry{32, 80, 54, kMeasured, 1},
    ProfileEntry{33, -30, 15, kQualitative, 0},
    ProfileEntry{34, -30, 15, kQualitative, 0},
    ProfileEntry{35, -40, 20, kQualitative, 1},
    ProfileEntry{36, -40, 20, kQualitative, 1},
    ProfileEntry{37, 28, 17.5f, kMeasured, 1},
    ProfileEntry{38, 28, 17.5f, kMeasured, 1},
    ProfileEntry{48, 4000, 2000, kQualitative, 1},
};

constexpr std::array kJoy = {
    ProfileEntry{4, -271, 110, kMeasured, -0.8f},   ProfileEntry{5, -60, 40, kQualitative, 1},
    ProfileEntry{6, 117, 49, kMeasured, 1},         ProfileEntry{7, 117, 49, kMeasured, 1},
    ProfileEntry{12, 250, 80, kQualitative, 1},     ProfileEntry{13, 250, 80, kQualitative, 1},
    ProfileEntry{19, 177.8f, 93.1f, kMeasured, -1}, ProfileEntry{20, 169.4f, 85.4f, kMeasured, -1},
    ProfileEntry{21, 76.2f, 39.9f, kMeasured, 1},   ProfileEntry{22, 72.6f, 36.6f, kMeasured, 1},
    ProfileEntry{33, 24, 22, kMeasured, -1},        ProfileEntry{34, 25, 22, kMeasured, -1},
    ProfileEntry{41, 150, 50, kQualitative, 1},     ProfileEntry{42, 150, 50, kQualitative, 1},
    ProfileEntry{53, 117, 49, kMeasured, 1},        ProfileEntry{54, 117, 49, kMeasured, 1},
};

constexpr std::array kDisgust = {
    ProfileEntry{4, -234, 109, kMeasured, 0},
    ProfileEntry{5, 177, 108, kMeasured, -1},
    ProfileEntry{6, -20, 10, kQualitative, 0},
    ProfileEntry{7, -20, 10, kQualitative, 0},
    ProfileEntry{8, -200, 60, kQualitative, 0},
    ProfileEntry{9, -200, 60, kQualitative, 0},
    ProfileEntry{12, -60, 40, kQualitative, 1},
    ProfileEntry{13, -60, 40, kQualitative, 1},
    ProfileEntry{16, 60, 40, kQualitative, 1},
    ProfileEntry{19, 142.1f, 103.6f, kMeasured, 0.3f},
    ProfileEntry{20, 147.7f, 101.5f, kMeasured, 0.3f},
    ProfileEntry{21, 60.9f, 44.4f, kMeasured, 1},
    ProfileEntry{22, 63.3f, 43.5f, kMeasured, 1},
    ProfileEntry{31, -60, 30, kQualitative, 0.5f},
    ProfileEntry{32, -60, 30, kQualitative, 0.5f},
    ProfileEntry{33, -80, 53, kMeasured, 1},
    ProfileEntry{34, -82, 54, kMeasured, 1},
    ProfileEntry{37, 26, 17, kMeasured, 1},
    ProfileEntry{38, 26, 17, kMeasured, 1},
    ProfileEntry{41, 90, 40, kQualitative, 1},
    ProfileEntry{42, 90, 40, kQualitative, 1},
    ProfileEntry{61, 30, 15, kQualitative, 1},
    ProfileEntry{62, 30, 15, kQualitative, 1},
    ProfileEntry{63, 50, 20, kQualitative, 0},
};

// Lips of fear and surprise: F11 is the gap between the outer lips and FAP 3 moves no lip, so the
// gap is F4 on the lower lip (FAP 5) and the rest on the upper one (FAP 4); the jaw follows by F11.
constexpr std::array kFear = {
    ProfileEntry{3, 291, 189, kMeasured, 0.2f},
    ProfileEntry{4, -73, 54, kMeasured, 0},
    ProfileEntry{5, -218, 135, kMeasured, 0.2f},
    ProfileEntry{6, 80, 40, kQualitative, 1},
    ProfileEntry{7, 80, 40, kQualitative, 1},
    ProfileEntry{12, -80, 40, kQualitative, 1},
    ProfileEntry{13, -80, 40, kQualitative, 1},
    ProfileEntry{19, -170.8f, 88.2f, kMeasured, 1},
    ProfileEntry{20, -174.3f, 89.6f, kMeasured, 1},
    ProfileEntry{21, -73.2f, 37.8f, kMeasured, -0.5f},
    ProfileEntry{22, -74.7f, 38.4f, kMeasured, -0.5f},
    ProfileEntry{31, 104, 69, kMeasured, 1},
    ProfileEntry{32, 111, 72, kMeasured, 1},
    ProfileEntry{33, 72, 58, kMeasured, 0.3f},
    ProfileEntry{34, 75, 60, kMeasured, 0.3f},
    ProfileEntry{37, 60, 30, kQualitative, 1},
    ProfileEntry{38, 60, 30, kQualitative, 1},
};

constexpr std::array kSurprise = {
    ProfileEntry{3, 885, 316, kMeasured, -0.2f},    ProfileEntry{4, -90, 40, kMeasured, -1},
    ProfileEntry{5, -795, 276, kMeasured, -0.4f},   ProfileEntry{6, -41, 19.5f, kMeasured, 1},
    ProfileEntry{7, -41, 19.5f, kMeasured, 1},      ProfileEntry{12, -110, 60, kQualitative, 0.5f},
    ProfileEntry{13, -110, 60, kQualitative, 0.5f}, ProfileEntry{19, -177.8f, 58.1f, kMeasured, 1},
    ProfileEntry{20, -176.4f, 56.7f, kMeasured, 1}, ProfileEntry{21, -76.2f, 24.9f, kMeasured, -1},
    ProfileEntry{22, -75.6f, 24.3f, kMeasured, -1}, ProfileEntry{31, 224, 103, kMeasured, 0},
    ProfileEntry{32, 211, 97, kMeasured, 0},        ProfileEntry{33, 144, 64, kMeasured, 0.5f},
    ProfileEntry{34, 142, 62, kMeasured, 0.5f},     ProfileEntry{35, 54, 31, kMeasured, 1},
    ProfileEntry{36, 55, 31, kMeasured, 1},         ProfileEntry{37, -43, 30, kMeasured, -1},
    ProfileEntry{38, -43, 30, kMeasured, -1},       ProfileEntry{53, -41, 19.5f, kMeasured, 1},
    ProfileEntry{54, -41, 19.5f, kMeasured, 1},
};

}  // namespace

std::span<const ProfileEntry> profile(Emotion e) {
  switch (e) {
    case Emotion::joy:
      return kJoy;
    case Emotion::sadness:
      return kSadness;
    case Emotion::anger:
      return kAnger;
    case Emotion::fear:
      return kFear;
    case Emotion::disgust:
      return kDisgust;
    case Emotion::surprise:
      return kSurprise;
    case Emotion::calm:
      break;
  }
  return {};
}

float shown_value(const ProfileEntry& entry) {
  const float further = entry.lean * entry.deviation;
  return entry.mean < 0.0f ? entry.mean - further : entry.mean + further;
}

face::FapFrame peak_face(Emotion e) {
  face::FapFrame out;
  for (const ProfileEntry& p : profile(e)) out.set(p.fap, shown_value(p));
  face::fill_from_partners(&out);
  return out;
}

face::FapFrame expression(const Weights& weights) {
  face::FapFrame out;
  for (int fap = 3; fap <= face::kFapCount; ++fap) out.set(fap, 0.0f);
  for (std::size_t i = 1; i < kEmotionCount; ++i) {
    if (weights[i] == 0.0f) continue;
    const face::FapFrame peak = peak_face(static_cast<Emotion>(i));
    for (int fap = 3; fap <= face::kFapCount; ++fap)
      if (peak.has(fap)) out.set(fap, out.get(fap) + weights[i] * peak.get(fap));
  }
  return out;
}

void expand_expression(face::FapFrame& frame) {
  if (!frame.has(face::kFapExpression)) return;
  frame.mask.set(face::kFapExpression, false);
  const face::ExpressionField& f = frame.expression;
  Weights weights{};
  const auto add = [&weights](std::uint8_t select, std::uint8_t intensity) {
    if (select > 0 && select < kEmotionCount)
      weights[select] += static_cast<float>(intensity) / 63.0f;
  };
  add(f.first, f.first_intensity);
  add(f.second, f.second_intensity);
  const face::FapFrame shown = expression(weights);
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    if (!frame.has(fap) && shown.get(fap) != 0.0f) frame.set(fap, shown.get(fap));
}

}  // namespace caryatid::emotion
