// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/timer.hpp"

namespace waitpoint {

timer::~timer() { WAITPOINT_REQUIRE(!firing_, "a timer is destroyed by its own callback"); }

void timer::start_at(Time time) {
  if (!sync::before_releasing(kernel::Operation::timer_start, object_)) return;
  recurrence_.reset();
  // Time::max() means never.
  if (time == Time::max())
    event_.cancel();
  else
    event_.schedule(time, object_);
}

void timer::start_every(Period period, Duration phase) {
  if (!sync::before_releasing(kernel::Operation::timer_start, object_)) return;
  const Duration since = now().since_start() - phase;
  const std::int64_t next = since < Duration() ? 0 : period.first_tick_at_or_after(since + Duration::from_ns(1));
  recurrence_ = {period, phase, next};
  schedule_next();
}

void timer::schedule_next() {
  event_.schedule(Time() + recurrence_->phase + recurrence_->period.tick(recurrence_->next), object_);
}

bool timer::stop() {
  if (!sync::before_releasing(kernel::Operation::timer_stop, object_)) return false;
  const bool was_pending = event_.pending();
  event_.cancel();
  recurrence_.reset();
  return was_pending;
}

void timer::fire(void* self_address) {
  timer& self = *static_cast<timer*>(self_address);
  // Schedules the next tick before the callback, which may stop the timer.
  if (self.recurrence_.has_value()) {
    ++self.recurrence_->next;
    self.schedule_next();
  }
  self.firing_ = true;
  self.callback_();
  self.firing_ = false;
}

}  // namespace waitpoint
