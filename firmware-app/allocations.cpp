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
extern "C" {
void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* block, std::size_t bytes);
void* __real__Znwm(std::size_t bytes);
void* __real__Znam(std::size_t bytes);

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
void* __wrap__Znwm(std::size_t bytes) {
  count();
  return __real__Znwm(bytes);
}
void* __wrap__Znam(std::size_t bytes) {
  count();
  return __real__Znam(bytes);
}
}

namespace caryatid::app {

void seal_heap() { g_sealed = true; }
std::uint64_t allocations_since_seal() { return g_count; }

}  // namespace caryatid::app
