// Runs a fuzz target over kept inputs without libFuzzer: each file whole, cut at every length and
// with every bit flipped. usage: NAME_fuzz [FILE-OR-FOLDER]...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

// Work for each file: bounded, so that a large file does not stall the test list.
constexpr std::size_t kMostVariants = 4000;
constexpr std::size_t kMostBytes = 64u << 20;

void run_one(const std::uint8_t* data, std::size_t size) {
  // A copy of exactly this size, so that the sanitizer sees a read past the end.
  const Bytes exact(data, data + size);
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

void run_variants(Bytes bytes) {
  run_one(bytes.data(), bytes.size());
  if (bytes.empty()) return;
  const std::size_t variants =
      std::clamp<std::size_t>(kMostBytes / bytes.size(), 16, kMostVariants);
  const std::size_t cut_step = bytes.size() / variants + 1;
  for (std::size_t length = 0; length < bytes.size(); length += cut_step)
    run_one(bytes.data(), length);
  const std::size_t bit_step = bytes.size() * 8 / variants + 1;
  for (std::size_t bit = 0; bit < bytes.size() * 8; bit += bit_step) {
    const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
    bytes[bit / 8] ^= mask;
    run_one(bytes.data(), bytes.size());
    bytes[bit / 8] ^= mask;
  }
}

bool run_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "%s: cannot be read\n", path.c_str());
    return false;
  }
  run_variants(Bytes(std::istreambuf_iterator<char>(file), {}));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  run_one(nullptr, 0);
  std::size_t count = 0;
  bool all_read = true;
  for (int i = 1; i < argc; ++i) {
    if (!std::filesystem::is_directory(argv[i])) {
      all_read = run_file(argv[i]) && all_read;
      ++count;
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      all_read = run_file(entry.path()) && all_read;
      ++count;
    }
  }
  std::printf("%zu kept inputs, cut and flipped\n", count);
  return all_read ? 0 : 1;
}
