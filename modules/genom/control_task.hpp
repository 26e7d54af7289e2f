// SPDX-License-Identifier: BSD-3-Clause
// The control task of a module: takes requests, starts and ends activities, replies.
//
// At each event (a letter, or a change of an activity's state), in GenoM's order:
//
//   take both locks -> ended activities: final reply, slot free -> one letter, if there is any; then signal every
//   aperiodic task -> activities whose incompatible ones are all gone: START, intermediate reply -> control poster ->
//   give the locks
//
// The last request wins: a new activity interrupts those of the request types that its own type names, and waits for
// them.
#pragma once

#include <deque>

#include "modules/genom/execution_task.hpp"
#include "modules/genom/module_data.hpp"
#include "modules/genom/module_watch.hpp"
#include "modules/genom/poster.hpp"

namespace waitpoint::genom {

class Module;

struct ActivityStatus {
  std::int32_t number = -1;
  std::uint32_t request = 0;
  State state = State::ether;

  static constexpr auto fields() {
    return std::tuple(field("number", &ActivityStatus::number), field("request", &ActivityStatus::request),
                      field("state", &ActivityStatus::state));
  }
};

/// The control poster.
struct ModuleStatus {
  Bounded<ActivityStatus, activities_max> activities;
  std::uint64_t missed_periods = 0;  ///< of all execution tasks
  bool suspended = false;            ///< a task is, after a forbidden transition

  static constexpr auto fields() {
    return std::tuple(field("activities", &ModuleStatus::activities),
                      field("missed_periods", &ModuleStatus::missed_periods),
                      field("suspended", &ModuleStatus::suspended));
  }
};

/// Input of the request "Abort", which every module has.
struct AbortInput {
  static constexpr std::int32_t end_module = -99;    ///< refused while activities run
  static constexpr std::int32_t resume_tasks = -88;  ///< after a forbidden transition
  std::int32_t activity = 0;                         ///< the activity to end, or one of the above

  static constexpr auto fields() { return std::tuple(field("activity", &AbortInput::activity)); }
};

class ControlTask {
 public:
  /// `tasks` are those of the module, which is passed on to the watch.
  ControlTask(const Module& module, ModuleData& data, std::deque<ExecutionTask>& tasks, Poster<ModuleStatus>& poster)
      : module_(module), data_(data), tasks_(tasks), poster_(poster) {}

  /// The task's own code; returns when the module is ended.
  void run();

  void expect_init() { init_done_ = false; }
  void set_interrupt_end(bool value) { interrupt_end_ = value; }
  /// Null: nobody. Before the module is started.
  void set_watch(ModuleWatch* watch) { watch_ = watch; }
  /// The request "Abort".
  Report abort(std::int32_t activity);

 private:
  void end_activities();
  void start_activities();
  void handle(const Letter& letter);
  Report execute(const RequestType& type, const Letter& letter);
  void interrupt_incompatible(const RequestType& type);
  void interrupt(Activity& activity);
  bool interruptible(State state) const;
  bool blocked(const Activity& candidate) const;
  void write_status();
  void reply(LetterKind kind, const Letter& request, Report report, const Payload& output);
  void reply(LetterKind kind, const Activity& activity);
  void tell(LetterKind kind, const RequestType& request, std::int32_t activity = -1, Report report = ok) const;

  const Module& module_;
  ModuleData& data_;
  std::deque<ExecutionTask>& tasks_;
  Poster<ModuleStatus>& poster_;
  ModuleWatch* watch_ = nullptr;
  bool init_done_ = true;
  bool interrupt_end_ = true;
};

}  // namespace waitpoint::genom
