#pragma once
// Whole files in and out, for every reader and writer of the host tools: one place that knows what
// can go wrong and says it. Errors: std::runtime_error, one line "FILE: what is wrong; cure".
#include <filesystem>
#include <string>
#include <string_view>

namespace caryatid::bake {

// What keeps a file from being read, or from being made or replaced; empty: nothing does. Looks
// and changes nothing, so that a tool can ask before its work. O(1).
std::string why_unreadable(const std::filesystem::path& path);
std::string why_unwritable(const std::filesystem::path& path);

// All bytes of a file or pipe; an empty file gives an empty string.
std::string read_file(const std::filesystem::path& path);
// Writes beside, then renames, so that a cut never leaves half a file; nothing is left beside on
// failure. Devices and pipes are written as they stand.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace caryatid::bake
