// Encoder and decoder against each other, and against damage, on clips of our own.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/face/fap_fill.h"
#include "core/stream/fba_decoder.h"
#include "core/stream/fba_encoder.h"
#include "core/stream/fba_plan.h"

namespace caryatid::stream {
namespace {

using Bytes = std::vector<std::byte>;

// A face that moves smoothly in all FAPs, values divisible by every base step.
std::vector<face::FapFrame> waves(std::size_t count) {
  std::vector<face::FapFrame> frames(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int fap = 3; fap <= face::kFapCount; ++fap) {
      const auto t = static_cast<double>(i) * 0.1 + fap;
      const int step = face::fap_info(fap).quantiser;
      frames[i].set(fap, static_cast<float>(step * std::lround(40.0 * std::sin(t))));
    }
  return frames;
}

std::vector<body::BapFrame> steps(std::size_t count, int last) {
  std::vector<body::BapFrame> frames(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int bap = 1; bap <= last; ++bap) {
      const int step = body::bap_info(bap).quantiser_visage;
      frames[i].set(bap, static_cast<float>(step * ((static_cast<int>(i) * bap) % 30 - 15)));
    }
  return frames;
}

Bytes encode(const FbaClip& clip, const FbaSettings& settings) {
  std::vector<ModelNode> nodes(1 << 18);
  FbaEncoder encoder(settings, nodes);
  Bytes bytes(1 << 20);
  BitWriter writer(bytes);
  EXPECT_TRUE(encoder.begin(&writer).ok());
  for (std::size_t i = 0; i < clip.size(); ++i) {
    FbaPlaneInput plane;
    if (i < clip.face.size()) plane.face = &clip.face[i];
    if (i < clip.body.size()) plane.body = &clip.body[i];
    plane.intra = clip.intra_every > 0 && i % clip.intra_every == 0;
    EXPECT_TRUE(encoder.encode(plane, &writer).ok()) << i;
  }
  EXPECT_TRUE(encoder.finish(&writer).ok());
  bytes.resize(writer.size_bytes());
  return bytes;
}

struct Decoded {
  std::vector<FbaPlane> planes;
  std::vector<face::FapFrame> faces;
  std::vector<body::BapFrame> bodies;
  std::vector<double> times_s;
  std::vector<FbaFault> faults;  // The last one is why it ended.
};

Decoded decode(const Bytes& bytes, std::size_t node_count = 1 << 18) {
  std::vector<ModelNode> nodes(node_count);
  FbaDecoder decoder(nodes, {});
  decoder.refill(bytes, true);
  Decoded out;
  FbaPlane plane;
  face::FapFrame face;
  body::BapFrame body;
  while (true) {
    const Status status = decoder.next(&plane, &face, &body);
    if (status.ok()) {
      out.planes.push_back(plane);
      out.faces.push_back(face);
      out.bodies.push_back(body);
      out.times_s.push_back(decoder.time_s());
      continue;
    }
    out.faults.push_back(static_cast<FbaFault>(status.detail));
    if (status.code == Code::not_ready) return out;
    if (out.faults.size() > 100000) return out;
  }
}

FbaSettings settings_for(const FbaClip& clip) {
  FbaSettings settings;
  set_masks(clip, &settings);
  set_ranges(clip, &settings);
  return settings;
}

TEST(Fba, FaceComesBackExactlyWithQuantiserOne) {
  const auto frames = waves(80);
  const FbaClip clip{frames, {}, 25};
  const Decoded got = decode(encode(clip, settings_for(clip)));
  ASSERT_EQ(got.faces.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(got.faces[i].value, frames[i].value) << i;
  EXPECT_EQ(got.faults, std::vector{FbaFault::end_of_stream});
}

TEST(Fba, BodyWithExtensionsComesBackExactly) {
  const auto frames = steps(40, body::kBapCountExtended);
  const FbaClip clip{{}, frames, 0};
  const Decoded got = decode(encode(clip, settings_for(clip)));
  ASSERT_EQ(got.bodies.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(got.bodies[i].value, frames[i].value) << i;
}

TEST(Fba, FaceAndBodyShareAPlane) {
  const auto faces = waves(20);
  const auto bodies = steps(20, 47);
  const FbaClip clip{faces, bodies, 10};
  const Decoded got = decode(encode(clip, settings_for(clip)));
  ASSERT_EQ(got.planes.size(), 20u);
  EXPECT_TRUE(got.planes[10].intra && got.planes[10].face && got.planes[10].body);
  EXPECT_EQ(got.faces[13].value, faces[13].value);
  EXPECT_EQ(got.bodies[13].value, bodies[13].value);
}

// Whatever the quantiser, a reconstructed value is within half a step (rounded up).
TEST(Fba, ErrorStaysWithinHalfAStep) {
  const auto frames = waves(60);
  const FbaClip clip{frames, {}, 20};
  for (const int quant : {0, 2, 5, 31}) {
    FbaSettings settings = settings_for(clip);
    settings.fap_quant = static_cast<std::uint8_t>(quant);
    set_ranges(clip, &settings);
    const Decoded got = decode(encode(clip, settings));
    ASSERT_EQ(got.faces.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
      for (int fap = 3; fap <= face::kFapCount; ++fap) {
        // Quantiser 0 codes values as they are; the largest ranges cut what is beyond them.
        const int step = face::fap_info(fap).quantiser * quant;
        if (quant == 0 && face::fap_info(fap).quantiser > 4) continue;
        EXPECT_LE(std::abs(got.faces[i].get(fap) - frames[i].get(fap)),
                  static_cast<float>((step + 1) / 2))
            << fap << " quant " << quant;
      }
  }
}

TEST(Fba, VisemeAndExpressionFields) {
  std::vector<face::FapFrame> frames(30);
  Random random(3);
  for (face::FapFrame& frame : frames) {
    frame.mask.set(face::kFapViseme);
    frame.mask.set(face::kFapExpression);
    const auto draw = [&](std::uint32_t n) { return static_cast<std::uint8_t>(random.next() % n); };
    frame.viseme = {draw(15), draw(15), draw(64), draw(2) == 1};
    frame.expression = {draw(7), draw(64), draw(7), draw(64), draw(2) == 1, draw(2) == 1};
  }
  const FbaClip clip{frames, {}, 7};
  const Decoded got = decode(encode(clip, settings_for(clip)));
  ASSERT_EQ(got.faces.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(got.faces[i].viseme, frames[i].viseme) << i;
    EXPECT_EQ(got.faces[i].expression, frames[i].expression) << i;
  }
}

TEST(Fba, TimesFollowRateSkipAndTimeCode) {
  const auto frames = waves(3);
  FbaSettings settings = settings_for({frames, {}, 0});
  settings.rate = {12, 8, false};  // 12.5 Hz
  std::vector<ModelNode> nodes(4096);
  FbaEncoder encoder(settings, nodes);
  Bytes bytes(1 << 16);
  BitWriter writer(bytes);
  ASSERT_TRUE(encoder.begin(&writer).ok());
  for (const std::uint32_t skip : {31u, 0u, 0u}) {
    FbaPlaneInput plane;
    plane.face = &frames[0];
    plane.skip = skip;
    ASSERT_TRUE(encoder.encode(plane, &writer).ok());
  }
  FbaPlaneInput late;
  late.face = &frames[1];
  late.intra = true;
  late.has_time_code = true;
  late.time_code = {1, 2, 3};
  ASSERT_TRUE(encoder.encode(late, &writer).ok());
  late.intra = false;
  ASSERT_TRUE(encoder.encode(late, &writer).ok());
  ASSERT_TRUE(encoder.finish(&writer).ok());
  bytes.resize(writer.size_bytes());
  const Decoded got = decode(bytes);
  ASSERT_EQ(got.times_s.size(), 5u);
  const double expected[] = {0.0, 32 * 0.08, 33 * 0.08, 3723.0, 3723.08};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(got.times_s[i], expected[i], 1e-9) << i;
}

TEST(Fba, RateOf1000Over1001) { EXPECT_NEAR((FbaRate{30, 0, true}.hertz()), 29.97003, 1e-5); }

// A plane of 7 bits before an end code must not be taken for stuffing, by us or by others.
TEST(Fba, EmptyPlaneBeforeTheEndIsNotLost) {
  face::FapFrame empty;
  FbaSettings settings;
  std::vector<ModelNode> nodes(16);
  for (int planes = 1; planes <= 9; ++planes) {
    FbaEncoder encoder(settings, nodes);
    Bytes bytes(4096);
    BitWriter writer(bytes);
    ASSERT_TRUE(encoder.begin(&writer).ok());
    for (int i = 0; i < planes; ++i) {
      FbaPlaneInput plane;
      plane.face = &empty;
      ASSERT_TRUE(encoder.encode(plane, &writer).ok());
    }
    ASSERT_TRUE(encoder.finish(&writer).ok());
    bytes.resize(writer.size_bytes());
    const Decoded got = decode(bytes);
    EXPECT_EQ(std::count_if(got.planes.begin(), got.planes.end(),
                            [](const FbaPlane& p) { return p.face; }),
              planes);
    EXPECT_EQ(got.faults, std::vector{FbaFault::end_of_stream});
  }
}

TEST(Fba, RangesThatAreTooSmallClampAndCatchUp) {
  std::vector<face::FapFrame> frames(10);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].set(3, i == 0 ? 0.0f : 1000.0f);
  FbaSettings settings = settings_for({frames, {}, 0});
  settings.range[fap_slot(3)] = {1, 1, 1, 1};  // 60 levels of 4 units a plane
  const Decoded got = decode(encode({frames, {}, 0}, settings));
  ASSERT_EQ(got.faces.size(), 10u);
  EXPECT_EQ(got.faces[1].get(3), 240.0f);
  EXPECT_EQ(got.faces[9].get(3), 1000.0f);
}

TEST(Fba, BadSettingsAreRefused) {
  std::vector<ModelNode> nodes(16);
  BitWriter writer;
  const auto begin = [&](const FbaSettings& settings) {
    return FbaEncoder(settings, nodes).begin(&writer).code;
  };
  FbaSettings settings;
  settings.fap_quant = 32;
  EXPECT_EQ(begin(settings), Code::invalid_argument);
  settings = {};
  settings.range[fap_slot(9)].inter_low = 32;
  EXPECT_EQ(begin(settings), Code::invalid_argument);
  settings = {};
  settings.range[fap_slot(4)] = {0, 0, 1, 1};
  EXPECT_EQ(begin(settings), Code::invalid_argument);
  settings = {};
  settings.rate = {0, 0, false};
  EXPECT_EQ(begin(settings), Code::invalid_argument);
}

TEST(Fba, FullOutputAndFullPoolAreSaid) {
  const auto frames = waves(30);
  const FbaSettings settings = settings_for({frames, {}, 0});
  std::vector<ModelNode> nodes(20);
  std::byte few[200];
  BitWriter writer(few);
  FbaEncoder encoder(settings, nodes);
  ASSERT_TRUE(encoder.begin(&writer).ok());
  FbaPlaneInput plane;
  plane.face = &frames[0];
  EXPECT_EQ(encoder.encode(plane, &writer).detail,
            static_cast<std::uint16_t>(FbaFault::output_full));
  EXPECT_EQ(encoder.encode(plane, &writer).detail,
            static_cast<std::uint16_t>(FbaFault::model_pool_full));
  const Decoded got = decode(encode({frames, {}, 0}, settings), 200);
  EXPECT_EQ(got.faults.front(), FbaFault::model_pool_full);
}

TEST(Fba, DctIsRefusedByName) {
  const auto frames = waves(2);
  const FbaClip clip{frames, {}, 0};
  Bytes bytes = encode(clip, settings_for(clip));
  // Head: start code 32, intra 1, objects 2, rate 1+13, time code 1, skip 1, quantiser 5; groups 1
  // (type 0) and 2..10 (type 3) 3 bits each; gender 1; then the coding type.
  const std::size_t bit = 32 + 1 + 2 + 14 + 1 + 1 + 5 + 30 + 1;
  bytes[bit / 8] |= static_cast<std::byte>(0x80 >> bit % 8);
  const Decoded got = decode(bytes);
  EXPECT_EQ(got.faults.front(), FbaFault::dct_coding);
  EXPECT_TRUE(got.planes.empty());
}

TEST(Fba, NoObjectStart) {
  const Decoded got = decode(Bytes(100, std::byte{0x55}));
  EXPECT_EQ(got.faults.front(), FbaFault::no_object_start);
}

TEST(Fba, HeadersOfASequenceBeforeTheObjectAreSkipped) {
  const auto frames = waves(4);
  const FbaClip clip{frames, {}, 0};
  Bytes bytes = encode(clip, settings_for(clip));
  const std::byte head[] = {std::byte{0},    std::byte{0},   std::byte{1}, std::byte{0xB0},
                            std::byte{1},    std::byte{0},   std::byte{0}, std::byte{1},
                            std::byte{0xB5}, std::byte{0x0C}};
  bytes.insert(bytes.begin(), std::begin(head), std::end(head));
  EXPECT_EQ(decode(bytes).faces.size(), 4u);
}

// Planes lost to damage: everything from the next intra plane on is right again.
std::size_t right_at_the_end(const Decoded& got, const std::vector<face::FapFrame>& frames) {
  std::size_t right = 0;
  while (right < got.faces.size() && right < frames.size() &&
         got.faces[got.faces.size() - 1 - right].value == frames[frames.size() - 1 - right].value)
    ++right;
  return right;
}

TEST(Fba, JoinsAStreamInTheMiddle) {
  const auto frames = waves(100);
  for (const bool start_codes : {true, false}) {
    const FbaClip clip{frames, {}, 20};
    FbaSettings settings = settings_for(clip);
    settings.plane_start_codes = start_codes;
    const Bytes whole = encode(clip, settings);
    Bytes cut(whole.begin(), whole.begin() + 4);
    cut.insert(cut.end(), whole.begin() + static_cast<long>(whole.size() / 3), whole.end());
    const Decoded got = decode(cut);
    EXPECT_GE(right_at_the_end(got, frames), 40u) << start_codes;
  }
}

TEST(Fba, BytesOfNoiseHoldTheFaceUntilTheNextIntraPlane) {
  const auto frames = waves(100);
  const FbaClip clip{frames, {}, 10};
  const Bytes whole = encode(clip, settings_for(clip));
  Random random(5);
  std::size_t worst = frames.size();
  for (int trial = 0; trial < 200; ++trial) {
    Bytes bad = whole;
    const std::size_t at = 40 + random.next() % (bad.size() / 2);
    for (std::size_t i = at; i < at + 8; ++i) bad[i] = static_cast<std::byte>(random.next());
    worst = std::min(worst, right_at_the_end(decode(bad), frames));
  }
  // The damage is in the first half; an undetected wrong plane lasts until the next intra plane.
  EXPECT_GE(worst, 30u);
}

TEST(Fba, CutAnywhereEndsCleanly) {
  const auto frames = waves(6);
  const FbaClip clip{frames, {}, 3};
  const Bytes whole = encode(clip, settings_for(clip));
  for (std::size_t size = 4; size < whole.size(); ++size) {
    const Decoded got = decode(Bytes(whole.begin(), whole.begin() + static_cast<long>(size)));
    // The last plane may have been decoded from what the cut left of it; no other.
    for (std::size_t i = 0; i + 1 < got.faces.size() && i < frames.size(); ++i) {
      EXPECT_EQ(got.faces[i].value, frames[i].value) << size;
    }
  }
}

TEST(FbaPlan, LeavesOutWhatIsRestored) {
  std::vector<face::FapFrame> frames(20);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].set(5, static_cast<float>(i) * -10.0f);
    frames[i].set(31, static_cast<float>(i) * 3.0f);
    frames[i].set(40, 0.0f);
    face::fill_from_partners(&frames[i]);
    frames[i].set(32, static_cast<float>(i));  // Unlike its partner: must be sent.
  }
  const FbaClip clip{frames, {}, 0};
  FbaSettings settings;
  set_masks(clip, &settings);
  leave_out_restorable(clip, 0.1f, &settings);
  EXPECT_TRUE(settings.fap_mask.test(5) && settings.fap_mask.test(31) &&
              settings.fap_mask.test(32));
  for (const std::size_t fap : {10u, 11u, 40u, 39u, 52u, 57u, 58u})
    EXPECT_FALSE(settings.fap_mask.test(fap)) << fap;
}

// The rules of the player decide what the rate control leaves out.
TEST(FbaPlan, LeavesOutByTheRulesOfThePlayer) {
  std::vector<face::FapFrame> frames(20);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].set(6, static_cast<float>(i) * 4.0f);
    frames[i].set(7, static_cast<float>(i) * 2.0f);
  }
  face::FitRule half{};
  half.receiver = 7;
  half.numerator_count = 1;
  half.numerator[0] = {0.5f, {6, 0}, {1, 0}};
  FbaClip clip{frames, {}, 0};
  const auto sends_right = [&clip] {
    FbaSettings settings;
    set_masks(clip, &settings);
    leave_out_restorable(clip, 0.01f, &settings);
    EXPECT_TRUE(settings.fap_mask.test(6));
    return settings.fap_mask.test(7);
  };
  EXPECT_TRUE(sends_right());
  clip.fit = {&half, 1};
  EXPECT_FALSE(sends_right());
}

TEST(FbaPlan, MeasuresWhatTheEncoderWrites) {
  const auto frames = waves(50);
  const FbaClip clip{frames, {}, 25};
  const FbaSettings settings = settings_for(clip);
  std::vector<ModelNode> nodes(1 << 16);
  const auto bits = measure_bits(clip, settings, nodes);
  ASSERT_TRUE(bits.ok());
  EXPECT_EQ(bits.value, encode(clip, settings).size() * 8);
}

TEST(FbaPlan, KeepsTheRate) {
  const auto frames = waves(250);
  const FbaClip clip{frames, {}, 0};
  std::vector<ModelNode> nodes(1 << 16);
  float step_mm = 0.0f;
  for (const double kbit_per_s : {6.0, 3.0, 1.5}) {
    FbaSettings settings;
    RatePlan plan;
    ASSERT_TRUE(plan_rate(clip, kbit_per_s, nodes, &settings, &plan).ok()) << kbit_per_s;
    EXPECT_LE(plan.kbit_per_s, kbit_per_s);
    EXPECT_GT(plan.step_mm, step_mm);
    step_mm = plan.step_mm;
    const double seconds = 250 / 25.0;
    EXPECT_NEAR(static_cast<double>(encode(clip, settings).size()) * 8 / 1000 / seconds,
                plan.kbit_per_s, 1e-9);
  }
  FbaSettings settings;
  RatePlan plan;
  EXPECT_EQ(plan_rate(clip, 0.05, nodes, &settings, &plan).detail,
            static_cast<std::uint16_t>(FbaFault::rate_too_low));
}

TEST(Arithmetic, ListedModelsAgreeWithATableOfFrequencies) {
  constexpr std::uint32_t kSymbols = 40;
  std::vector<ModelNode> nodes(kSymbols);
  ModelPool pool(nodes);
  AdaptiveModel model;
  std::vector<std::uint32_t> frequency(kSymbols, 1);
  Random random(9);
  for (int round = 0; round < 40000; ++round) {
    const std::uint32_t symbol = std::min(random.next() % kSymbols, random.next() % kSymbols);
    std::uint32_t low = 0, total = 0;
    for (std::uint32_t s = 0; s < kSymbols; ++s) {
      total += frequency[s];
      if (s > symbol) low += frequency[s];
    }
    if (round % 97 == 0) {
      const Interval share = pool.share(model, kSymbols, symbol);
      ASSERT_EQ(share.low, low);
      ASSERT_EQ(share.high, low + frequency[symbol]);
      ASSERT_EQ(share.total, total);
      ASSERT_EQ(pool.find(model, kSymbols, low).symbol, symbol);
      ASSERT_EQ(pool.find(model, kSymbols, share.high - 1).symbol, symbol);
    }
    if (total == 16383)
      for (std::uint32_t& f : frequency) f = (f + 1) / 2;
    ++frequency[symbol];
    ASSERT_TRUE(pool.count(&model, kSymbols, symbol));
  }
}

}  // namespace
}  // namespace caryatid::stream
