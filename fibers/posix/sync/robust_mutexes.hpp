// SPDX-License-Identifier: BSD-3-Clause
// Mutexes held by a thread that ends, or whose process is forked. The next owner of a robust one gets EOWNERDEAD.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// Hands over the robust mutexes that the running thread holds at its end. Others stay locked.
void let_robust_mutexes_go();
/// What the running thread still holds stays locked, by no task: its own record will be another's.
void leave_held_objects();
/// In a child process: the mutexes that `task`, which is not there, held at the fork stay locked.
void leave_mutexes_of(kernel::Task& task);
/// Takes `object` from its owner, which may have left it so.
void take_from_owner(kernel::Object& object);
/// In a child process: process-shared mutexes are still held by the parent's thread, not by its copy.
void leave_shared_mutexes();

}  // namespace waitpoint::posix
