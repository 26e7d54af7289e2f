// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/seed_with_nodes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "modules/run/ranks/archive.hpp"
#include "modules/run/ranks/results.hpp"
#include "tools/nodes/simulated_nodes.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* result_variable = "WAITPOINT_RESULT_OF_SEED";

// Without the options of the series.
std::vector<std::string> arguments_of_one(std::span<const std::string> arguments, std::uint64_t seed) {
  constexpr std::string_view of_series[] = {"--seeds", "--jobs", "--summary"};
  std::vector<std::string> one;
  one.reserve(arguments.size() + 2);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = std::string_view(arguments[i]).substr(0, arguments[i].find('='));
    if (std::ranges::find(of_series, name) == std::end(of_series))
      one.push_back(arguments[i]);
    else if (name == arguments[i])
      ++i;
  }
  one.emplace_back("--seed");
  one.push_back(std::to_string(seed));
  return one;
}

/// Scope in which the standard output shows nothing.
class HiddenOutput {
 public:
  HiddenOutput() : shown_(dup(STDOUT_FILENO)) {
    std::fflush(stdout);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing < 0) return;
    dup2(nothing, STDOUT_FILENO);
    close(nothing);
  }
  ~HiddenOutput() {
    if (shown_ < 0) return;
    dup2(shown_, STDOUT_FILENO);
    close(shown_);
  }
  HiddenOutput(const HiddenOutput&) = delete;
  HiddenOutput& operator=(const HiddenOutput&) = delete;

 private:
  int shown_;
};

/// An empty file, which is removed in the end.
class ResultFile {
 public:
  ResultFile() : path_((std::filesystem::temp_directory_path() / "waitpoint-result-XXXXXX").string()) {
    const int made = mkstemp(path_.data());
    if (made < 0) throw BadInput(path_, std::string("cannot be made: ") + std::strerror(errno));
    close(made);
    setenv(result_variable, path_.c_str(), 1);
  }
  ~ResultFile() {
    unsetenv(result_variable);
    unlink(path_.c_str());
  }
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string path_;
};

}  // namespace

bridge::RunResult run_seed_with_nodes(std::span<const std::string> arguments, std::uint64_t seed) {
  const ResultFile file;
  int status = 0;
  const double begin_s = wall_clock_s();
  {
    const HiddenOutput hidden;
    status = run_among_nodes(arguments_of_one(arguments, seed), seed, Report::none);
  }
  const std::string bytes = file.bytes();
  if (bytes.empty()) throw std::runtime_error(fmt::format("the run with nodes ended with status {}", status));
  bridge::RunResult result;
  run::Unpacking unpacking(bytes);
  unpacking(result);
  result.wall_s = wall_clock_s() - begin_s;
  result.real_time_factor = result.simulated.seconds() / result.wall_s;
  return result;
}

void leave_result(bridge::RunResult& result) {
  const char* const path = std::getenv(result_variable);
  if (path == nullptr) return;
  run::Packing packing;
  packing(result);
  std::ofstream(path, std::ios::binary) << packing.bytes();
}

}  // namespace waitpoint::tools
