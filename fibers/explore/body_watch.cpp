// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body_watch.hpp"

#include "fibers/explore/races/races.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/schedules/trail_recorder.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

Outcome take_profile(Body& body, Profile& profile) {
  Fifo fifo;
  if (races::present()) {
    races::forget_learned();
    races::learn(true);
    (void)body.run(fifo);
    races::learn(false);
  }
  Profiling counting(profile);
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  scheduler.set_watch(&counting);
  Outcome outcome = body.run(fifo);
  scheduler.set_watch(nullptr);
  profile.finish(body.explorer().steps());
  profile.memory = body.memory();
  return outcome;
}

Timeline take_timeline(Body& body, std::span<const Decision> decisions) {
  Timeline timeline;
  TimelineRecorder recording(timeline, &body.explorer());
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  scheduler.set_watch(&recording);
  Fifo rest;
  (void)body.run(rest, {.prefix = decisions});
  scheduler.set_watch(nullptr);
  return timeline;
}

std::vector<DoneEvent> take_events(Body& body, std::span<const Decision> decisions, std::size_t from) {
  std::vector<DoneEvent> events;
  EventLog log(events, body.explorer(), from);
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  Fifo rest;
  scheduler.set_watch(&log);
  (void)body.run(rest, {.prefix = decisions});
  scheduler.set_watch(nullptr);
  return events;
}

Trail take_trail(Body& body, const Schedule& schedule, std::uint32_t log_spacing) {
  Trail trail{log_spacing, {}};
  TrailRecorder recording(trail, body.simulation());
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  scheduler.set_watch(&recording);
  Fifo rest;
  (void)body.run(rest, {.prefix = schedule.decisions});
  scheduler.set_watch(nullptr);
  return trail;
}

}  // namespace waitpoint::exploration
