// SPDX-License-Identifier: BSD-3-Clause
// The budget of a part of an analysis. A cheap target's has no limit of time, so that a failure always gets the same
// report.
#pragma once

#include <algorithm>
#include <chrono>

#include "fibers/explore/target/target.hpp"

namespace waitpoint::exploration {

class Budget {
 public:
  explicit Budget(const Effort& effort) : effort_(effort), start_(Clock::now()) {}

  /// Takes one run; false if the budget is exhausted.
  bool take() {
    const bool is_late =
        effort_.seconds > 0 && std::chrono::duration<double>(Clock::now() - start_).count() >= effort_.seconds;
    if (used_ == effort_.runs || effort_.events == 0 || is_late) return false;
    ++used_;
    return true;
  }
  /// Charges the run's events.
  void spend(const RunVerdict& verdict) { effort_.events -= std::min(effort_.events, verdict.events); }
  /// The runs so far.
  std::uint64_t used() const { return used_; }

 private:
  using Clock = std::chrono::steady_clock;

  Effort effort_;
  Clock::time_point start_;
  std::uint64_t used_ = 0;
};

}  // namespace waitpoint::exploration
