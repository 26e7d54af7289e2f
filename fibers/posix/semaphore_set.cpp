// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/semaphore_set.hpp"

#include <unistd.h>

#include "fibers/posix/program.hpp"
#include "fibers/posix/signals.hpp"
#include "fibers/posix/system_v_ends.hpp"
#include "fibers/posix/waiting.hpp"

namespace waitpoint::posix::system_v {

Table<Set, sets_max> sets;

namespace {

// Null without memory.
Adjustments* adjustments_of(Set& set, const Program* program) {
  for (Adjustments* each = set.adjustments; each != nullptr; each = each->next)
    if (each->program == program) return each;
  const std::size_t bytes = sizeof(Adjustments) + static_cast<std::size_t>(set.size) * sizeof(int);
  auto* const made = static_cast<Adjustments*>(std::calloc(1, bytes));
  if (made == nullptr) return nullptr;
  made->program = program;
  made->by = reinterpret_cast<int*>(made + 1);
  made->next = set.adjustments;
  return set.adjustments = made;
}

const Program* program_of(const kernel::Task* task) { return task != nullptr ? thread_of(*task).program : nullptr; }

// Whether all operations of a call could be done, and were; if not, which one is the first in the way and, if it can
// never be done, why.
struct Attempt {
  const sembuf* hindered_by;
  int error;
};

void take_back(Set& set, Adjustments* undo, const sembuf* from, const sembuf* to) {
  while (to != from) {
    --to;
    Value& value = set.values[to->sem_num];
    value.value = static_cast<unsigned short>(value.value - to->sem_op);
    if ((to->sem_flg & SEM_UNDO) != 0) undo->by[to->sem_num] += to->sem_op;
  }
}

Attempt attempt(Set& set, const kernel::Task* task, const sembuf* operations, std::size_t count) {
  Adjustments* undo = nullptr;
  for (const sembuf* at = operations; at != operations + count; ++at) {
    Value& value = set.values[at->sem_num];
    const int result = value.value + at->sem_op;
    int error = 0;
    const bool hindered = at->sem_op == 0 ? value.value != 0 : result < 0;
    if (result > value_max) error = ERANGE;
    if (!hindered && error == 0 && (at->sem_flg & SEM_UNDO) != 0) {
      if (undo == nullptr) undo = adjustments_of(set, program_of(task));
      if (undo == nullptr)
        error = ENOMEM;
      else if (const int by = undo->by[at->sem_num] - at->sem_op; by < -value_max - 1 || by > value_max)
        error = ERANGE;
      else
        undo->by[at->sem_num] = by;
    }
    if (hindered || error != 0) {
      take_back(set, undo, operations, at);
      return {at, error};
    }
    value.value = static_cast<unsigned short>(result);
  }
  for (const sembuf* at = operations; at != operations + count; ++at) set.values[at->sem_num].last = getpid();
  set.operated = date();
  return {nullptr, 0};
}

void end_waiting(Waiting& waiting, int result) {
  waiting.result = result;
  waiting.done = true;
  waiting.task->scheduler->wake(*waiting.task);
}

void append(Set& set, Waiting& waiting) {
  Waiting** last = &set.first;
  while (*last != nullptr) last = &(*last)->next;
  *last = &waiting;
  waiting.next = nullptr;
}

void remove(Set& set, Waiting& waiting) {
  for (Waiting** link = &set.first; *link != nullptr; link = &(*link)->next)
    if (*link == &waiting) {
      *link = waiting.next;
      return;
    }
}

// Whether a waiting call could go on if it were its turn. What can never be done ends with its error.
bool could_go_on(Set& set, Waiting& waiting) {
  Value* const values = set.values;
  int left[2];  // mostly one or two operations, on different semaphores
  if (waiting.count > 2 || (waiting.count == 2 && waiting.operations[0].sem_num == waiting.operations[1].sem_num))
    return true;
  for (std::size_t i = 0; i < waiting.count; ++i) {
    const sembuf& operation = waiting.operations[i];
    left[i] = values[operation.sem_num].value + operation.sem_op;
    if (operation.sem_op == 0 ? left[i] != 0 : left[i] < 0) return false;
  }
  return true;
}

}  // namespace

// After a change: one after the other, of the chooser's choice, as long as any call can go on.
void let_go_on(Set& set) {
  for (;;) {
    std::uint32_t count = 0;
    for (Waiting* each = set.first; each != nullptr; each = each->next)
      if (could_go_on(set, *each)) ++count;
    if (count == 0) return;
    bool any = false;
    // From the chosen one around, until one was done: those of many operations may turn out to be hindered.
    std::uint32_t chosen = is_simulated() ? kernel::running->scheduler->chooser().waiter(*kernel::running, count) : 0;
    for (std::uint32_t tried = 0; tried < count && !any; ++tried, chosen = (chosen + 1) % count) {
      std::uint32_t at = 0;
      Waiting* each = set.first;
      while (each != nullptr && (!could_go_on(set, *each) || at++ != chosen)) each = each->next;
      if (each == nullptr) break;
      const Attempt made = attempt(set, each->task, each->operations, each->count);
      each->hindered_by = made.hindered_by;
      if (made.hindered_by != nullptr && made.error == 0) continue;
      remove(set, *each);
      end_waiting(*each, made.error);
      any = true;
    }
    if (!any) return;
  }
}

void end_all(Set& set, int error) {
  while (Waiting* waiting = set.first) {
    set.first = waiting->next;
    end_waiting(*waiting, error);
  }
}

int operate(int id, const sembuf* operations, std::size_t count, Time deadline) {
  if (count == 0) return fail(EINVAL);
  if (count > operations_a_call_max) return fail(E2BIG);
  const Use<Set> set(sets.find(id));
  if (!set) return fail(EINVAL);
  bool alters = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (operations[i].sem_num >= set->size) return fail(EFBIG);
    alters = alters || operations[i].sem_op != 0;
  }
  if (!is_allowed(*set, alters ? 2 : 4)) return fail(EACCES);
  pass_if_simulated(operations->sem_op > 0 ? kernel::Operation::release : kernel::Operation::acquire, &set->object);
  if (set->removed) return fail(EIDRM);
  const Attempt made = attempt(*set, kernel::running, operations, count);
  if (made.error != 0) return fail(made.error);
  if (made.hindered_by == nullptr) {
    if (alters) let_go_on(*set);
    return 0;
  }
  if ((made.hindered_by->sem_flg & IPC_NOWAIT) != 0) return fail(EAGAIN);
  if (!is_simulated()) refuse("a thread waits before main() begins");
  if (deadline <= kernel::running->local_time) return fail(EAGAIN);
  Waiting waiting{kernel::running, operations, count, made.hindered_by, 0, false, nullptr};
  for (;;) {
    append(*set, waiting);
    const Wait ended = wait_on(set->object, deadline);
    if (waiting.done) return waiting.result == 0 ? 0 : fail(waiting.result);
    remove(*set, waiting);
    if (ended != Wait::interrupted) return fail(EAGAIN);
    if (is_interrupted(Restart::never)) return fail(EINTR);
    if (set->removed) return fail(EIDRM);
    // No handler has run: nothing has changed.
  }
}

void forget_semaphore_waiter(const kernel::Task& task) {
  for (int slot = 0; slot < sets.end(); ++slot) {
    Set* const set = sets.in_slot(slot);
    for (Waiting** link = set == nullptr ? nullptr : &set->first; link != nullptr && *link != nullptr;
         link = &(*link)->next)
      if ((*link)->task == &task) {
        *link = (*link)->next;
        --set->users;
        return;
      }
  }
}

void forget_semaphores() { sets.clear(); }

void undo_semaphores_of(const Program& program) {
  for (int slot = 0; slot < sets.end(); ++slot) {
    Set* const set = sets.in_slot(slot);
    if (set == nullptr) continue;
    for (Adjustments** link = &set->adjustments; *link != nullptr;) {
      Adjustments* const each = *link;
      if (each->program != &program) {
        link = &each->next;
        continue;
      }
      for (int i = 0; i < set->size; ++i) {
        const int to = set->values[i].value + each->by[i];
        if (each->by[i] != 0)
          set->values[i] = {static_cast<unsigned short>(to < 0 ? 0 : to > value_max ? value_max : to), getpid()};
      }
      *link = each->next;
      std::free(each);
    }
    let_go_on(*set);
  }
}

}  // namespace waitpoint::posix::system_v
