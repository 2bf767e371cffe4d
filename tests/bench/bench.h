#pragma once
// What the benchmarks of this folder share. A benchmark registers itself with BENCHMARK(..) of
// Google Benchmark; its name starts with its room ("lod/step"), its label holds a hash of its
// result, so that faster-but-wrong shows.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <string>

namespace caryatid::bench {

// `print` is called once after all benchmarks have run: for tables that compare several of them.
// Returns true, so that a static variable can call it.
bool at_end(void (*print)());

inline std::string label_of(std::uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "hash %016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace caryatid::bench
