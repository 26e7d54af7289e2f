// SPDX-License-Identifier: BSD-3-Clause
// The wait-for graph: a task that is blocked without a timeout on an object that is held waits for each of its holders.
// A cycle is a deadlock, whatever else happens.
//
//   A --lock--> left, held by B        B --lock--> map, held by readers C and D        D --lock--> ..., held by A
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class WaitGraph {
 public:
  /// A task of a cycle that `task`, which has just blocked, closes; null if it closes none. `search.to` leads around
  /// the cycle. Depth first, each task once: linear in the edges.
  Task* find_cycle(Task& task);

 private:
  std::uint64_t searches_ = 0;
};

}  // namespace waitpoint::kernel
