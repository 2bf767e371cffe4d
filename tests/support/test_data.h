#pragma once
// Data of others, kept beside the project: CARYATID_TEST_DATA names its folder. Tests that need it
// skip without it, and each has a sibling on data of our own.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace caryatid::test {

// The folder, empty when the variable is not set or the part is not there.
inline std::filesystem::path test_data(const char* part) {
  const char* root = std::getenv("CARYATID_TEST_DATA");
  if (root == nullptr) return {};
  const std::filesystem::path path = std::filesystem::path(root) / part;
  return std::filesystem::exists(path) ? path : std::filesystem::path{};
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace caryatid::test

// Inside a TEST: the folder, or the test is skipped with a clear line.
#define CARYATID_NEED_TEST_DATA(variable, part)                             \
  const std::filesystem::path variable = ::caryatid::test::test_data(part); \
  if (variable.empty()) GTEST_SKIP() << "needs " << part << " under $CARYATID_TEST_DATA"
