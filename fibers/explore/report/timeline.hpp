// SPDX-License-Identifier: BSD-3-Clause
// The events of each task in one schedule: as text, and as a trace for the viewers of Chrome and Perfetto, with a track
// per task in virtual time, and arrows from the waking task to the woken one.
//
//   a#1   [lock mutex #1][ computing .............. ][unlock mutex #1][ sleeping ......]
//   b#2        [lock mutex #1][ waiting for mutex #1 ][resume mutex #1]
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/kernel/operation.hpp"

namespace waitpoint::exploration {

struct TimelineEvent {
  Time time;
  std::uint32_t task;  ///< index of Timeline::tasks
  kernel::Operation operation;
  std::string object;     ///< "mutex #1 "left""; empty without one
  std::string waits_for;  ///< the object that its task waited for afterwards; empty if none
  std::int64_t woken_by;  ///< index of the event that woke the task; -1 for none
  bool is_switch;         ///< it was chosen over the default order's event
};

struct TimelineProcess {
  std::int64_t id;
  std::string name;
};

struct TimelineTask {
  std::string title;
  std::uint32_t process = 0;  ///< index of Timeline::processes
};

struct Timeline {
  std::vector<TimelineProcess> processes;  ///< empty: the one of the simulation
  std::vector<TimelineTask> tasks;         ///< in the order of their first events
  std::vector<TimelineEvent> events;
  std::size_t decisions = 0;  ///< of the explorer, up to the last event
};

/// The last events, one a line: the time, the task in its column, its operation; with an asterisk at a switch. Cycles
/// are printed once, with a count. At most `lines_max` lines.
std::string to_text(const Timeline& timeline, std::size_t lines_max);

/// Chrome's trace format (JSON). At one instant, events are spaced a nanosecond apart, with that length. From there to
/// its next event, or the end, a task is shown waiting, sleeping or, if time passes, computing. A process's tasks are
/// below it.
void write_trace(std::ostream& out, const Timeline& timeline);

}  // namespace waitpoint::exploration
