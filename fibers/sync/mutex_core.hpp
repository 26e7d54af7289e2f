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
    if (object_.owner != nullptr) return wait_for_owner(deadline);
    const Unseen unseen;
    kernel::own(object_, *kernel::running);
    return true;
  }
  /// Hands the lock on; it is a bug not to own it.
  void release() {
    if (!is_owned_by_caller() || object_.first_waiter != nullptr) return hand_over();
    const Unseen unseen;
    kernel::disown(object_);
  }

 private:
  bool wait_for_owner(Time deadline);
  void hand_over();

  Object object_;
};

}  // namespace waitpoint::sync
