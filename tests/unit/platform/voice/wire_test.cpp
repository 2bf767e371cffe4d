#include "platform/voice/wire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace caryatid::platform::wire {
namespace {

std::string record(Type type, std::string_view payload, std::uint32_t utterance = 7) {
  std::byte head[kHeadBytes];
  put_head(type, utterance, payload.size(), head);
  return std::string(reinterpret_cast<const char*>(head), sizeof head) + std::string(payload);
}

void feed(Reader& reader, std::string_view bytes) {
  const auto room = reader.room();
  ASSERT_GE(room.size(), bytes.size());
  std::transform(bytes.begin(), bytes.end(), room.begin(), [](char c) { return std::byte(c); });
  reader.took(bytes.size());
}

TEST(Wire, RecordsSurviveAnyCut) {
  const std::string stream = record(Type::phone, std::string("\x05\0\0\0", 4) + "\u02C8a") +
                             record(Type::pcm, "abcd") +
                             record(Type::end, std::string("\x10\x27\0\0", 4));
  auto reader = std::make_unique<Reader>();
  std::vector<Type> seen;
  for (const char c : stream) {
    feed(*reader, {&c, 1});
    Record r;
    while (reader->next(&r).ok()) {
      seen.push_back(r.type);
      EXPECT_EQ(r.utterance, 7u);
      if (r.type == Type::end) {
        EXPECT_EQ(r.time_ms(), 10000);
      }
    }
  }
  EXPECT_EQ(seen, (std::vector{Type::phone, Type::pcm, Type::end}));
}

TEST(Wire, EachFaultHasItsReason) {
  const auto refusal = [](const std::string& bytes) {
    auto reader = std::make_unique<Reader>();
    feed(*reader, bytes);
    Record r;
    const Status status = reader->next(&r);
    EXPECT_EQ(status.code, Code::corrupt_data);
    return Refusal{status.detail};
  };
  EXPECT_EQ(refusal(std::string("\x09\0\0\0\0\0\0\0", 8)), Refusal::unknown_type);
  EXPECT_EQ(refusal(std::string("\x02\x01\x02\0\0\0\0\0", 8)), Refusal::reserved_byte);
  EXPECT_EQ(refusal(std::string("\x02\0\xFF\xFF\0\0\0\0", 8)), Refusal::wrong_size);
  EXPECT_EQ(refusal(record(Type::pcm, "abc")), Refusal::wrong_size);
  EXPECT_EQ(refusal(record(Type::word, "abcd")), Refusal::wrong_size);
  EXPECT_EQ(refusal(record(Type::sentence, "\xFF\xFF\xFF\xFF")), Refusal::bad_time);
}

TEST(Wire, TheLongestRecordFits) {
  auto reader = std::make_unique<Reader>();
  feed(*reader, record(Type::say, std::string(kMostBytes, 'x')));
  Record r;
  ASSERT_TRUE(reader->next(&r).ok());
  EXPECT_EQ(r.payload.size(), kMostBytes);
  EXPECT_FALSE(reader->room().empty());
}

}  // namespace
}  // namespace caryatid::platform::wire
