// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec_options.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "tools/command/options/results.hpp"

namespace waitpoint::tools {

void declare(Command& command, ExecOptions& options) {
  command.description = "Runs a program with simulated threads in virtual time (docs/exec.md).";
  command.examples = {"--seeds 1..100 -- ./queue_test", "-- server=./server :: after:server ./client"};
  command.takes_program = true;
  command.notes =
      "Behind '--' a program, or several in one simulation: NAME=a ARGUMENTS :: after:NAME b ARGUMENTS\n"
      "(after:NAME its end, after:NAME.started, after:tcp:PORT, after:PATH: what its start waits for).\n"
      "With --json the program's output goes to standard error.\n"
      "Exit status: the program's own; 124: deadlock; 125: the program cannot be run; with --seeds 1: a seed failed. "
      "Data races (of programs compiled with -fsanitize=thread) do not affect it; waitpoint explore counts them.";
  declare_schedule(command, options, "run each seed from A to B until one has a nonzero exit status", "random");
  declare_conditions(command, options.conditions, Repetition::not_needed);
  command.section("Results");
  declare_trace(command, options.trace, "write the actions of each thread as a trace for Chrome and Perfetto");
  command.add("--quiet", flag(options.quiet), "print no summary line, unless the run failed");
  command.json(options.json);
  command.rules.push_back({"--trace", Rule::Kind::excludes, {"--seeds"}});
  command.finally([&command, &options] {
    options.words = command.program();
    if (options.words.empty())
      throw BadInput("exec", "expected a program: waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS ...]");
    // A token of another kind is for a test that calls explore().
    const char* const replayed = std::getenv("WAITPOINT_REPLAY");
    if (replayed != nullptr && std::string_view(replayed).starts_with("wx1.0."))
      throw BadInput("WAITPOINT_REPLAY", "expected no schedule for exec: waitpoint explore --replay " +
                                             std::string(replayed) + " -- PROGRAM repeats it");
  });
}

}  // namespace waitpoint::tools
