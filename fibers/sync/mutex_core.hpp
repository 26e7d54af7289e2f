// SPDX-License-Identifier: BSD-3-Clause
// Exclusive ownership: what mutex, timed_mutex and their recursive kin have in common.
//
// A lock has one owner or none (kernel/ownership.hpp). A release with waiters hands the lock to one of them, of the
// chooser's choice: nobody comes between.
#pragma once

#include "fibers/kernel/ownership.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/misuse.hpp"

namespace waitpoint::sync {

class MutexCore {
 public:
  constexpr MutexCore(const char* kind, const char* label) : object_(kind, label) {}

  kernel::Object& object() { return object_; }
  const kernel::Object& object() const { return object_; }
  bool is_owned_by_caller() const { return object_.owner == kernel::running; }

  // --- after the caller's waitpoint ---

  /// True once the caller owns the lock; false if the deadline came first. An owner waits for itself.
  bool acquire(Time deadline) {
#ifndef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    if (object_.owner == nullptr) {
      kernel::own(object_, *kernel::running);
      return true;
    }
#endif
    const bool is_owner = acquire_in_any_case(deadline);
    asm volatile("");  // or lock() ends with the call, and has no frame in the stack of who waits there
    return is_owner;
  }
  /// Hands the lock on; it is a bug not to own it.
  void release() {
#ifndef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    if (is_owned_by_caller() && object_.first_waiter == nullptr) return kernel::disown(object_);
#endif
    release_in_any_case();
  }

 private:
  bool acquire_in_any_case(Time deadline);
  void release_in_any_case();

  Object object_;
};

}  // namespace waitpoint::sync
