#include "platform/files/background_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace caryatid::platform {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string scratch(const char* name) {
  return testing::TempDir() + name + "_" + std::to_string(::getpid());
}

TEST(BackgroundWriter, TheLastContentIsOnTheDiskAfterStop) {
  const std::string a = scratch("writer_a"), b = scratch("writer_b");
  BackgroundWriter writer;
  ASSERT_TRUE(writer.add(a.c_str(), true).ok());
  ASSERT_EQ(writer.add(b.c_str(), false).value, 1u);
  ASSERT_TRUE(writer.start().ok());
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(writer.put(0, std::string_view(std::to_string(i))).ok());
  EXPECT_TRUE(writer.put(1, std::string_view("other")).ok());
  writer.stop();
  EXPECT_EQ(text_of(a), "99");
  EXPECT_EQ(text_of(b), "other");
  EXPECT_FALSE(std::filesystem::exists(a + ".new"));
}

TEST(BackgroundWriter, AReaderNeverSeesAPiece) {
  const std::string path = scratch("writer_whole");
  BackgroundWriter writer;
  ASSERT_TRUE(writer.add(path.c_str(), false).ok());
  ASSERT_TRUE(writer.start().ok());
  const std::string long_text(4000, 'a'), short_text = "b";
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(writer.put(0, i % 2 == 0 ? long_text : short_text).ok());
    const std::string seen = text_of(path);
    EXPECT_TRUE(seen.empty() || seen == long_text || seen == short_text) << seen.size();
  }
}

TEST(BackgroundWriter, AFolderThatIsNotThereIsToldAtTheNextPut) {
  BackgroundWriter writer;
  ASSERT_TRUE(writer.add("/proc/nonexistent/status", false).ok());
  ASSERT_TRUE(writer.start().ok());
  ASSERT_TRUE(writer.put(0, std::string_view("x")).ok());
  Status status;
  for (int i = 0; i < 1000 && status.ok(); ++i) {
    ::usleep(1000);
    status = writer.put(0, std::string_view("x"));
  }
  EXPECT_EQ(status.code, Code::io);
  EXPECT_EQ(status.detail, ENOENT);
}

TEST(BackgroundWriter, LimitsAreRefused) {
  BackgroundWriter writer;
  EXPECT_FALSE(writer.add(std::string(300, 'p').c_str(), false).ok());
  for (std::size_t i = 0; i < BackgroundWriter::kMaxFiles; ++i)
    EXPECT_TRUE(writer.add("x", false).ok());
  EXPECT_EQ(writer.add("x", false).status.code, Code::out_of_capacity);
  EXPECT_EQ(writer.put(99, std::string_view("x")).code, Code::invalid_argument);
  EXPECT_EQ(writer.put(0, std::string(BackgroundWriter::kMaxFileBytes + 1, 'x')).code,
            Code::out_of_capacity);
}

// /dev/full stands for a full disk; the old content stays. (A rename over it would need root.)
TEST(ReplaceFile, AFailedWriteLeavesTheOldContent) {
  const std::string path = scratch("replace");
  ASSERT_EQ(replace_file(path.c_str(), std::string_view("old"), true), 0);
  std::filesystem::create_symlink("/dev/full", path + ".new");
  EXPECT_EQ(replace_file(path.c_str(), std::string_view("new"), false), ENOSPC);
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(replace_file(path.c_str(), std::string_view("new"), false), 0);
  EXPECT_EQ(text_of(path), "new");
}

}  // namespace
}  // namespace caryatid::platform
