// SPDX-License-Identifier: BSD-3-Clause
// What a primitive has for tasks to wait for and meet at: a kernel's object that cannot vanish under those who do.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::sync {

/// It is a bug to destroy what a task of the running run holds or waits for. What another run left, or a run that is
/// over, is not looked at; nor is what is destroyed outside any task.
void check_destroyed(const kernel::Object& object);

struct Object : kernel::Object {
  using kernel::Object::Object;
  ~Object() {
    if (owner != nullptr || holder_count != 0 || users != 0) check_destroyed(*this);
  }
};

}  // namespace waitpoint::sync
