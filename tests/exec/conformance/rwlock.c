// SPDX-License-Identifier: BSD-3-Clause
// Read-write locks.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <stdint.h>

static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
static struct timespec deadline;

static void prefer(int kind) {
  pthread_rwlockattr_t attributes;
  EXPECT_IS(pthread_rwlockattr_init(&attributes), 0);
  EXPECT_IS(pthread_rwlockattr_setkind_np(&attributes, kind), 0);
  EXPECT_IS(pthread_rwlock_init(&lock, &attributes), 0);
  EXPECT_IS(pthread_rwlockattr_destroy(&attributes), 0);
}

enum call { READ, WRITE, TRY_READ, TRY_WRITE, TIMED_READ, TIMED_WRITE, CLOCK_READ, CLOCK_WRITE };
static int take(enum call call) {
  switch (call) {
    case READ: return pthread_rwlock_rdlock(&lock);
    case WRITE: return pthread_rwlock_wrlock(&lock);
    case TRY_READ: return pthread_rwlock_tryrdlock(&lock);
    case TRY_WRITE: return pthread_rwlock_trywrlock(&lock);
    case TIMED_READ: return pthread_rwlock_timedrdlock(&lock, &deadline);
    case TIMED_WRITE: return pthread_rwlock_timedwrlock(&lock, &deadline);
    case CLOCK_READ: return pthread_rwlock_clockrdlock(&lock, CLOCK_MONOTONIC, &deadline);
    default: return pthread_rwlock_clockwrlock(&lock, CLOCK_MONOTONIC, &deadline);
  }
}
static void* take_and_unlock(void* call) {
  const int error = take((enum call)(intptr_t)call);
  if (error == 0) EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  return (void*)(intptr_t)error;
}
static pthread_t start_call(enum call call) { return start(take_and_unlock, (void*)(intptr_t)call); }
static int by_another(enum call call) { return (int)(intptr_t)join(start_call(call)); }

CASE(readers_hold_it_together) {
  EXPECT_IS(take(READ), 0);
  EXPECT_IS(by_another(READ), 0);
  EXPECT_IS(by_another(TRY_READ), 0);
  EXPECT_IS(take(READ), 0);
}
CASE(a_reader_keeps_writers_out) {
  take(READ);
  EXPECT_IS(by_another(TRY_WRITE), EBUSY);
  EXPECT_IS(take(TRY_WRITE), EBUSY);
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  EXPECT_IS(by_another(TRY_WRITE), 0);
}
CASE(a_writer_keeps_all_out) {
  EXPECT_IS(take(WRITE), 0);
  EXPECT_IS(by_another(TRY_READ), EBUSY);
  EXPECT_IS(by_another(TRY_WRITE), EBUSY);
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  EXPECT_IS(by_another(TRY_READ), 0);
}
CASE(who_tried_to_write_holds_it) {
  EXPECT_IS(take(TRY_WRITE), 0);
  EXPECT_IS(by_another(TRY_READ), EBUSY);
}
CASE(who_tried_to_read_holds_it) {
  EXPECT_IS(take(TRY_READ), 0);
  EXPECT_IS(by_another(TRY_WRITE), EBUSY);
}
CASE(writing_twice_is_a_deadlock) {
  take(WRITE);
  EXPECT_IS(take(WRITE), EDEADLK);
  EXPECT_IS(take(READ), EDEADLK);
  EXPECT_IS(take(TRY_WRITE), EBUSY);
  EXPECT_IS(take(TRY_READ), EBUSY);
}
CASE(a_timed_lock_of_the_writer_is_a_deadlock) {
  take(WRITE);
  deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_IS(take(TIMED_WRITE), EDEADLK);
  EXPECT_IS(take(TIMED_READ), EDEADLK);
}
CASE(it_is_free_after_as_many_unlocks_as_locks_to_read) {
  for (int i = 0; i < 3; ++i) take(READ);
  for (int i = 0; i < 3; ++i) {
    EXPECT_IS(by_another(TRY_WRITE), EBUSY);
    pthread_rwlock_unlock(&lock);
  }
  EXPECT_IS(by_another(TRY_WRITE), 0);
}

static void waits_and_gets(enum call held, enum call call) {
  take(held);
  deadline = in_ms(call >= CLOCK_READ ? CLOCK_MONOTONIC : CLOCK_REALTIME, 5000);
  const pthread_t id = start_call(call);
  let_others_wait();
  EXPECT_IS(pthread_tryjoin_np(id, NULL), EBUSY);
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  EXPECT_IS((intptr_t)join(id), 0);
}
CASE(a_reader_waits_for_the_writer) { waits_and_gets(WRITE, READ); }
CASE(a_writer_waits_for_the_writer) { waits_and_gets(WRITE, WRITE); }
CASE(a_writer_waits_for_readers) { waits_and_gets(READ, WRITE); }
CASE(timedrdlock_waits_for_the_writer) { waits_and_gets(WRITE, TIMED_READ); }
CASE(timedwrlock_waits_for_readers) { waits_and_gets(READ, TIMED_WRITE); }
CASE(clockrdlock_waits_for_the_writer) { waits_and_gets(WRITE, CLOCK_READ); }
CASE(clockwrlock_waits_for_readers) { waits_and_gets(READ, CLOCK_WRITE); }

static void is_timed_out(enum call held, enum call call, clockid_t clock) {
  take(held);
  const long long begin = now_ns(clock);
  deadline = in_ms(clock, 6);
  EXPECT_IS(by_another(call), ETIMEDOUT);
  EXPECT(now_ns(clock) - begin >= 6000000);
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  EXPECT_IS(by_another(WRITE), 0);
}
CASE(timedrdlock_waits_until_its_deadline) { is_timed_out(WRITE, TIMED_READ, CLOCK_REALTIME); }
CASE(timedwrlock_waits_until_its_deadline) { is_timed_out(READ, TIMED_WRITE, CLOCK_REALTIME); }
CASE(clockrdlock_waits_until_its_deadline) { is_timed_out(WRITE, CLOCK_READ, CLOCK_MONOTONIC); }
CASE(clockwrlock_waits_until_its_deadline) { is_timed_out(WRITE, CLOCK_WRITE, CLOCK_MONOTONIC); }

CASE(a_past_deadline_is_timed_out) {
  take(WRITE);
  deadline = in_ms(CLOCK_REALTIME, -1000);
  EXPECT_IS(by_another(TIMED_READ), ETIMEDOUT);
  EXPECT_IS(by_another(TIMED_WRITE), ETIMEDOUT);
  deadline = (struct timespec){1, 0};
  EXPECT_IS(by_another(CLOCK_READ), ETIMEDOUT);
  EXPECT_IS(by_another(CLOCK_WRITE), ETIMEDOUT);
}
CASE(a_free_lock_is_got_after_the_deadline) {
  deadline = in_ms(CLOCK_REALTIME, -1000);
  EXPECT_IS(by_another(TIMED_READ), 0);
  EXPECT_IS(by_another(TIMED_WRITE), 0);
}
CASE(invalid_nanoseconds_are_refused) {
  take(WRITE);
  deadline = invalid_time(CLOCK_REALTIME);
  EXPECT_IS(by_another(TIMED_READ), EINVAL);
  EXPECT_IS(by_another(TIMED_WRITE), EINVAL);
  EXPECT_IS(by_another(CLOCK_READ), EINVAL);
  EXPECT_IS(by_another(CLOCK_WRITE), EINVAL);
}
CASE(clocks_of_processor_time_are_refused) {
  deadline = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_rwlock_clockrdlock(&lock, CLOCK_PROCESS_CPUTIME_ID, &deadline), EINVAL);
  EXPECT_IS(pthread_rwlock_clockwrlock(&lock, CLOCK_PROCESS_CPUTIME_ID, &deadline), EINVAL);
}

CASE(by_default_readers_pass_a_writer_that_waits) {
  take(READ);
  const pthread_t writer = start_call(WRITE);
  let_others_wait();
  EXPECT_IS(by_another(READ), 0);
  EXPECT_IS(by_another(TRY_READ), 0);
  pthread_rwlock_unlock(&lock);
  EXPECT_IS((intptr_t)join(writer), 0);
}

CASE(readers_wait_behind_a_preferred_writer) {
  prefer(PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP);
  take(READ);
  const pthread_t writer = start_call(WRITE);
  let_others_wait();
  EXPECT_IS(by_another(TRY_READ), EBUSY);
  deadline = in_ms(CLOCK_REALTIME, 3);
  EXPECT_IS(by_another(TIMED_READ), ETIMEDOUT);
  pthread_rwlock_unlock(&lock);
  EXPECT_IS((intptr_t)join(writer), 0);
  EXPECT_IS(by_another(READ), 0);
}

CASE(readers_go_on_when_a_preferred_writer_times_out) {
  prefer(PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP);
  take(READ);
  deadline = in_ms(CLOCK_REALTIME, 10);
  const pthread_t writer = start_call(TIMED_WRITE);
  let_others_wait();
  const pthread_t reader = start_call(READ);
  EXPECT_IS((intptr_t)join(writer), ETIMEDOUT);
  EXPECT_IS((intptr_t)join(reader), 0);
}

static void* write_and_note(void* unused) {
  take(WRITE);
  note("w");
  pthread_rwlock_unlock(&lock);
  return unused;
}
static void* read_and_note(void* unused) {
  take(READ);
  note("r");
  pthread_rwlock_unlock(&lock);
  return unused;
}
CASE(a_preferred_writer_comes_before_readers_that_wait) {
  prefer(PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP);
  take(WRITE);
  const pthread_t reader = start(read_and_note, NULL);
  let_others_wait();
  const pthread_t writer = start(write_and_note, NULL);
  let_others_wait();
  pthread_rwlock_unlock(&lock);
  join(reader);
  join(writer);
  EXPECT_NOTED("wr");
}

static atomic_int readers, writers;
static void* read_many(void* unused) {
  for (int i = 0; i < 50; ++i) {
    take(READ);
    atomic_fetch_add(&readers, 1);
    if (i % 8 == 0) sched_yield();
    EXPECT_IS(writers, 0);
    atomic_fetch_sub(&readers, 1);
    pthread_rwlock_unlock(&lock);
  }
  return unused;
}
static void* write_many(void* unused) {
  for (int i = 0; i < 50; ++i) {
    take(WRITE);
    EXPECT_IS(atomic_fetch_add(&writers, 1), 0);
    EXPECT_IS(readers, 0);
    if (i % 8 == 0) sched_yield();
    atomic_fetch_sub(&writers, 1);
    pthread_rwlock_unlock(&lock);
  }
  return unused;
}
static void many(void) {
  pthread_t ids[6];
  for (int i = 0; i < 6; ++i) ids[i] = start(i % 3 == 0 ? write_many : read_many, NULL);
  for (int i = 0; i < 6; ++i) join(ids[i]);
}
CASE(writers_are_alone) { many(); }
CASE(preferred_writers_are_alone) {
  prefer(PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP);
  many();
}
CASE(writers_of_the_kind_that_is_as_the_default_are_alone) {
  prefer(PTHREAD_RWLOCK_PREFER_WRITER_NP);
  many();
}

CASE(a_destroyed_lock_can_be_made_again) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_IS(pthread_rwlock_init(&lock, NULL), 0);
    EXPECT_IS(take(i % 2 == 0 ? READ : WRITE), 0);
    EXPECT_IS(by_another(TRY_WRITE), EBUSY);
    EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
    EXPECT_IS(pthread_rwlock_destroy(&lock), 0);
  }
}
CASE(the_static_initialiser_of_preferred_writers) {
  static pthread_rwlock_t made = PTHREAD_RWLOCK_WRITER_NONRECURSIVE_INITIALIZER_NP;
  EXPECT_IS(pthread_rwlock_wrlock(&made), 0);
  EXPECT_IS(pthread_rwlock_trywrlock(&made), EBUSY);
  EXPECT_IS(pthread_rwlock_unlock(&made), 0);
}
CASE(attributes_of_locks_have_defaults) {
  pthread_rwlockattr_t attributes;
  int value = -1;
  EXPECT_IS(pthread_rwlockattr_init(&attributes), 0);
  EXPECT_IS(pthread_rwlockattr_getkind_np(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_RWLOCK_DEFAULT_NP);
  EXPECT_IS(pthread_rwlockattr_getpshared(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_PROCESS_PRIVATE);
  EXPECT_IS(pthread_rwlockattr_setkind_np(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_rwlockattr_setpshared(&attributes, 77), EINVAL);
}
