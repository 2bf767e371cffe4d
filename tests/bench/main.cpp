// caryatid-bench: every benchmark of the project. Exit codes: 0 done, 2 wrong usage.
#include <cstring>
#include <string>
#include <vector>

#include "tests/bench/bench.h"

namespace caryatid::bench {
namespace {

std::vector<void (*)()>& endings() {
  static std::vector<void (*)()> list;
  return list;
}

int usage(std::FILE* out) {
  std::fputs(
      "caryatid-bench [--filter NAME] [--json FILE] [--benchmark_...]\n"
      "Runs the benchmarks whose name holds the regular expression NAME; --benchmark_list_tests\n"
      "lists them. Every line ends with a hash of its result.\n"
      "Example: caryatid-bench --filter lod --json lod.json\n",
      out);
  return out == stdout ? 0 : 2;
}

}  // namespace

bool at_end(void (*print)()) {
  endings().push_back(print);
  return true;
}

}  // namespace caryatid::bench

int main(int argc, char** argv) {
  using namespace caryatid::bench;
  std::vector<std::string> arguments{argv[0]};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--help" || word == "-h") return usage(stdout);
    if (word == "--filter" || word == "--json") {
      if (++i == argc) return usage(stderr);
      if (word == "--filter") {
        arguments.push_back("--benchmark_filter=" + std::string(argv[i]));
      } else {
        arguments.push_back("--benchmark_out=" + std::string(argv[i]));
        arguments.push_back("--benchmark_out_format=json");
      }
      continue;
    }
    arguments.push_back(word);
  }
  std::vector<char*> words;
  for (std::string& a : arguments) words.push_back(a.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data());
  if (benchmark::ReportUnrecognizedArguments(count, words.data())) return usage(stderr);
  benchmark::RunSpecifiedBenchmarks();
  for (void (*print)() : endings()) print();
  benchmark::Shutdown();
  return 0;
}
