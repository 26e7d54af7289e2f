// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/program.hpp"

#include "fibers/kernel/run.hpp"
#include "fibers/posix/program/allocator.hpp"
#include "fibers/posix/program/timer_firing.hpp"

namespace waitpoint::posix {

Record* record = nullptr;
constinit Program process_program;
constinit AllocatorCode allocator_code;
bool is_timer_firing = false;
std::uint64_t timers_fired = 0;
void (*instead_of_ending)(int status) = nullptr;

kernel::Task* first_task() {
  if (kernel::running != nullptr) return kernel::first_task(*kernel::running->scheduler);
  return has_host || record == nullptr || !record->began ? nullptr : kernel::first_task(record->scheduler());
}

Thread* thread_with_id(int id) {
  for (kernel::Task* task = first_task(); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).id == id) return &thread_of(*task);
  return nullptr;
}

}  // namespace waitpoint::posix
