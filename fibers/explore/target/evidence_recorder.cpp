// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/target/evidence_recorder.hpp"

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/target/evidence_text.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::exploration {

EvidenceRecorder::EvidenceRecorder(const WantedEvidence& wanted, Simulation& simulation, Explorer& explorer,
                                   Finding& finding)
    : wanted_(wanted),
      simulation_(simulation),
      explorer_(explorer),
      finding_(finding),
      narrator_(simulation.scheduler(), explorer),
      trail_{wanted.trail.value_or(0), {}} {
  kernel::Scheduler& scheduler = simulation.scheduler();
  if (wanted.profile) scheduler.set_watch(&profiling_.emplace(finding.lesson.profile));
  if (wanted.events) scheduler.set_watch(&recorder_.emplace(timeline_, &explorer, wanted.events->from));
  if (wanted.log_from) scheduler.set_watch(&log_.emplace(finding.evidence.log, explorer, *wanted.log_from));
  if (wanted.trail) scheduler.set_watch(&trail_recorder_.emplace(trail_, simulation));
  if (wanted.words || wanted.decision) scheduler.set_decisions(narrator_);
  if (wanted.decision) narrator_.ask_for(*wanted.decision, wanted.instead);
  if (wanted.stop_before) scheduler.set_decisions(stop_.emplace(scheduler, explorer, *wanted.stop_before));
}

EvidenceRecorder::~EvidenceRecorder() { release(); }

void EvidenceRecorder::release() {
  simulation_.scheduler().set_watch(nullptr);
  simulation_.scheduler().set_decisions(explorer_);
}

void EvidenceRecorder::finish() {
  release();
  if (profiling_) finding_.lesson.profile.finish(explorer_.steps());
  tell(narrator_.narration(), wanted_, finding_.evidence);
  if (wanted_.events) tell(timeline_, *wanted_.events, finding_.evidence);
  finding_.evidence.trail = to_text(trail_);
  if (has_stopped()) tell_stop();
}

void EvidenceRecorder::tell_stop() {
  kernel::Task& task = *stop_->stopped_before();
  sync::ReturnAddresses stack(frames_searched);
  stack.resize(kernel::call_stack(task, stack.data(), stack.size()));
  const sync::ReturnAddresses stacks[] = {stack};
  finding_.end = simulation_.global_time();
  tell(finding_.end, about_to(task), sync::user_source_lines(stacks, frames_shown).front(), finding_.evidence);
}

}  // namespace waitpoint::exploration
