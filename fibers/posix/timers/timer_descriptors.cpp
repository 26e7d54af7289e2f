// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/timers/timer_descriptors.hpp"
#include "fibers/posix/program/state_calls.hpp"

#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

void expire(kernel::EventNode& node);

struct TimerDescriptor {
  TimerDescriptor(int of, clockid_t by, TimerDescriptor* others) : descriptor(of), clock(by), next(others) {
    event.fire = expire;
  }

  kernel::EventNode event;  // the node is its first member
  int descriptor;
  clockid_t clock;
  Time due = Time::max();  ///< the next expiration not counted yet
  Duration interval;       ///< zero: one-shot
  kernel::Object object{"timer"};
  TimerDescriptor* next;
};
static_assert(offsetof(TimerDescriptor, event) == 0, "an event leads to its timer");
TimerDescriptor* first = nullptr;

TimerDescriptor* timer_of(int descriptor) {
  TimerDescriptor* timer = first;
  while (timer != nullptr && timer->descriptor != descriptor) timer = timer->next;
  return timer;
}

// Counts all expirations up to `now`.
void count(TimerDescriptor& timer, Time now) {
  if (timer.due > now) return;
  eventfd_t expirations = 1;
  if (timer.interval > Duration()) {
    expirations += static_cast<eventfd_t>((now - timer.due).ns() / timer.interval.ns());
    timer.due = later(timer.due, Duration::from_ns(static_cast<std::int64_t>(expirations) * timer.interval.ns()));
  } else {
    timer.due = Time::max();
  }
  const ErrorNumberKept kept;
  [[maybe_unused]] const ssize_t written = WAITPOINT_NEXT(write)(timer.descriptor, &expirations, sizeof expirations);
  if (family::own != nullptr) family::own->written_by_timers += sizeof expirations;
}

void expire(kernel::EventNode& node) {
  auto& timer = reinterpret_cast<TimerDescriptor&>(node);
  WAITPOINT_CHECK(timer.event.fire == expire && timer.object.robot != nullptr, "an event is no timer descriptor's");
  const TimerFiring firing;
  count(timer, kernel::global_time(*timer.object.robot->scheduler));
  look_at_descriptors();
}

void await(TimerDescriptor& timer) {
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  if (timer.event.in_list()) kernel::cancel(scheduler, timer.event);
  if (timer.due == Time::max()) return;
  WAITPOINT_CHECK(timer.interval >= Duration(), "a timer descriptor has a negative interval");
  kernel::enter(timer.object);
  const Time now = kernel::running->local_time;
  kernel::schedule(scheduler, timer.event, timer.due > now ? timer.due : now, timer.object);
}

bool can_be_awaited(clockid_t clock) {
  return is_clock_of_deadlines(clock) || clock == CLOCK_BOOTTIME || clock == CLOCK_REALTIME_ALARM ||
         clock == CLOCK_BOOTTIME_ALARM;
}

timespec left_of(const TimerDescriptor& timer) {
  if (timer.due == Time::max()) return {};
  const std::int64_t ns = (timer.due - kernel::running->local_time).ns();
  return to_timespec(ns > 0 ? ns : 0);
}

}  // namespace

void forget_timer_descriptor(int descriptor) {
  for (TimerDescriptor** link = &first; *link != nullptr; link = &(*link)->next) {
    TimerDescriptor& timer = **link;
    if (timer.descriptor != descriptor) continue;
    if (timer.event.in_list()) kernel::cancel(*timer.object.robot->scheduler, timer.event);
    *link = timer.next;
    std::free(&timer);
    return;
  }
}

void bring_up_to_date(int descriptor) {
  TimerDescriptor* const timer = timer_of(descriptor);
  if (timer == nullptr) return;
  count(*timer, kernel::running->local_time);
  await(*timer);
}

bool is_timer_descriptor(int descriptor) { return timer_of(descriptor) != nullptr; }

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int timerfd_create(clockid_t clock, int flags) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timerfd_create)(clock, flags);
  if (!can_be_awaited(clock)) return fail(EINVAL);
  static_assert(int{TFD_NONBLOCK} == int{EFD_NONBLOCK} && int{TFD_CLOEXEC} == int{EFD_CLOEXEC});
  if ((flags & ~(TFD_NONBLOCK | TFD_CLOEXEC)) != 0) return fail(EINVAL);
  const int descriptor = eventfd(0, flags);
  if (descriptor < 0) return -1;
  auto* const memory = static_cast<TimerDescriptor*>(std::malloc(sizeof(TimerDescriptor)));
  if (memory == nullptr) {
    close(descriptor);
    return fail(ENOMEM);
  }
  first = new (memory) TimerDescriptor(descriptor, clock, first);
  return descriptor;
}

WAITPOINT_INTERPOSED int timerfd_settime(int descriptor, int flags, const itimerspec* to, itimerspec* old) noexcept {
  if (timer_of(descriptor) == nullptr) return WAITPOINT_NEXT(timerfd_settime)(descriptor, flags, to, old);
  if (!can_be_read(to) || (old != nullptr && !can_be_written(old))) return fail(EFAULT);
  if ((flags & ~(TFD_TIMER_ABSTIME | TFD_TIMER_CANCEL_ON_SET)) != 0) return fail(EINVAL);
  if (!is_valid(to->it_value) || !is_valid(to->it_interval) || to->it_value.tv_sec < 0 || to->it_interval.tv_sec < 0)
    return fail(EINVAL);
  const AlsoUsing descriptors(changing(place::channels) | reading(place::descriptors));
  pass(kernel::Operation::timer_start, nullptr);
  TimerDescriptor* const timer = timer_of(descriptor);
  if (timer == nullptr) return fail(EBADF);  // another thread has closed it meanwhile
  if (old != nullptr) *old = {to_timespec(timer->interval.ns()), left_of(*timer)};
  // Earlier expirations that were not read are dropped.
  pollfd one{descriptor, POLLIN, 0};
  if (WAITPOINT_NEXT(poll)(&one, 1, 0) == 1) {
    eventfd_t forgotten = 0;
    [[maybe_unused]] const ssize_t size = WAITPOINT_NEXT(read)(descriptor, &forgotten, sizeof forgotten);
  }
  timer->interval = span(to->it_interval);
  if (to->it_value.tv_sec == 0 && to->it_value.tv_nsec == 0)
    timer->due = Time::max();
  else
    timer->due = (flags & TFD_TIMER_ABSTIME) != 0 ? when(timer->clock, to->it_value)
                                                  : later(kernel::running->local_time, span(to->it_value));
  await(*timer);
  return 0;
}

WAITPOINT_INTERPOSED int timerfd_gettime(int descriptor, itimerspec* time) noexcept {
  before_call<"timerfd_gettime">(reading(place::timers | place::descriptors));
  const TimerDescriptor* const timer = timer_of(descriptor);
  if (timer == nullptr) return WAITPOINT_NEXT(timerfd_gettime)(descriptor, time);
  if (!can_be_written(time)) return fail(EFAULT);
  *time = {to_timespec(timer->interval.ns()), left_of(*timer)};
  return 0;
}
