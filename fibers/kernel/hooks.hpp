// SPDX-License-Identifier: BSD-3-Clause
// The attachments of the layers above to a run: plain values, read where they apply. None is part of an event.
#pragma once

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

/// A filter for durations that do not follow from the run itself, such as measured ones: records them, or replaces them
/// by the recorded ones.
struct Durations {
  Duration (*pass)(Durations&, const Task&, Duration) = nullptr;
};

struct Hooks {
  /// Delivers the running task's pending signals, at its next waitpoint after attention::signal is set; may compute and
  /// pass waitpoints itself.
  void (*deliver_signals)(Task&) = nullptr;
  /// Called when a blocked task has closed a cycle. True: the run continues; false, and if null: it ends with a
  /// deadlock.
  bool (*continues_after_cycle)(Task&) = nullptr;
  /// Called when the running task has computed for long without a waitpoint, before it yields: may let its local time
  /// pass. Null: none passes.
  void (*computes_long)(Task&) = nullptr;
  /// Null: durations are used unchanged.
  Durations* durations = nullptr;
  /// The command that repeats this run, for waitpoint_describe_run(); must outlive the run.
  const char* replay = "";
  /// The run's object in the layer above.
  void* client = nullptr;
};

}  // namespace waitpoint::kernel
