// SPDX-License-Identifier: BSD-3-Clause
// Throttles a run to a multiple of the wall clock's speed and reports its lag. The wall clock only delays the run and
// does not enter it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>

#include "core/time.hpp"
#include "modules/bridge/run_result.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {

/// Simulated seconds per second to which a run may be throttled; 0: unthrottled.
inline bool is_speed(double speed) { return speed == 0 || (speed >= 1e-6 && speed <= 1e6); }
inline constexpr const char* speeds = "0 or a number from 0.000001 to 1000000";

class Pacing {
 public:
  /// `speed` is in simulated seconds per second; 0: unthrottled.
  explicit Pacing(double speed, Progress::Clock clock = &wall_clock_s)
      : clock_(clock), speed_(speed), start_s_(clock()) {}

  double speed() const { return speed_; }
  /// Anchors virtual time `now` at the present wall clock time, and sets the speed: after a pause, or when the speed
  /// changes.
  void restart(Time now, double speed) {
    speed_ = speed;
    from_ = now;
    start_s_ = clock_();
  }

  /// Waits until the wall clock reaches `now`, or `stop()` returns true: it is polled ten times a second, and may call
  /// restart().
  template <class Stop>
  void wait_for(Time now, Stop stop) {
    if (speed_ <= 0) return;
    const double late_s = std::max(0.0, clock_() - due_s(now));
    ++waits_;
    lag_sum_s_ += late_s;
    lag_max_s_ = std::max(lag_max_s_, late_s);
    late_s_ = late_s;
    for (;;) {
      const double left_s = speed_ > 0 ? due_s(now) - clock_() : 0;
      if (left_s <= 0 || stop()) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, 0.1)));
    }
  }

  /// Behind the wall clock, at the last wait.
  double late_s() const { return late_s_; }
  /// Empty for an unthrottled run.
  std::optional<bridge::Lag> lag() const {
    if (waits_ == 0) return std::nullopt;
    return bridge::Lag{lag_sum_s_ / static_cast<double>(waits_), lag_max_s_};
  }

 private:
  double due_s(Time now) const { return start_s_ + (now - from_).seconds() / speed_; }

  Progress::Clock clock_;
  double speed_;
  Time from_;
  double start_s_;
  std::uint64_t waits_ = 0;
  double lag_sum_s_ = 0, lag_max_s_ = 0, late_s_ = 0;
};

}  // namespace waitpoint::tools
