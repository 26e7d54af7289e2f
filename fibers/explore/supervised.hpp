// SPDX-License-Identifier: BSD-3-Clause
// The state of the exploring process, in memory that it shares with its supervisor.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <functional>
#include <string>

#include "fibers/explore/schedules/token.hpp"

namespace waitpoint::exploration {

enum class Stage : std::uint8_t { nothing, default_schedule, schedule, replay, minimizing };

/// The state of a requested run in a fresh process, one that has not run the body before.
enum class Fresh : std::uint8_t { not_asked, asked, known, unknown };

/// Messages of the explored process in the pipe: a normal end; a request to run a token, which follows up to the end of
/// the line, in a fresh process.
inline constexpr char done_message = '\0', asks_for_fresh = 'F';

struct Supervised {
  std::atomic<std::uint64_t> number;  ///< of the schedule
  std::atomic<const char*> strategy;  ///< of the schedule, known before the fork; null: that of the campaign
  std::atomic<std::uint64_t> turn;    ///< incremented at the start of each run
  std::atomic<Stage> doing;
  std::atomic<bool> done;
  std::atomic<Fresh> fresh;                  ///< the state of the last requested fresh run
  std::atomic<std::uint64_t> fresh_outcome;  ///< its result
  char failure[400];                         ///< the failure being minimised
};

/// The supervisor's constant parameters.
struct Supervision {
  pid_t explored;
  Token token;                                     ///< without the number; for a replay, complete
  std::string replay, after;                       ///< the replay line's parts before and after the token
  std::function<std::uint64_t(const Token&)> run;  ///< the result of a token's run, as a number
  double limit_s;                                  ///< wall-clock limit of a schedule; 0: none
};

/// Runs in the supervising process: waits until the explored one ends, which closes the other end of `pipe`, or reports
/// a normal end. Reports a schedule that takes long; ends the process if one exceeds the limit or waits for something
/// that is not simulated; reports the schedule in which the process ended. Executes requested fresh runs.
[[noreturn]] void supervise(int pipe, Supervised& supervised, const Supervision& supervision);

/// The signal that makes the explored process end with status 1.
inline constexpr int end_signal = SIGXCPU;

}  // namespace waitpoint::exploration
