// SPDX-License-Identifier: BSD-3-Clause
// Dependent events, i.e. those whose order may change the result: at the same object, unless both only read it.
#pragma once

#include <cstdint>

#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

inline bool is_read_only(kernel::Operation operation) {
  return operation == kernel::Operation::load || operation == kernel::Operation::stop_requested;
}

/// A yielding task is not offered until another has acted; a signal acts at the next event of another task: the order
/// of events around them matters, whatever their objects.
inline bool acts_on_any(kernel::Operation operation) {
  return operation == kernel::Operation::yield || operation == kernel::Operation::signal;
}

/// The two sides of a channel are two objects, its name is in a table, and a poll looks at several.
inline bool is_of_channel(kernel::Operation operation) {
  switch (operation) {
    case kernel::Operation::open:
    case kernel::Operation::close:
    case kernel::Operation::connect:
    case kernel::Operation::accept:
    case kernel::Operation::send:
    case kernel::Operation::receive:
    case kernel::Operation::poll: return true;
    default: return false;
  }
}

/// A tick acts on all timers that it drives.
inline bool is_of_timer(kernel::Operation operation) {
  switch (operation) {
    case kernel::Operation::timer_start:
    case kernel::Operation::timer_stop:
    case kernel::Operation::timer_wait:
    case kernel::Operation::timer_tick: return true;
    default: return false;
  }
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

/// In weak memory, events whose order may change what loads return, though they do not change memory: two loads of one
/// location, since a seq_cst one has its place in the order of all; and a fence with each access to memory.
inline bool are_dependent_in_weak_memory(kernel::Operation a, std::uint64_t x, kernel::Operation b, std::uint64_t y) {
  const auto is_access = [](kernel::Operation operation) {
    switch (operation) {
      case kernel::Operation::load:
      case kernel::Operation::store:
      case kernel::Operation::exchange:
      case kernel::Operation::compare_exchange:
      case kernel::Operation::modify:
      case kernel::Operation::fence: return true;
      default: return false;
    }
  };
  const bool has_fence = a == kernel::Operation::fence || b == kernel::Operation::fence;
  return is_access(a) && is_access(b) && (has_fence || x == y);
}

/// True if it acts on something that the kernel does not know as an object, if it is given none: a descriptor, a file,
/// a signal, memory between processes.
inline bool acts_on_unknown(kernel::Operation operation) {
  switch (operation) {
    case kernel::Operation::start:
    case kernel::Operation::end:
    case kernel::Operation::resume:
    case kernel::Operation::timeout:
    case kernel::Operation::yield:
    case kernel::Operation::sleep:
    case kernel::Operation::fence: return false;
    default: return true;
  }
}

/// `x` and `y` identify the objects; 0: none.
inline bool are_dependent(kernel::Operation a, std::uint64_t x, kernel::Operation b, std::uint64_t y) {
  // Whatever comes behind the end of the process does not happen.
  if (a == kernel::Operation::exit || b == kernel::Operation::exit) return true;
  if (x == 0 && y == 0) return acts_on_unknown(a) && acts_on_unknown(b);
  return x == y && !(is_read_only(a) && is_read_only(b));
}

/// Compares the pending operations of two tasks.
inline bool are_dependent(const kernel::Task& a, const kernel::Task& b) {
  const auto identity = [](const kernel::Task& task) { return task.at != nullptr ? task.at->identity : 0; };
  return are_dependent(a.operation, identity(a), b.operation, identity(b));
}

}  // namespace waitpoint::exploration
