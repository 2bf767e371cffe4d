#include "firmware-app/last_good.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace caryatid::app {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_below(const fs::path& relative) {
  return !relative.empty() && relative.is_relative() && *relative.begin() != "..";
}

// Files of `names` as (name relative to folder, content).
std::vector<std::pair<fs::path, std::string>> read_all(const fs::path& folder,
                                                       const std::vector<std::string>& names) {
  std::vector<std::pair<fs::path, std::string>> all;
  for (const std::string& name : names) {
    const fs::path relative = fs::path(name).lexically_relative(folder);
    std::error_code error;
    if (is_below(relative) && fs::is_regular_file(name, error))
      all.emplace_back(relative, content_of(name));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool write(const fs::path& file, const std::string& content) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  return out.flush().good();
}

}  // namespace

std::string LastGood::config() const {
  if (state_.empty()) return {};
  // The second name is there when a power cut came between the two renames of keep().
  for (const char* name : {"last_good", "last_good.old"}) {
    const fs::path link = fs::path(state_) / name / "name";
    const std::string config = content_of(link);
    std::error_code error;
    const fs::path file = fs::path(state_) / name / config;
    if (!config.empty() && fs::is_regular_file(file, error)) return file.string();
  }
  return {};
}

bool LastGood::keep(const std::string& config, const std::vector<std::string>& files) const {
  if (state_.empty() || config.empty()) return true;
  fs::path folder = fs::path(config).parent_path();
  if (folder.empty()) folder = ".";
  std::vector<std::string> names = files;
  names.push_back(config);
  const auto all = read_all(folder, names);
  const fs::path now = fs::path(state_) / "last_good";
  const fs::path next = fs::path(state_) / "last_good.new",
                 old = fs::path(state_) / "last_good.old";
  const bool same = std::all_of(all.begin(), all.end(), [&now](const auto& file) {
    return content_of(now / file.first) == file.second;
  });
  if (same && this->config() == (now / fs::path(config).filename()).string()) return true;
  std::error_code error;
  fs::remove_all(next, error);
  bool good = write(next / "name", fs::path(config).filename().string());
  for (const auto& [name, content] : all) good = good && write(next / name, content);
  if (!good) return false;
  ::sync();  // Before the renames; at start, never in a frame.
  fs::remove_all(old, error);
  fs::rename(now, old, error);  // There may be none yet.
  error.clear();
  fs::rename(next, now, error);
  if (error) return false;
  fs::remove_all(old, error);
  return true;
}

}  // namespace caryatid::app
