// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/timer_event.hpp"

#include <algorithm>
#include <cstring>

#include "core/digest.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/robot_state.hpp"

namespace waitpoint::sync {
namespace {

// Of the whole run: attached to its first robot, the environment.
struct RunTimers : RobotState {
  explicit RunTimers(kernel::Robot&) {}
  std::uint32_t pending = 0;
  std::uint32_t barren = 0;  // consecutive timers fired while only timers were scheduled
  Time instant;
  std::uint32_t firings = 0;  // at that instant
};

struct RobotTimers : RobotState {
  explicit RobotTimers(kernel::Robot& robot)
      : run(state_of<RunTimers>(*kernel::roster(*robot.scheduler).first_robot())) {
    task.scheduler = robot.scheduler;
    task.robot = &robot;
    task.id = Digest::mix(~robot.id);
    task.phase = kernel::Phase::deliveries;
    task.state = kernel::TaskState::running;
    task.attention = kernel::attention::timer;
    task.service = true;
    std::strcpy(task.name, "timers");
  }
  ~RobotTimers() override { kernel::sanitizer::end_timer(known_as); }
  RunTimers& run;
  kernel::Task task;
  void* known_as = nullptr;  // its identity for a sanitizer
};

}  // namespace

void TimerEvent::schedule(Time time, kernel::Object& timer) {
  cancel();
  timer_ = &timer;
  kernel::Scheduler& scheduler = *timer.robot->scheduler;
  due_ = std::max(time, kernel::global_time(scheduler));
  kernel::schedule(scheduler, event_, due_, timer);
  ++state_of<RobotTimers>(*timer.robot).run.pending;
}

void TimerEvent::cancel() {
  if (!event_.in_list()) return;
  kernel::cancel(*timer_->robot->scheduler, event_);
  --state_of<RobotTimers>(*timer_->robot).run.pending;
}

void TimerEvent::fire(kernel::EventNode& node) {
  TimerEvent& self = *static_cast<Event&>(node).self;
  RobotTimers& timers = state_of<RobotTimers>(*self.timer_->robot);
  kernel::Scheduler& scheduler = *timers.task.scheduler;
  RunTimers& run = timers.run;
  --run.pending;
  run.barren = kernel::pending_events(scheduler) == run.pending ? run.barren + 1 : 0;
  if (run.barren > idle_firings_max) return;

  run.firings = run.instant == self.due_ ? run.firings + 1 : 0;
  run.instant = self.due_;
  if (run.firings > firings_max) {
    timers.task.at = self.timer_;
    return kernel::stop_between_events(scheduler, kernel::StopCause::no_progress, timers.task);
  }

  void* const left = kernel::sanitizer::enter_timer(timers.known_as);
  kernel::Task* const interrupted = kernel::running;
  kernel::Object* const timer = self.timer_;  // the callback may destroy the object that contains *this
  kernel::running = &timers.task;
  timers.task.local_time = self.due_;
  // A firing is part of the robot's digest, like a task's event.
  kernel::waitpoint(scheduler, kernel::Operation::timer_tick, self.timer_);
  try {
    self.function_(self.of_);
  } catch (...) {
    WAITPOINT_REQUIRE(false, "an exception escapes from a timer's callback");
  }
  // Later stops or starts of the timer happen after the callback.
  kernel::sanitizer::release(timer);
  kernel::running = interrupted;
  kernel::sanitizer::leave_timer(left);
}

}  // namespace waitpoint::sync
