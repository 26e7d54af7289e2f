// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/thread.hpp"

#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread_area.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

void run_thread(void* argument) {
  Thread& thread = *static_cast<Thread*>(argument);
  thread.body(thread);
}

void spend_for_computing(kernel::Task& task) {
  if (!is_thread(task)) return;
  if (record == nullptr || record->settings.asked == nullptr) return spend(cost_of_accesses);
  Thread& thread = thread_of(task);
  if (thread.spins_at != task.local_time) thread.spins = 0;
  thread.spins_at = task.local_time;
  constexpr std::uint32_t spins_at_one_instant = 50;
  if (++thread.spins < spins_at_one_instant) return;
  const Time next = task.scheduler->next_event_time();
  if (next > task.local_time && next != Time::max()) spend(next - task.local_time);
}

Thread* find(pthread_t id) {
  void* const area = reinterpret_cast<void*>(id);
  return area == nullptr ? nullptr : thread_of_area(area);
}

Duration spent_by(int id) {
  if (kernel::running == nullptr) return {};
  for (const kernel::Task* task = kernel::running->scheduler->first_task(); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).id == id) return thread_of(*task).spent;
  return {};
}

}  // namespace waitpoint::posix
