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

struct Watching {
  Watch* watch = nullptr;
  bool is_on = false;  ///< events are shown: to the watch, a debugger or a sanitizer
};

/// Shows the events from now on to `watch`; null: to none.
void set_watch(Scheduler& scheduler, Watch* watch);
Watch* watch(const Scheduler& scheduler);

}  // namespace waitpoint::kernel
