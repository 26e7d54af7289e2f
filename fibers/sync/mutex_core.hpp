// SPDX-License-Identifier: BSD-3-Clause
// Exclusive ownership: the common part of mutex, timed_mutex and their recursive variants.
//
// A lock has one owner or none (kernel/ownership.hpp). A release with waiters hands the lock directly to one of them,
// chosen by the chooser: no other task can take it in between.
#pragma once

#include "fibers/kernel/ownership.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/object.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint::sync {

class MutexCore {
 public:
  constexpr MutexCore(const char* kind, const char* label) : object_(kind, label) {}

  kernel::Object& object() { return object_; }
  const kernel::Object& object() const { return object_; }
  bool is_owned_by_caller() const { return object_.owner == kernel::running; }

  // --- after the caller's waitpoint ---

  /// True once the caller owns the lock; false if the deadline came first. Relocking by the owner blocks.
  [[gnu::always_inline]] bool acquire(Time deadline) {
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    return acquire_unseen(deadline);
#else
    return acquire_here(deadline);
#endif
  }
  /// Hands the lock over; it is a misuse not to own it.
  [[gnu::always_inline]] void release() {
#ifndef WAITPOINT_SEEN_BY_THREAD_SANITIZER
    if (__builtin_expect(is_owned_by_caller(), 1)) return release_here();
#endif
    release_slow();
  }

 private:
  [[gnu::always_inline]] bool acquire_here(Time deadline) {
    if (object_.owner == nullptr) {
      kernel::own(object_, *kernel::running);
      return true;
    }
    // An expired deadline must not enqueue a waiter, not even for this instant.
    if (deadline != Time::max() && deadline <= kernel::running->local_time) return false;
    return block(object_, deadline);  // release made the woken task the owner
  }
  [[gnu::always_inline]] void release_here() {
    kernel::disown(object_);
    if (kernel::Task* next = wake_one(object_); next != nullptr) kernel::own(object_, *next);
  }
  bool acquire_unseen(Time deadline);
  void release_slow();

  Object object_;
};

}  // namespace waitpoint::sync
