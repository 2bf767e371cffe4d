#include "firmware-app/allocations.h"

#include <atomic>
#include <cstddef>
#include <new>

namespace {
std::atomic<bool> g_sealed{false};
std::atomic<std::uint64_t> g_count{0};

void count() {
  if (g_sealed.load(std::memory_order_relaxed)) g_count.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// Names are the linker's: --wrap=X resolves X to __wrap_X and __real_X to X.
// operator new(std::size_t) is _Znwm or _Znwj, as std::size_t is unsigned long or unsigned int.
#if __SIZEOF_SIZE_T__ == 8
#define CARYATID_NEW(name) name##m
#else
#define CARYATID_NEW(name) name##j
#endif
extern "C" {
void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* block, std::size_t bytes);
void* CARYATID_NEW(__real__Znw)(std::size_t bytes);
void* CARYATID_NEW(__real__Zna)(std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  count();
  return __real_malloc(bytes);
}
void* __wrap_calloc(std::size_t n, std::size_t bytes) {
  count();
  return __real_calloc(n, bytes);
}
void* __wrap_realloc(void* block, std::size_t bytes) {
  count();
  return __real_realloc(block, bytes);
}
void* CARYATID_NEW(__wrap__Znw)(std::size_t bytes) {
  count();
  return CARYATID_NEW(__real__Znw)(bytes);
}
void* CARYATID_NEW(__wrap__Zna)(std::size_t bytes) {
  count();
  return CARYATID_NEW(__real__Zna)(bytes);
}
}

namespace caryatid::app {

void seal_heap() { g_sealed = true; }
std::uint64_t allocations_since_seal() { return g_count; }

}  // namespace caryatid::app
