#include "core/stream/fba_plan.h"

#include <algorithm>
#include <cmath>

#include "core/face/fap_fill.h"

namespace caryatid::stream {
namespace {

constexpr float kFapu = 1.0f / 1024.0f;
constexpr float kMilliRadOfAu = 1e-5f;
constexpr float kEyeLever_mm = 12.0f, kTongueLever_mm = 10.0f, kHeadLever_mm = 120.0f;
constexpr int kTongueRoll = 47;

std::int32_t whole(float value) { return static_cast<std::int32_t>(std::lround(value)); }

bool is_intra(const FbaClip& clip, std::size_t frame) {
  return frame == 0 || (clip.intra_every > 0 && frame % clip.intra_every == 0);
}

// Highest and lowest levels of one slot over the clip, as the encoder will choose them when its
// ranges are wide enough.
struct Extremes {
  std::int32_t intra_high = 0, intra_low = 0, inter_high = 0, inter_low = 0;
  // The same for intra planes at any frame, and whether a jump will ask for one.
  std::int32_t any_high = 0, any_low = 0;
  bool overflows = false;
};

template <class Frame>
Extremes extremes_of(const FbaClip& clip, std::span<const Frame> frames, int number,
                     std::size_t slot, int step, const FbaSettings& settings, int divisor) {
  Extremes e;
  std::int32_t value = 0;
  const std::int32_t reach = kMaxRangeCode * kRangeStep / divisor;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::int32_t target = frames[i].has(number) ? whole(frames[i].get(number)) : value;
    const std::int32_t intra = choose_level(settings, slot, target, step, 0.5f);
    e.any_high = std::max(e.any_high, intra);
    e.any_low = std::min(e.any_low, intra);
    if (is_intra(clip, i)) {
      e.intra_high = std::max(e.intra_high, intra);
      e.intra_low = std::min(e.intra_low, intra);
      value = value_of(intra, step);
      continue;
    }
    const std::int32_t level =
        choose_level(settings, slot, target - value, step, settings.dead_zone);
    e.inter_high = std::max(e.inter_high, level);
    e.inter_low = std::min(e.inter_low, level);
    e.overflows = e.overflows || level > reach || level < -reach;
    value += value_of(level, step);
  }
  return e;
}

RangeCodes codes_of(const Extremes& extremes, int divisor, bool intra_anywhere) {
  const auto code = [divisor](std::int32_t level) {
    const std::int32_t steps = level < 0 ? -level : level;
    return static_cast<std::uint8_t>(
        std::min((steps * divisor + kRangeStep - 1) / kRangeStep, kMaxRangeCode));
  };
  RangeCodes codes{code(intra_anywhere ? extremes.any_high : extremes.intra_high),
                   code(intra_anywhere ? extremes.any_low : extremes.intra_low),
                   code(extremes.inter_high), code(extremes.inter_low)};
  // Zeros in both intra ranges would mean "never set" to deployed decoders.
  codes.intra_high = std::max<std::uint8_t>(codes.intra_high, 1);
  return codes;
}

FbaCoding coding_of(const FbaSettings& settings) {
  FbaCoding coding;
  coding.fap_quant = settings.fap_quant;
  coding.bap_quant_index = settings.bap_quant_index;
  return coding;
}

// Whether every frame comes back within the tolerance when only the FAPs of `sent` are sent.
bool restores(const FbaClip& clip, const BitSet<face::kFapCount + 1>& clip_mask,
              const BitSet<face::kFapCount + 1>& sent, float tolerance_mm) {
  face::FapFrame all;
  for (const face::FapFrame& frame : clip.face) {
    face::FapFrame got;
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const auto n = static_cast<std::size_t>(fap);
      if (frame.mask.test(n)) all.value[n] = frame.value[n];
      if (sent.test(n)) got.set(fap, all.value[n]);
    }
    face::fill_from_partners(&got, clip.fit);
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const auto n = static_cast<std::size_t>(fap);
      if (!clip_mask.test(n) || sent.test(n)) continue;
      const float error = got.get(fap) - all.value[n];
      if (std::abs(error) * fap_unit_mm(fap) > tolerance_mm) return false;
    }
  }
  return true;
}

}  // namespace

float fap_unit_mm(int fap) {
  switch (face::fap_info(fap).unit) {
    case face::FapUnit::mns:
      return 20.0f * kFapu;
    case face::FapUnit::mw:
      return 50.0f * kFapu;
    case face::FapUnit::ens:
      return 49.0f * kFapu;
    case face::FapUnit::es:
      return 62.0f * kFapu;
    case face::FapUnit::irisd:
      return 11.7f * kFapu;
    case face::FapUnit::au:
      break;
    case face::FapUnit::none:
      return 0.0f;
  }
  if (fap == kTongueRoll) return kTongueLever_mm * kMilliRadOfAu;
  return (fap < kTongueRoll ? kEyeLever_mm : kHeadLever_mm) * kMilliRadOfAu;
}

void set_masks(const FbaClip& clip, FbaSettings* io_settings) {
  io_settings->fap_mask.clear();
  io_settings->bap_mask.clear();
  for (const face::FapFrame& frame : clip.face)
    for (std::size_t fap = 1; fap <= face::kFapCount; ++fap)
      if (frame.mask.test(fap)) io_settings->fap_mask.set(fap);
  for (const body::BapFrame& frame : clip.body)
    for (std::size_t bap = 1; bap <= body::kBapCountExtended; ++bap)
      if (frame.mask.test(bap)) io_settings->bap_mask.set(bap);
}

void leave_out_restorable(const FbaClip& clip, float tolerance_mm, FbaSettings* io_settings) {
  const BitSet<face::kFapCount + 1> all = io_settings->fap_mask;
  for (int fap = face::kFapCount; fap >= 3; --fap) {
    const auto n = static_cast<std::size_t>(fap);
    if (!io_settings->fap_mask.test(n)) continue;
    io_settings->fap_mask.set(n, false);
    if (restores(clip, all, io_settings->fap_mask, tolerance_mm)) {
      io_settings->unlisted[face::fap_info(fap).group] = FapMaskType::interpolate;
    } else {
      io_settings->fap_mask.set(n);
    }
  }
}

void set_ranges(const FbaClip& clip, FbaSettings* io_settings) {
  const FbaCoding coding = coding_of(*io_settings);
  const FbaSettings& settings = *io_settings;
  // A jump of one parameter makes a whole plane intra: the others must be ready for it.
  bool intra_anywhere = false;
  for (const bool last_pass : {false, true}) {
    for (std::size_t slot = kFieldSlots; slot < kFbaSlots; ++slot) {
      const bool body = slot >= kBapSlotBase;
      const int number = static_cast<int>(body ? slot - kBapSlotBase + 1 : slot - kFieldSlots + 3);
      const auto n = static_cast<std::size_t>(number);
      if (last_pass) io_settings->range[slot] = {1, 0, 0, 0};
      if (!(body ? settings.bap_mask.test(n) : settings.fap_mask.test(n))) continue;
      const int step = step_of(coding, slot, settings.quantisers);
      const int divisor = range_divisor(coding, body);
      const Extremes extremes =
          body ? extremes_of(clip, clip.body, number, slot, step, settings, divisor)
               : extremes_of(clip, clip.face, number, slot, step, settings, divisor);
      intra_anywhere = intra_anywhere || extremes.overflows;
      if (last_pass) io_settings->range[slot] = codes_of(extremes, divisor, intra_anywhere);
    }
  }
}

Result<std::size_t> measure_bits(const FbaClip& clip, const FbaSettings& settings,
                                 std::span<ModelNode> nodes) {
  BitWriter writer;
  FbaEncoder encoder(settings, nodes);
  // A writer without bytes counts; that it is full is no news.
  const auto bad = [](Status status) {
    return !status.ok() && status.detail != static_cast<std::uint16_t>(FbaFault::output_full);
  };
  if (const Status status = encoder.begin(&writer); bad(status)) return {status, 0};
  for (std::size_t i = 0; i < clip.size(); ++i) {
    FbaPlaneInput plane;
    if (i < clip.face.size()) plane.face = &clip.face[i];
    if (i < clip.body.size()) plane.body = &clip.body[i];
    plane.intra = is_intra(clip, i);
    if (const Status status = encoder.encode(plane, &writer); bad(status)) return {status, 0};
  }
  static_cast<void>(encoder.finish(&writer));
  return {{}, writer.position()};
}

namespace {

constexpr int kStepCount = 28;
constexpr float kFinestStep_mm = 0.02f, kStepRatio = 1.25f;  // 0.02 * 1.25^27 = 8.3 mm
constexpr std::uint8_t kQuantisers[] = {1, 2, 3, 4, 5, 6, 8, 10, 13, 16, 20, 25, 31};

// The cheapest settings whose steps are about step_mm: 0 bits when nothing could be encoded.
Status plan_step(const FbaClip& clip, float step_mm, std::span<ModelNode> nodes,
                 FbaSettings* io_settings, std::size_t* out_bits) {
  FbaSettings base = *io_settings;
  set_masks(clip, &base);
  leave_out_restorable(clip, step_mm * 0.5f, &base);
  *out_bits = 0;
  Status last{Code::out_of_capacity, static_cast<std::uint16_t>(FbaFault::model_pool_full)};
  for (const std::uint8_t quant : kQuantisers) {
    FbaSettings tried = base;
    tried.fap_quant = quant;
    bool too_coarse = false;
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      if (!tried.fap_mask.test(static_cast<std::size_t>(fap))) continue;
      const float one = fap_unit_mm(fap) * static_cast<float>(face::fap_info(fap).quantiser) *
                        static_cast<float>(quant);
      too_coarse = too_coarse || one > 1.25f * step_mm;
      tried.coarseness[fap_slot(fap)] =
          static_cast<std::uint8_t>(std::clamp(std::lround(step_mm / one), 1L, 255L));
    }
    if (too_coarse && *out_bits > 0) break;
    set_ranges(clip, &tried);
    const Result<std::size_t> bits = measure_bits(clip, tried, nodes);
    if (!bits.ok()) {
      last = bits.status;
      continue;
    }
    if (*out_bits == 0 || bits.value < *out_bits) {
      *out_bits = bits.value;
      *io_settings = tried;
    }
  }
  return *out_bits > 0 ? Status{} : last;
}

}  // namespace

Status plan_rate(const FbaClip& clip, double kbit_per_s, std::span<ModelNode> nodes,
                 FbaSettings* io_settings, RatePlan* out_plan) {
  const double seconds = static_cast<double>(clip.size()) / io_settings->rate.hertz();
  const FbaSettings base = *io_settings;
  int low = 0, high = kStepCount - 1;
  while (true) {
    const int middle = (low + high) / 2;
    const float step_mm = kFinestStep_mm * std::pow(kStepRatio, static_cast<float>(middle));
    FbaSettings tried = base;
    std::size_t bits = 0;
    CARYATID_TRY(plan_step(clip, step_mm, nodes, &tried, &bits));
    const double rate = static_cast<double>(bits) / 1000.0 / seconds;
    const bool fits = rate <= kbit_per_s;
    if (fits || low == high) {
      *io_settings = tried;
      *out_plan = {rate, step_mm};
    }
    if (low == high)
      return fits ? Status{}
                  : Status{Code::out_of_capacity,
                           static_cast<std::uint16_t>(FbaFault::rate_too_low)};
    if (fits)
      high = middle;
    else
      low = middle + 1;
  }
}

}  // namespace caryatid::stream
