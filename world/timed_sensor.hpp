// SPDX-License-Identifier: BSD-3-Clause
// A body's sensor, read at its own times (world/sensors/types/sensors.hpp): after each step of the world those at which
// it is due.
#pragma once

#include <algorithm>

#include "world/world.hpp"

namespace waitpoint::world {

/// The multiples of `period` in the step that the world has just done, `steps` in all, of length `step`; time 0 counts
/// at the start.
inline std::int64_t times_due(Duration period, Duration step, std::uint64_t steps) {
  const Duration now = step * static_cast<std::int64_t>(steps);
  return steps == 0 ? 1 : now / period - (now - step) / period;
}

template <class S>
class TimedSensor {
 public:
  /// The body's sensor number `number` of type S, in a world of that step.
  TimedSensor(std::size_t number, const typename S::Description& description, Duration step)
      : number_(number), step_(step) {
    if constexpr (ReadOnDemand<S>) period_ = S::period(description);
  }

  std::size_t number() const { return number_; }
  /// The last one. Its date is the owner's.
  const typename S::Reading& reading() const { return reading_; }
  typename S::Reading& reading() { return reading_; }
  bool is_due(std::uint64_t steps) const { return times_due(period_, step_, steps) > 0; }

  /// Reads it after that many steps if it is due, and calls visit() after each new reading. True if there was one.
  template <class Visit>
  bool read(const World& world, BodyId body, std::uint64_t steps, Visit visit) {
    std::int64_t times = 1;
    if constexpr (ReadOnDemand<S>) times = times_due(period_, step_, steps);
    if constexpr (requires { S::in_turns; })
      times = reading_.number == 0 ? 1 : times;
    else
      times = std::min<std::int64_t>(times, 1);
    bool is_new = false;
    for (; times > 0; --times) {
      std::uint64_t draw = steps;
      if constexpr (ReadOnDemand<S> && requires { reading_.number; }) draw = reading_.number + 1;
      is_new = world.read<S>(body, draw, reading_, number_);
      if (is_new) visit();
    }
    return is_new;
  }
  bool read(const World& world, BodyId body, std::uint64_t steps) {
    return read(world, body, steps, [] {});
  }

 private:
  std::size_t number_;
  Duration step_, period_;
  typename S::Reading reading_;
};

}  // namespace waitpoint::world
