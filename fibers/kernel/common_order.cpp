// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/common_order.hpp"

#include "core/error.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/scheduler_steps.hpp"

namespace waitpoint::kernel {

EventKey next_key(Scheduler& scheduler) {
  Agenda& agenda = scheduler.agenda;
  if (const Task* const paused = scheduler.window.paused; paused != nullptr) return agenda.key_in_turn(*paused);
  return agenda.ready.empty() ? agenda.next_key() : EventKey{agenda.now, make_order(Phase::tasks, 0)};
}

void schedule(Scheduler& scheduler, EventNode& node, const EventKey& key) { put(scheduler, node, key); }

void advance(Scheduler& scheduler, Time time) {
  WAITPOINT_CHECK(running == nullptr && scheduler.agenda.now <= time && time <= next_event_time(scheduler),
                  "the global time moves back, or over an event");
  scheduler.agenda.advance(time);
}

void continue_as(Scheduler& scheduler, std::uint64_t id) {
  Task& task = *running;
  WAITPOINT_CHECK(scheduler.roster.first_task() == &task && task.next == nullptr, "a child has tasks of its parent's");
  task.maker = task.id;
  task.made_after = task.sequence;
  task.id = id;
  task.sequence = task.children = 0;
  turn.close();
  hash_events_of(*task.robot);
}

}  // namespace waitpoint::kernel
