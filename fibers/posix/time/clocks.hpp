// SPDX-License-Identifier: BSD-3-Clause
// The program's clocks: all of them show virtual time, from a date that is the same for every run.
#pragma once

#include <ctime>

#include "core/time.hpp"

namespace waitpoint::posix {

/// What CLOCK_REALTIME shows when the program begins: 2024-01-01 00:00:00 UTC. Others begin at an hour, as on a machine
/// that was started a while ago; those of processor time at zero.
inline constexpr std::int64_t first_date_s = 1'704'067'200, first_uptime_s = 3600;

/// Whether a clock is one that can be waited by.
bool is_clock(clockid_t clock);
/// Whether it is one of the two that primitives take deadlines by.
inline bool is_clock_of_deadlines(clockid_t clock) { return clock == CLOCK_REALTIME || clock == CLOCK_MONOTONIC; }
/// Virtual time to nanoseconds of a clock.
std::int64_t reading_ns(clockid_t clock, Time time);
/// The virtual time at which `clock` shows `reading`; never the past of the run's start, Time::max() beyond what can be
/// told.
Time when(clockid_t clock, const timespec& reading);
/// How long ago `clock` showed `reading`; zero if it has not yet.
Duration passed_since(clockid_t clock, const timespec& reading);
/// A span; Duration::max() beyond what can be told.
Duration span(const timespec& time);

inline bool is_valid(const timespec& time) { return time.tv_nsec >= 0 && time.tv_nsec < 1'000'000'000; }
timespec to_timespec(std::int64_t ns);

/// The running thread reads a clock: its local time, and a little of it passes.
Time read_clock();
/// As clock_gettime().
int read_clock(clockid_t clock, timespec& time);

/// Later than any wait.
Time later(Time from, Duration span);

}  // namespace waitpoint::posix
