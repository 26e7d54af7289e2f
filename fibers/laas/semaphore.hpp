// SPDX-License-Identifier: BSD-3-Clause
// What semLib's and h2semLib's semaphores are both made of: a count, or a holder, and who waits.
//
// A mutex is a ticket lock, first come, first served, in every order: giving it hands it to who has waited longest, so
// that two tasks which loop over take and give alternate strictly. pocolibs draws the ticket also where it then does
// not wait, and a take that fails without waiting leaves a ticket that nobody will serve; here only who waits has a
// place in the queue, and gives it up with the time-out. A count does not saturate; who of several is served is a
// choice.
#pragma once

#include <cstdint>

#include "fibers/laas/ticks.hpp"

namespace waitpoint::laas {

enum class Taken : std::uint8_t {
  taken,
  timed_out,
  deleted,  ///< while the caller waited
};

class Semaphore {
 public:
  enum class Kind : std::uint8_t { none, count, mutex };

  explicit Semaphore(kernel::Robot& robot, const char* label = "") : object_("semaphore", label), robot_(robot) {}

  /// Makes it one of `kind` with `count` units (a mutex: free). It must be of none.
  void create(Kind kind, int count);
  /// Makes it one of none; who waits goes on with Taken::deleted.
  void destroy();
  Kind kind() const { return kind_; }

  /// Takes a unit, or the mutex, within a time-out in ticks that counts from the call: see Ticks::deadline.
  Taken take(int ticks);
  /// Gives one back. OK, or an errno: EPERM for a mutex that the caller does not hold, EOVERFLOW for a unit too many.
  int give();
  /// Lets all go on that wait; a count stays what it is.
  void flush();
  /// Sets the count; who waits is served from it.
  void set(int count);

  // --- without a waitpoint, for who has passed one ---

  /// Blocks the caller until a unit is handed to it, or the deadline.
  Taken wait(Time deadline);
  /// Hands a unit to one that waits, or adds it to the count.
  void hand_over();
  bool has_waiters() const { return kind_ != Kind::none && object_.first_waiter != nullptr; }

  kernel::Object& object() { return object_; }
  int count = 0;

 private:
  kernel::Object object_;
  kernel::Robot& robot_;
  Kind kind_ = Kind::none;
  std::uint32_t generation_ = 0;  // of what this place was made and destroyed for
};

}  // namespace waitpoint::laas
