// SPDX-License-Identifier: BSD-3-Clause
// A run compared with a logged one while it goes on: every event's time, robot, task, operation and object, and the
// digest of its robot so far. The run pauses at the first event that differs.
#pragma once

#include <exception>

#include "tools/check/event_log.hpp"

namespace waitpoint::tools {

class EventComparison : private kernel::Watch {
 public:
  /// With the log of that file, from its start; the descriptor stays the caller's. `started`, if any, is called by each
  /// task at its first event, on its stack.
  explicit EventComparison(int log, void (*started)(const kernel::Task&) = nullptr);
  void watch(Simulation& simulation) { simulation.scheduler().set_watch(this); }

  /// Whether the runs have parted; what follows is not compared.
  bool parted() const { return difference_.has_value(); }
  /// After the run, of which nothing is compared any more: where it parted from the logged one, or nothing. A digest or
  /// an end that differs after equal events is a difference too.
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
  std::exception_ptr failure_;  // of the log; nothing may be thrown through the kernel
};

/// Where a run parted that came to an end of its own, by a signal or by force, after `equal` events.
Difference cut_off(int log, std::uint64_t equal, const std::string& end);

}  // namespace waitpoint::tools
