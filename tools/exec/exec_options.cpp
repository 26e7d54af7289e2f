// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec_options.hpp"

#include <cstdlib>

#include "core/error.hpp"

namespace waitpoint::tools {

ExecArguments::ExecArguments(CommandLine& line)
    : command_(line.add_command("exec",
                                "Runs a program with its threads as simulated ones, in virtual time (docs/exec.md):\n"
                                "  waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]")) {
  command_.option("--seed", seed_, "N",
                  "from which the schedule and random numbers follow (default:\n$WAITPOINT_SEED, or 1)");
  command_.option("--seeds", seeds_, "A..B",
                  "run each seed from A to B, until one ends with another status than 0; what the\n"
                  "program writes is shown of that one");
  command_.option("--strategy", strategy_, "S",
                  "random, the default: threads that could go on at one instant do so in an\n"
                  "order of the seed's; fifo: a thread goes on until it waits");
  command_.option("--trace", trace_, "FILE.json",
                  "write what each thread did, up to the end or the crash, for the viewers of\n"
                  "Chrome and Perfetto");
  conditions_.add_to(command_);
  command_.flag("--quiet", quiet_, "no line about the run at its end, unless it failed");
  command_.footer(
      "Several programs in one process, built as shared objects: exec -- a.so ARGUMENTS :: NAME=b.so ARGUMENTS\n"
      "The exit status is the program's own; 124 if its threads wait for each other for ever, 125 if it\n"
      "cannot be run; with --seeds 1 if a seed failed. Data races (programs compiled with -fsanitize=thread) are\n"
      "told and change no status: waitpoint explore --exec takes them for failures.");
}

ExecOptions ExecArguments::options(const std::vector<std::string>& words) const {
  if (words.empty()) throw BadInput("exec", "expected what to run: waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]");
  ExecOptions options;
  options.words = words;
  options.quiet = quiet_;
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
  }
  if (strategy_ == "fifo")
    options.order = kernel::Order::fifo;
  else if (strategy_ != "random")
    refuse("--strategy", "random or fifo (waitpoint explore --exec has others)", strategy_);
  return options;
}

}  // namespace waitpoint::tools
