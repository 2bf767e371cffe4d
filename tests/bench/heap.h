#pragma once
// Bytes on the heap, counted by operator new of caryatid-bench: what a method needs at its peak.
#include <cstddef>

namespace caryatid::bench {

std::size_t heap_bytes();
std::size_t heap_peak_bytes();
void reset_heap_peak();  // The peak starts again from heap_bytes().

}  // namespace caryatid::bench
