// SPDX-License-Identifier: BSD-3-Clause
// What a process that explores says of itself, in memory that it shares with the one that supervises it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <functional>
#include <string>

#include "fibers/explore/schedules/token.hpp"

namespace waitpoint::exploration {

enum class Doing : std::uint8_t { nothing, default_schedule, schedule, replay, minimizing };

/// A run in a process that has run nothing before.
enum class Fresh : std::uint8_t { not_asked, asked, known, unknown };

/// What the explored process writes into the pipe: it has ended well; a token follows, up to the end of the line, whose
/// run it wants to know from a fresh process.
inline constexpr char it_is_done = '\0', asks_for_fresh = 'F';

struct Supervised {
  std::atomic<std::uint64_t> number;  ///< of the schedule
  std::atomic<std::uint64_t> turn;    ///< another one for each run that begins
  std::atomic<Doing> doing;
  std::atomic<bool> done;
  std::atomic<Fresh> fresh;                  ///< what became of the run that was asked for last
  std::atomic<std::uint64_t> fresh_outcome;  ///< what it came to
  char failure[400];                         ///< of what is minimised
};

/// What the supervisor knows from the beginning.
struct Supervision {
  pid_t explored;
  Token token;                                     ///< but for the number; of a replay, its own
  std::string replay, after;                       ///< the line that repeats a schedule, around its token
  std::function<std::uint64_t(const Token&)> run;  ///< what a token's run came to, as a number
  std::uint32_t limit_s;  ///< of the wall clock: a schedule that takes longer is ended; 0: none is
};

/// In the supervising process: waits for the explored one to end, which closes the other end of `pipe`, or says that it
/// is done. Tells of a schedule that goes on for long, ends the process where one does for too long or waits for
/// something that is not simulated, and tells within which one the process has ended. Carries out runs that are asked
/// for.
[[noreturn]] void supervise(int pipe, Supervised& supervised, const Supervision& supervision);

/// Whoever sends it this signal wants it to end with status 1.
inline constexpr int end_signal = SIGXCPU;

}  // namespace waitpoint::exploration
