#include "core/lod/controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/crc.h"
#include "core/base/random.h"

namespace caryatid::lod {
namespace {

constexpr float kFrameUs = 1e6f / 60.0f;

struct Bench {
  std::array<ObjectNeed, 3> objects{};
  SceneNeeds needs;
  Bench() {
    objects[0] = {600, 8500, 300000.0f, 1.0f, 1.0f, 0.5f, 1.0f, 0.55f};
    objects[1] = {900, 18000, 200000.0f, 1.0f, 0.6f, 0.0f, 0.5f, 0.0f};
    objects[2] = {700, 9000, 150000.0f, 2.5f, 0.8f, 0.0f, 0.6f, 0.0f};
    needs = {objects, 1920.0f * 1080.0f, false};
  }
  Work work_of(const LodDecision& d) const {
    Work work;
    const float area = d.render_scale * d.render_scale;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      work.triangles += d.triangles[i];
      work.vertices_deformed += static_cast<std::uint32_t>(objects[i].deformed_per_triangle *
                                                           static_cast<float>(d.triangles[i]));
      work.shaded_px += objects[i].screen_px * objects[i].overdraw * area;
    }
    work.target_px = needs.display_px * area;
    work.shading = d.shading;
    return work;
  }
};

LodConfig at_60() {
  LodConfig config;
  config.vblanks_per_frame = 1;
  config.prior = boards()[0];
  return config;
}

std::uint32_t total(const LodDecision& d) {
  std::uint32_t n = 0;
  for (std::uint32_t i = 0; i < d.object_count; ++i) n += d.triangles[i];
  return n;
}

void expect_bounded(const LodDecision& d, const Bench& bench) {
  ASSERT_EQ(d.object_count, bench.objects.size());
  for (std::size_t i = 0; i < bench.objects.size(); ++i) {
    ASSERT_GE(d.triangles[i], bench.objects[i].min_triangles);
    ASSERT_LE(d.triangles[i], bench.objects[i].max_triangles);
  }
  ASSERT_GE(d.render_scale, 0.5f);
  ASSERT_LE(d.render_scale, 1.0f);
  ASSERT_GE(d.frame_divisor, 1);
  ASSERT_LE(d.cover_wait_ms, 2000);
  ASSERT_TRUE(d.morph_ms == 0 || (d.morph_ms >= 200 && d.morph_ms <= 500));
  ASSERT_GE(d.max_records_per_frame, 64u);
  ASSERT_TRUE(std::isfinite(d.predicted_us) && std::isfinite(d.limit_us));
}

// A trace says what the board shows at frame n, whatever was decided.
using Trace = std::function<FrameSample(int frame, Random&)>;

FrameSample sample_of(float cpu_us, float gpu_us) {
  FrameSample s;
  s.cpu_us = static_cast<std::uint32_t>(cpu_us);
  s.gpu_us = static_cast<std::uint32_t>(gpu_us);
  s.vblanks =
      static_cast<std::uint16_t>(std::max(std::ceil((cpu_us + gpu_us + 200) / kFrameUs), 1.0f));
  return s;
}

struct NamedTrace {
  const char* name;
  Trace trace;
};

std::vector<NamedTrace> traces() {
  const auto heat = [](FrameSample s, ThermalLevel level) {
    s.thermal = level;
    return s;
  };
  return {
      {"random", [](int, Random& r) { return sample_of(r.between(0, 2e4f), r.between(0, 3e4f)); }},
      {"wild", [](int, Random& r) { return sample_of(0, std::exp(r.between(0, 17))); }},
      {"square 1 s",
       [](int n, Random&) { return sample_of(3000, n / 60 % 2 ? 20000.0f : 4000.0f); }},
      {"square 5 s",
       [](int n, Random&) { return sample_of(3000, n / 300 % 2 ? 20000.0f : 4000.0f); }},
      {"sawtooth",
       [](int n, Random&) { return sample_of(3000, 5000.0f + 60.0f * float(n % 240)); }},
      {"slow drift",
       [](int n, Random&) { return sample_of(3000, 9000 + 6000 * std::sin(float(n) / 2000)); }},
      {"spikes",
       [](int n, Random&) { return sample_of(3000 + (n % 97 == 0 ? 9000.0f : 0.0f), 9000); }},
      {"throttling",
       [heat](int n, Random&) {
         const bool hot = n / 900 % 2 != 0;
         return heat(sample_of(3000, hot ? 14000.0f : 9000.0f),
                     hot ? ThermalLevel::hot : ThermalLevel::normal);
       }},
      {"thermal flapping",
       [heat](int n, Random& r) {
         return heat(sample_of(3000, 9000),
                     static_cast<ThermalLevel>(n % 20 ? 3 * (n / 20 % 2) : r.next() % 4));
       }},
      {"no fence",
       [](int n, Random&) {
         FrameSample s = sample_of(3000, n / 200 % 2 ? 20000.0f : 4000.0f);
         s.gpu_us = FrameSample::kUnknown;
         return s;
       }},
      {"nothing measured", [](int, Random&) { return FrameSample{}; }},
  };
}

// Runs a trace for `frames`; the clock goes by the vblanks that the trace shows.
void run(const Trace& trace, int frames,
         const std::function<void(const LodDecision&, std::uint64_t)>& see,
         bool jump_back = false) {
  const Bench bench;
  BudgetController controller(at_60());
  controller.begin(bench.needs);
  Random random(11);
  std::uint64_t time_us = 0;
  for (int n = 0; n < frames; ++n) {
    FrameSample sample = trace(n, random);
    time_us += std::max<std::uint64_t>(sample.vblanks, 1) * 16667;
    if (jump_back && n % 500 == 499) time_us -= std::min<std::uint64_t>(time_us, 5'000'000);
    sample.time_us = time_us;
    sample.drawn = bench.work_of(controller.decision());
    const LodDecision& d = controller.step(sample, bench.needs);
    expect_bounded(d, bench);
    see(d, time_us);
  }
}

TEST(BudgetController, OutputsAreBoundedOnEveryTrace) {
  for (const NamedTrace& t : traces()) {
    SCOPED_TRACE(t.name);
    run(t.trace, 20000, [](const LodDecision&, std::uint64_t) {});
  }
}

TEST(BudgetController, NeverOscillatesOnAnyTrace) {
  for (const NamedTrace& t : traces()) {
    SCOPED_TRACE(t.name);
    std::uint64_t last_up_us = 0, time_us = 0;
    int reversals = 0;
    Change direction = Change::reduce;
    std::vector<std::uint64_t> reversal_us;
    run(t.trace, 60000, [&](const LodDecision& d, std::uint64_t now) {
      time_us = now;
      if (d.change == Change::none) return;
      if (d.change != Change::reduce) {
        EXPECT_GE(now - last_up_us, 1'980'000u);  // 2 s, less the vblank of rounding.
        last_up_us = now;
      }
      if (d.change == direction || d.change == Change::reshare) return;
      direction = d.change;
      ++reversals;
      reversal_us.push_back(now);
    });
    // Waits double from 2 to 64 s while reductions follow refinements within 30 s, so once that has
    // happened no pair of changes (two reversals) comes more often than every 30 s.
    int late = 0;
    for (const std::uint64_t r : reversal_us) late += r > 180'000'000;
    const auto minutes = static_cast<double>(time_us) / 60e6 - 3.0;
    EXPECT_LE(late, 4.0 * minutes + 2.0) << reversals;
  }
}

TEST(BudgetController, AClockThatJumpsBackDoesNoHarm) {
  for (const NamedTrace& t : traces()) {
    SCOPED_TRACE(t.name);
    run(
        t.trace, 20000, [](const LodDecision&, std::uint64_t) {}, true);
  }
}

TEST(BudgetController, SameSamplesSameDecisions) {
  for (const NamedTrace& t : traces()) {
    const auto hash_of_run = [&] {
      std::uint64_t hash = kHashSeed;
      run(t.trace, 5000, [&](const LodDecision& d, std::uint64_t) {
        hash = caryatid::hash_of(std::span<const std::uint32_t>(d.triangles), hash);
        hash = caryatid::hash_of(std::span<const float>(&d.predicted_us, 1), hash);
      });
      return hash;
    };
    EXPECT_EQ(hash_of_run(), hash_of_run()) << t.name;
  }
}

// Closed loop on an undisturbed virtual board; returns the decision after `seconds`.
LodDecision settle(const BoardCosts& board, int seconds,
                   ThermalLevel thermal = ThermalLevel::normal, bool idle = false) {
  Bench bench;
  BudgetController controller(at_60());
  VirtualBoard virtual_board(board, 1);
  LodDecision d = controller.begin(bench.needs);
  bench.needs.idle = idle;
  Disturbance disturbance;
  disturbance.thermal = thermal;
  for (int n = 0; n < 60 * seconds; ++n)
    d = controller.step(virtual_board.run(bench.work_of(d), d.frame_divisor, disturbance),
                        bench.needs);
  return d;
}

TEST(BudgetController, AFasterBoardIsGivenMore) {
  std::uint32_t before = 0;
  for (const float factor : {2.0f, 1.5f, 1.0f, 0.7f, 0.4f}) {
    BoardCosts board = boards()[0];
    for (float* cost : {&board.cpu_fixed_us, &board.cpu_vertex_ns, &board.gpu_fixed_us,
                        &board.gpu_triangle_ns, &board.gpu_target_px_ns, &board.gpu_shaded_px_ns[0],
                        &board.gpu_shaded_px_ns[1], &board.gpu_shaded_px_ns[2]})
      *cost *= factor;
    const LodDecision d = settle(board, 120);
    const auto worth = static_cast<std::uint32_t>(d.render_scale * 1e6f) + total(d);
    EXPECT_GE(worth, before) << factor;
    before = worth;
  }
}

TEST(BudgetController, AnAmpleBoardEndsAtFullQuality) {
  BoardCosts board = boards()[2];
  board.gpu_triangle_ns *= 0.2f;
  const LodDecision d = settle(board, 120);
  EXPECT_EQ(total(d), 35500u);
  EXPECT_EQ(d.render_scale, 1.0f);
  EXPECT_EQ(d.shading, Shading::per_pixel);
}

TEST(BudgetController, ABoardThatCannotIsSlowedAndHeldAtTheFloor) {
  BoardCosts board = boards()[0];
  board.cpu_fixed_us = 20000;
  const LodDecision d = settle(board, 30);
  EXPECT_EQ(total(d), 2200u);
  EXPECT_EQ(d.render_scale, 0.5f);
  EXPECT_EQ(d.frame_divisor, 2);
}

TEST(BudgetController, CriticalHeatMeansTenFramesASecond) {
  EXPECT_EQ(settle(boards()[2], 20, ThermalLevel::critical).frame_divisor, 6);
}

TEST(BudgetController, SavesHeatOnlyWhileNobodyLooksAndItIsWarm) {
  EXPECT_EQ(settle(boards()[2], 20, ThermalLevel::warm, true).frame_divisor, 2);
  EXPECT_EQ(settle(boards()[2], 20, ThermalLevel::warm, false).frame_divisor, 1);
  EXPECT_EQ(settle(boards()[2], 20, ThermalLevel::normal, true).frame_divisor, 1);
}

TEST(BudgetController, WakesInTheVeryNextFrame) {
  Bench bench;
  BudgetController controller(at_60());
  VirtualBoard board(boards()[2], 1);
  LodDecision d = controller.begin(bench.needs);
  Disturbance warm;
  warm.thermal = ThermalLevel::warm;
  bench.needs.idle = true;
  for (int n = 0; n < 600; ++n)
    d = controller.step(board.run(bench.work_of(d), d.frame_divisor, warm), bench.needs);
  ASSERT_EQ(d.frame_divisor, 2);
  bench.needs.idle = false;
  d = controller.step(board.run(bench.work_of(d), d.frame_divisor, warm), bench.needs);
  EXPECT_EQ(d.frame_divisor, 1);
}

TEST(BudgetController, PlansForACameraThatMovesIn) {
  Bench bench;
  BudgetController controller(at_60());
  VirtualBoard board(boards()[0], 1);
  for (ObjectNeed& o : bench.objects) o.screen_px *= 0.2f;
  LodDecision d = controller.begin(bench.needs);
  for (int n = 0; n < 3600; ++n) d = controller.step(board.run(bench.work_of(d)), bench.needs);
  int late = 0;
  for (int n = 0; n < 120; ++n) {  // Five times the area within 2 s.
    for (ObjectNeed& o : bench.objects) o.screen_px *= std::pow(5.0f, 1.0f / 120.0f);
    const FrameSample s = board.run(bench.work_of(d));
    late += s.vblanks > 1;
    d = controller.step(s, bench.needs);
  }
  EXPECT_EQ(late, 0);
}

TEST(BudgetController, ANewObjectIsSharedInAtOnce) {
  Bench bench;
  BudgetController controller(at_60());
  controller.begin({std::span(bench.objects).first(2), bench.needs.display_px, false});
  FrameSample sample;
  const LodDecision& d = controller.step(sample, bench.needs);
  expect_bounded(d, bench);
}

TEST(BudgetController, AnEmptySceneIsAScene) {
  BudgetController controller(at_60());
  controller.begin({});
  EXPECT_EQ(controller.step({}, {}).object_count, 0u);
}

}  // namespace
}  // namespace caryatid::lod
