#include "assets/bake/stream/talking_track.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/face/visemes.h"

namespace caryatid::bake {
namespace {

// Speech runs at 11-13 phonemes a second (Levelt 1989: 10-15); phrases are parted by pauses.
constexpr double kPhone_s = 0.085, kPhoneSpread_s = 0.05;
constexpr double kPhrase_s = 2.2, kPhraseSpread_s = 1.8, kPause_s = 0.45;
constexpr double kBlinkEvery_s = 3.0, kBlinkSpread_s = 2.5;  // 15-25 a minute while talking.
constexpr double kBlinkDown_s = 0.09, kBlinkUp_s = 0.16;
constexpr double kStep_s = 0.005;

// Rough frequencies of the 15 visemes in running English, per cent.
constexpr int kShare[face::kVisemeCount] = {0, 7, 4, 4, 13, 5, 2, 8, 11, 6, 9, 10, 12, 5, 4};

// A value that follows its target like a critically damped spring.
struct Follower {
  double value = 0.0, speed = 0.0;
  void follow(double target, double time_s) {
    const double rate = 4.7 / time_s;  // 95 % of a step after time_s.
    speed += (rate * rate * (target - value) - 2.0 * rate * speed) * kStep_s;
    value += speed * kStep_s;
  }
};

class Talker {
 public:
  explicit Talker(std::uint64_t seed) : random_(seed) {}

  void step() {
    speak();
    accent();
    blink();
    look();
    now_s_ += kStep_s;
  }

  face::FapFrame frame() const {
    face::FapFrame out;
    for (int fap = 3; fap <= face::kFapCount; ++fap)
      if (mouth_present_.test(static_cast<std::size_t>(fap)))
        out.set(fap, rounded(mouth_[static_cast<std::size_t>(fap)].value));
    const double brow = brow_.value;
    for (const int fap : {31, 32}) out.set(fap, rounded(0.8 * brow + worry_.value));
    for (const int fap : {33, 34}) out.set(fap, rounded(brow + 0.5 * worry_.value));
    for (const int fap : {35, 36}) out.set(fap, rounded(0.9 * brow));
    for (const int fap : {37, 38}) out.set(fap, rounded(0.7 * worry_.value));
    const double down = lid_ * 1000.0 + std::max(0.0, pitch_eye_.value) * 0.01;
    for (const int fap : {19, 20}) out.set(fap, rounded(down - 0.25 * brow));
    for (const int fap : {21, 22}) out.set(fap, rounded(lid_ * 120.0));
    for (const int fap : {23, 24}) out.set(fap, rounded(yaw_eye_.value));
    for (const int fap : {25, 26}) out.set(fap, rounded(pitch_eye_.value));
    out.set(48, rounded(head_[0].value));
    out.set(49, rounded(head_[1].value));
    out.set(50, rounded(head_[2].value));
    return out;
  }

 private:
  static float rounded(double value) { return static_cast<float>(std::lround(value)); }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.unit());
  }
  int draw_viseme() {
    int at = static_cast<int>(random_.next() % 100);
    for (int v = 0; v < face::kVisemeCount; ++v)
      if ((at -= kShare[v]) < 0) return v;
    return 4;
  }

  // The next sound when the present one is over; the mouth runs after it.
  void speak() {
    if (now_s_ >= next_phone_s_) {
      if (now_s_ >= phrase_end_s_ + kPause_s) {
        phrase_end_s_ = now_s_ + kPhrase_s + between(0, kPhraseSpread_s);
        loudness_ = between(0.7, 1.15);
      }
      const bool pause = now_s_ >= phrase_end_s_;
      target_ = face::viseme_frame(pause ? 0 : draw_viseme());
      next_phone_s_ = now_s_ + kPhone_s + between(-0.5, 1.0) * kPhoneSpread_s;
    }
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const auto n = static_cast<std::size_t>(fap);
      if (!target_.mask.test(n)) continue;
      mouth_present_.set(n);
      mouth_[n].follow(loudness_ * static_cast<double>(target_.get(fap)), fap == 3 ? 0.14 : 0.11);
    }
  }

  // Brows and head mark words: some a second, larger at the beginning of a phrase.
  void accent() {
    if (now_s_ >= next_accent_s_) {
      const bool talking = now_s_ < phrase_end_s_;
      next_accent_s_ = now_s_ + between(0.35, 1.4);
      brow_target_ = talking && random_.unit() < 0.45f ? between(60, 260) : 0.0;
      worry_target_ = random_.unit() < 0.2f ? between(20, 90) : 0.0;
      head_target_[0] = talking ? between(-4000, 7000) : between(-1500, 1500);
      head_target_[1] = between(-9000, 9000);
      head_target_[2] = between(-3500, 3500);
    }
    brow_.follow(brow_target_, 0.3);
    worry_.follow(worry_target_, 0.5);
    for (int i = 0; i < 3; ++i) head_[i].follow(head_target_[i], i == 0 ? 0.45 : 0.8);
  }

  void blink() {
    if (now_s_ >= next_blink_s_) {
      blink_s_ = now_s_;
      next_blink_s_ = now_s_ + kBlinkEvery_s + between(-1, 1) * kBlinkSpread_s;
    }
    const double t = now_s_ - blink_s_;
    lid_ = t < kBlinkDown_s ? t / kBlinkDown_s : std::max(0.0, 1 - (t - kBlinkDown_s) / kBlinkUp_s);
  }

  // Saccades: 30-60 ms, seldom more than 10 degrees while talking to somebody.
  void look() {
    if (now_s_ >= next_look_s_) {
      const bool away = random_.unit() < 0.35f;
      yaw_target_ = away ? between(-16000, 16000) : between(-2500, 2500);
      pitch_target_ = away ? between(-6000, 9000) : between(-1500, 1500);
      next_look_s_ = now_s_ + between(0.4, 2.2);
    }
    yaw_eye_.follow(yaw_target_, 0.05);
    pitch_eye_.follow(pitch_target_, 0.05);
  }

  Random random_;
  double now_s_ = 0.0;
  double next_phone_s_ = 0.0, phrase_end_s_ = 1.0, next_accent_s_ = 0.0, next_blink_s_ = 1.3;
  double blink_s_ = -10.0, next_look_s_ = 0.0;
  double loudness_ = 1.0, brow_target_ = 0.0, worry_target_ = 0.0, yaw_target_ = 0.0;
  double pitch_target_ = 0.0, lid_ = 0.0;
  double head_target_[3] = {0, 0, 0};
  face::FapFrame target_;
  BitSet<face::kFapCount + 1> mouth_present_;
  std::array<Follower, face::kFapCount + 1> mouth_;
  Follower brow_, worry_, yaw_eye_, pitch_eye_, head_[3];
};

}  // namespace

std::vector<face::FapFrame> make_talking_track(double seconds, double frames_per_second,
                                               std::uint64_t seed) {
  Talker talker(seed);
  std::vector<face::FapFrame> frames;
  const auto count = static_cast<std::size_t>(std::lround(seconds * frames_per_second));
  double time_s = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted_s = static_cast<double>(i + 1) / frames_per_second;
    for (; time_s < wanted_s; time_s += kStep_s) talker.step();
    frames.push_back(talker.frame());
  }
  return frames;
}

}  // namespace caryatid::bake
