// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/taskLib.hpp"

#include <cerrno>
#include <string>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/laas/tasks.hpp"
#include "fibers/laas/ticks.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::laas {
namespace {

bool is_priority(int priority) { return priority >= 0 && priority <= 255; }

kernel::StackSize stack_for(int bytes) {
  kernel::StackSize size = kernel::StackSize::small;
  while (static_cast<std::size_t>(bytes) > kernel::bytes(size)) size = static_cast<kernel::StackSize>(int(size) + 1);
  return size;
}

// Registers the caller's control block while its function runs.
struct Spawned {
  explicit Spawned(TaskControlBlock& block) { Tasks::here().adopt(block); }
  ~Spawned() { Tasks::here().end(); }
};

// Thrown by taskDelete() through the task's frames.
struct TaskDeleted {};

}  // namespace

long spawn_task(const char* name, int priority, int options, int stackSize, std::function<void()> body) {
  if (!is_priority(priority) || stackSize < 0) return fail(EINVAL);
  if (stackSize > stack_size_max) return fail(S_portLib_NO_MEMORY);
  TaskControlBlock& block = Tasks::here().make();
  block.name = name != nullptr ? name : "t" + std::to_string(block.id);
  block.priority = priority;
  block.options = options;
  block.spawned = true;
  const thread_attributes attributes{block.name.c_str(), stack_for(stackSize), (options & TASK_SERVICE) != 0};
  thread(attributes, [&block, body = std::move(body)] {
    const Spawned spawned(block);
    try {
      body();
    } catch (const TaskDeleted&) {
    }
  }).detach();
  return block.id;
}

STATUS taskDelete(long tid) {
  const TaskControlBlock& self = Tasks::here().self();
  if (Tasks::here().find(tid) == nullptr) return fail(S_portLib_INVALID_TASKID);
  if ((tid != 0 && tid != self.id) || !self.spawned) return fail(S_portLib_NOT_IMPLEMENTED);
  throw TaskDeleted();
}

long taskIdSelf() { return Tasks::here().self().id; }

const char* taskName(long tid) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task != nullptr) return task->name.c_str();
  fail(S_portLib_INVALID_TASKID);
  return nullptr;
}

long taskNameToId(const char* name) {
  TaskControlBlock* const task = Tasks::here().find(std::string(name));
  return task != nullptr ? task->id : fail(S_portLib_NO_SUCH_TASK);
}

STATUS taskDelay(int ticks) {
  if (ticks < 0) return fail(EINVAL);
  if (ticks == 0) {
    this_thread::yield();
    return OK;
  }
  const Ticks& clock = Ticks::here();
  WAITPOINT_REQUIRE(clock.running(), "a delay in ticks, but h2initGlob() started no clock");
  this_thread::sleep_for(clock.span(ticks));
  return OK;
}

STATUS taskSuspend(long tid) {
  Tasks& tasks = Tasks::here();
  TaskControlBlock& self = tasks.self();
  if (tasks.find(tid) == nullptr) return fail(S_portLib_INVALID_TASKID);
  if (tid != 0 && tid != self.id) return fail(S_portLib_NOT_IMPLEMENTED);
  sync::enter_run(self.suspended);
  if (sync::before_blocking(kernel::Operation::wait, tasks.object())) sync::block(self.suspended);
  return OK;
}

STATUS taskResume(long tid) {
  Tasks& tasks = Tasks::here();
  if (!sync::before_releasing(kernel::Operation::release, tasks.object())) return OK;
  TaskControlBlock* const task = tasks.find(tid);
  if (task == nullptr) return fail(S_portLib_INVALID_TASKID);
  kernel::wake_all(*sync::running_task().scheduler, task->suspended);
  return OK;
}

STATUS taskPrioritySet(long tid, int newPriority) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task == nullptr) return fail(S_portLib_INVALID_TASKID);
  if (!is_priority(newPriority)) return fail(EINVAL);
  task->priority = newPriority;
  return OK;
}

STATUS taskPriorityGet(long tid, int* pPriority) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task == nullptr) return fail(S_portLib_INVALID_TASKID);
  if (pPriority != nullptr) *pPriority = task->priority;
  return OK;
}

STATUS taskOptionsGet(long tid, int* pOptions) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task == nullptr) return fail(S_portLib_INVALID_TASKID);
  if (pOptions != nullptr) *pOptions = task->options;
  return OK;
}

STATUS taskSetUserData(long tid, unsigned long data) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task == nullptr) return fail(S_portLib_INVALID_TASKID);
  task->user_data = data;
  return OK;
}

unsigned long taskGetUserData(long tid) {
  TaskControlBlock* const task = Tasks::here().find(tid);
  if (task != nullptr) return task->user_data;
  fail(S_portLib_INVALID_TASKID);
  return 0;
}

}  // namespace waitpoint::laas
