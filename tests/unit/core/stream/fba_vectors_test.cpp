// Streams of others against the values that they are known to hold: real_* were written by a
// deployed encoder, the rest by an independent model of it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/stream/fba_decoder.h"
#include "tests/support/test_data.h"

namespace caryatid::stream {
namespace {

// A plane as the vectors' text has it: kind and the masked values.
std::string text_of(const FbaDecoder& decoder, const FbaPlane& plane, const face::FapFrame& face,
                    const body::BapFrame& body) {
  std::ostringstream line;
  line << (plane.intra ? "I" : "P");
  if (plane.face) {
    const auto field = [&](std::size_t slot) { line << decoder.slot_value(slot) << ","; };
    if (face.has(1)) {
      line << " vis:";
      for (const std::size_t slot : {0u, 1u, 2u}) field(slot);
      line << face.viseme.viseme_def;
    }
    if (face.has(2)) {
      line << " exp:";
      for (const std::size_t slot : {3u, 4u, 5u, 6u}) field(slot);
      line << face.expression.init_face << "," << face.expression.expression_def;
    }
    for (int fap = 3; fap <= face::kFapCount; ++fap)
      if (face.has(fap)) line << " F" << fap << "=" << std::llround(face.get(fap));
  }
  if (plane.body)
    for (int bap = 1; bap <= body::kBapCountExtended; ++bap)
      if (body.has(bap)) line << " B" << bap << "=" << std::llround(body.get(bap));
  return line.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  return lines;
}

// The clock of the deployed decoder, which differs from the rule that FbaDecoder::time_s() follows:
// time codes stay until the next intra plane and do not restart the running sum, planes with a body
// only ignore fractions of the rate, planes with nothing take no time.
class VisageClock {
 public:
  long long time_ms(const FbaPlane& plane) {
    if (plane.has_rate) {
      rate_ = plane.rate.frame_rate;
      if (plane.face) rate_ += plane.rate.sixteenths / 16.0;
    }
    bool& time_code = time_code_[plane.face ? 1 : 0];
    if (plane.intra && (plane.face || plane.body)) time_code = plane.has_time_code;
    if (plane.has_time_code) code_s_ = plane.time_code.in_seconds();
    const long long time = std::llround(time_code ? code_s_ * 1000.0 : std::floor(next_ms_));
    if (plane.face || plane.body) next_ms_ += (plane.skip + 1) * 1000.0 / rate_;
    return time;
  }

 private:
  double rate_ = 30.0;
  bool time_code_[2] = {};  // Of planes with a body only, of planes with a face.
  double code_s_ = 0.0;
  double next_ms_ = 0.0;
};

struct Decoded {
  std::vector<std::string> planes;
  std::vector<long long> times_ms;
  FbaFault end = FbaFault::none;
};

// Feeds `piece` bytes at a time; 0: all at once.
Decoded decode(const std::string& stream, std::size_t piece) {
  std::vector<ModelNode> nodes(65536);
  FbaDecoder decoder(nodes, {});
  VisageClock clock;
  const auto bytes = std::as_bytes(std::span(stream));
  std::size_t begin = 0, end = piece == 0 ? bytes.size() : 0;
  decoder.refill(bytes.subspan(begin, end - begin), end == bytes.size());
  Decoded out;
  FbaPlane plane;
  face::FapFrame face;
  body::BapFrame body;
  while (true) {
    const Status status = decoder.next(&plane, &face, &body);
    if (status.ok()) {
      out.planes.push_back(text_of(decoder, plane, face, body));
      out.times_ms.push_back(clock.time_ms(plane));
      continue;
    }
    out.end = static_cast<FbaFault>(status.detail);
    if (out.end != FbaFault::need_more) return out;
    begin += decoder.consumed_bytes();
    end = std::min(end + piece, bytes.size());
    decoder.refill(bytes.subspan(begin, end - begin), end == bytes.size());
  }
}

class Vectors : public ::testing::TestWithParam<const char*> {};

TEST_P(Vectors, DecodeToTheKnownValues) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vectors");
  const std::string stream = test::read_file(folder / (std::string(GetParam()) + ".fba"));
  const auto expected =
      lines_of(test::read_file(folder / (std::string(GetParam()) + ".decoded.txt")));
  const Decoded got = decode(stream, 0);
  EXPECT_EQ(got.end, FbaFault::end_of_stream) << describe(got.end);
  ASSERT_EQ(got.planes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(got.planes[i], expected[i]) << i;
}

TEST_P(Vectors, DecodeAlikeInPieces) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vectors");
  const std::string stream = test::read_file(folder / (std::string(GetParam()) + ".fba"));
  const Decoded whole = decode(stream, 0);
  for (const std::size_t piece : {1u, 7u, 100u}) {
    const Decoded got = decode(stream, piece);
    EXPECT_EQ(got.planes, whole.planes) << piece;
    EXPECT_EQ(got.end, whole.end) << piece;
  }
}

INSTANTIATE_TEST_SUITE_P(Fba, Vectors,
                         ::testing::Values("bap_hi_q1", "fap_eyes_q5_startcodes", "fap_joy_q1",
                                           "fapbap_viseme_expr_q1", "real_clap_q1",
                                           "real_eyes_partial_ranges", "real_flush22",
                                           "real_joy_hi_both", "real_joy_q1_timecode_skip",
                                           "real_ve_q1", "syn_1249"));

class VectorTimes : public ::testing::TestWithParam<const char*> {};

TEST_P(VectorTimes, FollowFromThePlaneHeads) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vectors");
  const std::string stream = test::read_file(folder / (std::string(GetParam()) + ".fba"));
  const auto expected = lines_of(test::read_file(folder / (std::string(GetParam()) + ".pts.txt")));
  const Decoded got = decode(stream, 0);
  ASSERT_EQ(got.times_ms.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(got.times_ms[i], std::stoll(expected[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(Fba, VectorTimes,
                         ::testing::Values("real_joy_q1_timecode_skip", "syn_1249"));

}  // namespace
}  // namespace caryatid::stream
