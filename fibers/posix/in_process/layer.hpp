// SPDX-License-Identifier: BSD-3-Clause
// What the host of programs in its own process calls: their threads are tasks of the host's scheduler.
//
// The library is preloaded into the host, so that programs, and the libraries that they use, call it in place of the C
// library; calls of the host's own code are passed on. There is one kernel, the host's: the library has none and links
// to the host's by its symbols. The host finds the library by the symbol of this table, which is missing unless the
// library is preloaded.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"
#include "fibers/posix/links/carrier.hpp"

namespace waitpoint::posix {

struct LoadedProgram;

struct InProcessLayer {
  /// The table's symbol.
  static constexpr char symbol[] = "waitpoint_in_process";
  using Error = char[512];

  /// Loads the program whose file is its first argument; null with the reason. All functions are called from outside
  /// tasks, except `is_program_task` and `deliver_signals`.
  LoadedProgram* (*load)(const char* name, int argc, const char* const* argv, Error& error);
  /// Makes its first thread a task of `robot`. Its tasks are services: they do not keep the run alive. False without
  /// memory.
  bool (*start)(LoadedProgram& program, kernel::Scheduler& scheduler, kernel::Robot& robot);
  /// True if it has ended, with its status as of waitpid().
  bool (*has_ended)(const LoadedProgram& program, int& status);
  /// Releases its threads and memory before the run is unwound. None of its code is called.
  void (*drop)(LoadedProgram* program, kernel::Scheduler& scheduler);
  /// Frees the objects that programs have left under names and keys, when all those of a run are gone.
  void (*forget_names)();
  /// True for a program's task; and the delivery of its signals.
  bool (*is_program_task)(const kernel::Task& task);
  void (*deliver_signals)(kernel::Task& task);
  /// Carries data between sockets of programs of different robots; null: it arrives at once.
  void (*set_carrier)(const Carrier* carrier);
};

}  // namespace waitpoint::posix
