// SPDX-License-Identifier: BSD-3-Clause
// An execution task of a module: runs the codels (short pieces of the module's code) of its activities, and permanent
// codels of its own.
//
// One wake-up (a tick of its period, or an event), in GenoM's order:
//
//   take both locks -> permanent codel -> one codel of each own activity, in table order -> second permanent codel
//   -> automatic posters -> signal the control task if an activity's state changed -> release the locks -> yield
//
// Both locks are held during all codels: codels of one module never overlap and are never interrupted. A codel's cost
// is added to the local time at its end, before the posters that it wrote are published.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/genom/module_data.hpp"
#include "modules/genom/output_poster.hpp"
#include "modules/genom/request.hpp"
#include "modules/genom/settings.hpp"
#include "modules/genom/task_computing.hpp"

namespace waitpoint::genom {

/// Activation and cost of a task. A scenario may override these under `tasks.<task>`; the cost only if the task has
/// permanent codels.
struct TaskOptions {
  Duration period_ms = {};
  Duration delay_ms = {};
  Duration cost_us = {};

  static void fields(auto field) {
    field("period_ms", &TaskOptions::period_ms,
          "period of its wake-ups, more than 0; a task has none if its module declares none: it is woken by events");
    field("delay_ms", &TaskOptions::delay_ms, "phase of a periodic task's wake-ups");
    field("cost_us", &TaskOptions::cost_us, "of each permanent codel");
  }
};

class ExecutionTask {
 public:
  ExecutionTask(ModuleData& module, std::string name, TaskOptions options, TaskComputing computing = {});

  const std::string& name() const { return name_; }
  const TaskOptions& options() const { return options_; }
  const TaskComputing& computing() const { return computing_; }

  /// Called at every wake-up, before and after the activities' codels.
  void set_permanent(std::function<void()> codel) { permanent_ = std::move(codel); }
  void set_second_permanent(std::function<void()> codel) { second_permanent_ = std::move(codel); }
  /// True if the task has a codel that `cost_us` applies to.
  bool has_permanent() const { return permanent_ || second_permanent_ || start_ || end_; }
  /// Of an aperiodic task: waits for its next wake-up in place of the frame, without the module's locks. Once it has
  /// returned, the activities' codels are called.
  void set_wait(std::function<void()> codel) { wait_ = std::move(codel); }
  /// Called once when the task starts and when it ends.
  void set_start(std::function<void()> codel) { start_ = std::move(codel); }
  void set_end(std::function<void()> codel) { end_ = std::move(codel); }

  /// Wakes an aperiodic task once, however often it is called before the task runs. No effect on a periodic task. Call
  /// with the lock on the control data.
  void signal();
  /// The same from a task that is not the module's, and has no lock of it.
  void wake();
  void add(OutputPosterBase& poster) { posters_.push_back(&poster); }

  bool periodic() const { return options_.period_ms > Duration(); }
  bool suspended() const { return suspended_; }
  /// Until it is resumed, its codels are not called and execution requests are rejected.
  void suspend() { suspended_ = true; }
  void resume() { suspended_ = false; }
  /// Periods missed because the task was still busy.
  std::int64_t missed_periods() const { return missed_periods_; }
  /// Wake-ups whose work ended after the next wake-up was due, and the greatest lateness of these.
  std::int64_t missed_deadlines() const { return missed_deadlines_; }
  Duration greatest_lateness() const { return greatest_lateness_; }
  bool ended() const { return ended_; }

  /// Adds to a working set the memory that all tasks of the module touch.
  using AddModule = std::function<void(WorkingSet& set)>;

  /// The body of the task; returns when the module has ended.
  void run(const AddModule& add_module);

 private:
  void find_working_set(const AddModule& add_module);
  std::int64_t wait();
  bool wake_up(std::int64_t periods);
  void call_permanent(const std::function<void()>& codel);
  bool step(Activity& activity);
  void after_codel(Duration cost);

  // Members touched by every wake-up of a periodic task come first.
  ModuleData& module_;
  TaskOptions options_;
  bool signalled_ = false;  // since the last wake-up
  bool suspended_ = false;
  bool ended_ = false;
  std::int64_t missed_periods_ = 0;
  std::vector<OutputPosterBase*> posters_;
  std::function<void()> permanent_, second_permanent_;
  std::optional<threads::periodic_timer> timer_;
  std::int64_t missed_deadlines_ = 0;
  Duration greatest_lateness_;
  threads::counting_semaphore<> event_{0, "task event"};
  std::function<void()> start_, end_, wait_;
  std::string name_;
  TaskComputing computing_;
  WorkingSet working_set_;
};

}  // namespace waitpoint::genom
