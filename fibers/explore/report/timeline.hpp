// SPDX-License-Identifier: BSD-3-Clause
// What each task did in one schedule, event by event: as text, and as a trace for the viewers of Chrome and Perfetto,
// with a track for each task in virtual time, and arrows from who woke to who was woken.
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
  std::string waits_for;  ///< for what its task waited from then on; empty if it did not
  std::int64_t woken_by;  ///< index of the event that woke the task; -1 for none
  bool is_switch;         ///< it came in place of another task's that could have gone on
};

struct Timeline {
  std::vector<std::string> tasks;  ///< their titles, in the order of their first events
  std::vector<TimelineEvent> events;
};

/// The last events, one a line: the time, the task in its column, what it does; with an asterisk where it came in
/// another's place. What is repeated stands there once, with how often. At most `lines_max` lines.
std::string to_text(const Timeline& timeline, std::size_t lines_max);

/// In the JSON of Chrome's trace format. Where virtual time stands still, events follow each other by a nanosecond, and
/// have that length. Up to its next event, or to the end, a task then waits, sleeps or, where time passes, computes.
void write_trace(std::ostream& out, const Timeline& timeline);

}  // namespace waitpoint::exploration
