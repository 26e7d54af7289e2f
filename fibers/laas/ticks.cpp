// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/ticks.hpp"

#include <cerrno>

namespace waitpoint::laas {

STATUS Ticks::start(int ticks_per_second) {
  if (ticks_per_second < 0 || (running() && ticks_per_second != rate_)) return fail(EINVAL);
  if (ticks_per_second == 0 || running()) return OK;
  rate_ = ticks_per_second;
  period_ = Period::hertz(rate_);
  start_ = kernel::local_time(sync::running_task());
  return OK;
}

std::int64_t Ticks::now() const {
  const Duration since = kernel::local_time(sync::running_task()) - start_;
  return period_->first_tick_at_or_after(since + Duration::from_ns(1)) - 1;
}

Time Ticks::time_of(std::int64_t tick) const { return start_ + period_->tick(tick); }

Duration Ticks::span(std::int64_t ticks) const { return period_->tick(ticks); }

Time Ticks::deadline(int ticks) const {
  if (ticks == WAIT_FOREVER) return Time::max();
  if (ticks == NO_WAIT) return Time();
  WAITPOINT_REQUIRE(running(), "a time-out in ticks, but h2initGlob() started no clock");
  return time_of(now() + ticks + 1);
}

void Ticks::list(TickAction& item, std::int64_t due, std::uint64_t rank) {
  if (item.listed_) items_.erase(&item);
  item.due_ = due;
  item.rank_ = rank;
  item.listed_ = true;
  items_.insert(&item);
  schedule();
}

void Ticks::unlist(TickAction& item) {
  if (!item.listed_) return;
  items_.erase(&item);
  item.listed_ = false;
  schedule();
}

void Ticks::schedule() {
  if (firing_) return;
  if (items_.empty()) return event_.cancel();
  const std::int64_t next = (*items_.begin())->due_;
  if (event_.pending() && scheduled_ == next) return;
  scheduled_ = next;
  event_.schedule(time_of(next), object_);
}

void Ticks::fire(void* self_address) {
  Ticks& self = *static_cast<Ticks*>(self_address);
  self.firing_ = true;
  while (!self.items_.empty() && (*self.items_.begin())->due_ <= self.scheduled_) {
    TickAction& item = **self.items_.begin();
    self.items_.erase(self.items_.begin());
    item.listed_ = false;
    item.at_tick();
  }
  self.firing_ = false;
  self.schedule();
}

}  // namespace waitpoint::laas
