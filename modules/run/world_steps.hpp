// SPDX-License-Identifier: BSD-3-Clause
// The instants at which a world steps: the multiples of its period.
#pragma once

#include "core/time.hpp"

namespace waitpoint::run {

class WorldSteps {
 public:
  explicit WorldSteps(Duration period) : period_(period) {}

  Duration period() const { return period_; }
  /// The last one up to `time`, which is not before the start.
  Time last(Time time) const { return Time() + period_ * (time.since_start() / period_); }
  /// The first one after `time`.
  Time next(Time time) const { return last(time) + period_; }
  bool contain(Time time) const { return last(time) == time; }

 private:
  Duration period_;
};

}  // namespace waitpoint::run
