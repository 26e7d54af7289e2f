// SPDX-License-Identifier: BSD-3-Clause
// System V semaphores.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <sys/sem.h>

static int set = -1;
static atomic_int done;

static int make(int size) {
  set = semget(IPC_PRIVATE, size, IPC_CREAT | 0600);
  EXPECT(set >= 0);
  return set;
}
static int unmake(void) { return semctl(set, 0, IPC_RMID); }

// With the standard's union, the kernel leaves these uninitialised.
static int set_to(int number, int value) { return semctl(set, number, SETVAL, value); }
static int value_of(int number) { return semctl(set, number, GETVAL); }

static int change(int number, int by, int flags) {
  struct sembuf one = {(unsigned short)number, (short)by, (short)flags};
  return semop(set, &one, 1);
}
static key_t some_key(void) { return (key_t)(0x57000000 | (getpid() & 0xFFFFFF)); }

CASE(a_private_set_is_new_each_time) {
  const int first = make(1);
  const int second = semget(IPC_PRIVATE, 1, 0600);
  EXPECT(second >= 0 && second != first);
  EXPECT_IS(semctl(second, 0, IPC_RMID), 0);
  EXPECT_IS(unmake(), 0);
}
CASE(a_key_leads_to_the_same_set) {
  const int first = semget(some_key(), 2, IPC_CREAT | 0600);
  EXPECT(first >= 0);
  EXPECT_IS(semget(some_key(), 2, IPC_CREAT | 0600), first);
  EXPECT_IS(semget(some_key(), 0, 0), first);
  EXPECT_IS(semget(some_key(), 1, 0600), first);
  EXPECT_FAILS(semget(some_key(), 3, 0600), EINVAL);
  EXPECT_FAILS(semget(some_key(), 2, IPC_CREAT | IPC_EXCL | 0600), EEXIST);
  EXPECT_IS(semctl(first, 0, IPC_RMID), 0);
  EXPECT_FAILS(semget(some_key(), 2, 0600), ENOENT);
}
CASE(get_refuses_no_semaphores_and_too_many) {
  EXPECT_FAILS(semget(IPC_PRIVATE, 0, 0600), EINVAL);
  EXPECT_FAILS(semget(IPC_PRIVATE, -1, 0600), EINVAL);
  EXPECT_FAILS(semget(IPC_PRIVATE, 1 << 20, 0600), EINVAL);
}
CASE(semaphores_begin_at_zero) {
  make(3);
  unsigned short values[3] = {7, 7, 7};
  EXPECT_IS(semctl(set, 0, GETALL, values), 0);
  EXPECT(values[0] == 0 && values[1] == 0 && values[2] == 0);
  unmake();
}
CASE(values_are_set_one_by_one_and_all_at_once) {
  make(2);
  unsigned short values[2] = {3, 4};
  EXPECT_IS(semctl(set, 0, SETALL, values), 0);
  EXPECT_IS(value_of(0), 3);
  EXPECT_IS(value_of(1), 4);
  EXPECT_IS(set_to(1, 9), 0);
  EXPECT_IS(semctl(set, 0, GETALL, values), 0);
  EXPECT(values[0] == 3 && values[1] == 9);
  unmake();
}
CASE(values_out_of_range_are_refused) {
  make(1);
  EXPECT_FAILS(set_to(0, -1), ERANGE);
  EXPECT_FAILS(set_to(0, 32768), ERANGE);
  unsigned short value = 32768;
  EXPECT_FAILS(semctl(set, 0, SETALL, &value), ERANGE);
  EXPECT_IS(set_to(0, 32767), 0);
  EXPECT_FAILS(change(0, 1, 0), ERANGE);
  EXPECT_IS(value_of(0), 32767);
  unmake();
}
CASE(control_refuses_semaphores_that_are_not_there) {
  make(2);
  EXPECT_FAILS(value_of(2), EINVAL);
  EXPECT_FAILS(value_of(-1), EINVAL);
  EXPECT_FAILS(semctl(set, 0, 4711), EINVAL);
  unmake();
  EXPECT_FAILS(value_of(0), EINVAL);
  EXPECT_FAILS(semctl(-1, 0, GETVAL), EINVAL);
}
CASE(operations_count) {
  make(1);
  EXPECT_IS(change(0, 3, 0), 0);
  EXPECT_IS(change(0, -2, 0), 0);
  EXPECT_IS(value_of(0), 1);
  unmake();
}
CASE(the_last_who_operated_is_known) {
  make(2);
  EXPECT_IS(semctl(set, 0, GETPID), 0);
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(semctl(set, 0, GETPID), getpid());
  EXPECT_IS(semctl(set, 1, GETPID), 0);
  unmake();
}
CASE(what_cannot_be_done_at_once_is_refused_with_IPC_NOWAIT) {
  make(1);
  EXPECT_FAILS(change(0, -1, IPC_NOWAIT), EAGAIN);
  EXPECT_IS(change(0, 0, IPC_NOWAIT), 0);
  EXPECT_IS(set_to(0, 1), 0);
  EXPECT_FAILS(change(0, 0, IPC_NOWAIT), EAGAIN);
  EXPECT_FAILS(change(0, -2, IPC_NOWAIT), EAGAIN);
  EXPECT_IS(value_of(0), 1);
  unmake();
}
CASE(operations_refuse_what_is_not_there) {
  make(1);
  struct sembuf many[501] = {{0, 0, 0}};
  EXPECT_FAILS(change(1, 1, 0), EFBIG);
  EXPECT_FAILS(semop(set, many, 0), EINVAL);
  EXPECT_FAILS(semop(set, many, 501), E2BIG);
  unmake();
  EXPECT_FAILS(change(0, 1, 0), EINVAL);
  EXPECT_FAILS(semop(-1, many, 1), EINVAL);
}
CASE(operations_are_done_all_or_none) {
  make(2);
  struct sembuf two[2] = {{0, 1, 0}, {1, -1, IPC_NOWAIT}};
  EXPECT_FAILS(semop(set, two, 2), EAGAIN);
  EXPECT_IS(value_of(0), 0);
  EXPECT_IS(set_to(1, 1), 0);
  EXPECT_IS(semop(set, two, 2), 0);
  EXPECT_IS(value_of(0), 1);
  EXPECT_IS(value_of(1), 0);
  unmake();
}
CASE(operations_on_one_semaphore_follow_each_other) {
  make(1);
  struct sembuf lock[2] = {{0, 0, 0}, {0, 1, 0}};
  EXPECT_IS(semop(set, lock, 2), 0);
  EXPECT_IS(value_of(0), 1);
  lock[0].sem_flg = IPC_NOWAIT;
  EXPECT_FAILS(semop(set, lock, 2), EAGAIN);
  EXPECT_IS(value_of(0), 1);
  unmake();
}

static void* take_one(void* unused) {
  EXPECT_IS(change(0, -1, 0), 0);
  atomic_fetch_add(&done, 1);
  return unused;
}
static void* take_both(void* unused) {
  struct sembuf both[2] = {{0, -1, 0}, {1, -1, 0}};
  EXPECT_IS(semop(set, both, 2), 0);
  atomic_fetch_add(&done, 1);
  return unused;
}
static void* await_zero(void* unused) {
  EXPECT_IS(change(0, 0, 0), 0);
  atomic_fetch_add(&done, 1);
  return unused;
}
CASE(taking_waits_for_giving) {
  make(1);
  const pthread_t id = start(take_one, NULL);
  let_others_wait();
  EXPECT_IS(done, 0);
  EXPECT_IS(semctl(set, 0, GETNCNT), 1);
  EXPECT_IS(semctl(set, 0, GETZCNT), 0);
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(value_of(0), 0);  // a waiter has taken it
  EXPECT_IS(semctl(set, 0, GETNCNT), 0);
  join(id);
  unmake();
}
CASE(waiting_for_zero_ends_at_zero) {
  make(1);
  set_to(0, 2);
  const pthread_t id = start(await_zero, NULL);
  let_others_wait();
  EXPECT_IS(semctl(set, 0, GETZCNT), 1);
  EXPECT_IS(semctl(set, 0, GETNCNT), 0);
  EXPECT_IS(change(0, -1, 0), 0);
  let_others_wait();
  EXPECT_IS(done, 0);
  EXPECT_IS(change(0, -1, 0), 0);
  join(id);
  unmake();
}
CASE(taking_both_waits_until_both_are_there) {
  make(2);
  const pthread_t id = start(take_both, NULL);
  let_others_wait();
  EXPECT_IS(change(0, 1, 0), 0);
  let_others_wait();
  EXPECT_IS(done, 0);
  EXPECT_IS(value_of(0), 1);
  EXPECT_IS(change(1, 1, 0), 0);
  join(id);
  EXPECT_IS(value_of(0), 0);
  EXPECT_IS(value_of(1), 0);
  unmake();
}
CASE(giving_many_lets_as_many_go_on) {
  make(1);
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(take_one, NULL);
  let_others_wait();
  EXPECT_IS(semctl(set, 0, GETNCNT), 4);
  EXPECT_IS(change(0, 3, 0), 0);
  while (done < 3) sched_yield();
  sleep_ms(2);
  EXPECT_IS(done, 3);
  EXPECT_IS(change(0, 1, 0), 0);
  for (int i = 0; i < 4; ++i) join(ids[i]);
  unmake();
}
CASE(setting_a_value_lets_those_go_on_who_wait_for_it) {
  make(1);
  const pthread_t id = start(take_one, NULL);
  let_others_wait();
  EXPECT_IS(set_to(0, 1), 0);
  join(id);
  EXPECT_IS(value_of(0), 0);
  unmake();
}
CASE(setting_all_lets_those_go_on_who_wait_for_it) {
  make(2);
  unsigned short values[2] = {1, 1};
  const pthread_t id = start(take_both, NULL);
  let_others_wait();
  EXPECT_IS(semctl(set, 0, SETALL, values), 0);
  join(id);
  unmake();
}

static void* wait_for_removal(void* unused) {
  EXPECT_FAILS(change(0, -1, 0), EIDRM);
  return unused;
}
CASE(removal_ends_waits) {
  make(1);
  pthread_t ids[2] = {start(wait_for_removal, NULL), start(wait_for_removal, NULL)};
  let_others_wait();
  EXPECT_IS(unmake(), 0);
  join(ids[0]);
  join(ids[1]);
  EXPECT_FAILS(unmake(), EINVAL);
}
CASE(a_timed_operation_ends_at_its_time) {
  make(1);
  struct sembuf one = {0, -1, 0};
  const struct timespec timeout = {0, 20000000}, none = {0, 0}, invalid = {0, 1000000000}, negative = {-1, 0};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(semtimedop(set, &one, 1, &timeout), EAGAIN);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT_FAILS(semtimedop(set, &one, 1, &none), EAGAIN);
  EXPECT_FAILS(semtimedop(set, &one, 1, &invalid), EINVAL);
  EXPECT_FAILS(semtimedop(set, &one, 1, &negative), EINVAL);
  EXPECT_IS(semctl(set, 0, GETNCNT), 0);
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(semtimedop(set, &one, 1, &timeout), 0);
  unmake();
}
static void* take_in_time(void* unused) {
  struct sembuf one = {0, -1, 0};
  const struct timespec timeout = {5, 0};
  EXPECT_IS(semtimedop(set, &one, 1, &timeout), 0);
  return unused;
}
CASE(a_timed_operation_may_come_in_time) {
  make(1);
  const pthread_t id = start(take_in_time, NULL);
  let_others_wait();
  EXPECT_IS(change(0, 1, 0), 0);
  join(id);
  unmake();
}
CASE(without_a_timeout_a_timed_operation_waits_for_ever) {
  make(1);
  struct sembuf one = {0, 1, 0};
  EXPECT_IS(semtimedop(set, &one, 1, NULL), 0);
  EXPECT_IS(value_of(0), 1);
  unmake();
}
CASE(its_status_is_told) {
  const long long before = now_ns(CLOCK_REALTIME) / 1000000000;
  struct semid_ds status;
  set = semget(some_key(), 3, IPC_CREAT | 0640);
  EXPECT_IS(semctl(set, 0, IPC_STAT, &status), 0);
  EXPECT_IS(status.sem_nsems, 3);
  EXPECT_IS(status.sem_otime, 0);
  EXPECT(status.sem_ctime >= before - 1);
  EXPECT_IS(status.sem_perm.__key, some_key());
  EXPECT_IS(status.sem_perm.mode & 0777, 0640);
  EXPECT_IS(status.sem_perm.uid, geteuid());
  EXPECT_IS(status.sem_perm.cuid, geteuid());
  EXPECT_IS(status.sem_perm.gid, getegid());
  EXPECT_IS(status.sem_perm.cgid, getegid());
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(semctl(set, 0, IPC_STAT, &status), 0);
  EXPECT(status.sem_otime >= before - 1);
  unmake();
}
CASE(its_mode_can_be_set) {
  make(1);
  struct semid_ds status;
  EXPECT_IS(semctl(set, 0, IPC_STAT, &status), 0);
  status.sem_perm.mode = 0444;
  EXPECT_IS(semctl(set, 0, IPC_SET, &status), 0);
  EXPECT_IS(semctl(set, 0, IPC_STAT, &status), 0);
  EXPECT_IS(status.sem_perm.mode & 0777, 0444);
  unmake();
}
CASE(rights_are_those_of_the_mode) {
  make(1);
  struct semid_ds status;
  unsigned short value = 0;
  if (geteuid() == 0) EXPECT_IS(seteuid(12345), 0);
  if (geteuid() == 12345) {  // neither owner nor in the group
    EXPECT_FAILS(value_of(0), EACCES);
    EXPECT_FAILS(change(0, 1, 0), EACCES);
    EXPECT_FAILS(semctl(set, 0, GETALL, &value), EACCES);
    EXPECT_FAILS(semctl(set, 0, IPC_STAT, &status), EACCES);
    EXPECT_FAILS(unmake(), EPERM);
    EXPECT_IS(seteuid(0), 0);
  }
  EXPECT_IS(unmake(), 0);
}
CASE(undo_counts_within_its_range) {
  make(1);
  EXPECT_IS(change(0, 20000, SEM_UNDO), 0);
  EXPECT_IS(change(0, -20000, 0), 0);
  EXPECT_FAILS(change(0, 20000, SEM_UNDO), ERANGE);
  EXPECT_IS(value_of(0), 0);
  // SETVAL clears the undo values.
  EXPECT_IS(set_to(0, 0), 0);
  EXPECT_IS(change(0, 20000, SEM_UNDO), 0);
  EXPECT_IS(value_of(0), 20000);
  unmake();
}
CASE(its_limits_are_told) {
  struct seminfo information;
  EXPECT(semctl(0, 0, IPC_INFO, &information) >= 0);
  EXPECT(information.semvmx == 32767 && information.semmsl >= 250 && information.semopm >= 32);
  make(1);
  EXPECT(semctl(0, 0, SEM_INFO, &information) >= 0);
  EXPECT(information.semusz >= 1);
  unmake();
}
