// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/body_watch.hpp"

#include "fibers/explore/races/races.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::exploration {

RunVerdict take_profile(Body& body, Profile& profile) {
  Fifo fifo;
  if (races::present()) {
    races::forget_learned();
    races::learn(true);
    const RunVerdict learning = body.run(fifo);
    races::learn(false);
    if (!learning.passed() && learning.kind != RunVerdict::Kind::race) return learning;
  }
  Profiling counting(profile);
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  kernel::set_watch(scheduler, &counting);
  const RunVerdict verdict = body.run(fifo);
  kernel::set_watch(scheduler, nullptr);
  profile.finish(body.explorer().steps());
  profile.memory = body.memory();
  return verdict;
}

RunVerdict take_timeline(Body& body, Timeline& timeline) {
  TimelineRecorder recording(timeline, &body.explorer());
  kernel::Scheduler& scheduler = body.simulation().scheduler();
  kernel::set_watch(scheduler, &recording);
  Fifo rest;
  const RunVerdict verdict = body.run(rest);
  kernel::set_watch(scheduler, nullptr);
  return verdict;
}

}  // namespace waitpoint::exploration
