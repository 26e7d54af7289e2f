// SPDX-License-Identifier: BSD-3-Clause
// The wait-for graph: a task blocked without a timeout on a held object has an edge to each of its holders. A cycle is
// a deadlock, regardless of the other tasks.
//
//   A --lock--> left, held by B        B --lock--> map, held by readers C and D        D --lock--> ..., held by A
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class WaitGraph {
 public:
  /// Searches for a cycle closed by `task`, which has just blocked. Returns a task of the cycle, whose members are
  /// linked by `search.to`; null if there is none. Depth-first search, linear in the number of edges.
  Task* find_cycle(Task& task);

 private:
  std::uint64_t searches_ = 0;
};

}  // namespace waitpoint::kernel
