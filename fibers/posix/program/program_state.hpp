// SPDX-License-Identifier: BSD-3-Clause
// The state shared by the threads of a program.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/program/program_signals.hpp"
#include "fibers/posix/program/working_directory.hpp"

namespace waitpoint::posix {

struct CreatedTimers;
struct IntervalTimers;
struct NotificationStarter;

struct Program {
  kernel::Robot* robot = nullptr;  ///< to which its threads belong, as tasks
  const char* label = "";          ///< prefix of the names of its tasks
  bool is_service = false;         ///< it does not keep the run alive
  bool is_loaded = false;          ///< into the process of its host: a LoadedProgram
  /// Called, unless null, by each thread about to end; in the last one it ends the program.
  void (*thread_ends)() = nullptr;
  /// The default action of a signal that ends the program; null: it ends the process.
  void (*ends_by)(int signal) = nullptr;
  std::uint32_t threads_made = 0;
  std::uint64_t numbers_drawn[3] = {};  ///< of each stream of random numbers (randomness.hpp)
  /// Its processor time: the cost of its threads' uses of primitives and clocks.
  Duration spent;
  ProgramSignals signals{};
  int directory = directory_of_process;  ///< its working directory
  // Made when first used, and forgotten at its end: see timers/program_timers.hpp.
  IntervalTimers* interval_timers = nullptr;
  CreatedTimers* created_timers = nullptr;
  NotificationStarter* notification_starter = nullptr;
};

/// The program that is alone in its process.
extern Program process_program;

}  // namespace waitpoint::posix
