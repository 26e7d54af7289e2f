// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/environment.hpp"

#include <cstdlib>
#include <fstream>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::exploration {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

template <class Number>
void take(const char* name, Number& number, const char* expected) {
  const std::string text = variable(name);
  if (!text.empty() && (!parse_number(text, number) || number < 0))
    throw BadInput(name, std::string("expected ") + expected + ", found '" + text + "'");
}

}  // namespace

ExploreOptions with_environment(ExploreOptions options) {
  if (const std::string strategy = variable("WAITPOINT_STRATEGY"); !strategy.empty()) options.strategy = strategy;
  take("WAITPOINT_SEED", options.seed, "a whole number from 0 to 2^64 - 1");
  take("WAITPOINT_ITERATIONS", options.iterations, "a whole number");
  take("WAITPOINT_TIME_LIMIT", options.time_limit_s, "a number of seconds");
  if (const std::string replay = variable("WAITPOINT_REPLAY"); !replay.empty()) options.replay = replay;
  return options;
}

std::string trace_file() { return variable("WAITPOINT_TRACE"); }

std::string command_line(const ForeignChecks* checks) {
  std::string program;
  std::getline(std::ifstream("/proc/self/cmdline"), program, '\0');
  if (program.empty()) program = "and the same program again";
  const std::string name = checks != nullptr ? checks->name() : "";
  return name.empty() ? program : program + " " + checks->option_for(name);
}

}  // namespace waitpoint::exploration
