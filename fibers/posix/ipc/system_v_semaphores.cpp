// SPDX-License-Identifier: BSD-3-Clause
//
// The calls for System V semaphores.
#include <sys/sem.h>
#include <unistd.h>

#include <cstdarg>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/ipc/semaphore_set.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix::system_v {
namespace {

// The number of calls that wait for a semaphore to rise, or to be zero.
int count_waiting(const Set& set, int number, bool for_zero) {
  int count = 0;
  for (Waiting* each = set.first; each != nullptr; each = each->next)
    if (each->hindering().sem_num == number && (each->hindering().sem_op == 0) == for_zero) ++count;
  return count;
}

void forget_adjustments(Set& set, int number) {
  WAITPOINT_CHECK(number >= 0 && number < set.size,
                  "adjustments are forgotten of a semaphore that its set does not have");
  for (Adjustments* each = set.adjustments; each != nullptr; each = each->next) each->by[number] = 0;
}

int set_value(Set& set, int number, int to) {
  if (to < 0 || to > value_max) return fail(ERANGE);
  set.values[number].value = static_cast<unsigned short>(to);
  set.values[number].last = family::this_process();
  forget_adjustments(set, number);
  set.changed = date();
  let_go_on(set);
  return 0;
}

int set_all(Set& set, const unsigned short* to) {
  for (int i = 0; i < set.size; ++i)
    if (to[i] > value_max) return fail(ERANGE);
  for (int i = 0; i < set.size; ++i) {
    set.values[i].value = to[i];
    set.values[i].last = family::this_process();
    forget_adjustments(set, i);
  }
  set.changed = date();
  let_go_on(set);
  return 0;
}

union Argument {
  int value;
  semid_ds* status;
  unsigned short* array;
  seminfo* information;
};

static_assert(sizeof(Argument) == sizeof(long), "system calls pass it as a word");
static_assert(sets_max <= INT_MAX / semaphores_a_set_max, "semmns is an int");

int tell_limits(seminfo* to, bool used) {
  *to = {};
  to->semmni = sets_max;
  to->semmns = sets_max * semaphores_a_set_max;
  to->semmsl = semaphores_a_set_max;
  to->semopm = operations_a_call_max;
  to->semvmx = value_max;
  to->semaem = value_max;
  to->semmap = to->semmnu = to->semmns;
  to->semume = operations_a_call_max;
  to->semusz = used ? sets().count() : 20;
  for (int slot = 0; used && slot < sets().end(); ++slot)
    if (const Set* set = sets().in_slot(slot); set != nullptr) to->semaem += set->size;
  if (used) to->semaem -= value_max;
  return sets().greatest_slot();
}

int tell_status(const Set& set, semid_ds* to) {
  *to = {};
  to->sem_perm = set.permissions;
  to->sem_otime = set.operated;
  to->sem_ctime = set.changed;
  to->sem_nsems = static_cast<unsigned long>(set.size);
  return 0;
}

int control_one(Set& set, int number, int command, Argument argument) {
  if (number < 0 || number >= set.size) return fail(EINVAL);
  if (!is_allowed(set, command == SETVAL ? 2 : 4)) return fail(EACCES);
  switch (command) {
    case GETVAL: return set.values[number].value;
    case GETPID: return set.values[number].last;
    case GETNCNT: return count_waiting(set, number, false);
    case GETZCNT: return count_waiting(set, number, true);
    default: return set_value(set, number, argument.value);
  }
}

int control_all(Set& set, int command, Argument argument) {
  switch (command) {
    case GETALL:
      if (!is_allowed(set, 4)) return fail(EACCES);
      for (int i = 0; i < set.size; ++i) argument.array[i] = set.values[i].value;
      return 0;
    case SETALL: return is_allowed(set, 2) ? set_all(set, argument.array) : fail(EACCES);
    case IPC_STAT: return is_allowed(set, 4) ? tell_status(set, argument.status) : fail(EACCES);
    case IPC_SET:
      if (!is_owner(set)) return fail(EPERM);
      set_owner(set, argument.status->sem_perm);
      set.changed = date();
      return 0;
    case IPC_RMID:
      if (!is_owner(set)) return fail(EPERM);
      sets().remove(set);
      end_all(set, EIDRM);
      return 0;
    default: return fail(EINVAL);
  }
}

}  // namespace
}  // namespace waitpoint::posix::system_v

using namespace waitpoint;
using namespace waitpoint::posix;
using namespace waitpoint::posix::system_v;

WAITPOINT_INTERPOSED int semget(key_t key, int size, int flags) noexcept {
  if (size < 0 || size > semaphores_a_set_max) return fail(EINVAL);
  pass_if_simulated(kernel::Operation::open, nullptr);
  return sets().get(
      key, flags, [&](const Set& set) { return size > set.size ? EINVAL : 0; },
      [&](Set*& made) {
        if (size == 0) return EINVAL;
        made = make_object<Set>(sizeof(Set) + static_cast<std::size_t>(size) * sizeof(Value));
        if (made == nullptr) return ENOMEM;
        made->size = size;
        made->values = reinterpret_cast<Value*>(made + 1);
        made->changed = date();
        return 0;
      });
}

WAITPOINT_INTERPOSED int semop(int id, sembuf* operations, std::size_t count) noexcept {
  return operate(id, operations, count, Time::max());
}

WAITPOINT_INTERPOSED int semtimedop(int id, sembuf* operations, std::size_t count, const timespec* timeout) noexcept {
  if (timeout == nullptr || !is_simulated()) return operate(id, operations, count, Time::max());
  if (!can_be_read(timeout)) return fail(EFAULT);
  if (!is_valid(*timeout) || timeout->tv_sec < 0) return fail(EINVAL);
  return operate(id, operations, count, later(kernel::local_time(*kernel::running), span(*timeout)));
}

WAITPOINT_INTERPOSED int semctl(int id, int number, int command, ...) noexcept {
  va_list more;
  va_start(more, command);
  const Argument argument = va_arg(more, Argument);
  va_end(more);
  if (id < 0) return fail(EINVAL);
  if (command == IPC_INFO || command == SEM_INFO) {
    if (!has_memory(command, true, argument.information)) return fail(EFAULT);
    return tell_limits(argument.information, command == SEM_INFO);
  }
  const bool by_slot = command == SEM_STAT || command == SEM_STAT_ANY;
  const Use<Set> set([&] { return by_slot ? sets().in_slot(id) : sets().find(id); });
  if (!set) return fail(EINVAL);
  if ((command == GETALL || command == SETALL) && !can_be_read(argument.array)) return fail(EFAULT);
  if (!has_memory(command, by_slot || command == IPC_STAT, argument.status)) return fail(EFAULT);
  if (by_slot) {
    if (command == SEM_STAT && !is_allowed(*set, 4)) return fail(EACCES);
    tell_status(*set, argument.status);
    return set->id;
  }
  pass_if_simulated(kernel::Operation::modify, &object_of(*set));
  if (set->adjustments != nullptr) undo_of_ended(*set);
  if (set->removed) return fail(EIDRM);
  switch (command) {
    case GETVAL:
    case GETPID:
    case GETNCNT:
    case GETZCNT:
    case SETVAL: return control_one(*set, number, command, argument);
    default: return control_all(*set, command, argument);
  }
}
