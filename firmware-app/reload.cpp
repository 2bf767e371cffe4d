#include "firmware-app/reload.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "firmware-app/builtin.h"
#include "firmware-app/texts/compile.h"
#include "platform/log/log.h"

extern char** environ;

namespace caryatid::app {

Reload::~Reload() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  if (pipe_ >= 0) close(pipe_);
}

void Reload::watch(const std::string& config, const std::vector<std::string>& files) {
  config_.assign(config);
  files_.clear();
  for (const std::string& name : files) {
    File file;
    file.name.assign(name);
    look_at(&file);
    (void)files_.push(file);
  }
}

// A file that is away counts as empty.
void Reload::look_at(File* file) {
  struct stat s {};
  const bool there = stat(file->name.c_str(), &s) == 0;
  file->changed = there ? s.st_mtim : timespec{};
  file->bytes = there ? s.st_size : 0;
}

bool Reload::look() {
  bool changed = false;
  for (File& file : files_) {
    File now = file;
    look_at(&now);
    changed = changed || !(now == file);
    file = now;
  }
  return changed;
}

Reload::State Reload::poll(std::int64_t now_us, std::span<std::byte> slot, std::size_t* out_bytes) {
  if (child_ > 0) return read(now_us, slot, out_bytes);
  if (files_.empty() || now_us < next_look_us_) return State::quiet;
  next_look_us_ = now_us + kLook_us;
  const bool changed = look();
  if (changed_ && !changed) spawn(now_us);
  changed_ = changed;
  return State::quiet;
}

void Reload::spawn(std::int64_t now_us) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return;
  // The child's own end waits when the pipe is full.
  (void)fcntl(ends[1], F_SETFL, 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  char program[] = "caryatid", option[] = "--compile-programme";
  std::array<char, 256> config{};
  std::copy_n(config_.c_str(), config_.size(), config.data());
  char* arguments[] = {program, option, config.data(), nullptr};
  const int why = posix_spawn(&child_, "/proc/self/exe", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  pipe_ = ends[0];
  bytes_ = 0;
  limit_us_ = now_us + kLimit_us;
  if (why == 0) return;
  platform::log(platform::Event::text_refused,
                "changed texts can't be compiled now; start again to use them");
  child_ = -1;
  (void)finish(false);
}

Reload::State Reload::finish(bool good) {
  close(pipe_);
  pipe_ = -1;
  child_ = -1;
  return good ? State::ready : State::failed;
}

Reload::State Reload::read(std::int64_t now_us, std::span<std::byte> slot, std::size_t* out_bytes) {
  ssize_t got = 0;
  while (bytes_ < slot.size() &&
         (got = ::read(pipe_, slot.data() + bytes_, slot.size() - bytes_)) > 0)
    bytes_ += static_cast<std::size_t>(got);
  const bool over = now_us > limit_us_ || bytes_ == slot.size();
  if (over) kill(child_, SIGKILL);
  if (got < 0 && (errno == EAGAIN || errno == EINTR) && !over) return State::quiet;
  int status = 0;
  if (waitpid(child_, &status, over ? 0 : WNOHANG) == 0) return State::quiet;
  *out_bytes = bytes_;
  return finish(!over && WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int compile_to_stdout(const std::string& config) {
  const Result<pack::FontView> font = pack::read_font(builtin_font());
  if (!font.ok()) return 1;
  ProgrammeFiles files(config, builtin_programme());
  const CompiledProgramme compiled = compile_programme(files, font.value);
  for (const Message& m : compiled.messages.all())
    platform::log(platform::Event::text_refused, "%s", m.line.c_str());
  if (compiled.messages.any_wrong() || compiled.block.empty()) return 1;
  const std::size_t n = std::fwrite(compiled.block.data(), 1, compiled.block.size(), stdout);
  return n == compiled.block.size() && std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace caryatid::app
