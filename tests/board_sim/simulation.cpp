#include "tests/board_sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/base/crc.h"

namespace caryatid::sim {
namespace {

constexpr std::uint64_t kSecond = 1'000'000;

// A character as the bake makes it: full triangles from the base human's packages, the base mesh at
// about a tenth. screen share: of the display, in a head close-up and in a view of the whole body.
struct SimObject {
  std::uint32_t min_triangles, max_triangles;
  float close_share, body_share, overdraw, importance, deformed_per_triangle;
};
constexpr std::array<SimObject, 6> kCharacter{{
    {600, 8508, 0.30f, 0.012f, 1.0f, 1.0f, 0.55f},  // head
    {150, 2100, 0.02f, 0.001f, 1.3f, 1.0f, 0.55f},  // eyes, teeth, tongue, brows
    {700, 9000, 0.16f, 0.010f, 2.5f, 0.6f, 0.0f},   // hair
    {900, 15000, 0.04f, 0.050f, 1.0f, 0.5f, 0.0f},  // body
    {600, 9000, 0.16f, 0.090f, 1.0f, 0.5f, 0.0f},   // clothes
    {150, 2400, 0.0f, 0.008f, 1.0f, 0.2f, 0.0f},    // shoes
}};

lod::BoardCosts wrong_prior(const Scenario& scenario) {
  lod::BoardCosts prior = scenario.board;
  Random random(scenario.seed * 77 + 5);
  const auto bend = [&](float& v) {
    v *= random.between(1.0f - scenario.prior_error, 1.0f + scenario.prior_error);
  };
  for (float* v :
       {&prior.cpu_fixed_us, &prior.cpu_vertex_ns, &prior.cpu_record_ns, &prior.gpu_fixed_us,
        &prior.gpu_triangle_ns, &prior.gpu_target_px_ns, &prior.gpu_shaded_px_ns[0],
        &prior.gpu_shaded_px_ns[1], &prior.gpu_shaded_px_ns[2]})
    bend(*v);
  return prior;
}

lod::LodConfig config_of(const Scenario& scenario) {
  lod::LodConfig config;
  config.vblank_us = 1e6f / scenario.board.refresh_hz;
  config.vblanks_per_frame = scenario.vblanks_per_frame;
  config.prior = scenario.policy == Policy::fixed ? scenario.board : wrong_prior(scenario);
  return config;
}

}  // namespace

const char* name_of(Policy policy) {
  return policy == Policy::controller ? "controller"
         : policy == Policy::fixed    ? "fixed"
                                      : "reactive";
}

Simulation::Simulation(const Scenario& scenario)
    : scenario_(scenario),
      random_(scenario.seed * 31 + 7),
      disturbances_(scenario.seed, scenario.has_fence),
      board_(scenario_.board, scenario.vblanks_per_frame),
      controller_(config_of(scenario)) {
  needs_.objects = objects_;
  needs_.display_px = static_cast<float>(scenario.board.display_width) *
                      static_cast<float>(scenario.board.display_height);
  next_shot_us_ = scenario.scene_moves ? 10 * kSecond : ~std::uint64_t{0};
  move_scene(0);
  own_ = controller_.begin(needs_);
  for (std::size_t i = 0; i < objects_.size(); ++i)
    drawn_[i] = static_cast<float>(own_.triangles[i]);
}

// Shots: close-up (1), whole body (0) or between; speaking and listening take turns by the second.
void Simulation::move_scene(std::uint64_t time_us) {
  if (time_us >= next_shot_us_) {
    shot_at_us_ = time_us;
    next_shot_us_ = time_us + (10 + random_.next() % 30) * kSecond;
    close_up_from_ = close_up_;
    close_up_to_ = static_cast<double>(random_.next() % 3) * 0.5;
  }
  const double t = std::min(static_cast<double>(time_us - shot_at_us_) / (2.0 * kSecond), 1.0);
  close_up_ = close_up_from_ + (close_up_to_ - close_up_from_) * t;
  if (t < 1.0) last_scene_us_ = time_us;
  const bool speaks = (time_us / (7 * kSecond)) % 2 == 0;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const SimObject& o = kCharacter[i];
    const auto close = static_cast<float>(close_up_);
    objects_[i] = {o.min_triangles,
                   o.max_triangles,
                   needs_.display_px * (o.body_share + (o.close_share - o.body_share) * close),
                   o.overdraw,
                   i < 3 ? 1.0f : 0.5f,
                   speaks && i < 2 ? 0.8f : 0.2f,
                   o.importance,
                   o.deformed_per_triangle};
  }
}

// What the agent and the mesh room do with a decision: wait for a blink or saccade (every 0.4 to
// 2 s), morph, and apply at most the allowed records a frame. A refinement draws the finer mesh
// from the start of its morph, a reduction until its end.
void Simulation::move_level(const lod::LodDecision& decision, std::uint64_t time_us,
                            float seconds) {
  records_ = 0;
  const bool cover = time_us >= next_cover_us_;
  if (cover) next_cover_us_ = time_us + 400'000 + random_.next() % 1'600'000;
  if (sequence_ != decision.sequence) {
    sequence_ = decision.sequence;
    held_s_ = morph_s_ = 0;
    settled_ = false;
  }
  if (settled_) return;
  held_s_ += seconds;
  if (!cover && morph_s_ <= 0 && held_s_ * 1000.0f < decision.cover_wait_ms) return;
  morph_s_ += seconds;
  float todo = 0;
  for (std::size_t i = 0; i < drawn_.size(); ++i)
    todo += std::abs(static_cast<float>(decision.triangles[i]) - drawn_[i]);
  const auto allowed = 2.0f * static_cast<float>(decision.max_records_per_frame);
  const float part = todo <= allowed ? 1.0f : allowed / todo;
  const bool morphed = morph_s_ * 1000.0f >= decision.morph_ms;
  settled_ = part >= 1.0f && morphed;
  float done = 0;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const float difference = static_cast<float>(decision.triangles[i]) - drawn_[i];
    if (difference < 0 && !morphed) continue;
    drawn_[i] += part * difference;
    done += part * std::abs(difference);
  }
  records_ = static_cast<std::uint32_t>(done * 0.5f);
}

lod::Work Simulation::work_of(const lod::LodDecision& decision) const {
  const float area = decision.render_scale * decision.render_scale;
  lod::Work work;
  float triangles = 0, deformed = 0;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    triangles += drawn_[i];
    deformed += drawn_[i] * objects_[i].deformed_per_triangle;
    work.shaded_px += objects_[i].screen_px * objects_[i].overdraw * area;
  }
  work.triangles = static_cast<std::uint32_t>(triangles);
  work.vertices_deformed = static_cast<std::uint32_t>(deformed);
  work.records = records_;
  work.target_px = needs_.display_px * area;
  work.shading = decision.shading;
  return work;
}

void Simulation::react(const lod::FrameSample& sample) {
  own_.change = lod::Change::none;
  if (scenario_.policy != Policy::reactive) return;
  const bool late = sample.vblanks > scenario_.vblanks_per_frame;
  calm_frames_ = late ? 0 : calm_frames_ + 1;
  const int before = level_;
  if (late) level_ = std::max(level_ - 1, 1);
  if (calm_frames_ >= 30 && level_ < 20) {
    ++level_;
    calm_frames_ = 0;
  }
  if (level_ == before && own_.sequence > 0) return;
  own_.change = level_ < before ? lod::Change::reduce : lod::Change::refine;
  ++own_.sequence;
  own_.max_records_per_frame = 4096;
  for (std::size_t i = 0; i < objects_.size(); ++i)
    own_.triangles[i] =
        std::max(objects_[i].max_triangles * static_cast<std::uint32_t>(level_) / 20,
                 objects_[i].min_triangles);
}

void Simulation::count(const lod::FrameSample& sample, const lod::LodDecision& decision,
                       Outcome& out) {
  const std::uint64_t now = sample.time_us;
  ++out.frames;
  // Late by the target rate: a controller that halves the rate gets no credit for it.
  const bool late = sample.vblanks > scenario_.vblanks_per_frame;
  if (disturbances_.step_count() != counted_steps_) {
    counted_steps_ = disturbances_.step_count();
    late_after_step_ = 0;
  }
  if (late) {
    ++out.late;
    if (counted_steps_ > 0 && now < disturbances_.last_step_us() + 2 * kSecond)
      out.worst_late_after_step = std::max(out.worst_late_after_step, ++late_after_step_);
  }
  if (decision.sequence != counted_sequence_) {
    counted_sequence_ = decision.sequence;
    ++out.changes;
    change_us_[change_count_++ % change_us_.size()] = now;
    const bool steady = now > disturbances_.last_change_us() + 3 * kSecond &&
                        now > last_scene_us_ + 3 * kSecond && now > 10 * kSecond;
    if (steady) {
      std::uint32_t recent = 0;
      for (std::size_t i = 0; i < std::min<std::size_t>(change_count_, change_us_.size()); ++i)
        recent += change_us_[i] + kSecond > now;
      out.most_changes_in_a_second = std::max(out.most_changes_in_a_second, recent);
    }
  }
}

Outcome Simulation::run(const std::function<void(const Trace&)>& watch) {
  Outcome out;
  std::uint64_t hash = kHashSeed;
  const auto end_us = static_cast<std::uint64_t>(scenario_.hours * 3600.0 * 1e6);
  const lod::LodDecision* decision = &own_;
  std::uint64_t time_us = 0, before_us = 0;
  while (time_us < end_us) {
    const lod::Disturbance disturbance = disturbances_.next(time_us);
    move_level(*decision, time_us, static_cast<float>(time_us - before_us) * 1e-6f);
    const lod::Work work = work_of(*decision);
    const std::uint8_t divisor = decision->frame_divisor;
    const lod::FrameSample sample = board_.run(work, divisor, disturbance);
    move_scene(sample.time_us);
    if (scenario_.policy == Policy::controller)
      decision = &controller_.step(sample, needs_);
    else
      react(sample);
    before_us = time_us;
    time_us = sample.time_us;
    count(sample, *decision, out);
    out.mean_triangles += work.triangles;
    out.mean_scale += static_cast<double>(decision->render_scale);
    const std::uint32_t gpu_us = sample.gpu_us == lod::FrameSample::kUnknown ? 0 : sample.gpu_us;
    out.mean_us += sample.cpu_us + gpu_us;
    hash = (hash ^ (sample.time_us + work.triangles)) * 1099511628211ull;
    if (watch)
      watch({static_cast<double>(time_us) * 1e-6, static_cast<double>(sample.cpu_us + gpu_us),
             static_cast<double>(sample.cpu_us), work.triangles, decision->render_scale,
             sample.vblanks > scenario_.vblanks_per_frame, disturbances_.throttled(),
             sample.thermal, decision->change});
  }
  const auto frames = static_cast<double>(out.frames);
  out.mean_triangles /= frames;
  out.mean_scale /= frames;
  out.mean_us /= frames;
  out.steps = disturbances_.step_count();
  out.hash = hash;
  return out;
}

}  // namespace caryatid::sim
