// SPDX-License-Identifier: BSD-3-Clause
// The common part of semLib's and h2semLib's semaphores: a count, or a holder, and the waiting tasks.
//
// A mutex is a ticket lock, first come, first served, in every order: a give hands it to the longest waiting task, so
// that two tasks which loop over take and give alternate strictly. pocolibs also draws a ticket if the call then does
// not wait, so a failed try leaves a ticket that is never served; here only waiting tasks have a place in the queue,
// and a time-out gives it up. A count does not saturate; the chooser picks among several waiting tasks.
#pragma once

#include <cstdint>

#include "fibers/laas/ticks.hpp"

namespace waitpoint::laas {

enum class TakeResult : std::uint8_t {
  taken,
  timed_out,
  deleted,  ///< while the caller waited
};

class Semaphore {
 public:
  enum class Kind : std::uint8_t { none, count, mutex };

  explicit Semaphore(kernel::Robot& robot, const char* label = "") : object_("semaphore", label), robot_(robot) {}

  /// Makes an unused one a semaphore of `kind` with `count` units (a mutex: free).
  void create(Kind kind, int count);
  /// Makes it unused; waiting tasks return TakeResult::deleted.
  void destroy();
  Kind kind() const { return kind_; }

  /// Takes a unit, or the mutex, within a time-out in ticks from the call: see Ticks::deadline.
  TakeResult take(int ticks);
  /// Releases one. OK, or an errno: EPERM for a mutex not held by the caller, EOVERFLOW for a count overflow.
  int give();
  /// Wakes all waiting tasks; the count is unchanged.
  void flush();
  /// Sets the count; waiting tasks are served from it.
  void set(int count);

  // --- without a waitpoint: the caller has passed one ---

  /// Blocks the caller until a unit is handed to it, or the deadline.
  TakeResult wait(Time deadline);
  /// Hands a unit to a waiting task, or adds it to the count.
  void hand_over();
  bool has_waiters() const { return kind_ != Kind::none && object_.first_waiter != nullptr; }

  kernel::Object& object() { return object_; }
  int count = 0;

 private:
  kernel::Object object_;
  kernel::Robot& robot_;
  Kind kind_ = Kind::none;
  std::uint32_t generation_ = 0;  // counts creations and destructions
};

}  // namespace waitpoint::laas
