#include "tests/bench/heap.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace caryatid::bench {
namespace {

std::size_t live = 0, peak = 0;

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  live += malloc_usable_size(p);
  if (live > peak) peak = live;
  return p;
}

void release(void* p) {
  if (p != nullptr) live -= malloc_usable_size(p);
  std::free(p);
}

}  // namespace

std::size_t heap_bytes() { return live; }
std::size_t heap_peak_bytes() { return peak; }
void reset_heap_peak() { peak = live; }

}  // namespace caryatid::bench

void* operator new(std::size_t n) { return caryatid::bench::counted(std::malloc(n)); }
void* operator new(std::size_t n, std::align_val_t a) {
  const auto to = static_cast<std::size_t>(a);
  return caryatid::bench::counted(std::aligned_alloc(to, (n + to - 1) / to * to));
}
void operator delete(void* p) noexcept { caryatid::bench::release(p); }
void operator delete(void* p, std::size_t) noexcept { caryatid::bench::release(p); }
void operator delete(void* p, std::align_val_t) noexcept { caryatid::bench::release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  caryatid::bench::release(p);
}
