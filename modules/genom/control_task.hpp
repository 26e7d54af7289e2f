// SPDX-License-Identifier: BSD-3-Clause
// The control task of a module: receives requests, starts and ends activities, and sends replies.
//
// At each event (a letter, or a change of an activity's state), in GenoM's order:
//
//   take both locks -> ended activities: final reply, slot free -> one letter, if any; then signal every aperiodic
//   task -> activities whose incompatible activities have ended: START, intermediate reply -> control poster ->
//   release the locks
//
// The last request wins: a new activity interrupts the activities of the request types that its own type names, and
// starts when they have ended.
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

  static void fields(auto field) {
    field("number", &ActivityStatus::number);
    field("request", &ActivityStatus::request);
    field("state", &ActivityStatus::state);
  }
};

/// The value of the control poster, "<module>.control".
struct ModuleStatus {
  Bounded<ActivityStatus, activities_max> activities;
  std::uint64_t missed_periods = 0;  ///< of all execution tasks
  bool suspended = false;            ///< an execution task is suspended, after a forbidden transition

  static void fields(auto field) {
    field("activities", &ModuleStatus::activities);
    field("missed_periods", &ModuleStatus::missed_periods);
    field("suspended", &ModuleStatus::suspended);
  }
};

/// Input of the request "Abort", which every module has.
struct AbortInput {
  static constexpr std::int32_t end_module = -99;    ///< refused while activities run
  static constexpr std::int32_t resume_tasks = -88;  ///< after a forbidden transition
  std::int32_t activity = 0;                         ///< the activity to end, or one of the above

  static void fields(auto field) { field("activity", &AbortInput::activity); }
};

class ControlTask {
 public:
  /// `tasks` are the module's execution tasks; `module` is passed to the watch.
  ControlTask(const Module& module, ModuleData& data, std::deque<ExecutionTask>& tasks, Poster<ModuleStatus>& poster)
      : module_(module), data_(data), tasks_(tasks), poster_(poster) {}

  /// The body of the control task; returns when the module has ended.
  void run();

  void expect_init() { init_done_ = false; }
  void set_interrupt_end(bool value) { interrupt_end_ = value; }
  /// Call before the module is started. Null: no watch.
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
