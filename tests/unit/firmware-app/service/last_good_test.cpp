#include "firmware-app/last_good.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace caryatid::app {
namespace {

namespace fs = std::filesystem;

class LastGoodTest : public testing::Test {
 protected:
  fs::path root_ = testing::TempDir() + "last_good_" + std::to_string(::getpid());
  std::string config_ = root_ / "etc/kiosk.toml", text_ = root_ / "etc/texts/en.toml";
  LastGood last_{(root_ / "state").string()};

  void SetUp() override {
    fs::remove_all(root_);
    fs::create_directories(root_ / "etc/texts");
    fs::create_directories(root_ / "state");
    put(config_, "first");
    put(text_, "hello");
  }
  void TearDown() override { fs::remove_all(root_); }
  static void put(const std::string& file, const std::string& content) {
    std::ofstream(file) << content;
  }
  static std::string get(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(LastGoodTest, NothingIsKeptAtFirst) { EXPECT_EQ(last_.config(), ""); }

TEST_F(LastGoodTest, KeepsTheFilesAsTheyWere) {
  ASSERT_TRUE(last_.keep(config_, {config_, text_}));
  put(config_, "broken [");
  EXPECT_EQ(get(last_.config()), "first");
  EXPECT_EQ(get(fs::path(last_.config()).parent_path() / "texts/en.toml"), "hello");
}

TEST_F(LastGoodTest, ANewGoodOneTakesThePlaceOfTheOld) {
  ASSERT_TRUE(last_.keep(config_, {text_}));
  put(text_, "hello again");
  ASSERT_TRUE(last_.keep(config_, {text_}));
  EXPECT_EQ(get(fs::path(last_.config()).parent_path() / "texts/en.toml"), "hello again");
  EXPECT_FALSE(fs::exists(root_ / "state/last_good.old"));
}

TEST_F(LastGoodTest, UnchangedFilesAreNotWrittenAgain) {
  ASSERT_TRUE(last_.keep(config_, {text_}));
  const auto before = fs::last_write_time(last_.config());
  ASSERT_TRUE(last_.keep(config_, {text_}));
  EXPECT_EQ(fs::last_write_time(last_.config()), before);
}

TEST_F(LastGoodTest, APowerCutBetweenTheRenamesLeavesTheOldOnes) {
  ASSERT_TRUE(last_.keep(config_, {text_}));
  fs::rename(root_ / "state/last_good", root_ / "state/last_good.old");
  EXPECT_EQ(get(last_.config()), "first");
}

TEST_F(LastGoodTest, FilesOfOtherFoldersStayOut) {
  put((root_ / "secret").string(), "x");
  ASSERT_TRUE(last_.keep(config_, {(root_ / "secret").string()}));
  EXPECT_FALSE(fs::exists(root_ / "state/secret"));
  EXPECT_EQ(get(last_.config()), "first");
}

TEST_F(LastGoodTest, WithoutAStateFolderNothingHappens) {
  EXPECT_TRUE(LastGood("").keep(config_, {}));
  EXPECT_EQ(LastGood("").config(), "");
  EXPECT_FALSE(LastGood("/proc/nonexistent").keep(config_, {}));
}

}  // namespace
}  // namespace caryatid::app
