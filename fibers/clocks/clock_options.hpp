// SPDX-License-Identifier: BSD-3-Clause
// The choice of a task's local clock, as values for thread attributes and scenarios. docs/clocks.md explains the
// clocks.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::kernel {

enum class ClockKind : std::uint8_t {
  fixed,         ///< the greatest cost declared by compute(): the hard real-time model
  proportional,  ///< the wall-clock time of its segments
  cpu,           ///< the processor time of this process during its segments
  interval,      ///< a cost per computation, chosen by the chooser
  counted,       ///< the basic blocks of instrumented code executed in its segments
};

struct ClockOptions {
  ClockKind kind = ClockKind::fixed;
  /// Every duration is multiplied by this many millionths: 500 000 models a processor twice as fast.
  std::int64_t scale_millionths = 1'000'000;
  /// Of `interval`: the bounds of each computation's cost, whatever it declares itself; if both are 0, the declared
  /// bounds.
  Duration least = {}, greatest = {};
  /// Of `counted`: the cost of a basic block.
  Duration block_cost = Duration::from_ns(1);

  friend bool operator==(const ClockOptions&, const ClockOptions&) = default;
  /// True if the task needs no clock object.
  bool plain() const { return kind == ClockKind::fixed && scale_millionths == 1'000'000; }
};

}  // namespace waitpoint::kernel
