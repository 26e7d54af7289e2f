// SPDX-License-Identifier: BSD-3-Clause
#include "tools/nodes/simulated_nodes.hpp"

#include <dlfcn.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/error.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/shell_words.hpp"
#include "tools/exec/exec.hpp"
#include "tools/nodes/log_folder.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
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

ProgramConditions conditions_of_nodes() {
  // With the code around a use of a primitive: so a message takes some tenths of a millisecond from node to node, as on
  // a robot's computer. And loops that poll, as roscpp's and rospy's at their ends, end after fewer rounds.
  constexpr Duration call_cost = std::chrono::microseconds(5);
  ProgramConditions conditions;
  conditions.call_cost = call_cost;
  return conditions;
}

int run_among_nodes(std::span<const std::string> arguments, std::uint64_t seed, Report report) {
  ExecOptions options;
  options.seed = seed;
  options.conditions = conditions_of_nodes();
  options.quiet = report == Report::none;
  options.words = {std::filesystem::read_symlink("/proc/self/exe").string()};
  options.words.insert(options.words.end(), arguments.begin(), arguments.end());
  options.replay = "waitpoint" + quoted(std::vector<std::string>(arguments.begin(), arguments.end()));
  const LogFolder logs;
  logs.use();
  const double begin_s = wall_clock_s();
  const int status = exec(options);
  if (report == Report::at_end)
    std::fprintf(stderr, "waitpoint: the run with its nodes took %.1f s\n", wall_clock_s() - begin_s);
  return status;
}

}  // namespace waitpoint::tools
