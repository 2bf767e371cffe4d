#include "platform/control/control.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace caryatid::platform {
namespace {

class ControlTest : public testing::Test {
 protected:
  std::string path_ = testing::TempDir() + "caryatid_ctl_" + std::to_string(::getpid());
  Control control_;
  ErrorLine error_;
  std::vector<std::string> seen_;

  void SetUp() override { ASSERT_TRUE(control_.open(path_.c_str(), error_).ok()); }
  void poll() {
    control_.poll(this, [](void* self, std::span<const char> line, ControlReply& reply) {
      static_cast<ControlTest*>(self)->seen_.emplace_back(line.data(), line.size());
      reply.assign(std::string_view("ok"));
    });
  }
};

class Client {
 public:
  explicit Client(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path.c_str());
    connected_ =
        ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Client() { ::close(socket_); }
  bool connected() const { return connected_; }
  void send(std::string_view text) {
    (void)!::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  }
  // What has come; "" when nothing, "end" when the other side is gone.
  std::string receive() {
    char text[4096];
    const ssize_t n = ::recv(socket_, text, sizeof text, MSG_DONTWAIT);
    return n > 0 ? std::string(text, static_cast<std::size_t>(n)) : n == 0 ? "end" : "";
  }

 private:
  int socket_;
  bool connected_ = false;
};

TEST_F(ControlTest, AnswersEachLine) {
  Client client(path_);
  ASSERT_TRUE(client.connected());
  client.send("press joy\r\nstatus\n");
  poll();
  EXPECT_EQ(seen_, (std::vector<std::string>{"press joy", "status"}));
  EXPECT_EQ(client.receive(), "ok\nok\n");
}

TEST_F(ControlTest, JoinsWhatComesInPieces) {
  Client client(path_);
  client.send("pre");
  poll();
  client.send("ss joy");
  poll();
  EXPECT_TRUE(seen_.empty());
  client.send("\n");
  poll();
  EXPECT_EQ(seen_, std::vector<std::string>{"press joy"});
}

TEST_F(ControlTest, ALineThatIsTooLongIsOneError) {
  Client client(path_);
  client.send(std::string(3 * Control::kMaxLineBytes, 'x') + "\nstatus\n");
  poll();
  EXPECT_EQ(seen_, std::vector<std::string>{"status"});
  EXPECT_EQ(client.receive().substr(0, 6), "error:");
}

TEST_F(ControlTest, AFloodIsSpreadOverFrames) {
  Client client(path_);
  for (int i = 0; i < 40; ++i) client.send("status\n");
  poll();
  EXPECT_EQ(seen_.size(), std::size_t{Control::kMaxLinesPerPoll});
  poll();
  poll();
  EXPECT_EQ(seen_.size(), 40u);
}

TEST_F(ControlTest, TheOneSilentTheLongestMakesRoom) {
  std::vector<std::unique_ptr<Client>> clients;
  for (std::size_t i = 0; i < Control::kMaxClients; ++i) {
    clients.push_back(std::make_unique<Client>(path_));
    poll();
  }
  clients[0]->send("status\n");
  poll();
  EXPECT_EQ(clients[0]->receive(), "ok\n");
  Client late(path_);
  late.send("status\n");
  poll();
  poll();
  EXPECT_EQ(late.receive(), "ok\n");
  EXPECT_EQ(clients[1]->receive(),
            "error: silent the longest while another wants to speak; goodbye\n");
  clients[0]->send("status\n");
  poll();
  EXPECT_EQ(clients[0]->receive(), "ok\n");
}

TEST_F(ControlTest, ALivingSocketAndOtherFilesAreLeftAlone) {
  Control second;
  EXPECT_FALSE(second.open(path_.c_str(), error_).ok());
  EXPECT_NE(std::string_view(error_.c_str()).find("end the other caryatid"),
            std::string_view::npos);
  Client client(path_);
  EXPECT_TRUE(client.connected());
  const std::string file = path_ + ".txt";
  std::ofstream(file) << "precious";
  EXPECT_FALSE(second.open(file.c_str(), error_).ok());
  EXPECT_EQ(::access(file.c_str(), F_OK), 0);
  ::unlink(file.c_str());
}

TEST(ControlFile, ADeadSocketIsReplacedAndTakenAwayAtTheEnd) {
  const std::string path = testing::TempDir() + "caryatid_dead_" + std::to_string(::getpid());
  const int s = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path.c_str());
  ASSERT_EQ(::bind(s, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(s);  // As after kill -9: the file stays.
  ErrorLine error;
  {
    Control control;
    EXPECT_TRUE(control.open(path.c_str(), error).ok()) << error.c_str();
    EXPECT_TRUE(Client(path).connected());
  }
  EXPECT_NE(::access(path.c_str(), F_OK), 0);
}

TEST(ControlFile, APathThatIsTooLongIsRefused) {
  Control control;
  ErrorLine error;
  EXPECT_EQ(control.open(std::string(200, 'a').c_str(), error).code, Code::invalid_argument);
}

}  // namespace
}  // namespace caryatid::platform
