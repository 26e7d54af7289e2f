// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/periodic_timer.hpp"

namespace waitpoint {

periodic_timer::~periodic_timer() {
  if (event_.in_list()) scheduler_->cancel(event_);
}

void periodic_timer::start() {
  const Time now = kernel::running->local_time;
  const Duration since = now.since_start() - phase_;
  next_ = since < Duration() ? 0 : period_.first_tick_at_or_after(since + Duration::from_ns(1));
  pending_ = 0;
}

void periodic_timer::tick(kernel::EventNode& node) {
  periodic_timer& self = *static_cast<Event&>(node).timer;
  ++self.pending_;
  ++self.next_;
  self.scheduler_->wake_first(self.object_);
  if (self.object_.first_waiter != nullptr) self.scheduler_->schedule(node, self.time_of(self.next_), self.object_);
}

// The ticks that came while nobody waited.
void periodic_timer::catch_up() {
  const Duration since = kernel::running->local_time.since_start() - phase_;
  if (since < period_.tick(next_)) return;
  const std::int64_t coming = period_.first_tick_at_or_after(since + Duration::from_ns(1));
  pending_ += coming - next_;
  next_ = coming;
}

std::int64_t periodic_timer::wait() {
  scheduler_ = sync::running_task().scheduler;
  const bool fresh = scheduler_->enter(object_);
  if (!sync::before_blocking(kernel::Operation::timer_wait, object_)) return 0;
  if (fresh) start();
  catch_up();
  if (pending_ == 0) {
    if (!event_.in_list()) scheduler_->schedule(event_, time_of(next_), object_);
    sync::block(object_);
  }
  const std::int64_t ticks = pending_;
  pending_ = 0;
  due_ = time_of(next_ - 1);
  return ticks;
}

}  // namespace waitpoint
