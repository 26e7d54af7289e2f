// SPDX-License-Identifier: BSD-3-Clause
// What the layers above attach to a run: plain values, read where they apply. None is part of an event.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// Durations that do not follow from the run itself, before they count: they are recorded, or replaced by recorded
/// ones.
struct Durations {
  Duration (*pass)(Durations&, const Task&, Duration) = nullptr;
};

struct Hooks {
  /// Delivers the running task's signals, at its next waitpoint after attention::signal is set; may compute and pass
  /// waitpoints itself.
  void (*deliver_signals)(Task&) = nullptr;
  /// Called when a task has blocked in a cycle: true if the run continues all the same. Null: it ends, as a deadlock.
  bool (*continues_after_cycle)(Task&) = nullptr;
  /// Null: such durations count as they are.
  Durations* durations = nullptr;
  /// The command that repeats this run, for waitpoint_describe_run(); must outlive the run.
  const char* replay = "";
  /// The run's object in the layer above.
  void* client = nullptr;
};

}  // namespace waitpoint::kernel
