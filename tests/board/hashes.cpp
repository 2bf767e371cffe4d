// caryatid-hashes: a minute of the agent's life, its face and its pose, as hashes of their bits.
// A replay is worth its name only if every machine prints the same lines: cross/board.sh unit
// compares the boards' with the PC's. Exit code 1 when a second run differs from the first.
#include <array>
#include <cassert>
#include <cinttypes>
#include <cstdio>
#include <span>

#include "core/agent/agent.h"
#include "core/base/crc.h"
#include "core/base/trig.h"
#include "core/body/pose.h"
#include "core/emotion/profiles.h"
#include "core/face/mixer.h"

namespace {

using namespace caryatid;

constexpr float kFrame_s = 1.0f / 30.0f;
constexpr int kFrames = 1800;
constexpr int kPressEvery = 70;  // Frames: through onset, apex and into offset.

struct Hashes {
  std::uint64_t trig = kHashSeed, face = kHashSeed, body = kHashSeed, pose = kHashSeed;
  friend bool operator==(const Hashes&, const Hashes&) = default;
};

std::uint64_t hash_of_trig() {
  std::uint64_t hash = kHashSeed;
  for (int i = -20'000; i <= 20'000; ++i) {
    const float x = static_cast<float>(i) * 0.001f;
    const std::array<float, 2> values = {sin_of(x), cos_of(x)};
    hash = hash_of(std::span<const float>(values), hash);
  }
  return hash;
}

Hashes live_a_minute() {
  face::FapLimits limits;
  limits.low.fill(-2000.0f);
  limits.high.fill(2000.0f);
  const body::Skeleton skeleton = body::upright_skeleton();
  agent::Agent agent(2026);
  std::array<Affine, body::kHanimJointCount> pose;
  Hashes hashes;
  hashes.trig = hash_of_trig();
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame % kPressEvery == 20) {
      agent.press();
      agent.feel(static_cast<emotion::Emotion>(frame / kPressEvery %
                                               static_cast<int>(emotion::kEmotionCount)));
    }
    const agent::Intentions& will = agent.step(kFrame_s);
    const face::FapFrame felt = emotion::expression(will.emotions);
    face::MixJob mix;
    mix.emotion = &felt;
    mix.idle = &will.idle_face;
    mix.limits = &limits;
    const face::FapFrame shown = mix.run();
    body::PoseJob job;
    job.skeleton = &skeleton;
    job.baps = &will.body;
    job.out = pose;
    [[maybe_unused]] const Status posed = job.run();
    assert(posed.ok());
    hashes.face = hash_of(std::span<const float>(shown.value), hashes.face);
    hashes.body = hash_of(std::span<const float>(will.body.value), hashes.body);
    hashes.pose = hash_bytes(std::as_bytes(std::span(pose)), hashes.pose);
  }
  return hashes;
}

}  // namespace

int main() {
  const Hashes first = live_a_minute();
  std::printf("trig %016" PRIx64 "\nface %016" PRIx64 "\nbody %016" PRIx64 "\npose %016" PRIx64
              "\n",
              first.trig, first.face, first.body, first.pose);
  return live_a_minute() == first ? 0 : 1;
}
