// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/thread.hpp"

#include "fibers/kernel/run.hpp"
#include "fibers/posix/program/thread_area.hpp"

namespace waitpoint::posix {

void run_thread(void* argument) {
  Thread& thread = *static_cast<Thread*>(argument);
  thread.body(thread);
}

Thread* find(pthread_t id) {
  void* const area = reinterpret_cast<void*>(id);
  return area == nullptr ? nullptr : thread_of_area(area);
}

Duration spent_by(int id) {
  if (kernel::running == nullptr) return {};
  for (const kernel::Task* task = kernel::first_task(*kernel::running->scheduler); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).id == id) return thread_of(*task).spent;
  return {};
}

}  // namespace waitpoint::posix
