#include "platform/buttons/hidapi/hid_search.h"

namespace caryatid::platform {

HidFound search_hid(const HidDevice& wanted) {
  HidFound out;
  hid_device_info* const listed = hid_enumerate(wanted.vendor_id, wanted.product_id);
  for (const hid_device_info* info = listed; info != nullptr; info = info->next) {
    if (wanted.usage_page != 0 && info->usage_page != wanted.usage_page) continue;
    if (wanted.usage != 0 && info->usage != wanted.usage) continue;
    out.handle = hid_open_path(info->path);
    if (out.handle != nullptr) break;
    out.fault = HidFault::no_permission;
  }
  hid_free_enumeration(listed);
  if (out.handle != nullptr) out.fault = HidFault::none;
  return out;
}

bool HidSearcher::start() {
  running_ = ::pthread_create(&thread_, nullptr, thread_main, this) == 0;
  return running_;
}

void HidSearcher::stop() {
  if (!running_) return;
  ::pthread_mutex_lock(&mutex_);
  ending_ = true;
  ::pthread_cond_signal(&change_);
  ::pthread_mutex_unlock(&mutex_);
  ::pthread_join(thread_, nullptr);
  running_ = false;
  for (Slot& slot : slots_)
    if (slot.state == State::answered && slot.found.handle != nullptr) hid_close(slot.found.handle);
}

void HidSearcher::ask(std::size_t slot, const HidDevice& wanted) {
  ::pthread_mutex_lock(&mutex_);
  slots_[slot] = {State::asked, &wanted, {}};
  ::pthread_cond_signal(&change_);
  ::pthread_mutex_unlock(&mutex_);
}

bool HidSearcher::take(std::size_t slot, HidFound* out) {
  ::pthread_mutex_lock(&mutex_);
  const bool answered = slots_[slot].state == State::answered;
  if (answered) {
    *out = slots_[slot].found;
    slots_[slot] = {};
  }
  ::pthread_mutex_unlock(&mutex_);
  return answered;
}

void* HidSearcher::thread_main(void* self) {
  static_cast<HidSearcher*>(self)->run();
  return nullptr;
}

void HidSearcher::run() {
  ::pthread_mutex_lock(&mutex_);
  while (!ending_) {
    Slot* next = nullptr;
    for (Slot& slot : slots_)
      if (slot.state == State::asked) next = &slot;
    if (next == nullptr) {
      ::pthread_cond_wait(&change_, &mutex_);
      continue;
    }
    next->state = State::searching;
    ::pthread_mutex_unlock(&mutex_);
    const HidFound found = search_hid(*next->wanted);
    ::pthread_mutex_lock(&mutex_);
    next->found = found;
    next->state = State::answered;
  }
  ::pthread_mutex_unlock(&mutex_);
}

}  // namespace caryatid::platform
