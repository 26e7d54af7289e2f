// SPDX-License-Identifier: BSD-3-Clause
// Records the trail of a run, as its scheduler's watch.
#pragma once

#include "fibers/explore/schedules/trail.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint::exploration {

class TrailRecorder final : public kernel::Watch {
 public:
  /// `trail` must have a spacing and no marks; both must outlive the recorder.
  TrailRecorder(Trail& trail, const Simulation& simulation) : trail_(trail), simulation_(simulation) {
    event = &TrailRecorder::add;
  }

 private:
  static void add(kernel::Watch& watch, const kernel::EventRecord&) {
    TrailRecorder& self = static_cast<TrailRecorder&>(watch);
    if (self.trail_.marks.size() == Trail::marks_max) return;
    self.seen_ = self.seen_ == 0 ? kernel::events(self.simulation_.scheduler()) : self.seen_ + 1;
    if (self.seen_ % self.trail_.spacing() == 0) self.trail_.add(self.simulation_.digest().value());
  }

  Trail& trail_;
  const Simulation& simulation_;
  std::uint64_t seen_ = 0;  // events of the run, including this one
};

}  // namespace waitpoint::exploration
