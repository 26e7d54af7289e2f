// SPDX-License-Identifier: BSD-3-Clause
// Which local clock a task has, as values: what a thread's attributes and a scenario say. docs/clocks.md explains them.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::kernel {

enum class ClockKind : std::uint8_t {
  fixed,         ///< what the task declares with compute(), at most: the hard real-time model
  proportional,  ///< what the wall clock says that its segments took
  cpu,           ///< what the processor time of this process says
  interval,      ///< each computation costs a time of the chooser's choice
  counted,       ///< the basic blocks of instrumented code that its segments passed
};

struct ClockOptions {
  ClockKind kind = ClockKind::fixed;
  /// Every duration is multiplied by this many millionths: 500 000 is a processor that is twice as fast.
  std::int64_t scale_millionths = 1'000'000;
  /// Of `interval`: what each computation costs, whatever it declares itself; if both are 0, what it declares.
  Duration least = {}, greatest = {};
  /// Of `counted`: what a basic block costs.
  Duration block_cost = Duration::from_ns(1);

  friend bool operator==(const ClockOptions&, const ClockOptions&) = default;
  /// Whether a task needs a clock for it.
  bool plain() const { return kind == ClockKind::fixed && scale_millionths == 1'000'000; }
};

}  // namespace waitpoint::kernel
