#pragma once
#include <cstdint>

namespace caryatid::app {

// Counts heap allocations that code of ours makes after memory is sealed. The linker's --wrap sends
// malloc, calloc, realloc and operator new of our own objects here; those inside Mesa, libc or
// other shared libraries are not ours and not counted (README says where the border runs).
void seal_heap();
std::uint64_t allocations_since_seal();

}  // namespace caryatid::app
