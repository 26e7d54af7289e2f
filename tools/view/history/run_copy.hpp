// SPDX-License-Identifier: BSD-3-Clause
// A copy of a run: a forked process that stands at an instant of it, and serves the requests of its channel, until the
// channel is closed. Threads of the run are fibers, so that a fork copies all of them: what the copy does from here on
// is what the run does, or would do after an intervention, and the run itself is not touched.
//
// Requests are JSON: {"do": ..., "line": its line of time, ...}; each has one reply, with "error" if it is refused.
// Those that show the floor have the members of frame_options(). "until": a search for an event gives up a minute after
// it.
//
//   fork                       a copy of the copy: its channel comes as the reply's descriptor
//   to {time}                  goes on to that time, everything at it included, and shows the floor
//   step {count, task}         goes on by so many events, of one task if its number is given
//   to_event {event}           goes on to the state after the event of this number
//   event_before {event, task, count}    the number of the task's event that is so many before the last up to `event`
//   look                       the floor
//   events_so_far              their number
//   tasks; modules {robot}     run_states.hpp
//   events {from, to, most}    goes on to `from`, then shows the events up to `to`
//   plot {robot, poster, field, from, to, points}     samples of a poster's number
//   stack {event}              goes on to the event of this number, and shows the call stack of its task there
//   digests {times}            goes on to each of the times, and shows the digest there
//   intervene {text, date}     modules/run/intervention.hpp, at that step of the world, or the next one
//   counts {time}              event_counts.hpp, from the start of the run to that time, if given, or to here
//   journal                    the interventions so far, their results, and the copy's instant
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tools/view/event_counts.hpp"
#include "tools/view/frame_reader.hpp"
#include "tools/view/history/channel.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

class RunCopy {
 public:
  /// The run as it is now, everything before `reached` done and counted; `journal` has its head and the interventions
  /// so far.
  RunCopy(FrameReader& frames, run::Experiment& experiment, std::string journal, Time reached, EventCounts& counts)
      : frames_(frames), experiment_(experiment), counts_(counts), journal_(std::move(journal)), reached_(reached) {}

  /// Forks: returns the channel of the new copy. Between windows of the run. Throws std::system_error.
  Channel fork() const;

 private:
  [[noreturn]] void serve(Channel channel);
  void answer_requests();
  std::string answer(const Json& request);
  std::string floor(const Json& request, const Json& more = Json::object());
  bool may_search(Time until) const;
  std::size_t robot_in(const Json& request) const;
  void go_to(Time time);
  RunEnd go_on(Time time, const std::function<bool(const kernel::EventRecord&)>& enough = nullptr);
  std::string step(const Json& request);
  std::string to_event(const Json& request);
  std::string event_before(const Json& request);
  std::string events(const Json& request);
  std::string plot(const Json& request);
  std::string stack(const Json& request);
  std::string digests(const Json& request);
  std::string intervene(const Json& request);
  std::string journal() const;
  Time now() const;

  FrameReader& frames_;
  run::Experiment& experiment_;
  EventCounts& counts_;
  std::string journal_;
  std::vector<std::pair<Time, std::string>> interventions_;  // in copies, with their lines of the journal
  Channel* channel_ = nullptr;                               // in the copy
  Time reached_;                                             // everything before it is done
  int line_ = 0;                                             // of time, for frames
  bool is_over_ = false;
};

}  // namespace waitpoint::tools::view
