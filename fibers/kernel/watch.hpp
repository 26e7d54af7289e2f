// SPDX-License-Identifier: BSD-3-Clause
// Who looks on as events are executed: tracing and recording hang on the waitpoint by this.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// One executed event, as a watch sees it.
struct EventRecord {
  Time time;
  const Task* task;
  Operation operation;
  const Object* object;  ///< null for start, end, yield and sleep
};

/// Costs one predictable branch when there is none.
struct Watch {
  void (*event)(Watch&, const EventRecord&) = nullptr;
};

}  // namespace waitpoint::kernel
