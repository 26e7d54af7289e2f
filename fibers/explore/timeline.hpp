// SPDX-License-Identifier: BSD-3-Clause
// What each task did in one schedule, event by event: as text, and as a trace for the viewers of Chrome and Perfetto,
// with a track for each task in virtual time, and arrows from who woke to who was woken.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "fibers/explore/body.hpp"

namespace waitpoint::exploration {

/// "consumer#2 of r1": tasks of one name are told apart by their numbers. The robot is left out where there are none.
std::string title_of(const Task& task);
/// "consumer#2, about to lock mutex #1".
std::string about_to(const Task& task);

struct TimelineEvent {
  Time time;
  std::uint32_t task;  ///< index of Timeline::tasks
  kernel::Operation operation;
  std::string object;     ///< "mutex #1 "left""; empty without one
  std::int64_t woken_by;  ///< index of the event that woke the task; -1 for none
  bool is_switch;         ///< it came in place of another task's that could have gone on
};

struct Timeline {
  std::vector<std::string> tasks;  ///< their titles, in the order of their first events
  std::vector<TimelineEvent> events;
};

/// Takes down the events of one run from `from` on, as its scheduler's watch.
class TimelineRecorder : public kernel::Watch {
 public:
  TimelineRecorder(Timeline& timeline, const Explorer& explorer, Time from = Time());

 private:
  static void record(kernel::Watch& watch, const kernel::EventRecord& record);
  std::uint32_t number_of(const Task& task);

  Timeline& timeline_;
  const Explorer& explorer_;
  Time from_;
  std::map<std::uint64_t, std::uint32_t> numbers_;      // of tasks, by id
  std::map<std::uint64_t, std::int64_t> last_release_;  // the last event at an object that may have woken another
  std::size_t decisions_ = 0;
};

/// Runs `body` once more by `schedule`, and looks.
Timeline take_timeline(Body& body, const Schedule& schedule);

/// The last `events_max` events, one a line: the time, the task in its column, what it does; with an asterisk where it
/// came in another's place.
std::string to_text(const Timeline& timeline, std::size_t events_max);

/// In the JSON of Chrome's trace format. Where virtual time stands still, events follow each other by a nanosecond.
void write_trace(std::ostream& out, const Timeline& timeline);

}  // namespace waitpoint::exploration
