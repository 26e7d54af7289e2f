// SPDX-License-Identifier: BSD-3-Clause
// The execution of a plan as a state machine: the next order, from the reports of actions.
//
//   next() -> start an action, when its start is ready         report: started(), or postponed() by its conditions
//          -> stop one: its end is ready, or it has failed     report: ended(), when nature ends it
//          -> wait until a time, or for a report
//          -> finish: all actions are done, or the plan is aborted
//
// Deviations from the plan are repaired in this order:
//   early   the end is before the least duration: its bounds are given up, and the times that follow propagated again
//   late    the end is not within the greatest duration: likewise, up to the latest time that the other constraints
//   allow failed  of an action with a bad report, too late, or with a condition that is violated: the next branch of
//   its
//           alternative; without one, the plan is aborted
//
// It knows no clock and no task. All times are relative to the plan's origin.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/plan/plan_network.hpp"

namespace waitpoint::plan {

enum class EventKind : std::uint8_t { start, stop, end, early, late, failed, branch, repaired, completed, aborted };

/// An entry of the log.
struct Event {
  Duration time;
  EventKind kind = EventKind::start;
  std::size_t index = 0;  ///< of the action, or the alternative
  std::string detail = {};
};

struct PlanOrder {
  enum class Kind : std::uint8_t { start, stop, wait, finish };
  Kind kind = Kind::finish;
  std::size_t action = 0;
  Duration until = {};  ///< of wait
};

class Execution {
 public:
  /// The plan has passed check() and must outlive the execution.
  explicit Execution(const TemporalPlan& plan);

  PlanOrder next(Duration now);
  void started(std::size_t action, Duration now);
  /// The conditions of a start do not hold: it is due again at `until`.
  void postponed(std::size_t action, Duration until) { not_before_[action] = until; }
  /// The final report of the action's request.
  void ended(std::size_t action, Duration now, bool succeeded, const std::string& report);
  /// A condition during the action no longer holds.
  void violated(std::size_t action, Duration now, const std::string& condition) { fail(action, now, condition); }
  /// From outside: to be aborted.
  void abort(Duration now, const std::string& reason);

  bool is_running(std::size_t action) const { return running_[action]; }
  bool completed() const { return completed_; }
  /// Empty unless the plan is aborted.
  const std::string& failure() const { return failure_; }
  const std::vector<Event>& log() const { return log_; }

 private:
  bool rebuild(Duration now);
  bool check_late(Duration now);
  void end(std::size_t action, Duration now);
  void fail(std::size_t action, Duration now, const std::string& reason);
  void set(PointId point, Duration now);
  bool is_ahead(PointId point) const;
  void note(Duration time, EventKind kind, std::size_t index, std::string detail = "") {
    log_.push_back({time, kind, index, std::move(detail)});
  }

  const TemporalPlan& plan_;
  Situation situation_;
  std::unique_ptr<PlanNetwork> network_;
  std::unique_ptr<Dispatcher> dispatcher_;
  std::vector<bool> running_;         // by action
  std::vector<bool> to_stop_;         // by action: it runs, but is no longer part of the plan
  std::vector<Duration> not_before_;  // by action
  std::vector<Event> log_;
  std::string failure_;
  bool completed_ = false;
};

}  // namespace waitpoint::plan
