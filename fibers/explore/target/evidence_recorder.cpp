// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/target/evidence_recorder.hpp"

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/target/evidence_text.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/kernel/watch.hpp"
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
  if (wanted.profile) kernel::set_watch(scheduler, &profiling_.emplace(finding.lesson.profile));
  if (wanted.events) kernel::set_watch(scheduler, &recorder_.emplace(timeline_, &explorer, wanted.events->from));
  if (wanted.log_from) kernel::set_watch(scheduler, &log_.emplace(finding.evidence.log, explorer, *wanted.log_from));
  if (wanted.trail) kernel::set_watch(scheduler, &trail_recorder_.emplace(trail_, simulation));
  if (wanted.words || wanted.decision) kernel::set_decisions(scheduler, narrator_);
  if (wanted.decision) narrator_.ask_for(*wanted.decision, wanted.instead);
  if (wanted.stop_before) kernel::set_decisions(scheduler, stop_.emplace(scheduler, explorer, *wanted.stop_before));
}

EvidenceRecorder::~EvidenceRecorder() { release(); }

void EvidenceRecorder::release() {
  kernel::set_watch(simulation_.scheduler(), nullptr);
  kernel::set_decisions(simulation_.scheduler(), explorer_);
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
