// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/periodic_timer.hpp"

#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

periodic_timer::~periodic_timer() {
  if (event_.in_list()) kernel::cancel(*scheduler_, event_);
}

void periodic_timer::enter() {
  scheduler_ = sync::running_task().scheduler;
  if (!kernel::enter(object_)) return;
  running_ = true;
  next_ = -1;  // not started: the first waitpoint starts it
  missed_ = pending_ = 0;
}

void periodic_timer::start() {
  const Duration since = kernel::running->local_time.since_start() - phase_;
  next_ = since < Duration() ? 0 : period_.first_tick_at_or_after(since + Duration::from_ns(1));
}

void periodic_timer::tick(kernel::EventNode& node) {
  periodic_timer& self = *static_cast<Event&>(node).timer;
  ++self.pending_;
  self.last_ = self.time_of(self.next_++);
  kernel::wake_first(*self.scheduler_, self.object_);
  if (self.object_.first_waiter != nullptr)
    kernel::schedule(*self.scheduler_, node, self.time_of(self.next_), self.object_);
}

// Counts the ticks that passed without a waiter.
void periodic_timer::catch_up() {
  if (!running_) return;
  const Duration since = kernel::running->local_time.since_start() - phase_;
  if (since < period_.tick(next_)) return;
  const std::int64_t coming = period_.first_tick_at_or_after(since + Duration::from_ns(1));
  pending_ += coming - next_;
  next_ = coming;
  last_ = time_of(next_ - 1);
}

std::int64_t periodic_timer::wait_before(Time deadline) {
  enter();
  if (!sync::before_blocking(kernel::Operation::timer_wait, object_)) return 0;
  if (next_ < 0) start();
  catch_up();
  // Another tick may have passed between the wake-up and the task's turn.
  while (pending_ == 0 && running_ && deadline > kernel::running->local_time) {
    if (!event_.in_list()) kernel::schedule(*scheduler_, event_, time_of(next_), object_);
    // Without waiters, its event is removed from the list.
    if (!sync::block(object_, deadline) && object_.first_waiter == nullptr && event_.in_list())
      kernel::cancel(*scheduler_, event_);
  }
  const std::int64_t ticks = pending_;
  pending_ = 0;
  if (ticks > 0) {
    due_ = last_;
    missed_ += ticks - 1;
  }
  return ticks;
}

void periodic_timer::set_period(Period period, Duration phase) {
  enter();
  if (!sync::before_releasing(kernel::Operation::timer_start, object_)) return;
  if (next_ >= 0) catch_up();
  period_ = period;
  phase_ = phase;
  running_ = true;
  start();
  if (event_.in_list()) kernel::cancel(*scheduler_, event_);
  if (object_.first_waiter != nullptr) kernel::schedule(*scheduler_, event_, time_of(next_), object_);
}

void periodic_timer::stop() {
  enter();
  if (!sync::before_releasing(kernel::Operation::timer_stop, object_)) return;
  if (next_ < 0) start();
  catch_up();
  running_ = false;
  if (event_.in_list()) kernel::cancel(*scheduler_, event_);
  kernel::wake_all(*scheduler_, object_);
}

}  // namespace waitpoint
