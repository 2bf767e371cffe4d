#include "core/lod/controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/lod/share.h"

namespace caryatid::lod {
namespace {

constexpr float kPlanDeviations = 4.5f, kReduceDeviations = 3.2f, kHurryDeviations = 2.2f;
constexpr float kComfort = 0.35f;        // Of the way from the coarsest mesh to the finest.
constexpr float kComfortBetter = 0.40f;  // A better rung must be worth more than that: hysteresis.
constexpr float kRefineTo = 0.97f;  // Of the plan, so that a refinement does not end at its edge.
constexpr float kRefineGrowth = 1.25f;  // Per change.
constexpr float kRefineGain = 1.08f;    // Less is not worth a change.
constexpr float kReshare = 0.25f;       // An object's share must be this far off.
constexpr float kWaitMin_s = 2.0f, kWaitMax_s = 64.0f, kMistake_s = 30.0f, kForgive_s = 120.0f;
constexpr float kTryEvery_s = 0.25f;
constexpr float kRealStep = 1.15f, kUnsettled_s = 3.0f;  // Smaller ones may be noise.
// Without a fence the GPU is known by bounds alone, its pixels and triangles not apart: a better
// rung needs room for that, and nothing grows soon after a late frame, the first of a step perhaps.
constexpr float kBlindShare = 0.95f, kBlindRungShare = 0.8f, kBlindWait_s = 2.0f;
// How much a step slowed the GPU isn't known either: the first answer must be enough.
constexpr float kBlindHurryShare = 0.75f;
constexpr float kAhead_s = 0.5f;    // What a hidden and morphed change takes.
constexpr float kTrend_s = 0.15f;   // Time constant of the camera's trend.
constexpr float kThrottle = 1.43f;  // What a hot board is about to cost more: clocks fall by 30 %.
constexpr std::uint32_t kRecordsMin = 64, kRecordsMax = 4096;

float margin(float deadline_us, float deviation, float deviations) {
  return std::max(deadline_us / (1.0f + deviations * deviation), 0.6f * deadline_us);
}

std::uint32_t total(std::span<const std::uint32_t> triangles) {
  std::uint32_t n = 0;
  for (const std::uint32_t t : triangles) n += t;
  return n;
}

std::size_t count_of(const SceneNeeds& needs) {
  return std::min(needs.objects.size(), kMaxObjects);
}

}  // namespace

BudgetController::BudgetController(const LodConfig& config) : config_(config) {
  assert(config.vblanks_per_frame >= 1 && config.vblank_us > 2.0f * kFlipLeadUs);
}

const LodDecision& BudgetController::begin(const SceneNeeds& needs) {
  const std::size_t count = count_of(needs);
  const Limits limit = limits(work_of(std::span(decision_.triangles).first(count), 0, needs));
  const float share = started_ ? limit.plan_us : 0.7f * limit.deadline_us;
  decision_.object_count = static_cast<std::uint32_t>(count);
  started_ = true;
  adopt(best_plan(rung_, share, needs, needs.objects.first(count)), Change::reshare, true);
  return decision_;
}

const LodDecision& BudgetController::step(const FrameSample& sample, const SceneNeeds& needs) {
  if (!started_ || decision_.object_count != count_of(needs)) begin(needs);
  decision_.change = Change::none;
  late_ = sample.vblanks > config_.vblanks_per_frame * decision_.frame_divisor;
  advance_clock(sample, needs);
  learn(sample);
  const bool changed = adjust_rate(needs) || reduce(sample, needs) || refine(needs);
  if (changed) ++decision_.sequence;
  pace(sample, needs);
  return decision_;
}

// A clock that jumps back counts as standing still, one that jumps far ahead as one second.
void BudgetController::advance_clock(const FrameSample& sample, const SceneNeeds& needs) {
  const std::uint64_t passed_us =
      sample.time_us > last_time_us_
          ? std::min<std::uint64_t>(sample.time_us - last_time_us_, 1000000)
          : 0;
  last_time_us_ = sample.time_us;
  const float s = static_cast<float>(passed_us) * 1e-6f;
  for (float* timer : {&since_change_s_, &since_refine_s_, &since_reduce_s_, &since_try_s_,
                       &since_unexplained_s_, &since_late_s_, &since_step_s_, &idle_s_})
    *timer = std::min(*timer + s, kLong);
  if (!needs.idle) idle_s_ = 0.0f;
  if (late_) since_late_s_ = 0.0f;
  evidence_s_ = std::max(evidence_s_ - s, 0.0f);
  follow_camera(needs, s);
  overhead_us_ *= 1.0f - 0.02f * s;
  if (since_reduce_s_ > kForgive_s) wait_s_ = kWaitMin_s;
}

// A camera that moves in makes the coming frames dearer: plans for where it will be.
void BudgetController::follow_camera(const SceneNeeds& needs, float passed_s) {
  float covered_px = 0.0f;
  for (std::size_t i = 0; i < count_of(needs); ++i)
    covered_px += needs.objects[i].screen_px * needs.objects[i].overdraw;
  if (passed_s > 0.0f && covered_px_ > 0.0f) {
    const float rate = (covered_px - covered_px_) / passed_s;
    trend_px_s_ += std::min(passed_s / kTrend_s, 1.0f) * (rate - trend_px_s_);
  }
  covered_px_ = covered_px;
  approach_ = std::clamp(1.0f + kAhead_s * trend_px_s_ / std::max(covered_px, 1.0f), 1.0f, 2.0f);
}

void BudgetController::learn(const FrameSample& sample) {
  if (sample.thermal > thermal_ || sample.other_load_percent >= other_load_percent_ + 15)
    evidence_s_ = 1.0f, since_step_s_ = 0.0f;
  thermal_ = sample.thermal;
  other_load_percent_ = sample.other_load_percent;
  if (sample.cpu_us == FrameSample::kUnknown) return;
  blind_ = sample.gpu_us == FrameSample::kUnknown;
  const bool evidence = evidence_s_ > 0.0f;
  const auto cpu_us = static_cast<float>(sample.cpu_us);
  // A step of one stage makes one of the other likely: a hot board slows both.
  const float step = cpu_.learn(cpu_terms(config_.prior, sample.drawn), cpu_us, late_, evidence);
  note_step(step);
  learn_gpu(sample, evidence || step > 1.0f);
  if (thermal_ == ThermalLevel::normal) {
    cpu_.count_slowdown_from_here();
    gpu_.count_slowdown_from_here();
  }
}

void BudgetController::note_step(float factor) {
  if (factor > 1.0f) evidence_s_ = 1.0f;
  if (factor > kRealStep) since_step_s_ = 0.0f;
}

void BudgetController::learn_gpu(const FrameSample& sample, bool evidence) {
  const Terms terms = gpu_terms(config_.prior, sample.drawn);
  if (sample.gpu_us != FrameSample::kUnknown) {
    const float step = gpu_.learn(terms, static_cast<float>(sample.gpu_us), late_, evidence);
    note_step(step);
    learn_overhead(sample);
  } else if (sample.vblanks > 0) {
    const int periods = late_ ? sample.vblanks - 1 : sample.vblanks;
    const auto cpu_us = static_cast<float>(sample.cpu_us);
    gpu_.learn_bound(terms, static_cast<float>(periods) * config_.vblank_us - kFlipLeadUs - cpu_us,
                     late_);
  }
}

// Late although both stages were in time: something between (commit, interrupt) costs more than we
// see. The second within 2 s makes the frame 3 % shorter; that is forgotten at 2 % a second.
void BudgetController::learn_overhead(const FrameSample& sample) {
  const float frame_us = config_.vblank_us * static_cast<float>(config_.vblanks_per_frame);
  const float known_us = static_cast<float>(sample.cpu_us) + static_cast<float>(sample.gpu_us);
  if (!late_ || known_us + kFlipLeadUs > frame_us * static_cast<float>(decision_.frame_divisor))
    return;
  if (since_unexplained_s_ < 2.0f)
    overhead_us_ = std::min(overhead_us_ + 0.03f * frame_us, 0.3f * frame_us);
  since_unexplained_s_ = 0.0f;
}

float BudgetController::predict_now(const Work& work) const {
  return cpu_.predict(cpu_terms(config_.prior, work)) +
         gpu_.predict(gpu_terms(config_.prior, work)) + overhead_us_;
}

// While hot, plans for the clocks that throttling will bring, less what has already come.
float BudgetController::predict(const Work& work) const {
  if (thermal_ < ThermalLevel::hot) return predict_now(work);
  const auto factor = [](float slowdown) {
    return std::clamp(kThrottle / slowdown, 1.0f, kThrottle);
  };
  return factor(cpu_.slowdown()) * cpu_.predict(cpu_terms(config_.prior, work)) +
         factor(gpu_.slowdown()) * gpu_.predict(gpu_terms(config_.prior, work)) + overhead_us_;
}

BudgetController::Limits BudgetController::limits(const Work& work) const {
  const float cpu_us = cpu_.predict(cpu_terms(config_.prior, work));
  const float gpu_us = gpu_.predict(gpu_terms(config_.prior, work));
  const float cpu_noise = cpu_us * cpu_.deviation(), gpu_noise = gpu_us * gpu_.deviation();
  const float deviation =
      std::sqrt(cpu_noise * cpu_noise + gpu_noise * gpu_noise) / std::max(cpu_us + gpu_us, 1.0f);
  // Always the full rate: a lower one saves heat, it is not there to be filled with triangles.
  float deadline = config_.vblank_us * static_cast<float>(config_.vblanks_per_frame) - kFlipLeadUs;
  if (thermal_ == ThermalLevel::critical) deadline *= 0.5f;
  return {deadline, margin(deadline, deviation, kPlanDeviations),
          margin(deadline, deviation, kReduceDeviations),
          margin(deadline, deviation, kHurryDeviations)};
}

Work BudgetController::work_of(std::span<const std::uint32_t> triangles, int rung,
                               const SceneNeeds& needs) const {
  const Rung& r = kRungs[static_cast<std::size_t>(rung)];
  const float area = r.render_scale * r.render_scale;
  Work work;
  float deformed = 0.0f;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const ObjectNeed& need = needs.objects[i];
    work.triangles += triangles[i];
    deformed += need.deformed_per_triangle * static_cast<float>(triangles[i]);
    work.shaded_px += need.screen_px * need.overdraw * area * approach_;
  }
  work.vertices_deformed = static_cast<std::uint32_t>(deformed);
  work.target_px = needs.display_px * area;
  work.shading = r.shading;
  return work;
}

// The finest meshes that `limit_us` pays for on a rung. `capped` are the objects with the maxima
// that this change allows.
BudgetController::Plan BudgetController::plan_at(int rung, float limit_us, float comfort,
                                                 const SceneNeeds& needs,
                                                 std::span<const ObjectNeed> capped) const {
  Plan plan;
  plan.rung = rung;
  const std::size_t count = capped.size();
  Work one_triangle;
  one_triangle.triangles = 1000;
  const float gpu_us = gpu_.gain(1) * gpu_terms(config_.prior, one_triangle)[1] * 1e-3f;
  const float vertex_us = cpu_.gain(1) * config_.prior.cpu_vertex_ns * 1e-3f;
  std::array<float, kMaxObjects> triangle_us{};
  float wanted = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    const ObjectNeed& need = needs.objects[i];
    triangle_us[i] = std::max(gpu_us + vertex_us * need.deformed_per_triangle, 1e-6f);
    const auto least = static_cast<float>(need.min_triangles);
    wanted += least + comfort * (static_cast<float>(need.max_triangles) - least);
  }
  const std::array<std::uint32_t, kMaxObjects> none{};
  // Anticipated throttling makes every term dearer, so it shrinks the budget instead.
  const Work bare = work_of(std::span(none).first(count), rung, needs);
  const float plain =
      cpu_.predict(cpu_terms(config_.prior, bare)) + gpu_.predict(gpu_terms(config_.prior, bare));
  const float dearer = (predict(bare) - overhead_us_) / std::max(plain, 1.0f);
  const float budget = (limit_us - overhead_us_) / std::max(dearer, 1.0f) - plain;
  share_budget(capped, std::span(triangle_us).first(count), budget,
               std::span(plan.triangles).first(count));
  plan.triangle_sum = total(std::span(plan.triangles).first(count));
  plan.comfortable =
      static_cast<float>(plan.triangle_sum) >= wanted &&
      predict(work_of(std::span(plan.triangles).first(count), rung, needs)) <= 1.01f * limit_us;
  return plan;
}

BudgetController::Plan BudgetController::best_plan(int first_rung, float limit_us,
                                                   const SceneNeeds& needs,
                                                   std::span<const ObjectNeed> capped) const {
  for (int rung = first_rung;; ++rung) {
    const Plan plan = plan_at(rung, limit_us, kComfort, needs, capped);
    if (plan.comfortable || rung + 1 == static_cast<int>(kRungs.size())) return plan;
  }
}

// The objects with their maxima lowered to `share` of what is decided now and `growth` of the full
// mesh.
std::span<const ObjectNeed> BudgetController::cap(const SceneNeeds& needs, float share,
                                                  float growth, Needs& storage) const {
  const std::size_t count = count_of(needs);
  for (std::size_t i = 0; i < count; ++i) {
    storage[i] = needs.objects[i];
    const auto now = share * static_cast<float>(decision_.triangles[i]);
    const auto range = static_cast<float>(needs.objects[i].max_triangles);
    const auto most = static_cast<std::uint32_t>(now + growth * std::max(now, range));
    storage[i].max_triangles =
        std::clamp(most, storage[i].min_triangles,
                   std::max(storage[i].min_triangles, storage[i].max_triangles));
  }
  return std::span(storage).first(count);
}

bool BudgetController::at_floor(const SceneNeeds& needs) const {
  if (rung_ + 1 < static_cast<int>(kRungs.size())) return false;
  for (std::size_t i = 0; i < count_of(needs); ++i)
    if (decision_.triangles[i] > needs.objects[i].min_triangles) return false;
  return true;
}

bool BudgetController::reduce(const FrameSample& sample, const SceneNeeds& needs) {
  const std::size_t count = count_of(needs);
  const Work work = work_of(std::span(decision_.triangles).first(count), rung_, needs);
  const Limits limit = limits(work);
  const float predicted = predict(work);
  // What is still in the frame while a change waits or morphs.
  Work drawn = work;
  drawn.triangles = std::max(work.triangles, sample.drawn.triangles);
  drawn.vertices_deformed = std::max(work.vertices_deformed, sample.drawn.vertices_deformed);
  drawn.shaded_px /= approach_;  // As it is, not as it will be.
  const bool lagging = predict_now(drawn) > limit.hurry_us;
  if ((predicted <= limit.reduce_us && !lagging) || at_floor(needs)) return false;
  // One change a second unless something has happened: a moving camera, or a step, in whose wake a
  // frame beyond hope counts too. Else that is a refinement gone wrong, or noise.
  const bool stepped = evidence_s_ > 0.0f && since_late_s_ < 0.5f;
  const bool missing = predicted > limit.deadline_us && since_late_s_ < 0.5f;
  const bool eventful = approach_ > 1.01f || (since_step_s_ < kUnsettled_s && (stepped || missing));
  if (since_change_s_ < 1.0f && !eventful) return false;
  Needs storage;
  // A refinement on its way ends where it is.
  const auto decided = static_cast<float>(total(std::span(decision_.triangles).first(count)));
  const float reached = static_cast<float>(sample.drawn.triangles) / std::max(decided, 1.0f);
  const std::span<const ObjectNeed> capped = cap(needs, std::min(reached, 1.0f), 0.0f, storage);
  Plan plan = best_plan(rung_, limit.plan_us, needs, capped);
  const bool hurry = late_ || lagging;
  bulk_ = false;
  // In a hurry the next frame must fit although nearly all of today's triangles are still in it.
  while (hurry) {
    Work next = work_of(std::span(plan.triangles).first(count), plan.rung, needs);
    next.triangles =
        std::max(next.triangles, drawn.triangles - std::min(drawn.triangles, 2 * kRecordsMin));
    next.vertices_deformed = std::max(next.vertices_deformed, drawn.vertices_deformed);
    next.shaded_px /= approach_;
    next.records = kRecordsMin;
    const float next_us = predict_now(next);
    if (next_us <= (blind_ ? kBlindHurryShare : 1.0f) * limit.reduce_us) break;
    if (plan.rung + 1 == static_cast<int>(kRungs.size())) {
      bulk_ = next_us > limit.reduce_us;  // One long frame is better than many late ones.
      break;
    }
    plan = plan_at(plan.rung + 1, limit.plan_us, kComfort, needs, capped);
  }
  if (plan.rung == rung_ && plan.triangles == decision_.triangles) return false;
  note_reduction();
  adopt(plan, Change::reduce, hurry);
  return true;
}

// Clearly more triangles, or all that there are with time to spare.
bool BudgetController::worth_refining(const Plan& goal, float limit_us,
                                      const SceneNeeds& needs) const {
  const std::size_t count = count_of(needs);
  const std::uint32_t sum_now = total(std::span(decision_.triangles).first(count));
  if (static_cast<float>(goal.triangle_sum) >= kRefineGain * static_cast<float>(sum_now))
    return true;
  const Work work = work_of(std::span(goal.triangles).first(count), goal.rung, needs);
  return goal.triangle_sum > sum_now && predict(work) < 0.9f * limit_us;
}

bool BudgetController::moved_far(const Plan& goal, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    const auto now = static_cast<float>(decision_.triangles[i]);
    const auto then = static_cast<float>(goal.triangles[i]);
    if (std::abs(now - then) > std::max(kReshare * std::min(now, then), 100.0f)) return true;
  }
  return false;
}

bool BudgetController::refine(const SceneNeeds& needs) {
  if (since_change_s_ < wait_s_ || since_try_s_ < kTryEvery_s || thermal_ != ThermalLevel::normal ||
      late_)
    return false;
  if (blind_ && since_late_s_ < kBlindWait_s) return false;
  since_try_s_ = 0.0f;
  const std::size_t count = count_of(needs);
  const std::span<const std::uint32_t> now = std::span(decision_.triangles).first(count);
  const Limits limit = limits(work_of(now, rung_, needs));
  const float limit_us = kRefineTo * (blind_ ? kBlindShare : 1.0f) * limit.plan_us;
  Needs storage;
  const std::span<const ObjectNeed> capped = cap(needs, 1.0f, kRefineGrowth, storage);
  Change change = Change::refine;
  Plan plan;
  if (rung_ > 0)
    plan = plan_at(rung_ - 1, (blind_ ? kBlindRungShare : 1.0f) * limit_us, kComfortBetter, needs,
                   capped);
  // Pixels come at once, triangles go slowly: they must be gone before the better rung comes.
  if (plan.comfortable && predict(work_of(now, rung_ - 1, needs)) > limit.reduce_us) {
    plan.rung = rung_;
    change = Change::reshare;
  }
  if (!plan.comfortable) {
    const Plan goal = plan_at(rung_, limit_us, 0.0f, needs, needs.objects.first(count));
    if (!worth_refining(goal, limit_us, needs)) {
      if (!moved_far(goal, count)) return false;
      change = Change::reshare;
    }
    plan = plan_at(rung_, limit_us, 0.0f, needs, capped);
    if (plan.triangles == decision_.triangles) return false;
  }
  since_refine_s_ = 0.0f;
  adopt(plan, change, false);
  return true;
}

bool BudgetController::adjust_rate(const SceneNeeds& needs) {
  const Work work = work_of(std::span(decision_.triangles).first(count_of(needs)), rung_, needs);
  const float load = predict(work) / limits(work).deadline_us;
  int divisor = 1;
  bool saving = false;  // Chosen, not forced.
  if (thermal_ == ThermalLevel::critical) {
    const float frame_us = config_.vblank_us * static_cast<float>(config_.vblanks_per_frame);
    divisor = std::clamp(static_cast<int>(100000.0f / frame_us + 0.5f), 1, 32);
  } else if (at_floor(needs) && load > (decision_.frame_divisor > 1 ? 0.85f : 1.0f)) {
    divisor = std::clamp(static_cast<int>(std::ceil(load * 1.1f)), 2, 8);
  } else if (idle_s_ > 5.0f && thermal_ >= ThermalLevel::warm) {
    divisor = 2;
    saving = true;
  }
  const bool slower = divisor > decision_.frame_divisor;
  if (divisor == decision_.frame_divisor) return false;
  // Slower at once, and faster at once when somebody comes; but not to and fro when it was forced.
  if (!slower && !saving_ && since_change_s_ < wait_s_) return false;
  if (slower && !saving) note_reduction();
  if (!slower && !saving_) since_refine_s_ = 0.0f;
  saving_ = saving;
  decision_.change = slower ? Change::reduce : Change::refine;
  decision_.frame_divisor = static_cast<std::uint8_t>(divisor);
  decision_.cover_wait_ms = decision_.morph_ms = 0;
  since_change_s_ = 0.0f;
  return true;
}

// A reduction soon after a refinement says that the refinement was a mistake.
void BudgetController::note_reduction() {
  if (since_reduce_s_ > 1.0f && since_refine_s_ < kMistake_s)
    wait_s_ = std::min(2.0f * wait_s_, kWaitMax_s);
  since_reduce_s_ = 0.0f;
}

void BudgetController::adopt(const Plan& plan, Change change, bool at_once) {
  decision_.triangles = plan.triangles;
  if (rung_ != plan.rung) gpu_.expect_change();
  rung_ = plan.rung;
  decision_.render_scale = kRungs[static_cast<std::size_t>(rung_)].render_scale;
  decision_.shading = kRungs[static_cast<std::size_t>(rung_)].shading;
  decision_.change = change;
  decision_.cover_wait_ms = at_once ? 0 : change == Change::reduce ? 150 : 1500;
  decision_.morph_ms = at_once ? 0 : change == Change::reduce ? 200 : 350;
  since_change_s_ = 0.0f;
}

// How many records the coming frame may apply, from the time that it has left.
void BudgetController::pace(const FrameSample& sample, const SceneNeeds& needs) {
  const std::size_t count = count_of(needs);
  Work work = work_of(std::span(decision_.triangles).first(count), rung_, needs);
  const Limits limit = limits(work);
  decision_.predicted_us = predict(work);
  decision_.limit_us = limit.plan_us;
  work.triangles = std::max(work.triangles, sample.drawn.triangles);
  work.vertices_deformed = std::max(work.vertices_deformed, sample.drawn.vertices_deformed);
  const float drawn_us = predict_now(work);
  if (drawn_us > limit.hurry_us) decision_.cover_wait_ms = decision_.morph_ms = 0;
  const float record_us = std::max(cpu_.gain(2) * config_.prior.cpu_record_ns * 1e-3f, 0.02f);
  const float room = 0.8f * (limit.reduce_us - drawn_us) / record_us;
  decision_.max_records_per_frame =
      bulk_ ? kRecordsMax * 16
            : static_cast<std::uint32_t>(std::clamp(room, static_cast<float>(kRecordsMin),
                                                    static_cast<float>(kRecordsMax)));
  if (sample.drawn.triangles <= total(std::span(decision_.triangles).first(count))) bulk_ = false;
}

}  // namespace caryatid::lod
