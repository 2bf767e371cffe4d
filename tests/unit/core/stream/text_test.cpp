#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/stream/bap_text.h"
#include "core/stream/fap_text.h"
#include "tests/support/test_data.h"

namespace caryatid::stream {
namespace {

// `count` flags of which those in `on` are 1.
std::string flags(int count, const std::vector<int>& on) {
  std::string line;
  for (int n = 1; n <= count; ++n) {
    const bool one = std::find(on.begin(), on.end(), n) != on.end();
    line += one ? "1 " : "0 ";
  }
  return line;
}

struct Outcome {
  std::vector<face::FapFrame> frames;
  TextFault fault = TextFault::none;
  std::uint32_t line = 0;
};

Outcome read_fap(const std::string& text) {
  FapTextReader reader({text.data(), text.size()});
  Outcome outcome;
  face::FapFrame frame;
  Status status;
  while ((status = reader.next(&frame)).ok()) outcome.frames.push_back(frame);
  outcome.fault = static_cast<TextFault>(status.detail);
  outcome.line = reader.line();
  return outcome;
}

TEST(FapText, ReadsAFrame) {
  const Outcome got = read_fap("2.1 a.fap 25 1\n" + flags(68, {3, 12}) + "\n0 100 -20\n");
  ASSERT_EQ(got.frames.size(), 1u);
  EXPECT_EQ(got.fault, TextFault::end_of_text);
  EXPECT_EQ(got.frames[0].get(3), 100.0f);
  EXPECT_EQ(got.frames[0].get(12), -20.0f);
  EXPECT_EQ(got.frames[0].mask.count(), 2u);
}

TEST(FapText, HeaderWithSpacesInTheName) {
  const std::string text = "2.1 C:\\faps\\AU Interpolation 1131.fap 12.5 7\n";
  FapTextReader reader({text.data(), text.size()});
  ASSERT_TRUE(reader.read_header().ok());
  EXPECT_STREQ(reader.header().name.c_str(), "C:\\faps\\AU Interpolation 1131.fap");
  EXPECT_STREQ(reader.header().version.c_str(), "2.1");
  EXPECT_EQ(reader.header().frames_per_second, 12.5f);
  EXPECT_EQ(reader.header().frame_count, 7u);
}

TEST(FapText, SixtyNineFlagsOfGreta) {
  const Outcome got = read_fap("2.1 a 25 1\n" + flags(69, {48}) + "\n0 5\n");
  ASSERT_EQ(got.frames.size(), 1u);
  EXPECT_EQ(got.frames[0].get(48), 5.0f);
}

TEST(FapText, VisemeAndExpressionTakeFourAndSixNumbers) {
  const Outcome got =
      read_fap("2.1 a 25 1\n" + flags(68, {1, 2, 3}) + "\n0 3 4 20 1 2 50 6 10 1 0 77\n");
  ASSERT_EQ(got.frames.size(), 1u);
  EXPECT_EQ(got.frames[0].viseme, (face::VisemeField{3, 4, 20, true}));
  EXPECT_EQ(got.frames[0].expression, (face::ExpressionField{2, 50, 6, 10, true, false}));
  EXPECT_EQ(got.frames[0].get(3), 77.0f);
}

TEST(FapText, SingleNumberForAVisemeMeansItAlone) {
  const Outcome got = read_fap("2.1 a 25 1\n" + flags(69, {1, 3}) + "\n0 7 60\n");
  ASSERT_EQ(got.frames.size(), 1u);
  EXPECT_EQ(got.frames[0].viseme, (face::VisemeField{7, 0, 63, false}));
  EXPECT_EQ(got.frames[0].get(3), 60.0f);
}

TEST(FapText, CrlfCommentsTrailingBlanksAndNoNewlineAtTheEnd) {
  const Outcome got = read_fap("# made by hand\r\n2.0 a 5 2 \r\n" + flags(68, {3}) +
                               " \r\n1 10 \r\n# half way\r\n" + flags(68, {3}) + "\r\n2 -1.5e1");
  EXPECT_EQ(got.fault, TextFault::end_of_text);
  ASSERT_EQ(got.frames.size(), 2u);
  EXPECT_EQ(got.frames[1].get(3), -15.0f);
}

TEST(FapText, WrappedLines) {
  std::string wrapped = flags(68, {3, 4});
  wrapped[51] = '\n';
  const Outcome got = read_fap("2.1 a 25 1\n" + wrapped + "\n0 1\n2\n");
  ASSERT_EQ(got.frames.size(), 1u);
  EXPECT_EQ(got.frames[0].get(4), 2.0f);
}

TEST(FapText, ParametersThatLeaveTheMaskKeepTheirValue) {
  const Outcome got =
      read_fap("2.1 a 25 2\n" + flags(68, {3, 4}) + "\n0 1 2\n" + flags(68, {4}) + "\n1 9\n");
  ASSERT_EQ(got.frames.size(), 2u);
  EXPECT_FALSE(got.frames[1].has(3));
  EXPECT_EQ(got.frames[1].get(3), 1.0f);
  EXPECT_EQ(got.frames[1].get(4), 9.0f);
}

struct BadText {
  const char* what;
  std::string text;
  TextFault fault;
  std::uint32_t line;
};

TEST(FapText, EachFaultHasItsOwnDetailAndLine) {
  const std::string head = "2.1 a 25 1\n";
  const std::vector<BadText> cases = {
      {"empty", "", TextFault::header_short, 1},
      {"short header", "\n2.1 a\n", TextFault::header_short, 2},
      {"rate", "2.1 a 0 1\n", TextFault::header_rate, 1},
      {"rate word", "2.1 a fast 1\n", TextFault::header_rate, 1},
      {"count", "2.1 a 25 1.5\n", TextFault::header_frames, 1},
      {"flag", head + "0 0 2 0\n", TextFault::mask_flag, 2},
      {"67 flags", head + flags(67, {3}) + "\n0 5\n", TextFault::mask_columns, 2},
      {"70 flags", head + flags(70, {3}) + "\n0 5\n", TextFault::mask_columns, 2},
      {"value", head + flags(68, {3}) + "\n0 ten\n", TextFault::not_a_number, 3},
      {"nan", head + flags(68, {3}) + "\n0 nan\n", TextFault::not_a_number, 3},
      {"huge", head + flags(68, {3}) + "\n0 1e30\n", TextFault::not_a_number, 3},
      {"few", head + flags(68, {3, 4}) + "\n0 1\n" + flags(68, {3}), TextFault::value_count, 3},
      {"many", head + flags(68, {3}) + "\n0 1 2\n", TextFault::value_count, 3},
      {"cut", head + flags(68, {3}) + "\n0", TextFault::cut_off, 3},
      {"viseme", head + flags(68, {1}) + "\n0 15 0 0 0\n", TextFault::viseme_field, 3},
      {"blend", head + flags(68, {1}) + "\n0 1 0 64 0\n", TextFault::viseme_field, 3},
      {"expression", head + flags(68, {2}) + "\n0 7 0 0 0 0 0\n", TextFault::expression_field, 3},
      {"def", head + flags(68, {2}) + "\n0 1 0 0 0 2 0\n", TextFault::expression_field, 3},
  };
  for (const BadText& bad : cases) {
    const Outcome got = read_fap(bad.text);
    EXPECT_EQ(got.fault, bad.fault) << bad.what << ": " << describe(got.fault);
    EXPECT_EQ(got.line, bad.line) << bad.what;
  }
}

TEST(FapText, AFaultStays) {
  const std::string text = "2.1 a 25 1\n0 0 2\n";
  FapTextReader reader({text.data(), text.size()});
  face::FapFrame frame;
  const Status first = reader.next(&frame);
  EXPECT_EQ(first.code, Code::corrupt_data);
  EXPECT_EQ(reader.next(&frame), first);
}

// The same frames come out when the text arrives byte by byte.
TEST(FapText, ArrivesInPieces) {
  const std::string text = "2.1 a b 25 2\n" + flags(68, {3, 4}) + "\n0 -11 22\n" +
                           flags(68, {1, 4}) + "\n1 1 2 33 0 44\n";
  std::vector<face::FapFrame> got;
  std::string pending;
  FapTextReader reader({}, false);
  face::FapFrame frame;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const bool complete = i == text.size();
    pending.erase(0, reader.consumed_bytes());
    if (!complete) pending += text[i];
    reader.refill({pending.data(), pending.size()}, complete);
    Status status;
    while ((status = reader.next(&frame)).ok()) got.push_back(frame);
    EXPECT_EQ(status.code, Code::not_ready) << describe_text_fault(status);
  }
  const Outcome whole = read_fap(text);
  ASSERT_EQ(got.size(), whole.frames.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i].value, whole.frames[i].value);
}

std::string write_all(const std::vector<face::FapFrame>& frames) {
  std::string text = "2.1 own 25 1\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    char line[kMaxFapTextFrameBytes];
    const auto written = write_fap_text(static_cast<std::int32_t>(i), frames[i], line);
    EXPECT_TRUE(written.ok());
    text.append(line, written.value);
  }
  return text;
}

TEST(FapText, WriterAndReaderAgree) {
  std::vector<face::FapFrame> frames(2);
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    frames[0].set(fap, static_cast<float>(fap * 1000 - 40000));
  frames[1].set(4, -1e9f);
  frames[1].mask.set(1);
  frames[1].mask.set(2);
  frames[1].viseme = {14, 3, 63, true};
  frames[1].expression = {6, 63, 1, 2, false, true};
  const Outcome got = read_fap(write_all(frames));
  ASSERT_EQ(got.frames.size(), 2u) << describe(got.fault);
  EXPECT_EQ(got.frames[0].value, frames[0].value);
  EXPECT_EQ(got.frames[1].get(4), -1e9f);
  EXPECT_EQ(got.frames[1].viseme, frames[1].viseme);
  EXPECT_EQ(got.frames[1].expression, frames[1].expression);
}

TEST(FapText, WriterRefusesAShortBuffer) {
  char line[100];
  EXPECT_EQ(write_fap_text(0, {}, line).status.code, Code::out_of_capacity);
  EXPECT_EQ(write_text_header({}, std::span<char>(line, 3)).status.code, Code::out_of_capacity);
}

TEST(FapText, LongestFrameFitsItsBuffer) {
  face::FapFrame frame;
  for (int fap = 3; fap <= face::kFapCount; ++fap) frame.set(fap, -1e9f);
  frame.mask.set(1);
  frame.mask.set(2);
  char line[kMaxFapTextFrameBytes];
  EXPECT_TRUE(write_fap_text(-2000000000, frame, line).ok());
}

TEST(TextHeader, IsWrittenAsItIsRead) {
  TextHeader header;
  header.version.assign({"2.1", 3});
  header.name.assign({"two words", 9});
  header.frames_per_second = 29.97f;
  header.frame_count = 12;
  char text[64];
  const auto written = write_text_header(header, text);
  ASSERT_TRUE(written.ok());
  EXPECT_EQ(std::string(text, written.value), "2.1 two words 29.97 12\n");
}

TEST(BapText, CountsTheFlagsInsteadOfTrustingTheVersion) {
  for (const int columns : {186, 187, 296, 297}) {
    const std::string text = "3.2 a 25 1\n" + flags(columns, {1, 183}) + "\n0 -7 90\n";
    BapTextReader reader({text.data(), text.size()});
    body::BapFrame frame;
    ASSERT_TRUE(reader.next(&frame).ok()) << columns;
    EXPECT_EQ(frame.get(1), -7.0f);
    EXPECT_EQ(frame.get(183), 90.0f);
  }
  const std::string text = "3.1 a 25 1\n" + flags(185, {1}) + "\n0 5\n";
  BapTextReader reader({text.data(), text.size()});
  body::BapFrame frame;
  EXPECT_EQ(reader.next(&frame).detail, static_cast<std::uint16_t>(TextFault::mask_columns));
}

TEST(BapText, WriterAndReaderAgreeWithExtensions) {
  for (const int last : {186, 296}) {
    body::BapFrame frame;
    for (int bap = 1; bap <= last; bap += 5) frame.set(bap, static_cast<float>(-bap * 333));
    std::string text = "3.2 own 25 1\n";
    std::vector<char> line(kMaxBapTextFrameBytes);
    const auto written = write_bap_text(0, frame, line);
    ASSERT_TRUE(written.ok());
    text.append(line.data(), written.value);
    BapTextReader reader({text.data(), text.size()});
    body::BapFrame back;
    ASSERT_TRUE(reader.next(&back).ok());
    EXPECT_EQ(back.value, frame.value);
    EXPECT_EQ(back.mask, frame.mask);
  }
}

// Every file of another project reads to its end, holds as many frames as it says, and comes back
// unchanged from our own text.
TEST(TextOfOthers, FapFilesReadAndRoundTrip) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vreng");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".fap") continue;
    ++files;
    const std::string text = test::read_file(entry.path());
    const Outcome first = read_fap(text);
    EXPECT_EQ(first.fault, TextFault::end_of_text) << entry.path();
    FapTextReader reader({text.data(), text.size()});
    ASSERT_TRUE(reader.read_header().ok());
    EXPECT_EQ(first.frames.size(), reader.header().frame_count) << entry.path();
    const Outcome second = read_fap(write_all(first.frames));
    ASSERT_EQ(second.frames.size(), first.frames.size());
    for (std::size_t i = 0; i < first.frames.size(); ++i)
      EXPECT_EQ(second.frames[i].value, first.frames[i].value) << entry.path() << " " << i;
  }
  EXPECT_EQ(files, 7);
}

TEST(TextOfOthers, BapFilesReadAndRoundTrip) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vreng");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".bap") continue;
    ++files;
    const std::string text = test::read_file(entry.path());
    BapTextReader reader({text.data(), text.size()});
    std::string again = "3.2 own 25 1\n";
    std::vector<char> line(kMaxBapTextFrameBytes);
    std::vector<body::BapFrame> frames;
    body::BapFrame frame;
    while (reader.next(&frame).ok()) {
      frames.push_back(frame);
      const auto written = write_bap_text(reader.frame_index(), frame, line);
      ASSERT_TRUE(written.ok());
      again.append(line.data(), written.value);
    }
    EXPECT_EQ(frames.size(), reader.header().frame_count) << entry.path();
    BapTextReader second({again.data(), again.size()});
    for (const body::BapFrame& expected : frames) {
      body::BapFrame got = expected;
      ASSERT_TRUE(second.next(&got).ok()) << entry.path();
      EXPECT_EQ(got.value, expected.value) << entry.path();
    }
  }
  EXPECT_EQ(files, 14);
}

}  // namespace
}  // namespace caryatid::stream
