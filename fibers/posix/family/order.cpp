// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/order.hpp"

#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix::family {
namespace {

// Ends the window of the run: the event of another process, or a ring of this one, is the least.
void end_window(kernel::EventNode&) { kernel::pause(record->scheduler()); }
kernel::EventNode limit{kernel::EventNode::absent, end_window};

// Just before the least event of another process. Equal keys are in the order of the table.
kernel::EventKey limit_before(const Process& other, const kernel::Scheduler& scheduler) {
  kernel::EventKey key = key_of(other);
  if (key.time == Time::max()) return kernel::EventKey::never();
  if (index_of(*own) < index_of(other)) ++key.order;
  // In the explored order a strategy chooses among the processes with tasks of an instant: see process_choices.hpp.
  const bool is_explored = record->settings.order == kernel::Order::explored;
  if (is_explored && kernel::phase_of(key.order) >= kernel::Phase::tasks)
    key.order = kernel::make_order(kernel::Phase::processors, kernel::tie_mask);
  if (key.time < kernel::global_time(scheduler)) key.time = kernel::global_time(scheduler);
  return key;
}

}  // namespace

std::uint32_t index_of(const Process& process) { return static_cast<std::uint32_t>(&process - family->processes); }

kernel::EventKey key_of(const Process& process) { return key_of(*family, process); }

bool precedes(const Process& a, const Process& b) { return precedes(*family, a, b); }

Process* least_other() { return least_other(*family, *own); }

kernel::EventKey least_of_others() {
  const Process* const least = least_other();
  return least != nullptr ? key_of(*least) : kernel::EventKey::never();
}

bool has_others() { return family != nullptr && family->alive > 1; }

void remove_limit(kernel::Scheduler& scheduler) {
  if (limit.in_list()) kernel::cancel(scheduler, limit);
}

void limit_window(kernel::Scheduler& scheduler) {
  remove_limit(scheduler);
  const Process* const least = has_others() ? least_other() : nullptr;
  kernel::EventKey key = kernel::EventKey::never();
  if (least != nullptr) key = limit_before(*least, scheduler);
  if (own->is_rung && key_of_ring(*family, *own) < key) key = key_of_ring(*family, *own);
  if (key.time != Time::max()) kernel::schedule(scheduler, limit, key);
}

void ring(Process& process, Changes changes) {
  process.rung_for |= changes;
  const Time now = kernel::running != nullptr ? kernel::running->local_time : kernel::global_time(record->scheduler());
  if (process.is_rung && process.rung_at <= now) return;
  process.is_rung = true;
  process.rung_at = now;
  if (kernel::running != nullptr) limit_window(*kernel::running->scheduler);
}

void ring(Changes changes) {
  if (!has_others()) return;
  for (Process& process : entries())
    if (&process != own && (process.listens_to & changes) != 0 && takes_turns(process)) ring(process, changes);
}

}  // namespace waitpoint::posix::family
