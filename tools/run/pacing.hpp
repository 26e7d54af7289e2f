// SPDX-License-Identifier: BSD-3-Clause
// Holds a run back to a multiple of the wall clock's speed, and says how far it lagged behind. The wall clock is only
// waited for: nothing of it gets into the run.
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

/// Simulated seconds a second that a run may be held to; 0 does not hold it back.
inline bool is_speed(double speed) { return speed == 0 || (speed >= 1e-6 && speed <= 1e6); }
inline constexpr const char* speeds = "0 or a number from 0.000001 to 1000000";

class Pacing {
 public:
  /// `speed` simulated seconds a second; 0 does not hold back.
  explicit Pacing(double speed, Progress::Clock clock = &wall_clock_s)
      : clock_(clock), speed_(speed), start_s_(clock()) {}

  double speed() const { return speed_; }
  /// Virtual time `now` is due at this moment, and what follows at that speed: after a pause, or at another speed.
  void restart(Time now, double speed) {
    speed_ = speed;
    from_ = now;
    start_s_ = clock_();
  }

  /// Waits until the wall clock has come to `now`, or `stop()` says so: it is asked ten times a second, and may restart
  /// the pace.
  template <class Stop>
  void wait_for(Time now, Stop stop) {
    if (speed_ <= 0) return;
    const double late_s = std::max(0.0, clock_() - due_s(now));
    ++waits_;
    lag_sum_s_ += late_s;
    lag_max_s_ = std::max(lag_max_s_, late_s);
    for (;;) {
      const double left_s = speed_ > 0 ? due_s(now) - clock_() : 0;
      if (left_s <= 0 || stop()) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, 0.1)));
    }
  }

  /// Nothing of a run that was not held back.
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
  double lag_sum_s_ = 0, lag_max_s_ = 0;
};

}  // namespace waitpoint::tools
