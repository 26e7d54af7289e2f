// SPDX-License-Identifier: BSD-3-Clause
// The observer of executed events, for tracing and recording.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// An executed event.
struct EventRecord {
  Time time;
  const Task* task;
  Operation operation;
  const Object* object;  ///< null for start, end, yield and sleep
};

/// Called at each event. Without a watch the cost is one predictable branch.
struct Watch {
  void (*event)(Watch&, const EventRecord&) = nullptr;
};

}  // namespace waitpoint::kernel
