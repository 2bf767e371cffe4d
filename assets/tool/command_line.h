#pragma once
// What all sub-commands share: how they say that they were called wrongly, and files that are
// looked at before the work begins, so that nothing is found out, and nothing lost, minutes later.
#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace caryatid::tool {

// Wrong usage (exit code 2), found out after the command line was parsed. One line.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The option names files that are read; on_run() looks whether that is possible.
CLI::Option* reads(CLI::Option* option);
// As reads(), for FILE or FILE@FRAME.
CLI::Option* reads_frame(CLI::Option* option);
// The option names a file that is written, with one of these endings (none: any).
CLI::Option* writes(CLI::Option* option, const std::vector<std::string>& endings = {});

// The work of a sub-command: behind claim() with all its files.
void on_run(CLI::App* cmd, const std::function<void()>& work);

// Throws unless every input can be read, every output can be written, and no output is an input or
// another output, by whatever name. For commands that make up names of their own.
void claim(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

// FILE and FRAME of "FILE@FRAME"; frame 0 without it, or where a file has that whole name.
struct FrameName {
  std::string path;
  std::size_t frame = 0;
};
FrameName frame_name(const std::string& text);

// Text that was said by someone: UTF-8 with something to say in it. Throws UsageError.
void check_text(const std::string& option, const std::string& text);

// For terminals: control bytes and what is no UTF-8 as \xNN, so that a file's bytes do nothing.
std::string printable(const std::string& text);
// A line on stderr for something that was mended or left out.
void warn(const std::string& line);

}  // namespace caryatid::tool
