// SPDX-License-Identifier: BSD-3-Clause
// Programs that are guests in a host's simulation: their threads are tasks of the host's scheduler.
//
// The library of guests is preloaded into the host, so that programs, and the libraries that they use, call it in place
// of the C library; calls of the host's own code are passed on. There is one kernel, the host's: the library has none
// and links to the host's by its symbols. The host finds the library by the symbol of this table, which is missing
// unless the library is preloaded.
#pragma once

#include <cstddef>

#include "fibers/kernel/scheduler.hpp"

#include "fibers/posix/links/carrier.hpp"

namespace waitpoint::posix {

/// A program in the host's process.
struct Guest;

struct Guests {
  /// The table's symbol.
  static constexpr char symbol[] = "waitpoint_guests";
  using Error = char[512];

  /// Loads the program whose file is its first argument; null with the reason. All functions are called from outside
  /// tasks, except `is_guest` and `deliver_signals`.
  Guest* (*load)(const char* name, int argc, const char* const* argv, Error& error);
  /// Makes its first thread a task of `robot`. Its tasks are services: they do not keep the run alive. False without
  /// memory.
  bool (*start)(Guest& guest, kernel::Scheduler& scheduler, kernel::Robot& robot);
  /// True if it has ended, with its exit status.
  bool (*has_ended)(const Guest& guest, int& status);
  /// Releases its threads and memory before the run is unwound. None of its code is called.
  void (*take_away)(Guest* guest, kernel::Scheduler& scheduler);
  /// Frees the objects that guests have left under names and keys, when all guests of a run are gone.
  void (*forget_names)();
  /// True for a guest's task; and the delivery of its signals.
  bool (*is_guest)(const kernel::Task& task);
  void (*deliver_signals)(kernel::Task& task);
  /// Carries data between sockets of guests of different robots; null: it arrives at once.
  void (*set_carrier)(const Carrier* carrier);
};

}  // namespace waitpoint::posix
