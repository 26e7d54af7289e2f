// SPDX-License-Identifier: BSD-3-Clause
// How a run stands, and why it stopped.
#pragma once

#include <cstdint>

namespace waitpoint::kernel {

/// How run_before() came back.
enum class RunState : std::uint8_t {
  reached,  ///< the time asked for; more events may follow
  idle,     ///< no event is left; tasks may be blocked
  stopped,  ///< see StopCause
};

enum class StopCause : std::uint8_t {
  none,
  ended,        ///< no task remains but services
  deadlock,     ///< a cycle of owners without finite timeouts
  no_progress,  ///< virtual time stands still while tasks spin
  requested,    ///< by a task
};

}  // namespace waitpoint::kernel
