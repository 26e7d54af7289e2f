// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that sleep, in virtual time.
#include <sched.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

bool sleep_until(Time time) {
  const CancellationPoint point;
  return point.wait_until(time);
}

// Returns the time left if a signal handler interrupts the sleep; else zero.
timespec sleep_for(Duration span) {
  WAITPOINT_CHECK(span >= Duration(), "a thread sleeps for less than no time");
  const Time end = later(kernel::local_time(*kernel::running), span);
  if (sleep_until(end)) return {};
  const std::int64_t left_ns = (end - kernel::local_time(*kernel::running)).ns();
  return to_timespec(left_ns > 0 ? left_ns : 1);
}

// A thread cannot sleep by its own processor time.
bool is_of_this_thread(clockid_t clock) {
  if (clock == CLOCK_THREAD_CPUTIME_ID) return true;
  return is_processor_clock(clock) && is_thread_clock(clock) &&
         (owner_of(clock) == 0 || owner_of(clock) == this_thread().id);
}

bool is_nothing(const timespec& time) { return time.tv_sec == 0 && time.tv_nsec == 0; }

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* remaining) {
  if (!is_simulated()) return WAITPOINT_NEXT(clock_nanosleep)(clock, flags, time, remaining);
  if (clock == CLOCK_MONOTONIC_RAW || clock == CLOCK_REALTIME_COARSE || clock == CLOCK_MONOTONIC_COARSE) return ENOTSUP;
  if (is_device_clock(clock)) return ENOTSUP;
  if (is_clock(clock) && !can_be_read(time)) return EFAULT;
  if (!is_clock(clock) || is_of_this_thread(clock) || !is_valid(*time) || time->tv_sec < 0) return EINVAL;
  if ((flags & TIMER_ABSTIME) != 0) return sleep_until(when(clock, *time)) ? 0 : EINTR;
  const timespec left = posix::sleep_for(span(*time));
  if (is_nothing(left)) return 0;
  if (remaining != nullptr && !can_be_written(remaining)) return EFAULT;
  if (remaining != nullptr) *remaining = left;
  return EINTR;
}

WAITPOINT_INTERPOSED int nanosleep(const timespec* time, timespec* remaining) {
  if (!is_simulated()) return WAITPOINT_NEXT(nanosleep)(time, remaining);
  const int error = clock_nanosleep(CLOCK_REALTIME, 0, time, remaining);
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED unsigned sleep(unsigned seconds) {
  if (!is_simulated()) return WAITPOINT_NEXT(sleep)(seconds);
  return static_cast<unsigned>(posix::sleep_for(std::chrono::seconds(seconds)).tv_sec);
}

WAITPOINT_INTERPOSED int usleep(useconds_t microseconds) {
  if (!is_simulated()) return WAITPOINT_NEXT(usleep)(microseconds);
  return is_nothing(posix::sleep_for(std::chrono::microseconds(microseconds))) ? 0 : fail(EINTR);
}

WAITPOINT_INTERPOSED int thrd_sleep(const timespec* time, timespec* remaining) {
  const int error = clock_nanosleep(CLOCK_REALTIME, 0, time, remaining);
  return error == 0 ? 0 : error == EINTR ? -1 : -2;
}

// Not a cancellation point, but a thread with asynchronous cancellation may be cancelled anywhere.
WAITPOINT_INTERPOSED int sched_yield() {
  if (!is_simulated()) return 0;
  spend_for_look(cost_of_giving_way);
  {
    const InKernel within;
    kernel::yield(*kernel::running->scheduler);
  }
  if (this_thread().cancel_at_once) leave_if_cancelled();
  return 0;
}

WAITPOINT_INTERPOSED void thrd_yield() { sched_yield(); }
