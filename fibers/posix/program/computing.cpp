// SPDX-License-Identifier: BSD-3-Clause
//
// Virtual time of instrumented code that computes for long without a call: see waiting.hpp.
#include "fibers/kernel/run_window.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

void spend_for_computing(kernel::Task& task) {
  if (!is_thread(task)) return;
  if (record == nullptr || record->settings.asked == nullptr) return spend(cost_of_accesses);
  Thread& thread = thread_of(task);
  if (thread.spins_at != task.local_time) thread.spins = 0;
  thread.spins_at = task.local_time;
  constexpr std::uint32_t spins_at_one_instant = 50;
  if (++thread.spins < spins_at_one_instant) return;
  const Time next = kernel::next_event_time(*task.scheduler);
  if (next > task.local_time && next != Time::max()) spend(next - task.local_time);
}

}  // namespace waitpoint::posix
