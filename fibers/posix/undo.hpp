// SPDX-License-Identifier: BSD-3-Clause
// What a program leaves behind in System V semaphores when it ends.
#pragma once

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix::system_v {

/// Takes back what the program, a robot of the simulation, did to semaphores with SEM_UNDO.
void undo_semaphores_of(const kernel::Robot& program);

}  // namespace waitpoint::posix::system_v
