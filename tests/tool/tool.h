#pragma once
// Runs the built caryatid-tool in a folder of its own and gives what it said.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace caryatid::tool_test {

struct Outcome {
  int exit_code = -1;
  std::string output;  // stdout and stderr.
};

// Each test works in an empty folder with a tetrahedron, s.obj, and a second of a talk, t.fap.
class Tool : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("caryatid_tool_" + std::to_string(getpid()) + "_" + test->name());
    std::filesystem::create_directories(folder_);
    write("s.obj",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    ASSERT_EQ(run("fba track -o t.fap --seconds 1").exit_code, 0);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Outcome run(const std::string& arguments) const {
    Outcome run;
    const std::string command =
        "cd " + folder_.string() + " && " CARYATID_TOOL " " + arguments + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return run;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) run.output += static_cast<char>(c);
    const int status = pclose(pipe);
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return run;
  }

  // One line with these words in it.
  void refuses(const std::string& arguments, int exit_code, const std::string& words) const {
    const Outcome got = run(arguments);
    EXPECT_EQ(got.exit_code, exit_code) << arguments << "\n" << got.output;
    EXPECT_TRUE(got.output.starts_with("caryatid-tool: ")) << arguments << "\n" << got.output;
    EXPECT_EQ(got.output.find('\n') + 1, got.output.size()) << arguments << "\n" << got.output;
    EXPECT_NE(got.output.find(words), std::string::npos) << arguments << "\n" << got.output;
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string content(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  std::filesystem::path folder_;
  const std::string pack_ = std::string(CARYATID_SOURCE_DIR) + "/firmware-app/builtin_face.pack";
};

}  // namespace caryatid::tool_test
