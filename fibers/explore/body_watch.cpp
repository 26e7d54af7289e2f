// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body_watch.hpp"

#include "fibers/explore/races/races.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

RunVerdict take_profile(Body& body, Profile& profile) {
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
  const RunVerdict verdict = body.run(fifo);
  scheduler.set_watch(nullptr);
  profile.finish(body.explorer().steps());
  profile.memory = body.memory();
  return verdict;
}

Timeline take_timeline(Body& body) {
  Timeline timeline;
  TimelineRecorder recording(timeline, &body.explorer());
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  scheduler.set_watch(&recording);
  Fifo rest;
  (void)body.run(rest);
  scheduler.set_watch(nullptr);
  return timeline;
}

}  // namespace waitpoint::exploration
