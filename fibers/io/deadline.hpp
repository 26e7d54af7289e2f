// SPDX-License-Identifier: BSD-3-Clause
// The time limit of a communication. Every call that can block takes one:
//
//   read(buffer)              for ever
//   read(buffer, io::no_wait) not at all: Status::would_block
//   read(buffer, 5ms)         a span from now, or until a time: Status::timed_out. Zero and negative spans do not wait
#pragma once

#include <chrono>

#include "fibers/io/result.hpp"
#include "fibers/sync/clock.hpp"

namespace waitpoint::io {

struct NoWait {};
inline constexpr NoWait no_wait{};

class Deadline {
 public:
  /// No limit.
  constexpr Deadline() = default;
  Deadline(NoWait) : at_(sync::running_task().local_time), late_(Status::would_block) {}
  template <class Rep, class Ratio>
  Deadline(const std::chrono::duration<Rep, Ratio>& span) : at_(sync::after(span)) {}
  Deadline(Duration span) : Deadline(std::chrono::nanoseconds(span.ns())) {}
  Deadline(steady_clock::time_point time) : at_(to_time(time)) {}
  Deadline(Time time) : at_(time) {}

  /// Time::max() if there is no limit.
  Time at() const { return at_; }
  /// The status returned when the limit is exceeded.
  Status late() const { return late_; }

 private:
  Time at_ = Time::max();
  Status late_ = Status::timed_out;
};

}  // namespace waitpoint::io
