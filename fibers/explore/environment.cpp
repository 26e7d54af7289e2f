// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/environment.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::exploration {
namespace {

constexpr const char *strategy_name = "WAITPOINT_STRATEGY", *seed_name = "WAITPOINT_SEED",
                     *iterations_name = "WAITPOINT_ITERATIONS", *time_limit_name = "WAITPOINT_TIME_LIMIT",
                     *replay_name = "WAITPOINT_REPLAY";

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

bool came_to_replay = false;

[[noreturn]] void refuse(const std::string& why) {
  std::fflush(nullptr);
  std::fprintf(stderr, "waitpoint: %s\n", why.c_str());
  std::_Exit(2);
}

void check_replayed() {
  if (came_to_replay) return;
  refuse(std::string(replay_name) + ": expected a token of this program, found '" + variable(replay_name) +
         "': there was no such call");
}

// As a shell takes it for one.
std::string as_word(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%^";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) letter == '\'' ? quoted += "'\\''" : quoted += letter;
  return quoted + "'";
}

}  // namespace

void replay_was_come_to() { came_to_replay = true; }

ExploreOptions with_environment(ExploreOptions options) {
  if (const std::string strategy = variable(strategy_name); !strategy.empty()) options.strategy = strategy;
  take(seed_name, options.seed, "a whole number from 0 to 2^64 - 1");
  take(iterations_name, options.iterations, "a whole number");
  take(time_limit_name, options.time_limit_s, "a number of seconds");
  if (const std::string replay = variable(replay_name); !replay.empty()) {
    options.replay = replay;
    [[maybe_unused]] static const int registered = std::atexit(check_replayed);
  }
  return options;
}

void refuse_environment(const BadInput& input) {
  for (const char* name : {strategy_name, seed_name, iterations_name, time_limit_name, replay_name})
    if (!variable(name).empty()) refuse(input.what());
}

std::string trace_file() { return variable("WAITPOINT_TRACE"); }

std::string command_line(const ForeignChecks* checks) {
  const std::string name = checks != nullptr ? checks->name() : "";
  const std::string own = name.empty() ? "" : checks->option_for(name);
  const std::string own_key = own.substr(0, own.find('='));
  std::string line;
  std::ifstream words("/proc/self/cmdline");
  for (std::string word; std::getline(words, word, '\0');) {
    if (!own_key.empty() && word.substr(0, word.find('=')) == own_key) continue;
    line += (line.empty() ? "" : " ") + as_word(word);
  }
  if (line.empty()) line = "and the same program again";
  return own.empty() ? line : line + " " + as_word(own);
}

}  // namespace waitpoint::exploration
