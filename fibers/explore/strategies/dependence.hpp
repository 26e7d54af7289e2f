// SPDX-License-Identifier: BSD-3-Clause
// Which events may come to something else in the other order: those at one object, unless both only look at it.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

inline bool only_looks(kernel::Operation operation) {
  return operation == kernel::Operation::load || operation == kernel::Operation::stop_requested;
}

/// A wait for a condition gives its lock up, of which the kernel sees nothing: it may be any.
inline bool releases_unseen(kernel::Operation operation) { return operation == kernel::Operation::wait; }
inline bool is_of_lock(kernel::Operation operation) {
  switch (operation) {
    case kernel::Operation::lock:
    case kernel::Operation::try_lock:
    case kernel::Operation::unlock:
    case kernel::Operation::lock_shared:
    case kernel::Operation::try_lock_shared:
    case kernel::Operation::unlock_shared:
    case kernel::Operation::wait: return true;
    default: return false;
  }
}

/// Of what the two tasks are about to do.
inline bool are_dependent(const kernel::Task& a, const kernel::Task& b) {
  return a.at != nullptr && a.at == b.at && !(only_looks(a.operation) && only_looks(b.operation));
}

}  // namespace waitpoint::exploration
