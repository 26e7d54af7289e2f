// SPDX-License-Identifier: BSD-3-Clause
// The clocks of simulated tasks, with the interface of the standard library's: both show the caller's local virtual
// time, one since the start of the run, one as a date. Also the conversions from their time points and durations to
// Time.
//
// All timed calls treat unusual arguments alike:
//
//   negative duration, time point in the past        as in the standard: try once, do not wait
//   duration or time point beyond the range of Time  no timeout: hours::max() is not an error
//   fraction of a nanosecond                         rounded up: no call returns early
//   not a number                                     a misuse
#pragma once

#include <chrono>
#include <ctime>
#include <limits>

#include "core/time.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/blocking.hpp"

namespace waitpoint {

/// The caller's local virtual time. A task that polls it yields to other tasks now and then; if none of them advances
/// in time, the run ends with no progress.
inline Time now() {
  Time local;
  if (!kernel::read_clock(*sync::running_task().scheduler, local)) sync::unwind();
  return local;
}

struct steady_clock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<steady_clock>;
  static constexpr bool is_steady = true;

  /// Not noexcept: throws Unwind at the end of the run.
  static time_point now() { return time_point(duration(waitpoint::now().ns())); }
};

/// Counts from 1970-01-01 as std::chrono::system_clock does; a run starts at SimulationOptions::start_date. It is never
/// set during a run.
struct system_clock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<system_clock>;
  static constexpr bool is_steady = true;

  static time_point now();

  static std::time_t to_time_t(const time_point& t) noexcept { return std::chrono::system_clock::to_time_t(cut(t)); }
  static time_point from_time_t(std::time_t t) noexcept { return time_point(std::chrono::seconds(t)); }
  /// To and from the standard's time points of that epoch, for use with its calendar.
  template <class Span>
  static std::chrono::sys_time<Span> to_sys(const std::chrono::time_point<system_clock, Span>& t) {
    return std::chrono::sys_time<Span>(t.time_since_epoch());
  }
  template <class Span>
  static std::chrono::time_point<system_clock, Span> from_sys(const std::chrono::sys_time<Span>& t) {
    return std::chrono::time_point<system_clock, Span>(t.time_since_epoch());
  }

 private:
  static std::chrono::system_clock::time_point cut(const time_point& t) {
    return std::chrono::floor<std::chrono::system_clock::duration>(to_sys(t));
  }
};

namespace sync {

/// A deadline in the past at any time.
inline constexpr Time long_past = Time::from_ns(std::numeric_limits<std::int64_t>::min());

/// `span` in nanoseconds, rounded up, saturated to the range. NaN is a misuse.
template <class Rep, class Ratio>
constexpr std::int64_t ns_within_range(const std::chrono::duration<Rep, Ratio>& span) {
  using Limits = std::numeric_limits<std::int64_t>;
  if constexpr (std::chrono::treat_as_floating_point_v<Rep>) {
    const double ns = std::chrono::duration<double, std::nano>(span).count();
    WAITPOINT_REQUIRE(ns == ns, "a duration or a time is not a number");
    if (ns >= 0x1p63) return Limits::max();
    if (ns <= -0x1p63) return Limits::min();
    const std::int64_t whole = static_cast<std::int64_t>(ns);
    return static_cast<double>(whole) < ns ? whole + 1 : whole;
  } else {
    __extension__ using Wide = __int128;  // holds any count of any standard unit
    const Wide ns = std::chrono::ceil<std::chrono::duration<Wide, std::nano>>(span).count();
    if (ns > Limits::max()) return Limits::max();
    return ns < Limits::min() ? Limits::min() : static_cast<std::int64_t>(ns);
  }
}

/// The deadline `span` from the caller's local virtual time; not before that time.
template <class Rep, class Ratio>
[[gnu::always_inline]] inline Time after(const std::chrono::duration<Rep, Ratio>& span) {
  const Time from = kernel::local_time(running_task());
  const std::int64_t ns = ns_within_range(span);
  std::int64_t at = 0;
  if (ns <= 0) return from;
  return __builtin_add_overflow(from.ns(), ns, &at) ? Time::max() : Time::from_ns(at);
}

/// The date of system_clock at the start of the caller's run, in nanoseconds.
std::int64_t start_date_ns();

}  // namespace sync

/// Converts a time point of the clocks above to virtual time.
template <class Span>
Time to_time(const std::chrono::time_point<steady_clock, Span>& t) {
  return Time::from_ns(sync::ns_within_range(t.time_since_epoch()));
}
template <class Span>
Time to_time(const std::chrono::time_point<system_clock, Span>& t) {
  const std::int64_t ns = sync::ns_within_range(t.time_since_epoch());
  std::int64_t at = 0;
  if (__builtin_sub_overflow(ns, sync::start_date_ns(), &at)) return ns < 0 ? sync::long_past : Time::max();
  return ns == std::numeric_limits<std::int64_t>::max() ? Time::max() : Time::from_ns(at);
}

namespace sync {

/// The deadline for a time point of any simulated clock, i.e. one with a to_time() like those above.
template <class Clock, class Span>
Time until(const std::chrono::time_point<Clock, Span>& deadline) {
  static_assert(!std::is_same_v<Clock, std::chrono::steady_clock> && !std::is_same_v<Clock, std::chrono::system_clock>,
                "simulated tasks wait for virtual time, not for a clock of the machine");
  return to_time(deadline);
}

}  // namespace sync

/// Declares the cost of the caller's computation, between `least` and `greatest`: its local virtual time advances by
/// it, which delays its next operations. This is not a waitpoint, except on a shared processor, for which the caller
/// waits. The chooser picks the cost: the greatest in the default order. Negative or swapped costs are a misuse.
inline void compute(Duration least, Duration greatest) { kernel::compute(sync::running_task(), least, greatest); }
inline void compute(Duration cost) { kernel::compute(sync::running_task(), cost); }

/// The caller waits for a device: its local virtual time advances by `latency`, which no local clock scales.
inline void access_hardware(Duration latency) { kernel::access_hardware(sync::running_task(), latency); }

}  // namespace waitpoint
