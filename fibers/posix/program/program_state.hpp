// SPDX-License-Identifier: BSD-3-Clause
// What the threads of a program have in common.
#pragma once

#include <cstdint>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

struct Program {
  kernel::Robot* robot = nullptr;  ///< whose tasks its threads are
  const char* label = "";          ///< what the names of its tasks begin with
  bool is_service = false;         ///< it does not keep the run alive
  bool is_member = false;          ///< it is one of several: a Member
  /// Called by each thread that is about to end; null: not. The last one's ends the program.
  void (*thread_ends)() = nullptr;
  std::uint32_t threads_made = 0;
  std::uint64_t numbers_drawn = 0;  ///< random ones, from the system's
  /// What the uses of primitives and clocks of all its threads have cost: its processor time.
  Duration spent;
};

}  // namespace waitpoint::posix
