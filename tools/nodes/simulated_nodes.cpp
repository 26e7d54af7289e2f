// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/simulated_nodes.hpp"

#include <dlfcn.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/exec/exec.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

// Of a use of a primitive with what is around it: so a message takes some tenths of a millisecond from node to node, as
// on a robot's computer. And loops that poll, as roscpp's and rospy's at their ends, end after fewer rounds.
constexpr Duration call_cost = std::chrono::microseconds(5);

/// Where nodes write their logs: what earlier runs have left there would be part of the run.
class LogFolder {
 public:
  LogFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "waitpoint-ros-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw BadInput(name, std::string("cannot be made: ") + std::strerror(errno));
    path_ = name;
    setenv("ROS_HOME", name.c_str(), 1);
    setenv("ROS_LOG_DIR", name.c_str(), 1);
  }
  ~LogFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  LogFolder(const LogFolder&) = delete;
  LogFolder& operator=(const LogFolder&) = delete;

 private:
  std::filesystem::path path_;
};

}  // namespace

bool is_among_nodes() {
  static const bool is_simulated = [] {
    for (const char* const layer : {"libwaitpoint-exec.so", "libwaitpoint-exec-races.so"}) {
      try {
        if (dlopen(find_part(layer).c_str(), RTLD_LAZY | RTLD_NOLOAD) != nullptr) return true;
      } catch (const BadInput&) {  // there is none
      }
    }
    return false;
  }();
  return is_simulated;
}

int run_among_nodes(std::span<const std::string> arguments, std::uint64_t seed, Report report) {
  ExecOptions options;
  options.seed = seed;
  options.conditions.call_cost = call_cost;
  options.quiet = report == Report::none;
  options.words = {std::filesystem::read_symlink("/proc/self/exe").string()};
  options.words.insert(options.words.end(), arguments.begin(), arguments.end());
  const LogFolder logs;
  const double begin_s = wall_clock_s();
  const int status = exec(options);
  if (report == Report::at_end)
    std::fprintf(stderr, "waitpoint: the run with its nodes took %.1f s\n", wall_clock_s() - begin_s);
  return status;
}

}  // namespace waitpoint::tools
