// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/program/state_calls.hpp"

#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/times.h>
#include <unistd.h>

#include <cerrno>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/allocator.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
// Linux keeps the last 30 years of its range for the time that follows.
constexpr std::int64_t last_date_s = INT64_MAX / second_ns - std::int64_t{30} * 365 * 24 * 3600;
static_assert(first_date_s < last_date_s, "the program begins at a date that can be set");
static_assert(CLOCK_REALTIME == 0 && CLOCK_TAI == 11, "the kernel's clocks are numbered from 0 to 11; 10 is unused");
static_assert(CLOCKS_PER_SEC == 1'000'000, "clock() counts microseconds");
static_assert(sizeof(time_t) == sizeof(std::int64_t), "seconds of a clock do not end in 2038");

// The offset by which the program has set the date.
std::int64_t set_by_ns = 0;

std::int64_t begin_ns(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_REALTIME_ALARM:
    case CLOCK_TAI: return first_date_s * second_ns + set_by_ns;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_BOOTTIME:
    case CLOCK_BOOTTIME_ALARM: return first_uptime_s * second_ns;
    default: return 0;
  }
}

Duration spent_by_program() { return is_simulated() ? this_program().spent : Duration(); }

// Before main(), it is the start of the run.
Time now() { return is_simulated() ? read_clock() : Time(); }

}  // namespace

bool is_clock(clockid_t clock) {
  if (clock >= 0) return clock <= CLOCK_TAI && clock != 10;
  if (!is_processor_clock(clock)) return false;
  const int of = owner_of(clock);
  if (of == 0 || of == getpid()) return true;
  for (const kernel::Task* task = first_task(); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).id == of) return true;
  return call_directly(SYS_clock_getres, clock, 0) == 0;
}

std::int64_t reading_ns(clockid_t clock, Time time) {
  if (clock == CLOCK_PROCESS_CPUTIME_ID) return spent_by_program().ns();
  if (clock == CLOCK_THREAD_CPUTIME_ID) return is_simulated() ? this_thread().spent.ns() : 0;
  if (clock < 0) {
    if (!is_thread_clock(clock)) return spent_by_program().ns();
    if (owner_of(clock) == 0) return reading_ns(CLOCK_THREAD_CPUTIME_ID, time);
    return spent_by(owner_of(clock)).ns();
  }
  return begin_ns(clock) + time.ns();
}

Duration span(const timespec& time) {
  std::int64_t ns = 0;
  if (__builtin_mul_overflow(static_cast<std::int64_t>(time.tv_sec), second_ns, &ns) ||
      __builtin_add_overflow(ns, static_cast<std::int64_t>(time.tv_nsec), &ns))
    return time.tv_sec < 0 ? Duration() : Duration::max();
  return Duration::from_ns(ns);
}

Time later(Time from, Duration span) {
  std::int64_t ns = 0;
  return __builtin_add_overflow(from.ns(), span.ns(), &ns) ? Time::max() : Time::from_ns(ns);
}

Time when(clockid_t clock, const timespec& reading) {
  const Duration since_its_zero = span(reading);
  if (since_its_zero == Duration::max()) return Time::max();
  const std::int64_t ns = since_its_zero.ns() - begin_ns(clock);
  return ns < 0 ? Time() : Time::from_ns(ns);
}

Duration passed_since(clockid_t clock, const timespec& reading) {
  const std::int64_t at = span(reading).ns(), now = reading_ns(clock, kernel::local_time(*kernel::running));
  return Duration::from_ns(now > at ? now - at : 0);
}

timespec to_timespec(std::int64_t ns) { return {ns / second_ns, ns % second_ns}; }

int read_clock(clockid_t clock, timespec& time) {
  if (!is_clock(clock)) return fail(EINVAL);
  time = to_timespec(reading_ns(clock, posix::now()));
  return 0;
}

Time read_clock() {
  spend_for_look(record->settings.call_cost);
  Thread& thread = this_thread();
  if (++thread.clock_readings >= clock_readings_at_most || (thread.task->attention & kernel::attention::signal) != 0) {
    thread.clock_readings = 0;
    pass(kernel::Operation::poll, nullptr);
  }
  return kernel::local_time(*kernel::running);
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

// For the clocks of fibers/clocks that measure real time: the linker redirects their calls here. The C library's
// function shows virtual time, too, as its vDSO is replaced (traps/vdso.hpp).
extern "C" [[gnu::visibility("hidden")]] int __wrap_clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long result = call_directly(SYS_clock_gettime, clock, reinterpret_cast<long>(time));
  return result == 0 ? 0 : fail(static_cast<int>(-result));
}

WAITPOINT_INTERPOSED int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (is_host_code() || is_allocator(__builtin_return_address(0))) return WAITPOINT_NEXT(clock_gettime)(clock, time);
  // In Linux only these clocks need a system call, which checks the address.
  if ((clock == CLOCK_PROCESS_CPUTIME_ID || clock == CLOCK_THREAD_CPUTIME_ID) && !can_be_written(time))
    return fail(EFAULT);
  return posix::read_clock(clock, *time);
}

// The simulation's own date, not the machine's.
WAITPOINT_INTERPOSED int clock_settime(clockid_t clock, const timespec* time) noexcept {
  if (clock < 0 && is_clock(clock)) return fail(EPERM);
  if (clock != CLOCK_REALTIME) return fail(EINVAL);
  if (!is_valid(*time) || time->tv_sec < 0 || time->tv_sec > last_date_s) return fail(EINVAL);
  if (WAITPOINT_NEXT(geteuid)() != 0) return fail(EPERM);
  before_call<"clock_settime">(changing(place::run));
  set_by_ns += time->tv_sec * second_ns + time->tv_nsec - reading_ns(CLOCK_REALTIME, posix::now());
  return 0;
}

WAITPOINT_INTERPOSED int settimeofday(const timeval* time, const struct timezone* zone) noexcept {
  if (time == nullptr) return zone == nullptr ? 0 : fail(EPERM);
  if (time->tv_usec < 0 || time->tv_usec >= 1'000'000) return fail(EINVAL);
  const timespec to{time->tv_sec, time->tv_usec * 1000};
  return clock_settime(CLOCK_REALTIME, &to);
}

WAITPOINT_INTERPOSED int clock_getres(clockid_t clock, timespec* resolution) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(clock_getres)(clock, resolution);
  if (!is_clock(clock)) return fail(EINVAL);
  if (resolution != nullptr) *resolution = {0, 1};
  return 0;
}

WAITPOINT_INTERPOSED int gettimeofday(timeval* __restrict time, void* __restrict zone) noexcept {
  if (is_host_code() || is_allocator(__builtin_return_address(0))) return WAITPOINT_NEXT(gettimeofday)(time, zone);
  const timespec read = to_timespec(reading_ns(CLOCK_REALTIME, posix::now()));
  // The header declares it nonnull, Linux accepts null.
  timeval* const volatile asked = time;
  if (timeval* const to = asked; to != nullptr) *to = {read.tv_sec, read.tv_nsec / 1000};
  if (zone != nullptr) *static_cast<struct timezone*>(zone) = {};
  return 0;
}

WAITPOINT_INTERPOSED time_t time(time_t* time) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(time)(time);
  const time_t read = reading_ns(CLOCK_REALTIME, posix::now()) / second_ns;
  if (time != nullptr) *time = read;
  return read;
}

WAITPOINT_INTERPOSED int timespec_get(timespec* time, int base) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(timespec_get)(time, base);
  if (base != TIME_UTC) return 0;
  *time = to_timespec(reading_ns(CLOCK_REALTIME, posix::now()));
  return base;
}

WAITPOINT_INTERPOSED clock_t clock() noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(clock)();
  return reading_ns(CLOCK_PROCESS_CPUTIME_ID, posix::now()) / 1000;
}

WAITPOINT_INTERPOSED clock_t times(tms* buffer) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(times)(buffer);
  const std::int64_t tick_ns = second_ns / sysconf(_SC_CLK_TCK);
  const Time read = posix::now();
  if (buffer != nullptr) *buffer = {reading_ns(CLOCK_PROCESS_CPUTIME_ID, read) / tick_ns, 0, 0, 0};
  return reading_ns(CLOCK_MONOTONIC, read) / tick_ns;
}

// Of other processes only natives and those outside have clocks.
WAITPOINT_INTERPOSED int clock_getcpuclockid(pid_t process, clockid_t* clock) noexcept {
  if (!is_simulated() || (process != 0 && process != getpid()))
    return WAITPOINT_NEXT(clock_getcpuclockid)(process, clock);
  *clock = static_cast<clockid_t>((~static_cast<unsigned>(process) << 3) | 2);
  return 0;
}
