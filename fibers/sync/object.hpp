// SPDX-License-Identifier: BSD-3-Clause
// The kernel object of a primitive, checked against destruction while in use.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

/// Destroying an object that a task of the current run holds or waits for is a misuse. Objects left by an earlier or
/// finished run, and destruction outside any task, are not checked.
void check_destroyed(const kernel::Object& object);

/// For the destructors of objects that may be destroyed once no task waits: gives woken tasks that have not run since a
/// turn to leave.
void drain_woken_waiters(const kernel::Object& object);

struct Object : kernel::Object {
  using kernel::Object::Object;
  ~Object() {
    if (owner != nullptr || holder_count != 0 || users != 0) check_destroyed(*this);
  }
};

}  // namespace waitpoint::sync
