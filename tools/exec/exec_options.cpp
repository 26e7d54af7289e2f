// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::tools {

namespace {

using kernel::ClockKind;
using kernel::ClockOptions;

bool parse_cost(std::string_view text, Duration& cost) {
  double us = 0;
  if (!parse_number(text, us) || !(us > 0 && us <= 1e15)) return false;
  cost = Duration::from_seconds(us * 1e-6);
  return true;
}

bool parse_interval(std::string_view text, ClockOptions& clock) {
  const std::size_t dots = text.find("..");
  return dots != std::string_view::npos && parse_cost(text.substr(0, dots), clock.least) &&
         parse_cost(text.substr(dots + 2), clock.greatest) && clock.least <= clock.greatest;
}

// "x0.5", or nothing.
bool parse_scale(std::string_view text, ClockOptions& clock) {
  double scale = 1;
  if (!text.empty() && (text[0] != 'x' || !parse_number(text.substr(1), scale))) return false;
  clock.scale_millionths = std::llround(scale * 1e6);
  return scale >= 0 && scale <= 1e6;
}

ClockOptions clock_of(const std::string& where, const std::string& text) {
  const std::size_t colon = std::min(text.size(), text.find(':'));
  const std::string kind = text.substr(0, colon);
  const std::string_view value = std::string_view(text).substr(std::min(text.size(), colon + 1));
  ClockOptions clock;
  bool good = false;
  if (kind == "fixed") {
    good = parse_cost(value, clock.least);
    clock.greatest = clock.least;
  } else if (kind == "interval") {
    clock.kind = ClockKind::interval;
    good = parse_interval(value, clock);
  } else if (kind == "cpu" || kind == "proportional") {
    clock.kind = kind == "cpu" ? ClockKind::cpu : ClockKind::proportional;
    good = parse_scale(value, clock);
  }
  if (!good) refuse(where, "fixed:US, interval:US..US, cpu[:xFACTOR] or proportional[:xFACTOR]", text);
  return clock;
}

}  // namespace

ExecArguments::ExecArguments(CLI::App& app)
    : command_(app.add_subcommand("exec",
                                  "Runs a program with its threads as simulated ones, in virtual time (docs/exec.md):\n"
                                  "  waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]")) {
  command_
      ->add_option("--seed", seed_,
                   "from which the schedule and random numbers follow (default:\n$WAITPOINT_SEED, or 1)")
      ->type_name("N");
  command_
      ->add_option("--seeds", seeds_,
                   "run each seed from A to B, until one ends with another status than 0; what the\n"
                   "program writes is shown of that one")
      ->type_name("A..B");
  command_
      ->add_option("--strategy", strategy_,
                   "random, the default: threads that could go on at one instant do so in an\n"
                   "order of the seed's; fifo: a thread goes on until it waits")
      ->type_name("S");
  command_
      ->add_option("--clock", clock_,
                   "what a thread's code costs from one call to the next: fixed:US, interval:US..US\n"
                   "(chosen by the seed), or as measured, which does not repeat: cpu, proportional,\n"
                   "with :xFACTOR of that (default: nothing)")
      ->type_name("CLOCK");
  command_
      ->add_option("--trace", trace_,
                   "write what each thread did, up to the end or the crash, for the viewers of\n"
                   "Chrome and Perfetto")
      ->type_name("FILE.json");
  command_->add_flag("--isolate", isolate_, "what would leave this machine fails (EACCES)")->disable_flag_override();
  command_
      ->add_flag("--trap-rdtsc", trap_rdtsc_,
                 "the processor's counter shows virtual time, a nanosecond a tick, where the\n"
                 "program reads it by an instruction (some microseconds each)")
      ->disable_flag_override();
  command_->add_flag("--quiet", quiet_, "no line about the run at its end, unless it failed")->disable_flag_override();
  command_->footer(
      "Several programs in one process, built as shared objects: exec -- a.so ARGUMENTS :: NAME=b.so ARGUMENTS\n"
      "The exit status is the program's own; 124 if its threads wait for each other for ever, 125 if it\n"
      "cannot be run; with --seeds 1 if a seed failed. Data races (programs compiled with -fsanitize=thread) are\n"
      "told and change no status: waitpoint explore --exec takes them for failures.");
}

bool ExecArguments::parsed() const { return command_->parsed(); }

ExecOptions ExecArguments::options(const std::vector<std::string>& words) const {
  if (words.empty()) throw BadInput("exec", "expected what to run: waitpoint exec [OPTIONS] -- PROGRAM [ARGUMENTS...]");
  ExecOptions options;
  options.words = words;
  options.quiet = quiet_;
  options.isolate = isolate_;
  options.trap_rdtsc = trap_rdtsc_;
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
  if (!clock_.empty()) options.clock = clock_of("--clock", clock_);
  options.clock_text = clock_;
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
