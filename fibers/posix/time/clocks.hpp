// SPDX-License-Identifier: BSD-3-Clause
// The program's clocks: all show virtual time, starting at the same date in every run.
#pragma once

#include <ctime>

#include "core/time.hpp"

namespace waitpoint::posix {

/// CLOCK_REALTIME begins at 2024-01-01 00:00:00 UTC; the others at one hour, as on a machine booted a while ago; those
/// of processor time at zero.
inline constexpr std::int64_t first_date_s = 1'704'067'200, first_uptime_s = 3600;

/// Clocks of the processor time of processes and threads are numbered by glibc and the kernel: the complement of the
/// id, 0 for the caller's own, above a bit for threads and two bits for the kind of time. Their fourth kind is none, or
/// a device's clock.
inline bool is_processor_clock(clockid_t clock) { return clock < 0 && (clock & 3) != 3; }
inline bool is_device_clock(clockid_t clock) { return clock < 0 && (clock & 7) == 3; }
inline bool is_thread_clock(clockid_t clock) { return (clock & 4) != 0; }
inline int owner_of(clockid_t clock) { return ~(clock >> 3); }

/// True if the clock exists.
bool is_clock(clockid_t clock);
/// True for the two clocks by which primitives accept deadlines.
inline bool is_clock_of_deadlines(clockid_t clock) { return clock == CLOCK_REALTIME || clock == CLOCK_MONOTONIC; }
/// The reading of a clock, in nanoseconds, at a virtual time.
std::int64_t reading_ns(clockid_t clock, Time time);
/// The virtual time at which `clock` shows `reading`; not before the start of the run, Time::max() beyond the range.
Time when(clockid_t clock, const timespec& reading);
/// The time since `clock` showed `reading`; zero if that is in the future.
Duration passed_since(clockid_t clock, const timespec& reading);
/// As a duration; Duration::max() beyond the range.
Duration span(const timespec& time);

inline bool is_valid(const timespec& time) { return time.tv_nsec >= 0 && time.tv_nsec < 1'000'000'000; }
timespec to_timespec(std::int64_t ns);

/// The running thread reads a clock, which takes a little time: returns its local time.
Time read_clock();
/// As clock_gettime().
int read_clock(clockid_t clock, timespec& time);

/// `from` + `span`, at most Time::max().
Time later(Time from, Duration span);

}  // namespace waitpoint::posix
