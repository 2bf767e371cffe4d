#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace caryatid {

// CRC-32C (Castagnoli, reflected, as in iSCSI RFC 3720). Finds SD-card rot, not attackers.
// Start with 0; feed the previous result to go on over split input. O(bytes), 4 KiB of table.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t previous = 0);

// FNV-1a, 64 bits: the project's hash for poses, draw lists and benchmark results.
inline constexpr std::uint64_t kHashSeed = 14695981039346656037ull;
constexpr std::uint64_t hash_bytes(std::span<const std::byte> bytes,
                                   std::uint64_t hash = kHashSeed) {
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 1099511628211ull;
  return hash;
}
template <class T>
std::uint64_t hash_of(std::span<const T> values, std::uint64_t hash = kHashSeed) {
  return hash_bytes(std::as_bytes(values), hash);
}

}  // namespace caryatid
