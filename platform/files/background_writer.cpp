#include "platform/files/background_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace caryatid::platform {
namespace {

int write_all(int descriptor, std::span<const char> content) {
  while (!content.empty()) {
    const ssize_t n = ::write(descriptor, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n < 0 ? errno : EIO;
    content = content.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

// A rename is on the disk only when its folder is.
int sync_folder_of(const char* path) {
  FixedString<255> folder;
  const char* slash = std::strrchr(path, '/');
  if (slash == nullptr)
    folder.assign(std::span<const char>(".", 1));
  else
    folder.assign({path, slash == path ? 1 : static_cast<std::size_t>(slash - path)});
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

int replace_file(const char* path, std::span<const char> content, bool durable) {
  char scratch[256];
  if (std::snprintf(scratch, sizeof scratch, "%s.new", path) >= static_cast<int>(sizeof scratch))
    return ENAMETOOLONG;
  const int descriptor = ::open(scratch, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, content);
  if (error == 0 && durable && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(scratch, path) != 0) error = errno;
  if (error == 0 && durable) error = sync_folder_of(path);
  if (error != 0) (void)::unlink(scratch);
  return error;
}

Result<std::size_t> BackgroundWriter::add(const char* path, bool durable) {
  File file;
  file.path.assign({path, std::strlen(path)});
  file.durable = durable;
  if (file.path.size() != std::strlen(path) || !files_.push(file))
    return {{Code::out_of_capacity}, 0};
  return {{}, files_.size() - 1};
}

Status BackgroundWriter::start() {
  const int error = ::pthread_create(&thread_, nullptr, run, this);
  if (error != 0) return {Code::io, static_cast<std::uint16_t>(error)};
  running_ = true;
  return {};
}

void BackgroundWriter::stop() {
  if (!running_) return;
  ::pthread_mutex_lock(&mutex_);
  ending_ = true;
  ::pthread_cond_signal(&change_);
  ::pthread_mutex_unlock(&mutex_);
  ::pthread_join(thread_, nullptr);
  running_ = false;
}

Status BackgroundWriter::put(std::size_t file, std::span<const char> content) {
  if (file >= files_.size()) return {Code::invalid_argument};
  if (content.size() > kMaxFileBytes) return {Code::out_of_capacity};
  ::pthread_mutex_lock(&mutex_);
  File& f = files_[file];
  std::memcpy(f.content.data(), content.data(), content.size());
  f.size = content.size();
  f.waiting = true;
  const std::uint16_t error = f.error;
  f.error = 0;
  ::pthread_cond_signal(&change_);
  ::pthread_mutex_unlock(&mutex_);
  return error == 0 ? Status{} : Status{Code::io, error};
}

void* BackgroundWriter::run(void* self) {
  static_cast<BackgroundWriter*>(self)->work();
  return nullptr;
}

void BackgroundWriter::work() {
  ::pthread_mutex_lock(&mutex_);
  for (;;) {
    File* next = nullptr;
    for (File& f : files_)
      if (f.waiting) next = &f;
    if (next == nullptr && ending_) break;
    if (next == nullptr) {
      ::pthread_cond_wait(&change_, &mutex_);
      continue;
    }
    next->waiting = false;
    const std::size_t size = next->size;
    std::memcpy(copy_.data(), next->content.data(), size);
    ::pthread_mutex_unlock(&mutex_);
    const int error = replace_file(next->path.c_str(), {copy_.data(), size}, next->durable);
    ::pthread_mutex_lock(&mutex_);
    next->error = static_cast<std::uint16_t>(error);
  }
  ::pthread_mutex_unlock(&mutex_);
}

}  // namespace caryatid::platform
