// SPDX-License-Identifier: BSD-3-Clause
// Robust mutexes: behaviour after the death of the owner.
#include "tests/exec/conformance/harness.h"

#include <stdint.h>

static pthread_mutex_t mutex;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;

static void make(int type) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  EXPECT_IS(pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST), 0);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, type), 0);
  EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
}

static void* lock_and_end(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  return unused;
}
static void let_an_owner_end(int type) {
  make(type);
  join(start(lock_and_end, NULL));
}

static void* lock_it(void* unused) {
  (void)unused;
  const int error = pthread_mutex_lock(&mutex);
  if (error == 0) pthread_mutex_unlock(&mutex);
  return (void*)(intptr_t)error;
}
static int locked_by_another(void) { return (int)(intptr_t)join(start(lock_it, NULL)); }

CASE(lock_is_told_that_the_owner_ended) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
}
CASE(trylock_is_told_that_the_owner_ended) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EOWNERDEAD);
}
CASE(timedlock_is_told_that_the_owner_ended) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &deadline), EOWNERDEAD);
}
CASE(clocklock_is_told_that_the_owner_ended) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  const struct timespec deadline = in_ms(CLOCK_MONOTONIC, 5000);
  EXPECT_IS(pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, &deadline), EOWNERDEAD);
}

CASE(who_is_told_holds_the_mutex) {
  let_an_owner_end(PTHREAD_MUTEX_ERRORCHECK);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_lock(&mutex), EDEADLK);
}

static void* wait_for_it(void* unused) {
  (void)unused;
  const int error = pthread_mutex_lock(&mutex);
  if (error == EOWNERDEAD) {
    EXPECT_IS(pthread_mutex_consistent(&mutex), 0);
    pthread_mutex_unlock(&mutex);
  }
  return (void*)(intptr_t)error;
}
static void* lock_wait_and_end(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  sleep_ms(8);
  return unused;
}
CASE(one_of_those_that_wait_is_told_that_the_owner_ended) {
  make(PTHREAD_MUTEX_NORMAL);
  const pthread_t owner = start(lock_wait_and_end, NULL);
  sleep_ms(2);
  const pthread_t a = start(wait_for_it, NULL), b = start(wait_for_it, NULL);
  join(owner);
  EXPECT_IS((intptr_t)join(a) + (intptr_t)join(b), EOWNERDEAD);
}

CASE(a_mutex_made_consistent_is_as_before) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_consistent(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(locked_by_another(), 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
}

CASE(a_mutex_unlocked_inconsistent_is_lost) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(locked_by_another(), ENOTRECOVERABLE);
  EXPECT_IS(pthread_mutex_lock(&mutex), ENOTRECOVERABLE);
  EXPECT_IS(pthread_mutex_trylock(&mutex), ENOTRECOVERABLE);
}

CASE(a_timed_lock_of_a_lost_mutex_is_told) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &deadline), ENOTRECOVERABLE);
}

CASE(a_lost_mutex_can_be_destroyed_and_made_again) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  EXPECT_IS(pthread_mutex_lock(&mutex), ENOTRECOVERABLE);
  EXPECT_IS(pthread_mutex_destroy(&mutex), 0);
  make(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
}

CASE(who_waits_for_a_mutex_that_is_lost_is_told) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  const pthread_t id = start(lock_it, NULL);
  let_others_wait();
  pthread_mutex_unlock(&mutex);
  EXPECT_IS((intptr_t)join(id), ENOTRECOVERABLE);
}

CASE(consistent_is_for_inconsistent_mutexes) {
  make(PTHREAD_MUTEX_NORMAL);
  EXPECT_IS(pthread_mutex_consistent(&mutex), EINVAL);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(pthread_mutex_consistent(&mutex), EINVAL);
}

CASE(consistent_is_for_robust_mutexes) {
  pthread_mutex_init(&mutex, NULL);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(pthread_mutex_consistent(&mutex), EINVAL);
}

CASE(an_owner_that_ends_a_second_time_is_told_of_again) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  for (int i = 0; i < 3; ++i) {
    EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
    EXPECT_IS(pthread_mutex_consistent(&mutex), 0);
    EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
    join(start(lock_and_end, NULL));
  }
}

static void* be_told_and_end(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  return unused;
}
CASE(who_was_told_and_ends_leaves_the_mutex_to_be_told_of) {
  let_an_owner_end(PTHREAD_MUTEX_NORMAL);
  join(start(be_told_and_end, NULL));
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
}

static void* unlock_it(void* unused) {
  (void)unused;
  return (void*)(intptr_t)pthread_mutex_unlock(&mutex);
}
CASE(a_robust_mutex_is_unlocked_by_its_owner_alone) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  EXPECT_IS((intptr_t)join(start(unlock_it, NULL)), EPERM);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
}

static void* lock_twice_and_end(void* unused) {
  pthread_mutex_lock(&mutex);
  pthread_mutex_lock(&mutex);
  return unused;
}
CASE(a_recursive_robust_mutex_is_taken_over_once) {
  make(PTHREAD_MUTEX_RECURSIVE);
  join(start(lock_twice_and_end, NULL));
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_consistent(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(locked_by_another(), 0);
}

static void* lock_and_sleep(void* unused) {
  pthread_mutex_lock(&mutex);
  sleep_ms(5000);
  return unused;
}
CASE(a_cancelled_owner_is_told_of) {
  make(PTHREAD_MUTEX_NORMAL);
  const pthread_t id = start(lock_and_sleep, NULL);
  let_others_wait();
  pthread_cancel(id);
  join(id);
  EXPECT_IS(pthread_mutex_lock(&mutex), EOWNERDEAD);
}

static void* signal_and_end(void* unused) {
  pthread_mutex_lock(&mutex);
  pthread_cond_signal(&condition);
  return unused;
}
CASE(a_wait_for_a_condition_is_told_that_the_owner_ended) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(signal_and_end, NULL);
  EXPECT_IS(pthread_cond_wait(&condition, &mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_consistent(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  join(id);
}

static void note_lock(void* value) {
  (void)value;
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
  note("held");
}
static void* lock_with_key(void* key) {
  pthread_mutex_lock(&mutex);
  pthread_setspecific(*(pthread_key_t*)key, key);
  return NULL;
}
CASE(a_robust_mutex_is_held_until_after_the_destructors_of_keys) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_key_t key;
  pthread_key_create(&key, note_lock);
  join(start(lock_with_key, &key));
  EXPECT_NOTED("held");
  EXPECT_IS(pthread_mutex_trylock(&mutex), EOWNERDEAD);
}
CASE(trying_ones_own_checked_mutex_is_told) {
  for (int shared = PTHREAD_PROCESS_PRIVATE; shared <= PTHREAD_PROCESS_SHARED; ++shared) {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    EXPECT_IS(pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST), 0);
    EXPECT_IS(pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK), 0);
    EXPECT_IS(pthread_mutexattr_setpshared(&attributes, shared), 0);
    EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
    EXPECT_IS(pthread_mutex_lock(&mutex), 0);
    EXPECT_IS(pthread_mutex_trylock(&mutex), EDEADLK);
    EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
    EXPECT_IS(pthread_mutex_destroy(&mutex), 0);
  }
}
