// SPDX-License-Identifier: BSD-3-Clause
// A robot's table of tasks for pocolibs: the contents of VxWorks' task control blocks.
//
// A task is in the table from taskSpawn() to its end. A task created otherwise, and the pseudo-task of the robot's
// timers, is added at its first call, and stays until the end of the run.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "fibers/laas/portLib.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

namespace waitpoint::laas {

struct TaskControlBlock {
  explicit TaskControlBlock(long number) : id(number) {}
  long id;
  std::string name;
  int priority = 0;
  int options = 0;
  int error = 0;
  unsigned long user_data = 0;
  bool spawned = false;                        ///< by taskSpawn
  int events = 0;                              ///< the h2 semaphore that counts its events; 0 until it first waits for
                                               ///< one
  kernel::Object suspended{"suspended task"};  ///< it blocks on this between taskSuspend and taskResume
};

class Tasks : public sync::RobotState {
 public:
  explicit Tasks(kernel::Robot&) {}
  static Tasks& here() { return sync::state_of<Tasks>(*sync::running_task().robot); }

  /// The caller's block; created if it has none.
  TaskControlBlock& self();
  /// By its id, 0 being the caller; null if there is none.
  TaskControlBlock* find(long id);
  /// By its name, the first of several; null if there is none.
  TaskControlBlock* find(const std::string& name);

  TaskControlBlock& make();
  /// Registers `block` as the caller's.
  void adopt(TaskControlBlock& block) { by_task_.emplace(sync::running_task().id, &block); }
  /// Removes the caller's.
  void end();

  /// The object of operations on the table, which conflict: a task may end before another acts on it.
  kernel::Object& object() { return object_; }

 private:
  kernel::Object object_{"task table"};
  std::map<long, TaskControlBlock> by_id_;
  std::map<std::uint64_t, TaskControlBlock*> by_task_;  // by the kernel's id
  long made_ = 0;
};

}  // namespace waitpoint::laas
