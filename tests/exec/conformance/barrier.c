// SPDX-License-Identifier: BSD-3-Clause
// Barriers and spin locks.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <stdint.h>

static pthread_barrier_t barrier;
static atomic_int arrived, serial;

static void* arrive(void* unused) {
  atomic_fetch_add(&arrived, 1);
  const int result = pthread_barrier_wait(&barrier);
  EXPECT(result == 0 || result == PTHREAD_BARRIER_SERIAL_THREAD);
  if (result == PTHREAD_BARRIER_SERIAL_THREAD) atomic_fetch_add(&serial, 1);
  return unused;
}

CASE(a_barrier_of_no_threads_is_refused) { EXPECT_IS(pthread_barrier_init(&barrier, NULL, 0), EINVAL); }
CASE(a_barrier_of_one_thread_keeps_nobody) {
  EXPECT_IS(pthread_barrier_init(&barrier, NULL, 1), 0);
  for (int i = 0; i < 3; ++i) EXPECT_IS(pthread_barrier_wait(&barrier), PTHREAD_BARRIER_SERIAL_THREAD);
  EXPECT_IS(pthread_barrier_destroy(&barrier), 0);
}
CASE(those_that_arrive_wait_for_the_last) {
  pthread_barrier_init(&barrier, NULL, 3);
  const pthread_t a = start(arrive, NULL), b = start(arrive, NULL);
  let_others_wait();
  EXPECT_IS(pthread_tryjoin_np(a, NULL), EBUSY);
  EXPECT_IS(pthread_tryjoin_np(b, NULL), EBUSY);
  arrive(NULL);
  join(a);
  join(b);
  EXPECT_IS(arrived, 3);
}
CASE(one_of_each_turn_is_the_serial_thread) {
  pthread_barrier_init(&barrier, NULL, 4);
  pthread_t ids[4];
  for (int turn = 1; turn <= 5; ++turn) {
    for (int i = 0; i < 4; ++i) ids[i] = start(arrive, NULL);
    for (int i = 0; i < 4; ++i) join(ids[i]);
    EXPECT_IS(serial, turn);
  }
}
static void* arrive_often(void* unused) {
  for (int turn = 1; turn <= 20; ++turn) {
    atomic_fetch_add(&arrived, 1);
    pthread_barrier_wait(&barrier);
    EXPECT_IS(arrived, 3 * turn);
    pthread_barrier_wait(&barrier);
  }
  return unused;
}
CASE(nobody_comes_into_the_next_turn_before_all_are_in_this) {
  pthread_barrier_init(&barrier, NULL, 3);
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = start(arrive_often, NULL);
  for (int i = 0; i < 3; ++i) join(ids[i]);
  EXPECT_IS(pthread_barrier_destroy(&barrier), 0);
}
CASE(twice_as_many_pass_in_two_turns) {
  pthread_barrier_init(&barrier, NULL, 2);
  pthread_t ids[6];
  for (int i = 0; i < 6; ++i) ids[i] = start(arrive, NULL);
  for (int i = 0; i < 6; ++i) join(ids[i]);
  EXPECT_IS(serial, 3);
}
CASE(the_serial_thread_may_destroy_the_barrier) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_IS(pthread_barrier_init(&barrier, NULL, 2), 0);
    const pthread_t id = start(arrive, NULL);
    arrive(NULL);
    EXPECT_IS(pthread_barrier_destroy(&barrier), 0);
    join(id);
  }
}
CASE(a_barrier_can_be_made_again_for_another_number) {
  for (int count = 1; count < 5; ++count) {
    pthread_barrier_init(&barrier, NULL, (unsigned)count);
    pthread_t ids[5];
    for (int i = 0; i < count; ++i) ids[i] = start(arrive, NULL);
    for (int i = 0; i < count; ++i) join(ids[i]);
    EXPECT_IS(serial, count);
    EXPECT_IS(pthread_barrier_destroy(&barrier), 0);
  }
}
CASE(a_barrier_is_no_cancellation_point) {
  pthread_barrier_init(&barrier, NULL, 2);
  const pthread_t id = start(arrive, NULL);
  let_others_wait();
  pthread_cancel(id);
  sleep_ms(2);
  EXPECT_IS(pthread_tryjoin_np(id, NULL), EBUSY);
  arrive(NULL);
  EXPECT(join(id) != PTHREAD_CANCELED);
}
CASE(attributes_of_barriers_have_defaults) {
  pthread_barrierattr_t attributes;
  int shared = -1;
  EXPECT_IS(pthread_barrierattr_init(&attributes), 0);
  EXPECT_IS(pthread_barrierattr_getpshared(&attributes, &shared), 0);
  EXPECT_IS(shared, PTHREAD_PROCESS_PRIVATE);
  EXPECT_IS(pthread_barrierattr_setpshared(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_barrierattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_barrier_init(&barrier, &attributes, 1), 0);
  EXPECT_IS(pthread_barrierattr_destroy(&attributes), 0);
}

static pthread_spinlock_t spin;
static void* try_it(void* unused) {
  (void)unused;
  const int error = pthread_spin_trylock(&spin);
  if (error == 0) pthread_spin_unlock(&spin);
  return (void*)(intptr_t)error;
}
static int tried_by_another(void) { return (int)(intptr_t)join(start(try_it, NULL)); }

CASE(a_spin_lock_is_busy_while_it_is_held) {
  EXPECT_IS(pthread_spin_init(&spin, PTHREAD_PROCESS_PRIVATE), 0);
  EXPECT_IS(pthread_spin_lock(&spin), 0);
  EXPECT_IS(pthread_spin_trylock(&spin), EBUSY);
  EXPECT_IS(tried_by_another(), EBUSY);
  EXPECT_IS(pthread_spin_unlock(&spin), 0);
  EXPECT_IS(tried_by_another(), 0);
  EXPECT_IS(pthread_spin_destroy(&spin), 0);
}
CASE(a_spin_lock_that_was_tried_is_held) {
  pthread_spin_init(&spin, PTHREAD_PROCESS_SHARED);
  EXPECT_IS(pthread_spin_trylock(&spin), 0);
  EXPECT_IS(tried_by_another(), EBUSY);
}
static void* lock_and_note(void* unused) {
  EXPECT_IS(pthread_spin_lock(&spin), 0);
  note("locked");
  pthread_spin_unlock(&spin);
  return unused;
}
CASE(who_spins_gets_what_is_unlocked) {
  pthread_spin_init(&spin, PTHREAD_PROCESS_PRIVATE);
  pthread_spin_lock(&spin);
  const pthread_t id = start(lock_and_note, NULL);
  sleep_ms(2);
  note("unlocked ");
  pthread_spin_unlock(&spin);
  join(id);
  EXPECT_NOTED("unlocked locked");
}
static int counted;
static void* count(void* unused) {
  for (int i = 0; i < 100; ++i) {
    pthread_spin_lock(&spin);
    const int before = counted;
    if (i % 25 == 0) sched_yield();
    counted = before + 1;
    pthread_spin_unlock(&spin);
  }
  return unused;
}
CASE(one_thread_at_a_time_holds_a_spin_lock) {
  pthread_spin_init(&spin, PTHREAD_PROCESS_PRIVATE);
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(count, NULL);
  for (int i = 0; i < 4; ++i) join(ids[i]);
  EXPECT_IS(counted, 400);
}

CASE(a_barrier_of_too_many_threads_is_refused) {
  pthread_barrier_t barrier;
  EXPECT_IS(pthread_barrier_init(&barrier, NULL, 0x80000001u), EINVAL);
}
