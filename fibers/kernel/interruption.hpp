// SPDX-License-Identifier: BSD-3-Clause
// The end of a run before its tasks', and the other reason why a resumed task does not continue: a visit (visit.hpp).
//
// An ended run unwinds every remaining task: it is resumed once more, and its blocking call returns Wake::unwinding.
// All further calls are refused. The youngest task goes first, since a task may refer to the frames of its maker.
#pragma once

namespace waitpoint::kernel {

class Scheduler;
struct Visit;

struct Interruption {
  bool is_unwinding = false;
  bool is_pending = false;  ///< a resumed task must call answer_interrupt()
  Visit* visit = nullptr;   ///< of the task that is resumed next
};

/// True once the run is over: calls of its tasks are refused.
bool is_unwinding(const Scheduler& scheduler);
/// From outside of tasks: ends the run.
void unwind(Scheduler& scheduler);
/// Abandons the running task, which cannot or does not leave its frames while it is unwound: their resources leak.
[[noreturn]] void abandon();

}  // namespace waitpoint::kernel
