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
#include "fibers/explore/report/event_words.hpp"
#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/kernel/operation.hpp"

namespace waitpoint::exploration {

struct TimelineEvent {
  Time time = {};
  std::uint32_t task = 0;  ///< index of Timeline::tasks
  kernel::Operation operation = kernel::Operation::start;
  std::int32_t object = -1;     ///< index of Timeline::objects; -1: none
  std::int32_t waits_for = -1;  ///< the object that its task waited for afterwards; -1: none
  std::int64_t woken_by = -1;   ///< index of the event that woke the task; -1: none
  bool is_switch = false;       ///< it was chosen over the default order's event
  EventOf which = {};
};

struct TimelineProcess {
  std::int64_t id;
  std::string name;
};

struct TimelineTask {
  std::string title;          ///< "anna#2 of r1"
  std::uint32_t process = 0;  ///< index of Timeline::processes
  std::uint32_t number = 0;
  std::string name = {}, robot = {};
};

struct TimelineObject {
  std::string title;  ///< "mutex #1 "left""
  std::string kind = {}, label = {}, robot = {};
  std::uint64_t number = 0;
};

struct Timeline {
  std::vector<TimelineProcess> processes;  ///< empty: the one of the simulation
  std::vector<TimelineTask> tasks;         ///< in the order of their first events
  std::vector<TimelineObject> objects;     ///< the same
  std::vector<TimelineEvent> events;
  std::uint64_t events_before = 0;  ///< of the run, which are left out
  std::size_t decisions = 0;        ///< of the explorer, up to the last event

  /// The object's title; empty for none.
  std::string object(std::int32_t index) const {
    return index < 0 ? "" : objects[static_cast<std::size_t>(index)].title;
  }
  /// "lock mutex #1".
  std::string words(const TimelineEvent& event) const {
    if (event.object < 0) return event_in_words(event.operation, event.which.sequence, "", "");
    const TimelineObject& at = objects[static_cast<std::size_t>(event.object)];
    return event_in_words(event.operation, event.which.sequence, at.kind, at.title);
  }
};

/// The last events, one a line: the time, the task in its column, its operation; with an asterisk at a switch. Cycles
/// are printed once, with a count. At most `lines_max` lines.
std::string to_text(const Timeline& timeline, std::size_t lines_max);

/// Chrome's trace format (JSON). At one instant, events are spaced a nanosecond apart, with that length. From there to
/// its next event, or the end, a task is shown waiting, sleeping or, if time passes, computing. A process's tasks are
/// below it.
void write_trace(std::ostream& out, const Timeline& timeline);

}  // namespace waitpoint::exploration
