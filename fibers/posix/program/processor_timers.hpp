// SPDX-License-Identifier: BSD-3-Clause
// Timers on processor time, of the process or of a thread: checked whenever some is spent.
#pragma once

#include "core/time.hpp"

namespace waitpoint::posix {

struct ProcessorTimer {
  const Duration* spent = nullptr;  ///< the processor time it measures; null: it is not set
  Duration due;
  void (*ring)(ProcessorTimer&, const Duration& spent) = nullptr;
  ProcessorTimer* next = nullptr;
};

extern ProcessorTimer* first_processor_timer;

/// Sets it to ring once `spent` reaches `due`. A periodic timer sets itself again when it rings.
void set_processor_timer(ProcessorTimer& timer, const Duration& spent, Duration due);
void unset_processor_timer(ProcessorTimer& timer);
/// The same for all that measure `spent`, which is no longer counted.
void unset_processor_timers_of(const Duration& spent);
/// Rings the timers that are due.
void look_at_processor_timers();

}  // namespace waitpoint::posix
