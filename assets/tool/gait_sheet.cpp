#include "assets/tool/gait_sheet.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "assets/bake/gait/settled_walk.h"
#include "assets/tool/progress.h"
#include "assets/tool/soles.h"

namespace caryatid::tool {
namespace {

using bake::SettledWalk;

constexpr float kVisible = 1.12f;  // Height of a picture over the stature.
constexpr float kTick_m = 0.25f;
constexpr std::uint8_t kFloorGrey = 210;

// Pictures of one person without her travel, the whole body in each.
class FigureCamera {
 public:
  explicit FigureCamera(Studio* studio)
      : studio_(studio), stature_m_(studio->person().view().character->stature_m) {}

  Picture take(body::BapFrame frame, bool side) const {
    frame.set(182, 0.0f);
    frame.set(183, 0.0f);
    return shoot(frame, side);
  }
  // What is behind her.
  Picture empty() const {
    body::BapFrame away;
    away.set(181, 1e6f);
    return shoot(away, true);
  }
  float pixels_per_m(const Picture& p) const {
    return static_cast<float>(p.height) / (kVisible * stature_m_);
  }
  std::uint32_t floor_row(const Picture& p) const {
    return static_cast<std::uint32_t>(static_cast<float>(p.height) * (0.5f + 0.5f / kVisible));
  }

 private:
  Picture shoot(const body::BapFrame& frame, bool side) const {
    Pose pose;
    pose.baps = frame;
    scene::Framing framing;
    framing.target_m = {0.0f, 0.5f * stature_m_, 0.0f};
    framing.direction = side ? Vec3{-1, 0, 0} : Vec3{0, 0, 1};
    framing.visible_height_m = kVisible * stature_m_;
    framing.visible_width_m = 0.6f * stature_m_;
    pose.framing = framing;
    return studio_->picture(pose);
  }

  Studio* studio_;
  float stature_m_;
};

// The floor under a picture whose column `origin` is at `at_m` of the way, with a tick every
// quarter metre, longer at whole ones.
void draw_floor(float origin, float at_m, float pixels_per_m, std::uint32_t row, Picture* to) {
  fill_box({0, row, to->width, 1}, kFloorGrey, to);
  const float left_m = at_m - origin / pixels_per_m;
  const int first = static_cast<int>(std::ceil(left_m / kTick_m));
  for (int i = first;; ++i) {
    const float x = (static_cast<float>(i) * kTick_m - left_m) * pixels_per_m;
    if (x >= static_cast<float>(to->width)) break;
    const bool whole = i % 4 == 0;
    fill_box({static_cast<std::uint32_t>(x), row, whole ? 2u : 1u, whole ? 9u : 4u}, kFloorGrey,
             to);
  }
}

Picture middle_of(const Picture& p, float share) {
  const auto width = static_cast<std::uint32_t>(share * static_cast<float>(p.width));
  Picture out(width, p.height);
  const std::size_t skip = (p.width - width) / 2;
  for (std::size_t y = 0; y < p.height; ++y)
    std::copy_n(&p.rgb[3 * (y * p.width + skip)], 3 * width, &out.rgb[3 * y * width]);
  return out;
}

// What of `figure` differs from the empty picture, centred on column `x` of `to`.
void stamp(const Picture& figure, const Picture& empty, int x, Picture* to) {
  constexpr int kDiffers = 10;
  for (std::size_t row = 0; row < figure.height; ++row)
    for (std::size_t column = 0; column < figure.width; ++column) {
      const int at = x + static_cast<int>(column) - static_cast<int>(figure.width / 2);
      if (at < 0 || at >= static_cast<int>(to->width)) continue;
      const std::size_t from = 3 * (row * figure.width + column);
      const std::size_t into = 3 * (row * to->width + static_cast<std::size_t>(at));
      int difference = 0;
      for (std::size_t c = 0; c < 3; ++c)
        difference = std::max(difference, std::abs(figure.rgb[from + c] - empty.rgb[from + c]));
      if (difference > kDiffers) std::copy_n(&figure.rgb[from], 3, &to->rgb[into]);
    }
}

Picture chronophotograph(const FigureCamera& camera, SettledWalk walk, std::uint32_t width) {
  constexpr float kEvery_s = 0.7f;
  constexpr int kFigures = 7;
  constexpr float kMargin_m = 0.6f;
  const Picture empty = camera.empty();
  const float scale = camera.pixels_per_m(empty);
  Picture out(width, empty.height);
  for (std::size_t y = 0; y < out.height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      std::copy_n(&empty.rgb[3 * (y * empty.width + empty.width / 2)], 3,
                  &out.rgb[3 * (y * width + x)]);
  const std::uint32_t row = camera.floor_row(empty);
  draw_floor(kMargin_m * scale, 0.0f, scale, row, &out);
  for (int metre = 0; static_cast<float>(metre) < static_cast<float>(width) / scale; ++metre)
    draw_text(std::to_string(metre) + " m",
              static_cast<int>((static_cast<float>(metre) + kMargin_m) * scale) + 4,
              static_cast<int>(row) + 15, 13.0f, &out);
  const float start_mm = walk.step(0.0f).get(183);
  for (int i = 0; i < kFigures; ++i) {
    const body::BapFrame& frame = walk.step(i == 0 ? 0.0f : kEvery_s);
    const float at_m = (frame.get(183) - start_mm) / 1000.0f + kMargin_m;
    stamp(camera.take(frame, true), empty, static_cast<int>(at_m * scale), &out);
  }
  return out;
}

std::string pace(const bake::WalkMeasures& m) {
  char text[160];
  std::snprintf(text, sizeof text,
                "speed %.2f m/s    %.0f steps a minute    step %.2f m    above: one picture every "
                "0.7 s at its place on the floor",
                double(m.speed_mps), 60.0 * double(m.speed_mps / m.step_m), double(m.step_m));
  return text;
}

}  // namespace

GaitCells gait_poses(Studio* studio) {
  constexpr const char* kPoses[] = {"extended", "recoil", "passing", "anticipation"};
  const FigureCamera camera(studio);
  (void)camera.empty();  // Brings the person to full detail.
  const body::Skeleton& skeleton = studio->person().skeleton();
  const auto soles = skinned_soles(studio->person());
  GaitCells cells;
  Progress progress;
  for (int m = 0; m < body::kGaitMoodCount; ++m) {
    const char* name = body::gait_mood_name(body::GaitMood(m));
    progress.step(std::string("walk ") + name);
    SettledWalk walk(skeleton, body::gait_style(body::GaitMood(m)));
    for (int p = 0; p < 4; ++p) {
      // The right leg stands: its phase is the left one's and a half.
      const float phase = 0.5f + 0.125f * static_cast<float>(p);
      Picture picture = camera.take(p == 0 ? walk.to_phase(0.502f) : walk.to_phase(phase), true);
      fill_box({0, camera.floor_row(picture), picture.width, 1}, kFloorGrey, &picture);
      cells.pictures.push_back(picture);
      cells.captions.push_back(std::string(name) + ", " + kPoses[p]);
    }
    const auto w = bake::measure_walk(skeleton, walk.record(300, 30.0f), 30.0f, soles);
    std::printf(
        "%-8s slide %.2f mm a frame, below floor %.2f mm, clearance %.1f mm, pelvis travel "
        "%.1f mm, %d to %d maxima a step, %.2f m/s\n",
        name, 1e3 * double(w.slide_m), 1e3 * double(w.below_floor_m), 1e3 * double(w.clearance_m),
        1e3 * double(w.pelvis_travel_m), w.fewest_maxima, w.most_maxima, double(w.speed_mps));
  }
  return cells;
}

Picture gait_strip(Studio* studio, const body::GaitStyle& style) {
  constexpr std::uint32_t kColumns = 8;
  const FigureCamera camera(studio);
  const body::Skeleton& skeleton = studio->person().skeleton();
  std::vector<Picture> cells;
  std::vector<std::string> times;
  for (const bool side : {true, false}) {
    SettledWalk walk(skeleton, style);
    const float start_mm = walk.step(0.0f).get(183);
    for (int i = 0; i < 16; ++i) {
      const float phase = std::fmod(0.502f + static_cast<float>(i) / 16.0f, 1.0f);
      const body::BapFrame& frame = walk.to_phase(phase);
      Picture cell = middle_of(camera.take(frame, side), 0.72f);
      if (side)
        draw_floor(0.5f * static_cast<float>(cell.width), (frame.get(183) - start_mm) / 1000.0f,
                   camera.pixels_per_m(cell), camera.floor_row(cell), &cell);
      char time[32];
      std::snprintf(time, sizeof time, "%.2f s", double(style.cycle_s) * i / 16.0);
      cells.push_back(std::move(cell));
      times.emplace_back(time);
    }
  }
  const Picture frames = grid(cells, times, kColumns);
  const Picture way = chronophotograph(camera, SettledWalk(skeleton, style), frames.width);
  constexpr std::uint32_t kLine = 26;
  Picture out(frames.width, way.height + kLine + frames.height);
  paste(way, 0, 0, &out);
  SettledWalk measured(skeleton, style);
  const auto w = bake::measure_walk(skeleton, measured.record(600, 60.0f), 60.0f,
                                    bake::outline_points(skeleton));
  draw_text(pace(w), 8, static_cast<int>(way.height) + 19, 17.0f, &out);
  paste(frames, 0, way.height + kLine, &out);
  return out;
}

}  // namespace caryatid::tool
