// SPDX-License-Identifier: BSD-3-Clause
// Watches the robot's progress: the remaining way must shrink by a step within a period.
#pragma once

#include <limits>

#include "core/time.hpp"

namespace waitpoint::ndd {

class ProgressWatch {
 public:
  /// Progress of `step_m` is expected every `patience`.
  ProgressWatch(double step_m, Duration patience) : step_m_(step_m), patience_(patience) {}

  void start(Time now) {
    best_m_ = std::numeric_limits<double>::infinity();
    since_ = now;
  }
  /// The way became longer by `by_m` without motion: by another route.
  void lengthen(double by_m) { best_m_ += by_m; }
  /// Updates the remaining way; false once there has been no progress for longer than `patience`.
  bool progressing(Time now, double remaining_m) {
    if (remaining_m <= best_m_ - step_m_ || best_m_ == std::numeric_limits<double>::infinity()) {
      best_m_ = remaining_m;
      since_ = now;
    }
    return now - since_ <= patience_;
  }

 private:
  double step_m_;
  Duration patience_;
  double best_m_ = std::numeric_limits<double>::infinity();
  Time since_;
};

}  // namespace waitpoint::ndd
