// SPDX-License-Identifier: BSD-3-Clause
// Timers that count processor time, of the process or of a thread: looked at whenever some is spent.
#pragma once

#include "core/time.hpp"

namespace waitpoint::posix {

struct ProcessorTimer {
  const Duration* spent = nullptr;  ///< what it counts; null: it is not set
  Duration due;
  void (*ring)(ProcessorTimer&, const Duration& spent) = nullptr;
  ProcessorTimer* next = nullptr;
};

extern ProcessorTimer* first_processor_timer;

/// From now on it rings when so much is spent; it sets itself again if it is to.
void set_processor_timer(ProcessorTimer& timer, const Duration& spent, Duration due);
void unset_processor_timer(ProcessorTimer& timer);
/// Those that are due ring.
void look_at_processor_timers();

}  // namespace waitpoint::posix
