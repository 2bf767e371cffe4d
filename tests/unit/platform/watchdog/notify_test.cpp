#include "platform/watchdog/notify.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace caryatid::platform {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr Vitals kAll{true, true, true};

// A supervisor: the socket that systemd would hold.
class NotifyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "caryatid-notify-" + std::to_string(::getpid());
    ::unlink(path_.c_str());
    listen_on(path_);
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "10000000", 1);
    ::unsetenv("WATCHDOG_PID");
  }
  void TearDown() override {
    if (socket_ >= 0) ::close(socket_);
    ::unlink(path_.c_str());
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }
  void listen_on(const std::string& name) {
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof address.sun_path - 1);
    if (name[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
  }
  std::string received() {
    char text[256];
    const ssize_t size = ::recv(socket_, text, sizeof text, 0);
    return size < 0 ? "" : std::string(text, static_cast<std::size_t>(size));
  }

  std::string path_;
  int socket_ = -1;
  Notifier notifier_;
};

TEST_F(NotifyTest, ReadyAndStoppingArrive) {
  ASSERT_TRUE(notifier_.open().ok());
  EXPECT_TRUE(notifier_.supervised());
  EXPECT_EQ(notifier_.period_us(), 5 * kSecond_us);
  ASSERT_TRUE(notifier_.ready().ok());
  EXPECT_EQ(received(), "READY=1\nSTATUS=running");
  ASSERT_TRUE(notifier_.stopping().ok());
  EXPECT_EQ(received(), "STOPPING=1");
}

TEST_F(NotifyTest, AnAbstractSocketWorksToo) {
  ::close(socket_);
  const std::string name = "@caryatid-" + std::to_string(::getpid());
  listen_on(name);
  ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  ASSERT_TRUE(notifier_.open().ok());
  ASSERT_TRUE(notifier_.ready().ok());
  EXPECT_NE(received(), "");
}

TEST_F(NotifyTest, WithoutSupervisorNothingHappens) {
  ::unsetenv("NOTIFY_SOCKET");
  ASSERT_TRUE(notifier_.open().ok());
  EXPECT_FALSE(notifier_.supervised());
  EXPECT_TRUE(notifier_.ready().ok());
  EXPECT_TRUE(notifier_.beat(0, kAll).ok());
}

TEST_F(NotifyTest, WrongSocketNamesAreRefused) {
  ::setenv("NOTIFY_SOCKET", "relative", 1);
  EXPECT_EQ(notifier_.open().code, Code::invalid_argument);
  ::setenv("NOTIFY_SOCKET", ("/" + std::string(200, 'x')).c_str(), 1);
  EXPECT_EQ(notifier_.open().code, Code::invalid_argument);
}

TEST_F(NotifyTest, AVanishedSupervisorIsAnErrorNotASignal) {
  ASSERT_TRUE(notifier_.open().ok());
  ::close(socket_);
  socket_ = -1;
  ::unlink(path_.c_str());
  EXPECT_EQ(notifier_.ready().code, Code::io);
}

TEST_F(NotifyTest, ItBeatsEveryHalfPeriod) {
  ASSERT_TRUE(notifier_.open().ok());
  int beats = 0;
  for (std::int64_t now_us = 0; now_us <= 60 * kSecond_us; now_us += 33'333) {
    EXPECT_FALSE(notifier_.withheld(now_us)) << now_us;
    EXPECT_TRUE(notifier_.beat(now_us, kAll).ok());
    if (received() == "WATCHDOG=1") ++beats;
  }
  EXPECT_EQ(beats, 11);
}

TEST_F(NotifyTest, AnyMissingVitalSignWithholdsTheBeat) {
  for (const Vitals& seen :
       {Vitals{false, true, true}, Vitals{true, false, true}, Vitals{true, true, false}}) {
    Notifier notifier;
    ASSERT_TRUE(notifier.open().ok());
    for (std::int64_t now_us = 0; now_us <= 20 * kSecond_us; now_us += 33'333)
      (void)notifier.beat(now_us, seen);
    EXPECT_EQ(received(), "");
    EXPECT_TRUE(notifier.withheld(20 * kSecond_us));
    EXPECT_TRUE(notifier.beat(20 * kSecond_us, kAll).ok());
    EXPECT_EQ(received(), "WATCHDOG=1");
    EXPECT_FALSE(notifier.withheld(20 * kSecond_us));
  }
}

TEST_F(NotifyTest, AWatchdogForAnotherProcessIsNotOurs) {
  ::setenv("WATCHDOG_PID", "1", 1);
  ASSERT_TRUE(notifier_.open().ok());
  EXPECT_EQ(notifier_.period_us(), 0);
  EXPECT_TRUE(notifier_.supervised());
}

}  // namespace
}  // namespace caryatid::platform
