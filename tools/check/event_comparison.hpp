// SPDX-License-Identifier: BSD-3-Clause
// Compares a run with a logged one as it proceeds: every event's time, robot, task, operation and object, and its
// robot's digest so far. Pauses the run at the first difference.
#pragma once

#include <exception>

#include "fibers/kernel/watch.hpp"
#include "tools/check/event_log.hpp"

namespace waitpoint::tools {

class EventComparison : private kernel::Watch {
 public:
  /// Reads the log of that file from its start; borrows the descriptor. Each task calls `started`, if given, at its
  /// first event, on its own stack.
  explicit EventComparison(int log, void (*started)(const kernel::Task&) = nullptr);
  void watch(Simulation& simulation) { kernel::set_watch(simulation.scheduler(), this); }

  /// True if the runs have differed; later events are not compared.
  bool parted() const { return difference_.has_value(); }
  /// After the run: the first difference, or nothing. A digest or an end that differs after equal events counts, too.
  std::optional<Difference> finish(const Digest& digest, const std::string& end);

 private:
  static void compare(kernel::Watch& watch, const kernel::EventRecord& record);
  bool equal(const LogEntry& expected, const kernel::EventRecord& record);

  EventLogReader log_;
  void (*started_)(const kernel::Task&);
  SharedMapping shared_;
  EventNames names_;
  std::optional<LogEntry> latest_;
  std::optional<Difference> difference_;
  std::exception_ptr failure_;  // of the log; exceptions must not pass through the kernel
};

/// The difference for a run that was cut off by its own end, a signal or force after `equal` events.
Difference cut_off(int log, std::uint64_t equal, const std::string& end);

}  // namespace waitpoint::tools
