// SPDX-License-Identifier: BSD-3-Clause
// Programs that are guests in a simulation of somebody else's: their threads are tasks of the host's scheduler.
//
// The library of guests is preloaded into the host, so that programs, and the libraries that they use, call it in place
// of the C library; what the host's own code calls is passed on. There is one kernel, the host's: the library has none
// and finds the host's by its names. And the host finds the library by the name of this table, which is not there where
// nobody has preloaded it.
#pragma once

#include <cstddef>

#include "fibers/kernel/scheduler.hpp"

#include "fibers/posix/links/carrier.hpp"

namespace waitpoint::posix {

/// A program in the host's process.
struct Guest;

struct Guests {
  /// The table's name.
  static constexpr char symbol[] = "waitpoint_guests";
  using Error = char[512];

  /// The program in the file that is its first argument; null with the reason. All from outside tasks, but for the two
  /// last.
  Guest* (*load)(const char* name, int argc, const char* const* argv, Error& error);
  /// Its first thread is a task of `robot` from now on, and no task of it keeps the run alive; false without memory.
  bool (*start)(Guest& guest, kernel::Scheduler& scheduler, kernel::Robot& robot);
  /// Whether it has ended, and by which exit status.
  bool (*has_ended)(const Guest& guest, int& status);
  /// Takes away what is left of it, before the run is unwound; nothing of it is called any more.
  void (*take_away)(Guest* guest, kernel::Scheduler& scheduler);
  /// Takes away what guests have left behind under names and keys, when all of a run are gone.
  void (*forget_names)();
  /// Whether a task is a guest's, and what delivers its signals.
  bool (*is_guest)(const kernel::Task& task);
  void (*deliver_signals)(kernel::Task& task);
  /// By which guests of different robots send to each other's sockets; null: what they send arrives at once.
  void (*set_carrier)(const Carrier* carrier);
};

}  // namespace waitpoint::posix
