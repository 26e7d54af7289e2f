// SPDX-License-Identifier: BSD-3-Clause
//
// The explored order: the events of all tasks due at the present instant are moved from the event list to the ready
// set, and a strategy chooses among them.
#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"
#include "fibers/switch/reserved_pages.hpp"

namespace waitpoint::kernel {
namespace {

// Only events of the phase `tasks` are a choice.
constexpr std::size_t entry_size = sizeof(void*);  // of the table of ready tasks

bool is_before_tasks_at(const EventKey& key, Time time) {
  return key.time <= time && key.order < make_order(Phase::tasks, 0);
}
bool is_of_tasks(const EventKey& key) {
  return key.order >= make_order(Phase::tasks, 0) && key.order < make_order(Phase::processors, 0);
}

}  // namespace

void ReadySet::reserve(std::uint32_t capacity) {
  void* const memory = reserve_pages(capacity * entry_size);
  WAITPOINT_CHECK(memory != nullptr, "no address space for the tasks that are ready");
  tasks_ = static_cast<Task**>(memory);
  capacity_ = capacity;
}

ReadySet::~ReadySet() {
  if (tasks_ != nullptr) release_pages(tasks_, capacity_ * entry_size);
}

void Scheduler::reserve_ahead() {
  if (!has_address_space()) return;
  const PagesKept kept;
  const EventList events(events_max);
  StackArena stacks;
  ReadySet ready;
  ready.reserve(tasks_max);
  stacks.reserve_all();
  constexpr std::uint32_t usual_tasks = 8;
  stacks.guard_ahead(usual_tasks);
}

void Scheduler::set_decisions(Decisions& decisions) {
  WAITPOINT_CHECK(agenda_.chooser.order() == Order::explored, "a strategy decides only in the explored order");
  if (agenda_.chooser.decisions() == nullptr) agenda_.ready.reserve(tasks_max);
  agenda_.chooser.set_decisions(decisions);
}

// Moves the events of all ready tasks to the instant of the next event.
void Scheduler::let_time_pass() {
  WAITPOINT_CHECK(is_due_later(), "the strategy lets time pass, but no event is due later");
  const Time next = agenda_.events.least().key.time;
  while (!agenda_.ready.empty()) {
    Task& task = agenda_.ready.take(0);
    set_local_time(task, next);
    agenda_.events.insert(task.event, agenda_.key(task, next));
  }
}

Fiber& Scheduler::dispatch_explored() {
  for (;;) {
    if (agenda_.ready.empty() ||
        (!agenda_.events.empty() && is_before_tasks_at(agenda_.events.least().key, agenda_.now))) {
      EventNode* node = agenda_.events.pop_before(agenda_.until);
      if (node == nullptr) return end_window(pending_events() == 0 ? RunState::idle : RunState::reached);
      agenda_.now = agenda_.events.present();
      if (node->fire != nullptr) {
        node->fire(*node);
        continue;
      }
      Task& task = task_of(*node);
      if (task.phase != Phase::tasks) return dispatch_task(task);
      agenda_.ready.add(task);
      while (is_of_tasks(agenda_.events.least().key) && agenda_.events.least().key.time == agenda_.now)
        agenda_.ready.add(task_of(agenda_.events.pop()));
    }
    if (agenda_.now >= agenda_.until) return end_window(RunState::reached);
    const std::uint32_t chosen = agenda_.chooser.decisions()->next(agenda_.ready.tasks(), agenda_.ready.size());
    if (cause_ != StopCause::none) return end_window(RunState::stopped);
    if (__builtin_expect(chosen == Decisions::later, 0)) {
      let_time_pass();
      continue;
    }
    if (__builtin_expect(chosen == Decisions::elsewhere, 0)) return end_window(RunState::reached);
    return dispatch_task(agenda_.ready.take(chosen));
  }
}

}  // namespace waitpoint::kernel
