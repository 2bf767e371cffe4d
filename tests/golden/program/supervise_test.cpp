// The whole program under a supervisor: it says when it is ready, beats while screen, input and
// sound are alive, and stops beating when any one of them is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/golden/program/background.h"

namespace caryatid::golden {
namespace {

using ::testing::HasSubstr;

class Supervised : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder("supervised");
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const sockaddr_un address = address_of(folder_ / "notify");
    ASSERT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  void TearDown() override {
    kiosk_.reset();
    ::close(socket_);
    std::filesystem::remove_all(folder_);
  }
  // A heartbeat every quarter of a second.
  void start(const std::string& display, const std::string& audio) {
    const std::vector<std::string> arguments{
        "--display",     display,     "--size",
        "64x48",         "--audio",   audio,
        "--test-faults", "--control", (folder_ / "control").string()};
    const std::vector<std::string> environment{"NOTIFY_SOCKET=" + (folder_ / "notify").string(),
                                               "WATCHDOG_USEC=500000",
                                               "ALSA_CONFIG_PATH=" + (folder_ / "asound").string()};
    kiosk_ = std::make_unique<Background>(arguments, environment, folder_ / "log");
  }
  std::string message(int patience_ms = kPatience_ms) {
    pollfd waiting{socket_, POLLIN, 0};
    char text[256];
    if (::poll(&waiting, 1, patience_ms) <= 0) return "";
    const ssize_t n = ::recv(socket_, text, sizeof text, 0);
    return {text, static_cast<std::size_t>(n < 0 ? 0 : n)};
  }
  void expect_beats() {
    EXPECT_THAT(message(), HasSubstr("READY=1")) << kiosk_->output();
    for (int beat = 0; beat < 3; ++beat) EXPECT_EQ(message(), "WATCHDOG=1") << kiosk_->output();
  }
  // The program itself says that the heartbeat is overdue, and none comes any more.
  void expect_silence() {
    ControlClient control(folder_ / "control");
    ASSERT_TRUE(control.connected());
    EXPECT_TRUE(wait_until([&control] {
      return control.ask("status").find("\"heartbeat_late\":true") != std::string::npos;
    })) << kiosk_->output();
    expect_silence_alone();
  }
  void expect_silence_alone() {
    while (!message(0).empty()) {  // What was sent before the fault.
    }
    EXPECT_EQ(message(2000), "");
  }

  std::filesystem::path folder_;
  int socket_ = -1;
  std::unique_ptr<Background> kiosk_;
};

TEST_F(Supervised, ReadyThenBeatsThenAnOrderlyEnd) {
  start("none", "null");
  expect_beats();
  const auto asked = std::chrono::steady_clock::now();
  kiosk_->kill(SIGTERM);
  std::string last = message();
  while (last == "WATCHDOG=1") last = message();
  EXPECT_EQ(last, "STOPPING=1");
  const int status = kiosk_->exit_status();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - asked;
  std::printf("SIGTERM: ended after %.2f s\n", took.count());
  EXPECT_THAT(kiosk_->output(), HasSubstr(" 0 allocations after the seal"));
}

TEST_F(Supervised, NoFlipsNoHeartbeat) {
  start("surfaceless", "null");
  expect_beats();
  kiosk_->kill(SIGUSR1);
  expect_silence();
}

TEST_F(Supervised, NoInputNoHeartbeat) {
  start("none", "null");
  expect_beats();
  kiosk_->kill(SIGRTMIN);
  // The control socket is input too, and does not answer any more.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  expect_silence_alone();
}

// ALSA writes into a pipe that nobody reads: the device takes no more sound, without an error.
TEST_F(Supervised, SoundThatStandsStillNoHeartbeat) {
  if (!std::filesystem::exists(std::filesystem::path(CARYATID_PROGRAM).parent_path() /
                               "caryatid-voice"))
    GTEST_SKIP() << "needs caryatid-voice; install libespeak-ng-dev and build again";
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(::fcntl(reader, F_SETPIPE_SZ, 4096), 0);  // Full within a tenth of a second.
  write_file(folder_ / "asound", "pcm.stuck { type file slave.pcm quiet format raw file '" + pipe +
                                     "' }\n" + "pcm.quiet { type null }\n");
  start("none", "alsa:stuck");
  expect_beats();  // Nothing is to be heard: a silent device is no fault.
  {
    ControlClient control(folder_ / "control");
    EXPECT_EQ(control.ask("say One, two, three, four, five, six, seven, eight, nine, ten."), "ok");
  }
  expect_silence();
  // Even so it ends when it is told to.
  kiosk_->kill(SIGTERM);
  const int status = kiosk_->exit_status();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  ::close(reader);
}

// Under systemd every line goes to the journal with its event's name, in its own protocol. The
// journal is a socket of this test, put in the place of systemd's in a name space of its own.
TEST_F(Supervised, LinesGoToTheJournalByTheirNames) {
  if (std::system("unshare -Urm true 2>/dev/null") != 0)
    GTEST_SKIP() << "this system lets no user mount";
  const auto journal = folder_ / "journal";
  std::filesystem::create_directories(journal);
  const int lines = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const sockaddr_un address = address_of(journal / "socket");
  ASSERT_EQ(::bind(lines, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  write_file(folder_ / "kiosk.toml", "[[button]]\nname = 'a'\ngpio = 'NOWHERE'\nfeel = 'bliss'\n");
  const std::string command =
      "JOURNAL_STREAM=1:1 unshare -Urm sh -c 'mount --bind " + journal.string() +
      " /mnt && mount -t tmpfs run /run && mkdir -p /run/systemd/journal && "
      "mount --bind /mnt /run/systemd/journal && exec " +
      CARYATID_PROGRAM + " --display none --audio null --duration 0.2 --pack none.pack --config " +
      (folder_ / "kiosk.toml").string() + "' >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::string said;
  char line[2048];
  for (ssize_t n; (n = ::recv(lines, line, sizeof line, MSG_DONTWAIT)) > 0;)
    said.append(line, static_cast<std::size_t>(n));
  ::close(lines);
  for (const char* event : {"pack-refused", "button-lost", "text-refused"})
    EXPECT_THAT(said, HasSubstr("CARYATID_EVENT=" + std::string(event) + "\n"));
  EXPECT_THAT(said, HasSubstr("MESSAGE=none.pack: "));
  EXPECT_THAT(said, HasSubstr("PRIORITY=3\nSYSLOG_IDENTIFIER=caryatid\n"));
}

}  // namespace
}  // namespace caryatid::golden
