// SPDX-License-Identifier: BSD-3-Clause
// Virtual time: signed 64-bit integer nanoseconds, checked, never floating point.
//
// A Time is a point since the start of the run, a Duration a distance between two; the types keep them apart.
// An overflow is a bug and stops the run. Range: +-292 years.
//
//   Time + Duration -> Time      Time - Time -> Duration      Duration * integer -> Duration
//
// The k-th tick of a periodic activity is Period::tick(k), the k-th multiple rounded once: 75 Hz is not a whole number
// of nanoseconds, and a sum of rounded periods would drift.
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace waitpoint {

/// A span of virtual time, in nanoseconds.
class Duration {
 public:
  constexpr Duration() = default;

  /// From an integral std::chrono duration that nanoseconds can hold exactly: `Duration(20ms)`.
  template <class Rep, class Ratio>
  requires std::is_integral_v<Rep>
  constexpr Duration(std::chrono::duration<Rep, Ratio> d) : ns_(scaled(d.count(), nanoseconds_in<Ratio>())) {}

  static constexpr Duration from_ns(std::int64_t ns) { return Duration(ns, Raw{}); }
  /// Nearest nanosecond, halves away from zero. For values read from text; outside the range is bad usage (a bug).
  static Duration from_seconds(double seconds);
  static constexpr Duration max() { return from_ns(std::numeric_limits<std::int64_t>::max()); }

  constexpr std::int64_t ns() const { return ns_; }
  constexpr double seconds() const { return static_cast<double>(ns_) * 1e-9; }

  friend constexpr auto operator<=>(Duration, Duration) = default;
  friend constexpr Duration operator+(Duration a, Duration b) { return from_ns(checked_add(a.ns_, b.ns_)); }
  friend constexpr Duration operator-(Duration a, Duration b) { return from_ns(checked_sub(a.ns_, b.ns_)); }
  friend constexpr Duration operator-(Duration a) { return from_ns(checked_sub(0, a.ns_)); }
  friend constexpr Duration operator*(Duration a, std::int64_t k) { return from_ns(checked_mul(a.ns_, k)); }
  friend constexpr Duration operator*(std::int64_t k, Duration a) { return a * k; }
  friend constexpr Duration operator/(Duration a, std::int64_t k) { return from_ns(checked_div(a.ns_, k)); }
  /// The whole number of `b` in `a`, towards zero.
  friend constexpr std::int64_t operator/(Duration a, Duration b) { return checked_div(a.ns_, b.ns_); }
  constexpr Duration& operator+=(Duration b) { return *this = *this + b; }
  constexpr Duration& operator-=(Duration b) { return *this = *this - b; }

  static constexpr std::int64_t checked_add(std::int64_t a, std::int64_t b) {
    std::int64_t r = 0;
    WAITPOINT_CHECK(!__builtin_add_overflow(a, b, &r), "virtual time overflows");
    return r;
  }
  static constexpr std::int64_t checked_sub(std::int64_t a, std::int64_t b) {
    std::int64_t r = 0;
    WAITPOINT_CHECK(!__builtin_sub_overflow(a, b, &r), "virtual time overflows");
    return r;
  }
  static constexpr std::int64_t checked_mul(std::int64_t a, std::int64_t b) {
    std::int64_t r = 0;
    WAITPOINT_CHECK(!__builtin_mul_overflow(a, b, &r), "virtual time overflows");
    return r;
  }
  static constexpr std::int64_t checked_div(std::int64_t a, std::int64_t b) {
    WAITPOINT_CHECK(b != 0, "virtual time is divided by zero");
    return b == -1 ? checked_sub(0, a) : a / b;
  }

 private:
  struct Raw {};
  constexpr Duration(std::int64_t ns, Raw) : ns_(ns) {}

  template <class Ratio>
  static constexpr std::int64_t nanoseconds_in() {
    using InNs = std::ratio_divide<Ratio, std::nano>;
    static_assert(InNs::den == 1, "a unit finer than the nanosecond");
    return InNs::num;
  }
  template <class Count>
  static constexpr std::int64_t scaled(Count count, std::int64_t unit) {
    WAITPOINT_CHECK(std::in_range<std::int64_t>(count), "virtual time overflows");
    return checked_mul(static_cast<std::int64_t>(count), unit);
  }

  std::int64_t ns_ = 0;
};

/// A point of virtual time, in nanoseconds since the start of the run.
class Time {
 public:
  constexpr Time() = default;
  static constexpr Time from_ns(std::int64_t ns) { return Time(ns); }
  static constexpr Time max() { return from_ns(std::numeric_limits<std::int64_t>::max()); }

  constexpr std::int64_t ns() const { return ns_; }
  constexpr double seconds() const { return static_cast<double>(ns_) * 1e-9; }
  constexpr Duration since_start() const { return Duration::from_ns(ns_); }

  friend constexpr auto operator<=>(Time, Time) = default;
  friend constexpr Time operator+(Time t, Duration d) { return Time(Duration::checked_add(t.ns_, d.ns())); }
  friend constexpr Time operator-(Time t, Duration d) { return Time(Duration::checked_sub(t.ns_, d.ns())); }
  friend constexpr Duration operator-(Time a, Time b) { return Duration::from_ns(Duration::checked_sub(a.ns_, b.ns_)); }
  constexpr Time& operator+=(Duration d) { return *this = *this + d; }

 private:
  explicit constexpr Time(std::int64_t ns) : ns_(ns) {}
  std::int64_t ns_ = 0;
};

/// A rational period: `ticks` ticks in `span`.
class Period {
 public:
  /// One tick every `d`; `d` must be positive.
  static Period every(Duration d);
  /// `ticks` ticks a second; must be positive.
  static Period hertz(std::int64_t ticks);

  /// The k-th multiple, rounded to the nearest nanosecond. `tick(0)` is 0.
  Duration tick(std::int64_t k) const;
  /// The least k whose tick is at or after `d`; `d` must not be negative.
  std::int64_t first_tick_at_or_after(Duration d) const;

 private:
  Period(std::int64_t ticks, Duration span) : ticks_(ticks), span_(span) {}
  std::int64_t ticks_;
  Duration span_;
};

/// Seconds with nine decimals and no locale: "12.345000000".
std::string to_string(Time t);
std::string to_string(Duration d);

}  // namespace waitpoint
