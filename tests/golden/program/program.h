#pragma once
// Runs the built caryatid with arguments and gives what it said.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace caryatid::golden {

struct Outcome {
  int exit_code = -1;
  std::string output;  // stdout and stderr.
};

// before: for the shell, in front of the program.
inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  Outcome run;
  const std::string command = before + std::string(CARYATID_PROGRAM) + " " + arguments + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return run;
  char piece[512];
  while (std::fgets(piece, sizeof piece, pipe) != nullptr) run.output += piece;
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

// An empty folder of this test run.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("caryatid_golden_" + std::to_string(getpid()) + "_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::filesystem::path write_file(const std::filesystem::path& file,
                                        const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

inline const std::string kSource = CARYATID_SOURCE_DIR;
inline const std::string kBuiltin = kSource + "/firmware-app/builtin_face.pack";

}  // namespace caryatid::golden
