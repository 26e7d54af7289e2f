// SPDX-License-Identifier: BSD-3-Clause
// Records what is wanted of one run of a simulation in this process.
#pragma once

#include <optional>

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/schedules/event_stop.hpp"
#include "fibers/explore/schedules/trail_recorder.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/wanted_evidence.hpp"

namespace waitpoint::exploration {

/// Sits between the simulation and its explorer from its construction, before the run, to finish().
class EvidenceRecorder {
 public:
  /// All must outlive this.
  EvidenceRecorder(const WantedEvidence& wanted, Simulation& simulation, Explorer& explorer, Finding& finding);
  ~EvidenceRecorder();
  EvidenceRecorder(const EvidenceRecorder&) = delete;
  EvidenceRecorder& operator=(const EvidenceRecorder&) = delete;

  /// The run has reached the event before which it was to end.
  bool has_stopped() const { return stop_ && stop_->stopped_before() != nullptr; }
  /// After the run, before its tasks are unwound: completes the finding.
  void finish();
  /// The switches and the decision so far, if words or a decision are wanted.
  const Narration& narration() const { return narrator_.narration(); }

 private:
  void release();
  void tell_stop();

  WantedEvidence wanted_;
  Simulation& simulation_;
  Explorer& explorer_;
  Finding& finding_;
  Narrator narrator_;
  Timeline timeline_;
  Trail trail_;
  std::optional<Profiling> profiling_;
  std::optional<TimelineRecorder> recorder_;
  std::optional<EventLog> log_;
  std::optional<TrailRecorder> trail_recorder_;
  std::optional<EventStop> stop_;
};

}  // namespace waitpoint::exploration
