#include "assets/tool/speech_sheet.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/speech/liveliness.h"
#include "core/speech/mouth.h"

namespace caryatid::tool {
namespace {

constexpr std::int32_t kFrame_ms =
    40;  // As short as the shortest p of a voice: each is in a frame.
constexpr std::uint32_t kColumns = 14;
constexpr float kKiosk_ms = 1000.0f / 30.0f;

using Kind = SpokenEvent::Kind;

scene::Framing framing_of(const agent::Person& person, bool mouth_only) {
  const scene::Subject subject = scene::subject_of(person.view());
  scene::Framing f = scene::framing(scene::View::head, subject);
  if (!mouth_only) {
    // From the brows' hair to the collar: the lips are what it is about.
    f.target_m.y = subject.eyes_m.y - 0.02f;
    f.visible_height_m = f.visible_width_m = 0.28f;
    return f;
  }
  // From the nose to under the chin.
  f.target_m = person.feature_point_m(2, 2);
  f.target_m.y -= 0.01f;
  f.visible_height_m = f.visible_width_m = 0.11f;
  return f;
}

// Brows and head at `time_ms`: they have a history.
face::FapFrame life_at(const Spoken& spoken, std::int32_t time_ms) {
  auto life = std::make_unique<speech::Liveliness>(1);
  auto utterance = std::make_unique<speech::Utterance>();
  life->begin(1.0f);
  face::FapFrame out;
  for (float t = 0.0f; t <= static_cast<float>(time_ms); t += kKiosk_ms) {
    fill_utterance(spoken, static_cast<std::int32_t>(t), utterance.get());
    out = life->step(*utterance, t, kKiosk_ms * 1e-3f, true).faps;
  }
  return out;
}

struct Row {
  std::int32_t from_ms, to_ms;
  std::uint32_t y, cell;
  std::uint32_t x(std::int32_t time_ms) const {
    return static_cast<std::uint32_t>(std::max(time_ms - from_ms, 0)) * cell / kFrame_ms;
  }
  bool holds(std::int32_t time_ms) const { return time_ms >= from_ms && time_ms < to_ms; }
};

void draw_wave(const Spoken& spoken, const Row& row, std::uint32_t y, std::uint32_t height,
               Picture* to) {
  const std::uint32_t width = kColumns * row.cell;
  for (std::uint32_t x = 0; x < width; ++x) {
    const auto sample_at = [&](std::uint32_t at) {
      return (static_cast<std::uint64_t>(row.from_ms) * row.cell + std::uint64_t{at} * kFrame_ms) *
             spoken.rate_hz / (1000u * std::uint64_t{row.cell});
    };
    int most = 0;
    for (std::uint64_t s = sample_at(x); s < sample_at(x + 1) && s < spoken.samples.size(); ++s)
      most = std::max(most, std::abs(int{spoken.samples[static_cast<std::size_t>(s)]}));
    const auto half = static_cast<std::uint32_t>(most) * height / 2 / 32768;
    fill_box({x, y + height / 2 - half, 1, 2 * half + 1}, 200, to);
  }
}

void draw_labels(const Spoken& spoken, const std::string& text, const Row& row,
                 std::uint32_t phones_y, std::uint32_t words_y, Picture* to) {
  for (std::size_t i = 0; i < spoken.events.size(); ++i) {
    const SpokenEvent& e = spoken.events[i];
    if (!row.holds(e.time_ms)) continue;
    const std::uint32_t x = row.x(e.time_ms);
    if (e.kind == Kind::phone) {
      fill_box({x, phones_y, 1, words_y - phones_y}, 110, to);
      draw_text(e.text, static_cast<int>(x) + 3, static_cast<int>(phones_y) + 20, 20.0f, to);
    }
    if (e.kind == Kind::word)
      draw_text(text.substr(e.begin_byte, e.end_byte - e.begin_byte), static_cast<int>(x) + 3,
                static_cast<int>(words_y) + 26, 28.0f, to);
  }
}

}  // namespace

Picture speech_picture(const Spoken& spoken, const SpeechShot& shot, Studio* studio) {
  static const speech::Mouth mouth;
  auto utterance = std::make_unique<speech::Utterance>();
  fill_utterance(spoken, shot.time_ms, utterance.get());
  const speech::MouthShape m = mouth.at(*utterance, static_cast<float>(shot.time_ms), kKiosk_ms);
  Pose pose;
  pose.faps = shot.mood;
  pose.speech = life_at(spoken, shot.time_ms);
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    if (m.faps.has(fap)) pose.speech.set(fap, m.faps.get(fap));
  pose.speech_strength = std::max(m.strength, 1e-6f);
  pose.framing = framing_of(studio->person(), shot.mouth_only);
  return studio->picture(pose);
}

Picture speech_strip(const Spoken& spoken, const std::string& text, std::uint32_t cell,
                     Studio* studio) {
  constexpr std::uint32_t kWave = 70, kPhones = 26, kWords = 40;
  const std::int32_t row_ms = kFrame_ms * static_cast<std::int32_t>(kColumns);
  // Of the pause at the end a fifth of a second is enough to see the mouth shut.
  std::int32_t last_ms = 0;
  for (const SpokenEvent& e : spoken.events)
    if (e.kind == Kind::phone && !e.text.empty()) last_ms = e.time_ms + 200;
  last_ms = std::min(last_ms, spoken.end_ms);
  const auto rows = static_cast<std::uint32_t>((last_ms + row_ms - 1) / row_ms);
  const std::uint32_t row_height = cell + kWave + kPhones + kWords;
  Picture out(kColumns * cell, rows * row_height);
  for (std::uint32_t r = 0; r < rows; ++r) {
    const auto from_ms = static_cast<std::int32_t>(r) * row_ms;
    const Row row{from_ms, from_ms + row_ms, r * row_height, cell};
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::int32_t middle_ms =
          from_ms + kFrame_ms * static_cast<std::int32_t>(c) + kFrame_ms / 2;
      if (middle_ms > last_ms) break;
      paste(speech_picture(spoken, {.time_ms = middle_ms}, studio), c * cell, row.y, &out);
    }
    draw_wave(spoken, row, row.y + cell, kWave, &out);
    draw_labels(spoken, text, row, row.y + cell + kWave, row.y + cell + kWave + kPhones, &out);
  }
  return out;
}

}  // namespace caryatid::tool
