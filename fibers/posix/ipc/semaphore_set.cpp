// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/ipc/semaphore_set.hpp"

#include <algorithm>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/chain.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/ipc/system_v_ends.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix::system_v {

namespace {

// Null without memory.
Adjustments* adjustments_of(Set& set, const Caller& caller) {
  for (Adjustments* each = set.adjustments; each != nullptr; each = each->next)
    if (each->of == caller) return each;
  const std::size_t bytes = sizeof(Adjustments) + static_cast<std::size_t>(set.size) * sizeof(int);
  auto* const made = static_cast<Adjustments*>(family::take(bytes));
  if (made == nullptr) return nullptr;
  made->of = caller;
  made->by = reinterpret_cast<int*>(made + 1);
  made->next = set.adjustments;
  return set.adjustments = made;
}

Caller this_caller() { return {family::this_process(), is_simulated() ? &this_program() : nullptr}; }

// The result of a call's operations: if they were not done, the first that hinders the call, and an error if it can
// never be done.
struct Attempt {
  const sembuf* hindered_by;  // null: all were done
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

Attempt attempt(Set& set, const Caller& caller, const sembuf* operations, std::size_t count) {
  Adjustments* undo = nullptr;
  for (const sembuf* at = operations; at != operations + count; ++at) {
    WAITPOINT_CHECK(at->sem_num < set.size, "an operation is on a semaphore that its set does not have");
    Value& value = set.values[at->sem_num];
    const int result = value.value + at->sem_op;
    int error = 0;
    const bool hindered = at->sem_op == 0 ? value.value != 0 : result < 0;
    if (result > value_max) error = ERANGE;
    if (!hindered && error == 0 && (at->sem_flg & SEM_UNDO) != 0) {
      if (undo == nullptr) undo = adjustments_of(set, caller);
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
  for (const sembuf* at = operations; at != operations + count; ++at) set.values[at->sem_num].last = caller.process;
  set.operated = date();
  return {nullptr, 0};
}

void end_waiting(Waiting& waiting, int result) {
  WAITPOINT_CHECK(!waiting.done && result >= 0, "a call on semaphores ends twice, or without a result");
  waiting.result = result;
  waiting.done = true;
  if (waiting.caller.process != family::this_process()) return family::ring(family::of_objects);
  // A signal may have woken it before: then it finds the result when it runs.
  if (waiting.task->state == kernel::TaskState::blocked) kernel::wake(*waiting.task->scheduler, *waiting.task);
}

// Applies the adjustments and frees them.
void undo(Set& set, Adjustments& adjustments) {
  for (int i = 0; i < set.size; ++i) {
    const int to = set.values[i].value + adjustments.by[i];
    if (adjustments.by[i] != 0)
      set.values[i] = {static_cast<unsigned short>(std::clamp(to, 0, value_max)), adjustments.of.process};
  }
  family::give(&adjustments);
}

// False if a waiting call cannot continue now. A call of many operations is only known to when it is attempted.
bool could_go_on(Set& set, Waiting& waiting) {
  Value* const values = set.values;
  int left[2];  // most calls have one or two operations, on different semaphores
  if (waiting.count > 2 || (waiting.count == 2 && waiting.operations()[0].sem_num == waiting.operations()[1].sem_num))
    return true;
  for (std::size_t i = 0; i < waiting.count; ++i) {
    const sembuf& operation = waiting.operations()[i];
    left[i] = values[operation.sem_num].value + operation.sem_op;
    if (operation.sem_op == 0 ? left[i] != 0 : left[i] < 0) return false;
  }
  return true;
}

// Drops the waiting calls of killed processes.
void drop_dead(Set& set) {
  take_out_dead(
      set.first, [](const Waiting& each) { return each.caller.process; }, [](Waiting& each) { family::give(&each); });
}

bool is_done(const void* waiting) { return static_cast<const Waiting*>(waiting)->done; }

// The record of a waiting call.
Waiting* make_waiting(const Caller& caller, const sembuf* operations, std::size_t count) {
  WAITPOINT_CHECK(count > 0 && count <= operations_a_call_max, "a call waits with too many operations, or none");
  auto* const made = static_cast<Waiting*>(family::take(sizeof(Waiting) + count * sizeof(sembuf)));
  if (made == nullptr) return nullptr;
  made->caller = caller;
  made->task = kernel::running;
  made->count = count;
  std::copy(operations, operations + count, made->operations());
  return made;
}

}  // namespace

// One call after the other, by the chooser's choice, while any can continue.
void let_go_on(Set& set) {
  drop_dead(set);
  for (;;) {
    std::uint32_t count = 0;
    for (Waiting* each = set.first; each != nullptr; each = each->next)
      if (could_go_on(set, *each)) ++count;
    if (count == 0) return;
    bool any = false;
    // Round-robin from the chosen call until one is done: an attempt may show that many operations are hindered.
    std::uint32_t chosen =
        is_simulated() ? kernel::chooser(*kernel::running->scheduler).waiter(*kernel::running, count) : 0;
    WAITPOINT_CHECK(chosen < count, "a call on semaphores is chosen that does not wait");
    for (std::uint32_t tried = 0; tried < count && !any; ++tried, chosen = (chosen + 1) % count) {
      std::uint32_t at = 0;
      Waiting* each = set.first;
      while (each != nullptr && (!could_go_on(set, *each) || at++ != chosen)) each = each->next;
      if (each == nullptr) break;
      const Attempt made = attempt(set, each->caller, each->operations(), each->count);
      if (made.hindered_by != nullptr)
        each->hindered_by = static_cast<std::size_t>(made.hindered_by - each->operations());
      if (made.hindered_by != nullptr && made.error == 0) continue;
      remove(set.first, *each);
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

bool undo_of_ended(Set& set) {
  const bool any = take_out_dead(
      set.adjustments, [](const Adjustments& each) { return each.of.process; },
      [&](Adjustments& each) { undo(set, each); });
  if (any) let_go_on(set);
  return any;
}

namespace {

// The result of begin() if the call has to wait.
constexpr int no_wait_yet = -1;

int begin(Set& set, const Caller& caller, const sembuf* operations, std::size_t count, bool may_wait,
          Waiting*& waiting) {
  if (set.removed) return EIDRM;
  if (set.adjustments != nullptr) undo_of_ended(set);
  const Attempt made = attempt(set, caller, operations, count);
  if (made.error != 0) return made.error;
  if (made.hindered_by == nullptr) {
    if (std::any_of(operations, operations + count, [](const sembuf& each) { return each.sem_op != 0; }))
      let_go_on(set);
    return 0;
  }
  if ((made.hindered_by->sem_flg & IPC_NOWAIT) != 0 || !may_wait) return EAGAIN;
  waiting = make_waiting(caller, operations, count);
  if (waiting == nullptr) return ENOMEM;
  waiting->hindered_by = static_cast<std::size_t>(made.hindered_by - operations);
  append(set.first, *waiting);
  return no_wait_yet;
}

// Another process may have ended in the meantime: then its SEM_UNDO operations are reverted.
struct Awaited {
  Set& set;
  Waiting& waiting;
};
bool is_done_or_undone(const void* what) {
  const auto& awaited = *static_cast<const Awaited*>(what);
  if (is_done(&awaited.waiting)) return true;
  return undo_of_ended(awaited.set) && is_done(&awaited.waiting);
}

int wait_until_done(Set& set, Waiting& waiting, Time deadline) {
  const Awaited awaited{set, waiting};
  for (;;) {
    const Wait ended = wait_on_shared(object_of(set), deadline, is_done_or_undone, &awaited);
    if (waiting.done) return waiting.result;
    if (ended == Wait::timed_out) return EAGAIN;
    if (ended != Wait::interrupted) continue;  // check again
    // The handler may leave by a jump, so the call is out of the list while it runs.
    remove(set.first, waiting);
    if (is_interrupted(Restart::never)) return EINTR;
    if (set.removed) return EIDRM;
    append(set.first, waiting);
  }
}

}  // namespace

int operate(int id, const sembuf* given, std::size_t count, Time deadline) {
  if (count == 0) return fail(EINVAL);
  if (count > operations_a_call_max) return fail(E2BIG);
  if (!can_be_read(given)) return fail(EFAULT);
  // At the waitpoint below, another thread may change the program's own, which are checked before.
  sembuf operations[operations_a_call_max];
  std::copy(given, given + count, operations);
  const Use<Set> set([&] { return sets().find(id); });
  if (!set) return fail(EINVAL);
  bool alters = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (operations[i].sem_num >= set->size) return fail(EFBIG);
    alters = alters || operations[i].sem_op != 0;
  }
  if (!is_allowed(*set, alters ? 2 : 4)) return fail(EACCES);
  pass_if_simulated(operations->sem_op > 0 ? kernel::Operation::release : kernel::Operation::acquire, &object_of(*set));
  const bool may_wait = is_simulated() && deadline > kernel::running->local_time;
  Waiting* waiting = nullptr;
  int error = 0;
  error = begin(*set, this_caller(), operations, count, may_wait || !is_simulated(), waiting);
  if (waiting != nullptr) {
    if (!is_simulated()) refuse("a thread waits before main() begins");
    const Listed listed(set->first, *waiting);
    error = wait_until_done(*set, *waiting, deadline);
  }
  // A signal may have come together with the operation.
  if (waiting != nullptr && deliverable(this_thread()) != 0) handle_signals();
  return error == 0 ? 0 : fail(error);
}

void forget_semaphore_waiter(const kernel::Task& task) {
  for (int slot = 0; slot < sets().end(); ++slot) {
    Set* const set = sets().in_slot(slot);
    if (set == nullptr) continue;
    Waiting* const waiter = take_first(set->first, [&](const Waiting& each) {
      return each.task == &task && each.caller.process == family::this_process();
    });
    if (waiter == nullptr) continue;
    family::give(waiter);
    --set->users;
    return;
  }
}

void forget_semaphores() { sets().clear(); }

void undo_semaphores_of(const Program& program) {
  const Caller caller{family::this_process(), &program};
  for (int slot = 0; slot < sets().end(); ++slot) {
    Set* const set = sets().in_slot(slot);
    if (set == nullptr) continue;
    for (Adjustments** link = &set->adjustments; *link != nullptr;) {
      Adjustments* const each = *link;
      if (each->of != caller) {
        link = &each->next;
        continue;
      }
      *link = each->next;
      undo(*set, *each);
    }
    let_go_on(*set);
  }
}

}  // namespace waitpoint::posix::system_v
