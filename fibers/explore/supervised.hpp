// SPDX-License-Identifier: BSD-3-Clause
// What a process that explores says of itself, in memory that it shares with the one that supervises it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <string>

#include "fibers/explore/token.hpp"

namespace waitpoint::exploration {

enum class Doing : std::uint8_t { nothing, default_schedule, schedule, minimizing };

struct Supervised {
  std::atomic<std::uint64_t> number;  ///< of the schedule
  std::atomic<std::uint64_t> turn;    ///< another one for each run that begins
  std::atomic<Doing> doing;
  std::atomic<bool> done;
  char failure[400];  ///< of what is minimised
};

/// What the supervisor knows from the beginning.
struct Supervision {
  pid_t explored;
  Token token;                ///< but for the number
  std::string replay, after;  ///< the line that repeats a schedule, around its token
  std::uint32_t limit_s;      ///< of the wall clock: a schedule that takes longer is ended; 0: none is
};

/// In the supervising process: waits for the explored one to end, which closes the other end of `pipe`, or says that it
/// is done. Tells of a schedule that goes on for long, ends the process where one does for too long or waits for
/// something that is not simulated, and tells within which one the process has ended.
[[noreturn]] void supervise(int pipe, const Supervised& supervised, const Supervision& supervision);

/// Whoever sends it this signal wants it to end with status 1.
inline constexpr int end_signal = SIGXCPU;

}  // namespace waitpoint::exploration
