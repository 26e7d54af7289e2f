// SPDX-License-Identifier: BSD-3-Clause
// The switch points of a run of a program that is not instrumented.
#pragma once

#include <cstdint>

namespace waitpoint {

/// Simulated calls; accesses of threads to memory that they share and write, too. Instrumented programs always have
/// both. Automatic: schedules of both kinds.
enum class SwitchAt : std::uint8_t { automatic, calls, accesses };

/// Why accesses are no switch points: with breakpoints a program could fail although it is correct.
enum class AccessObstacle : std::uint8_t {
  none,
  trap_handler,  ///< it handles SIGTRAP itself
  changed_code,  ///< its code is not that of its file, is writable, or is made so
  own_code,      ///< it reads or writes its own code as data
  allocator,     ///< it defines malloc(), which the C library calls while it holds locks of its own
  no_memory,     ///< there is none for breakpoints
  // Noticed by the explorer.
  endless,           ///< a schedule with breakpoints did not end
  nothing_shared,    ///< no access to memory that threads share and write was seen
  unlearned,         ///< nothing was learned, as runs with breakpoints failed
  several_programs,  ///< or one that is a shared object
  no_disassembler,   ///< this waitpoint was built without one
  // Of runs in which accesses are observed.
  several_processes,  ///< what they share is not seen
  long_loops,         ///< some breakpoints were removed
};

}  // namespace waitpoint
