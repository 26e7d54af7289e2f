// SPDX-License-Identifier: BSD-3-Clause
// VxWorks' tasks as pocolibs has them. Priorities go from 0, the highest, to 255; a task has its processor to itself
// unless its robot declares processors, so that they are kept and asked for, but decide nothing here.
//
// Ids are small numbers of the robot's own, never addresses; 0 is the caller.
#pragma once

#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fibers/laas/portLib.hpp"

namespace waitpoint::laas {

/// Options of taskSpawn: the coprocessor (ignored), and ours: the task does not keep the run alive.
inline constexpr int VX_FP_TASK = 0x0008;
inline constexpr int TASK_SERVICE = 0x10000;

/// Stacks go up to this; a larger one is S_portLib_NO_MEMORY.
inline constexpr int stack_size_max = 256 * 1024;

/// As taskSpawn, of what is called without arguments.
long spawn_task(const char* name, int priority, int options, int stackSize, std::function<void()> body);

/// A new task of the caller's robot that calls `entryPt(arguments...)`, and its id; or ERROR. Without a name it is
/// called "t" and its number.
template <class Function, class... Arguments>
long taskSpawn(const char* name, int priority, int options, int stackSize, Function&& entryPt,
               Arguments&&... arguments) {
  return spawn_task(name, priority, options, stackSize,
                    [entry = std::decay_t<Function>(std::forward<Function>(entryPt)),
                     parts = std::tuple<std::decay_t<Arguments>...>(std::forward<Arguments>(arguments)...)]() mutable {
                      std::apply(entry, std::move(parts));
                    });
}

/// The caller's id.
long taskIdSelf();
/// Null, or ERROR, where there is no such task.
const char* taskName(long tid);
long taskNameToId(const char* name);

/// Sleeps for as long as so many ticks last, from now on (between ticks, as pocolibs on POSIX does); 0 lets others of
/// this instant go first. A negative number is EINVAL, a positive one without a clock a bug.
STATUS taskDelay(int ticks);

/// The caller stops until another resumes it. Stopping another task is not implemented, as in pocolibs.
STATUS taskSuspend(long tid);
/// Nothing happens to a task that is not suspended.
STATUS taskResume(long tid);

STATUS taskPrioritySet(long tid, int newPriority);
STATUS taskPriorityGet(long tid, int* pPriority);
STATUS taskOptionsGet(long tid, int* pOptions);
STATUS taskSetUserData(long tid, unsigned long data);
/// 0 where there is no such task.
unsigned long taskGetUserData(long tid);

}  // namespace waitpoint::laas
