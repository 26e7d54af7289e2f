// SPDX-License-Identifier: BSD-3-Clause
// The end of the wall-clock time that an activity may take.
#pragma once

#include <chrono>
#include <limits>

namespace waitpoint::exploration {

class TimeLimit {
 public:
  /// In so many seconds; none if that is not positive.
  explicit TimeLimit(double limit_s) : limit_s_(limit_s) {}

  bool is_over() const { return limit_s_ > 0 && elapsed_s() >= limit_s_; }
  double left_s() const { return limit_s_ > 0 ? limit_s_ - elapsed_s() : std::numeric_limits<double>::infinity(); }

 private:
  using Clock = std::chrono::steady_clock;

  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  double limit_s_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace waitpoint::exploration
