#pragma once
// The built caryatid as a child that goes on while the test talks to it: signals, the control
// socket, the supervisor's socket.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/golden/program/program.h"

extern char** environ;

namespace caryatid::golden {

// Far beyond what any machine needs; what is waited for comes or the test fails.
inline constexpr int kPatience_ms = 60'000;

// True as soon as `condition` holds.
template <class Condition>
bool wait_until(Condition condition, int patience_ms = kPatience_ms) {
  for (int waited_ms = 0; waited_ms < patience_ms; waited_ms += 20) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

class Background {
 public:
  // environment: NAME=VALUE beside the test's own. Output goes to `log`.
  Background(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
             std::filesystem::path log)
      : log_(std::move(log)) {
    std::vector<std::string> texts{CARYATID_PROGRAM};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv, envp;
    for (std::string& text : texts) argv.push_back(text.data());
    std::vector<std::string> variables = environment;
    for (std::string& text : variables) envp.push_back(text.data());
    for (char** e = environ; *e != nullptr; ++e) envp.push_back(*e);
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    if (posix_spawn(&child_, CARYATID_PROGRAM, &files, nullptr, argv.data(), envp.data()) != 0)
      child_ = -1;
    posix_spawn_file_actions_destroy(&files);
  }
  ~Background() {
    if (child_ <= 0) return;
    kill(SIGKILL);
    (void)exit_status();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  pid_t pid() const { return child_; }
  void kill(int number) const {
    if (child_ > 0) ::kill(child_, number);
  }
  // Waits for its end; as waitpid's status, -1 where it does not end.
  int exit_status() {
    int status = -1;
    const bool ended = child_ > 0 && wait_until([this, &status] {
                         return waitpid(child_, &status, WNOHANG) == child_;
                       });
    if (ended) child_ = -1;
    return ended ? status : -1;
  }
  std::string output() const { return content(log_); }

 private:
  std::filesystem::path log_;
  pid_t child_ = -1;
};

// A Unix socket's address.
inline sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.string().copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

// One connection to --control.
class ControlClient {
 public:
  explicit ControlClient(const std::filesystem::path& path) {
    (void)wait_until([this, &path] {
      socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
      const sockaddr_un address = address_of(path);
      if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
        return true;
      ::close(socket_);
      socket_ = -1;
      return false;
    });
  }
  ~ControlClient() {
    if (socket_ >= 0) ::close(socket_);
  }
  ControlClient(const ControlClient&) = delete;
  ControlClient& operator=(const ControlClient&) = delete;

  bool connected() const { return socket_ >= 0; }
  int descriptor() const { return socket_; }
  bool send(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  // The next line, without its end; empty where none comes.
  std::string line() {
    for (;;) {
      const std::size_t end = held_.find('\n');
      if (end != std::string::npos) {
        const std::string out = held_.substr(0, end);
        held_.erase(0, end + 1);
        return out;
      }
      pollfd waiting{socket_, POLLIN, 0};
      char piece[2048];
      if (::poll(&waiting, 1, kPatience_ms) <= 0) return "";
      const ssize_t n = ::recv(socket_, piece, sizeof piece, 0);
      if (n <= 0) return "";
      held_.append(piece, static_cast<std::size_t>(n));
    }
  }
  std::string ask(const std::string& command) { return send(command + "\n") ? line() : ""; }

 private:
  int socket_ = -1;
  std::string held_;
};

}  // namespace caryatid::golden
