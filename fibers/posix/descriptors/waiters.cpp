// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/waiters.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/descriptors/connections.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

Waiter* head = nullptr;
Waiter* tail = nullptr;
int waiting_outside = 0;
int waiting_for_no_descriptor = 0;  // these must be polled
int waiting_for_input = 0;          // for descriptors outside
int waiting_for_streams = 0;        // of these, for terminals and standard input
int waiting_for_outsiders = 0;
family::Changes outside_changes = 0;  // what threads wait for outside

// For the other processes of the family.
void note_waits() {
  if (family::own == nullptr) return;
  // Without other processes it is not worth a search.
  family::Changes awaited = head != nullptr ? family::of_anything : 0;
  outside_changes = waiting_outside > 0 ? family::of_anything : 0;
  if (family::has_others()) {
    awaited = outside_changes = 0;
    for (const Waiter* waiter = head; waiter != nullptr; waiter = waiter->next) {
      awaited |= waiter->awaited;
      if (waiter->outside) outside_changes |= waiter->awaited;
    }
  }
  family::own->listens_to = awaited;
  family::own->waits_outside = waiting_outside > 0;
  family::own->awaits_input = waiting_for_input > 0;
  family::own->awaits_outsiders = waiting_for_outsiders > 0;
}

bool is_explored() { return record->settings.asked != nullptr; }

bool awaits_outsiders(const Waiter& waiter) {
  if (waiter.count == 0) return true;
  return waiter.partner == Partner::possible ? !is_explored() : waiter.partner != Partner::none;
}

void count_outside(const Waiter& waiter, int by) {
  waiting_outside += by;
  if (awaits_outsiders(waiter)) waiting_for_outsiders += by;
  (waiter.count == 0 ? waiting_for_no_descriptor : waiting_for_input) += by;
  if (waiter.partner == Partner::input) waiting_for_streams += by;
  WAITPOINT_CHECK(waiting_for_no_descriptor >= 0 && waiting_outside >= waiting_for_no_descriptor,
                  "the counts of threads that wait outside disagree");
}

}  // namespace

Waiter* first_waiter() { return head; }

void add(Waiter& waiter) {
  WAITPOINT_CHECK(tail == nullptr ? head == nullptr : tail->next == nullptr && tail != &waiter,
                  "the end of the list of waiting threads is broken");
  waiter.next = nullptr;
  waiter.previous = tail;
  (tail == nullptr ? head : tail->next) = &waiter;
  tail = &waiter;
  if (waiter.outside) {
    count_outside(waiter, 1);
    if (family::own != nullptr) family::own->is_to_look = true;
  }
  note_waits();
}

void remove(Waiter& waiter) {
  WAITPOINT_CHECK((waiter.previous == nullptr ? head : waiter.previous->next) == &waiter &&
                      (waiter.next == nullptr ? tail : waiter.next->previous) == &waiter,
                  "a thread that ends its wait is not in the list of waiting threads");
  (waiter.previous == nullptr ? head : waiter.previous->next) = waiter.next;
  (waiter.next == nullptr ? tail : waiter.next->previous) = waiter.previous;
  if (waiter.outside) count_outside(waiter, -1);
  note_waits();
}

family::Changes awaited_at(const pollfd* descriptors, nfds_t count) {
  family::Changes all = 0;
  for (nfds_t i = 0; i < count && all != family::of_descriptors; ++i)
    if (descriptors[i].fd >= 0) all |= changes_at(descriptors[i].fd, descriptors[i].events);
  return all;
}

family::Changes awaited_outside() { return outside_changes; }

void note_changed_watches() {
  for (Waiter* waiter = head; waiter != nullptr; waiter = waiter->next)
    if (waiter->count > 0) waiter->awaited = awaited_at(waiter->descriptors, waiter->count);
  note_waits();
}

void count_signal_waits(int by) {
  waiting_outside += by;
  if (!is_explored()) waiting_for_outsiders += by;
  WAITPOINT_CHECK(waiting_outside >= waiting_for_no_descriptor, "more waits for signals have ended than begun");
  note_waits();
}

bool anybody_must_ask() { return waiting_for_no_descriptor > 0; }

namespace {

// True if a thread of this process could act on an end inside before input from outside comes.
bool can_others_act(const kernel::Scheduler& scheduler) {
  if (family::has_others()) return true;
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next) {
    if (task->state == kernel::TaskState::blocked && !task->finite_wait) continue;
    const Waiter* waiter = head;
    while (waiter != nullptr && waiter->task != task) waiter = waiter->next;
    if (waiter == nullptr || !waiter->outside) return true;
  }
  return false;
}

}  // namespace

bool anybody_awaits_partner(const kernel::Scheduler& scheduler) {
  Partner nearest = Partner::none;
  for (const Waiter* waiter = head; waiter != nullptr; waiter = waiter->next)
    if (waiter->task->state == kernel::TaskState::blocked) nearest = std::max(nearest, waiter->partner);
  if (nearest == Partner::possible) return !is_explored() && !can_others_act(scheduler);
  return nearest == Partner::certain;
}

namespace {

bool may_be_served_by_natives() { return head != nullptr && !has_host && family::has_natives(); }

}  // namespace

bool anybody_waits_outside() { return waiting_outside > 0 || may_be_served_by_natives(); }
bool anybody_awaits_stream() { return waiting_for_streams > 0; }
bool anybody_awaits_outsiders() { return waiting_for_outsiders > 0 || may_be_served_by_natives(); }

void forget_waiters() {
  head = tail = nullptr;
  waiting_outside = waiting_for_no_descriptor = waiting_for_input = waiting_for_streams = waiting_for_outsiders = 0;
}

const pollfd* awaited_descriptors(const kernel::Task& task, nfds_t& count) {
  count = 0;
  for (const Waiter* waiter = head; waiter != nullptr; waiter = waiter->next)
    if (waiter->task == &task) {
      count = waiter->count;
      return waiter->descriptors;
    }
  return nullptr;
}

void forget_waiter(const kernel::Task& task) {
  for (Waiter* waiter = head; waiter != nullptr; waiter = waiter->next)
    if (waiter->task == &task) return remove(*waiter);
}

}  // namespace waitpoint::posix
