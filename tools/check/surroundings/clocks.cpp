// SPDX-License-Identifier: BSD-3-Clause
// Clocks set back: calendar clocks by days, clocks that count from the machine's start by half of their first reading.
// A deadline computed from one of them has passed already, and blocks no one.
#include <sys/time.h>
#include <time.h>

#include "tools/check/surroundings/next.hpp"

namespace waitpoint::surroundings {
namespace {

constexpr time_t calendar_behind_s = 953'271;  // 11 days, not a whole number of minutes

constinit Next<int(clockid_t, timespec*)> next_clock_gettime("clock_gettime");
constinit std::atomic<time_t> monotonic_behind_s{-1};

// The same offset for all clocks of this kind, from the first reading on.
time_t monotonic_behind(time_t now_s) {
  time_t behind_s = -1;
  if (monotonic_behind_s.compare_exchange_strong(behind_s, now_s / 2)) behind_s = now_s / 2;
  return behind_s;
}

int off(clockid_t clock, timespec* time) {
  const int result = next_clock_gettime(clock, time);
  if (result != 0) return result;
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_TAI: time->tv_sec -= calendar_behind_s; break;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_BOOTTIME: time->tv_sec -= monotonic_behind(time->tv_sec); break;
    default:  // processor time
      break;
  }
  return 0;
}

}  // namespace
}  // namespace waitpoint::surroundings

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept { return waitpoint::surroundings::off(clock, time); }

int gettimeofday(timeval* time, void* zone) noexcept {
  timespec now{};
  if (zone != nullptr) *static_cast<struct timezone*>(zone) = {};
  if (waitpoint::surroundings::off(CLOCK_REALTIME, &now) != 0) return -1;
  *time = {now.tv_sec, now.tv_nsec / 1000};
  return 0;
}

int timespec_get(timespec* time, int base) noexcept {
  return base == TIME_UTC && waitpoint::surroundings::off(CLOCK_REALTIME, time) == 0 ? base : 0;
}

time_t time(time_t* result) noexcept {
  timespec now{};
  waitpoint::surroundings::off(CLOCK_REALTIME_COARSE, &now);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}
}
