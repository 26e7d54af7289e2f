// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/environment.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::exploration {
namespace {

constexpr const char *strategy_name = "WAITPOINT_STRATEGY", *seed_name = "WAITPOINT_SEED",
                     *iterations_name = "WAITPOINT_ITERATIONS", *time_limit_name = "WAITPOINT_TIME_LIMIT",
                     *schedule_limit_name = "WAITPOINT_SCHEDULE_LIMIT", *races_name = "WAITPOINT_RACES",
                     *memory_name = "WAITPOINT_MEMORY", *replay_name = "WAITPOINT_REPLAY",
                     *trace_name = "WAITPOINT_TRACE", *finding_name = "WAITPOINT_FINDING";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

enum class Zero { allowed, refused };

template <class Number>
void take(const char* name, Number& number, Zero zero, const char* expected) {
  const std::string text = variable(name);
  if (!text.empty() && (!parse_number(text, number) || number < 0 || (zero == Zero::refused && number == 0)))
    throw BadInput(name, std::string("expected ") + expected + ", found '" + text + "'");
}

// Checked before the first run: the results of a campaign of hours must not be lost. An existing file is unchanged.
void check_can_be_written(const char* name) {
  const std::string file = variable(name);
  if (file.empty()) return;
  const bool is_new = access(file.c_str(), F_OK) != 0;
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (opened < 0)
    throw BadInput(name, "expected a file that can be written, found '" + file + "': " + std::strerror(errno));
  close(opened);
  if (is_new) unlink(file.c_str());
}

// The token whose call was reached: tests may set the variable for a part of the process.
std::string replay_reached;

[[noreturn]] void refuse(const std::string& why) {
  std::fflush(nullptr);
  std::fprintf(stderr, "waitpoint: %s\n", why.c_str());
  std::_Exit(2);
}

void check_replayed() {
  if (variable(replay_name).empty() || variable(replay_name) == replay_reached) return;
  refuse(std::string(replay_name) + ": expected a token of this program, found '" + variable(replay_name) +
         "': no test that ran makes such a call");
}

// Quoted for a shell where necessary.
std::string as_word(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%^";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) letter == '\'' ? quoted += "'\\''" : quoted += letter;
  return quoted + "'";
}

}  // namespace

void on_tests_finished() { check_replayed(); }

void mark_replay_reached() { replay_reached = variable(replay_name); }

ExploreOptions with_environment(ExploreOptions options) {
  if (const std::string strategy = variable(strategy_name); !strategy.empty()) options.strategy = strategy;
  take(seed_name, options.seed, Zero::allowed, "a whole number from 0 to 2^64 - 1");
  take(iterations_name, options.iterations, Zero::refused, "a positive whole number");
  take(time_limit_name, options.time_limit_s, Zero::refused, "a positive number of seconds, or the variable unset");
  double limit_s = options.schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s);
  take(schedule_limit_name, limit_s, Zero::allowed, "a number of seconds, 0 for none");
  options.schedule_limit_s = limit_s;
  if (const std::string races = variable(races_name); !races.empty()) {
    const std::optional<Races> meant = races_named(races);
    if (!meant) throw BadInput(races_name, std::string("expected ") + races_words + ", found '" + races + "'");
    options.races = *meant;
  }
  if (const std::string memory = variable(memory_name); !memory.empty()) {
    const std::optional<Memory> meant = memory_named(memory);
    if (!meant) throw BadInput(memory_name, std::string("expected ") + memory_words + ", found '" + memory + "'");
    options.memory = *meant;
  }
  check_can_be_written(trace_name);
  check_can_be_written(finding_name);
  if (const std::string replay = variable(replay_name); !replay.empty()) {
    options.replay = replay;
    [[maybe_unused]] static const int registered = std::atexit(check_replayed);
  }
  return options;
}

void refuse_environment(const BadInput& input) {
  for (const char* name : {strategy_name, seed_name, iterations_name, time_limit_name, schedule_limit_name, races_name,
                           memory_name, replay_name, trace_name, finding_name})
    if (!variable(name).empty()) refuse(input.what());
}

std::string trace_file() { return variable(trace_name); }
std::string finding_file() { return variable(finding_name); }

bool has_replay_variable() { return !variable(replay_name).empty(); }

std::string command_line(const ExternalChecks* checks) {
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
