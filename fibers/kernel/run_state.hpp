// SPDX-License-Identifier: BSD-3-Clause
// The state of a run, and the cause of its stop.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

/// The result of run_before().
enum class RunState : std::uint8_t {
  reached,  ///< no event is left before the end of the window; later ones may follow
  idle,     ///< no event is left; tasks may be blocked
  stopped,  ///< see StopCause
};

enum class StopCause : std::uint8_t {
  none,
  ended,        ///< no task remains but services
  deadlock,     ///< a cycle of the wait-for graph
  no_progress,  ///< virtual time stands still while tasks spin
  requested,    ///< by a task
};

}  // namespace waitpoint::kernel
