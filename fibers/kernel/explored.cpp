// SPDX-License-Identifier: BSD-3-Clause
//
// The order in which somebody else decides: the events of tasks that are due at the present instant are taken out of
// the event list together, and chosen from.
#include <sys/mman.h>

#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {
namespace {

// Of all phases the one in which there is a choice.
bool is_before_tasks_at(const EventKey& key, Time time) {
  return key.time <= time && key.order < make_order(Phase::tasks, 0);
}
bool is_of_tasks(const EventKey& key) {
  return key.order >= make_order(Phase::tasks, 0) && key.order < make_order(Phase::processors, 0);
}

}  // namespace

void ReadySet::reserve(std::uint32_t capacity) {
  void* memory = mmap(nullptr, capacity * sizeof(Task*), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  WAITPOINT_CHECK(memory != MAP_FAILED, "no address space for the tasks that are ready");
  tasks_ = static_cast<Task**>(memory);
  capacity_ = capacity;
}

ReadySet::~ReadySet() {
  if (tasks_ != nullptr) munmap(tasks_, capacity_ * sizeof(Task*));
}

void Scheduler::set_decisions(Decisions& decisions) {
  WAITPOINT_CHECK(chooser_.order() == Order::explored, "only in the explored order somebody else decides");
  if (chooser_.decisions() == nullptr) ready_.reserve(tasks_max);
  chooser_.set_decisions(decisions);
}

bool Scheduler::is_due_later() const { return !events_.empty() && events_.least().key.time < until_; }

// Those that are ready go on at the instant of the next event.
void Scheduler::let_time_pass() {
  WAITPOINT_CHECK(is_due_later(), "nothing is due later, for which time could pass");
  const Time next = events_.least().key.time;
  while (!ready_.empty()) {
    Task& task = ready_.take(0);
    set_local_time(task, next);
    events_.insert(task.event, key(task, next));
  }
}

Fiber& Scheduler::next_explored() {
  for (;;) {
    if (ready_.empty() || (!events_.empty() && is_before_tasks_at(events_.least().key, now_))) {
      EventNode* node = events_.pop_before(until_);
      if (node == nullptr) return outside(pending_events() == 0 ? RunState::idle : RunState::reached);
      now_ = events_.present();
      if (node->fire != nullptr) {
        node->fire(*node);
        continue;
      }
      Task& task = task_of(*node);
      if (task.phase != Phase::tasks) return go(task).fiber;
      ready_.add(task);
      while (is_of_tasks(events_.least().key) && events_.least().key.time == now_) ready_.add(task_of(events_.pop()));
    }
    if (now_ >= until_) return outside(RunState::reached);
    const std::uint32_t chosen = chooser_.decisions()->next(ready_.tasks(), ready_.size());
    if (cause_ != StopCause::none) return outside(RunState::stopped);
    if (__builtin_expect(chosen == Decisions::later, 0)) {
      let_time_pass();
      continue;
    }
    return go(ready_.take(chosen)).fiber;
  }
}

}  // namespace waitpoint::kernel
