// SPDX-License-Identifier: BSD-3-Clause
// Dependent events, i.e. those whose order may change the result: at the same object, unless both only read it.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

inline bool is_read_only(kernel::Operation operation) {
  return operation == kernel::Operation::load || operation == kernel::Operation::stop_requested;
}

/// A condition wait releases its lock, which the kernel does not see: it may be any lock.
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

/// Compares the pending operations of two tasks.
inline bool are_dependent(const kernel::Task& a, const kernel::Task& b) {
  return a.at != nullptr && a.at == b.at && !(is_read_only(a.operation) && is_read_only(b.operation));
}

}  // namespace waitpoint::exploration
