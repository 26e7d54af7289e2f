// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec_options.hpp"

#include <cstdlib>

#include "core/error.hpp"
#include "tools/command/distinct_files.hpp"

namespace waitpoint::tools {

ExecArguments::ExecArguments(CommandLine& line)
    : command_(line.add_command("exec",
                                "Runs a program with simulated threads in virtual time (docs/exec.md):\n"
                                "  waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]")) {
  command_.option("--seed", seed_, "N", "seed of the schedule and of random numbers (default: $WAITPOINT_SEED, or 1)");
  command_.option("--seeds", seeds_, "A..B",
                  "run each seed from A to B until one has a nonzero exit status, and show only its\n"
                  "output");
  command_.option("--strategy", strategy_, "random|fifo",
                  "order of threads that are ready at the same instant: random, by the seed, or\n"
                  "fifo: a thread runs until it blocks (default: random)");
  command_.option("--trace", trace_, "FILE.json",
                  "write the actions of each thread, up to the end or the crash, as a trace for\n"
                  "Chrome and Perfetto");
  conditions_.add_to(command_);
  command_.takes_program();
  command_.flag("--quiet", quiet_, "print no summary line, unless the run failed");
  command_.json(json_);
  command_.footer(
      "Several programs in one simulation: exec -- NAME=a ARGUMENTS :: after:NAME b ARGUMENTS\n"
      "(after:NAME its end, after:NAME.started, after:tcp:PORT, after:PATH: what its start waits for)\n"
      "With --json the program's output goes to standard error.\n"
      "Exit status: the program's own; 124: deadlock; 125: the program cannot be run; with --seeds 1: a seed failed.\n"
      "Data races (of programs compiled with -fsanitize=thread) are reported and do not affect the status; waitpoint\n"
      "explore --exec counts them as failures.");
}

ExecOptions ExecArguments::options(const std::vector<std::string>& words) const {
  if (words.empty()) throw BadInput("exec", "expected a program: waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]");
  ExecOptions options;
  options.words = words;
  options.quiet = quiet_;
  options.json = json_;
  options.conditions = conditions_.conditions(false);
  std::string where = "--seed", seed = seed_;
  if (const char* const given = std::getenv("WAITPOINT_SEED"); seed.empty() && given != nullptr) {
    where = "WAITPOINT_SEED";
    seed = given;
  }
  if (!seed.empty()) options.seed = seed_of(where, seed);
  if (!seeds_.empty()) {
    if (!seed_.empty()) throw BadInput("--seeds", "cannot be used together with --seed");
    options.seeds = seed_range_of("--seeds", seeds_);
  }
  if (!trace_.empty()) {
    if (options.seeds) throw BadInput("--trace", "cannot be used together with --seeds");
    options.trace = trace_;
    if (json_) check_beside_json({{"--trace", trace_}});
  }
  if (strategy_ == "fifo")
    options.order = kernel::Order::fifo;
  else if (strategy_ != "random")
    refuse("--strategy", "random or fifo (waitpoint explore --exec has others)", strategy_);
  return options;
}

}  // namespace waitpoint::tools
