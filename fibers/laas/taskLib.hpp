// SPDX-License-Identifier: BSD-3-Clause
// VxWorks' tasks as implemented by pocolibs. Priorities go from 0, the highest, to 255. A task has a processor of its
// own unless its robot declares processors; without these, priorities are stored but have no effect.
//
// Ids are small numbers of the robot's own, never addresses; 0 is the caller.
#pragma once

#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fibers/laas/include/taskLib.h"
#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// An option of taskSpawn beyond VxWorks': the task does not keep the run alive.
inline constexpr int TASK_SERVICE = 0x10000;

/// The greatest stack size in bytes; a larger one is S_portLib_NO_MEMORY.
inline constexpr int stack_size_max = 256 * 1024;

/// As taskSpawn, for a function without arguments.
long spawn_task(const char* name, int priority, int options, int stackSize, std::function<void()> body);

/// Creates a task of the caller's robot that calls `entryPt(arguments...)`, and returns its id; or ERROR. Without a
/// name it is called "t" and its number.
template <class Function, class... Arguments>
long taskSpawn(const char* name, int priority, int options, int stackSize, Function&& entryPt,
               Arguments&&... arguments) {
  return spawn_task(name, priority, options, stackSize,
                    [entry = std::decay_t<Function>(std::forward<Function>(entryPt)),
                     parts = std::tuple<std::decay_t<Arguments>...>(std::forward<Arguments>(arguments)...)]() mutable {
                      std::apply(entry, std::move(parts));
                    });
}

/// Ends the caller, a task of taskSpawn() given by 0 or its id. Deleting another task is not implemented.
STATUS taskDelete(long tid);

/// The caller's id.
long taskIdSelf();
/// Null, or ERROR, if there is no such task.
const char* taskName(long tid);
long taskNameToId(const char* name);

/// Sleeps for the duration of `ticks` from now (not aligned to ticks, as pocolibs on POSIX does); 0 yields to the other
/// tasks of this instant. A negative number is EINVAL, a positive one without a clock a misuse.
STATUS taskDelay(int ticks);

/// Suspends the caller until another task resumes it. Suspending another task is not implemented, as in pocolibs.
STATUS taskSuspend(long tid);
/// No effect on a task that is not suspended.
STATUS taskResume(long tid);

STATUS taskPrioritySet(long tid, int newPriority);
STATUS taskPriorityGet(long tid, int* pPriority);
STATUS taskOptionsGet(long tid, int* pOptions);
STATUS taskSetUserData(long tid, unsigned long data);
/// 0 if there is no such task.
unsigned long taskGetUserData(long tid);

}  // namespace waitpoint::laas
