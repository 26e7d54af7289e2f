// SPDX-License-Identifier: BSD-3-Clause
//
// The explored order: the events of all tasks due at the present instant are moved from the event list to the ready
// set, and a strategy chooses among them.
#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
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

// Moves the events of all ready tasks to the instant of the next event.
void let_time_pass(Agenda& agenda) {
  WAITPOINT_CHECK(agenda.is_due_later(), "the strategy lets time pass, but no event is due later");
  const Time next = agenda.events.least().key.time;
  while (!agenda.ready.empty()) {
    Task& task = agenda.ready.take(0);
    set_local_time(task, next);
    agenda.events.insert(task.event, agenda.key(task, next));
  }
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

void set_decisions(Scheduler& scheduler, Decisions& decisions) {
  Agenda& agenda = scheduler.agenda;
  WAITPOINT_CHECK(agenda.chooser.order() == Order::explored, "a strategy decides only in the explored order");
  if (agenda.chooser.decisions() == nullptr) agenda.ready.reserve(tasks_max);
  agenda.chooser.set_decisions(decisions);
}

Fiber& dispatch_explored(Scheduler& scheduler) {
  Agenda& agenda = scheduler.agenda;
  for (;;) {
    if (agenda.ready.empty() || (!agenda.events.empty() && is_before_tasks_at(agenda.events.least().key, agenda.now))) {
      EventNode* node = agenda.events.pop_before(agenda.until);
      if (node == nullptr) return end_window(scheduler, agenda.size() == 0 ? RunState::idle : RunState::reached);
      agenda.now = agenda.events.present();
      if (node->fire != nullptr) {
        node->fire(*node);
        continue;
      }
      Task& task = task_of(*node);
      if (task.phase != Phase::tasks) return dispatch_task(scheduler, task);
      agenda.ready.add(task);
      while (is_of_tasks(agenda.events.least().key) && agenda.events.least().key.time == agenda.now)
        agenda.ready.add(task_of(agenda.events.pop()));
    }
    if (agenda.now >= agenda.until) return end_window(scheduler, RunState::reached);
    const std::uint32_t chosen = agenda.chooser.decisions()->next(agenda.ready.tasks(), agenda.ready.size());
    if (scheduler.window.cause != StopCause::none) return end_window(scheduler, RunState::stopped);
    if (__builtin_expect(chosen == Decisions::later, 0)) {
      let_time_pass(agenda);
      continue;
    }
    if (__builtin_expect(chosen == Decisions::elsewhere, 0)) return end_window(scheduler, RunState::reached);
    return dispatch_task(scheduler, agenda.ready.take(chosen));
  }
}

}  // namespace waitpoint::kernel
