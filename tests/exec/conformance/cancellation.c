// SPDX-License-Identifier: BSD-3-Clause
// Cancellation: states, types, points, and the order of cleanup.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <stdatomic.h>
#include <stdint.h>

static atomic_int reached, passed;

static void expect_cancelled(pthread_t id) { EXPECT(join(id) == PTHREAD_CANCELED); }

static void cancel_and_expect(void* (*function)(void*), void* argument) {
  const pthread_t id = start(function, argument);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  expect_cancelled(id);
  EXPECT_IS(passed, 0);
}

#define CANCELLED_IN(name, statement)    \
  static void* in_##name(void* unused) { \
    (void)unused;                        \
    statement;                           \
    atomic_store(&passed, 1);            \
    return NULL;                         \
  }                                      \
  CASE(name##_is_a_cancellation_point) { cancel_and_expect(in_##name, NULL); }

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static sem_t semaphore;  // all zero: no units, on Linux
static const struct timespec long_time = {5, 0};

static void unlock(void* unused) {
  (void)unused;
  pthread_mutex_unlock(&mutex);
}
static struct timespec later(clockid_t clock) { return in_ms(clock, 5000); }

CANCELLED_IN(nanosleep, nanosleep(&long_time, NULL))
CANCELLED_IN(clock_nanosleep, clock_nanosleep(CLOCK_MONOTONIC, 0, &long_time, NULL))
CANCELLED_IN(sleep, sleep(5))
CANCELLED_IN(usleep, usleep(900000); usleep(900000); usleep(900000))
CANCELLED_IN(sem_wait, sem_wait(&semaphore))
CANCELLED_IN(sem_timedwait, struct timespec time = later(CLOCK_REALTIME); sem_timedwait(&semaphore, &time))
CANCELLED_IN(sem_clockwait, struct timespec time = later(CLOCK_MONOTONIC);
             sem_clockwait(&semaphore, CLOCK_MONOTONIC, &time))
CANCELLED_IN(pthread_cond_wait, pthread_mutex_lock(&mutex); pthread_cleanup_push(unlock, NULL);
             pthread_cond_wait(&condition, &mutex); pthread_cleanup_pop(1))
CANCELLED_IN(pthread_cond_timedwait, struct timespec time = later(CLOCK_REALTIME); pthread_mutex_lock(&mutex);
             pthread_cleanup_push(unlock, NULL); pthread_cond_timedwait(&condition, &mutex, &time);
             pthread_cleanup_pop(1))
CANCELLED_IN(pthread_cond_clockwait, struct timespec time = later(CLOCK_MONOTONIC); pthread_mutex_lock(&mutex);
             pthread_cleanup_push(unlock, NULL); pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &time);
             pthread_cleanup_pop(1))
static void* sleep_long(void* unused) {
  nanosleep(&long_time, NULL);
  return unused;
}
CANCELLED_IN(pthread_join, pthread_join(start(sleep_long, NULL), NULL))
CANCELLED_IN(pthread_timedjoin_np, struct timespec time = later(CLOCK_REALTIME);
             pthread_timedjoin_np(start(sleep_long, NULL), NULL, &time))
CANCELLED_IN(pthread_clockjoin_np, struct timespec time = later(CLOCK_MONOTONIC);
             pthread_clockjoin_np(start(sleep_long, NULL), NULL, CLOCK_MONOTONIC, &time))
CANCELLED_IN(
    pthread_testcancel, while (1) {
      pthread_testcancel();
      sched_yield();
    })

static void* cancelled_before_point(void* unused) {
  (void)unused;
  while (!atomic_load(&reached)) sched_yield();
  sleep(0);
  usleep(0);
  sem_post(&semaphore);
  sem_wait(&semaphore);
  atomic_store(&passed, 1);
  return NULL;
}
CASE(who_was_cancelled_before_leaves_at_the_next_point) {
  const pthread_t id = start(cancelled_before_point, NULL);
  EXPECT_IS(pthread_cancel(id), 0);
  atomic_store(&reached, 1);
  expect_cancelled(id);
  EXPECT_IS(passed, 0);
}

static void* wait_for_semaphore(void* unused) {
  (void)unused;
  sem_wait(&semaphore);
  return NULL;
}
CASE(a_thread_is_cancelled_however_far_it_has_come) {
  for (int i = 0; i < 50; ++i) {
    const pthread_t id = start(wait_for_semaphore, NULL);
    if (i % 3 == 1) sched_yield();
    EXPECT_IS(pthread_cancel(id), 0);
    expect_cancelled(id);
  }
}

static void* lock_cancelled(void* unused) {
  (void)unused;
  while (!atomic_load(&reached)) sched_yield();
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  atomic_store(&passed, 1);
  pthread_testcancel();
  return NULL;
}
CASE(locking_a_mutex_is_no_cancellation_point) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(lock_cancelled, NULL);
  pthread_cancel(id);
  atomic_store(&reached, 1);
  let_others_wait();
  pthread_mutex_unlock(&mutex);
  expect_cancelled(id);
  EXPECT_IS(passed, 1);
}

static void* with_cancellation_disabled(void* unused) {
  (void)unused;
  int old = -1;
  EXPECT_IS(pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &old), 0);
  EXPECT_IS(old, PTHREAD_CANCEL_ENABLE);
  atomic_store(&reached, 1);
  sleep_ms(10);
  pthread_testcancel();
  atomic_store(&passed, 1);
  EXPECT_IS(pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &old), 0);
  EXPECT_IS(old, PTHREAD_CANCEL_DISABLE);
  pthread_testcancel();
  return NULL;
}
CASE(a_disabled_cancellation_waits_until_it_is_enabled) {
  const pthread_t id = start(with_cancellation_disabled, NULL);
  while (!atomic_load(&reached)) sched_yield();
  EXPECT_IS(pthread_cancel(id), 0);
  expect_cancelled(id);
  EXPECT_IS(passed, 1);
}

static void* with_cancellation_disabled_for_ever(void* unused) {
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL);
  atomic_store(&reached, 1);
  sleep_ms(8);
  return unused;
}
CASE(who_never_enables_cancellation_gives_its_own_result) {
  const pthread_t id = start(with_cancellation_disabled_for_ever, &passed);
  while (!atomic_load(&reached)) sched_yield();
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == &passed);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 2000000);
}

CASE(setcancelstate_refuses_what_is_no_state) {
  EXPECT_IS(pthread_setcancelstate(77, NULL), EINVAL);
  EXPECT_IS(pthread_setcancelstate(-1, NULL), EINVAL);
}
CASE(setcanceltype_refuses_what_is_no_type) { EXPECT_IS(pthread_setcanceltype(77, NULL), EINVAL); }
CASE(setcanceltype_tells_the_old_type) {
  int old = -1;
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, &old), 0);
  EXPECT_IS(old, PTHREAD_CANCEL_DEFERRED);
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_DEFERRED, &old), 0);
  EXPECT_IS(old, PTHREAD_CANCEL_ASYNCHRONOUS);
}

static void* cancel_oneself(void* unused) {
  (void)unused;
  EXPECT_IS(pthread_cancel(pthread_self()), 0);
  atomic_store(&passed, 1);
  pthread_testcancel();
  return NULL;
}
CASE(a_deferred_cancellation_of_oneself_waits_for_a_point) {
  expect_cancelled(start(cancel_oneself, NULL));
  EXPECT_IS(passed, 1);
}

static void* cancel_oneself_at_once(void* unused) {
  (void)unused;
  pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL);
  pthread_cancel(pthread_self());
  _exit(1);
}
CASE(an_asynchronous_cancellation_of_oneself_is_at_once) { expect_cancelled(start(cancel_oneself_at_once, NULL)); }

static void* become_asynchronous(void* unused) {
  (void)unused;
  while (!atomic_load(&reached)) sched_yield();
  pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL);
  while (1) sched_yield();
  return NULL;
}
CASE(a_pending_cancellation_acts_when_it_becomes_asynchronous) {
  const pthread_t id = start(become_asynchronous, NULL);
  pthread_cancel(id);
  atomic_store(&reached, 1);
  expect_cancelled(id);
}

static void* yield_asynchronously(void* unused) {
  (void)unused;
  pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL);
  atomic_store(&reached, 1);
  while (1) sched_yield();
  return NULL;
}
CASE(an_asynchronous_cancellation_ends_a_loop_of_yields) {
  const pthread_t id = start(yield_asynchronously, NULL);
  while (!atomic_load(&reached)) sched_yield();
  EXPECT_IS(pthread_cancel(id), 0);
  expect_cancelled(id);
}

CASE(cancelling_a_thread_that_has_ended_changes_nothing) {
  const pthread_t id = start(in_nanosleep, NULL);
  pthread_cancel(id);
  sleep_ms(5);
  EXPECT_IS(pthread_cancel(id), 0);
  expect_cancelled(id);
}

CASE(cancelling_twice_is_as_cancelling_once) {
  const pthread_t id = start(in_nanosleep, NULL);
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT_IS(pthread_cancel(id), 0);
  expect_cancelled(id);
}

static void* cancel_main(void* id) {
  pthread_cancel(*(pthread_t*)id);
  EXPECT(join(*(pthread_t*)id) == PTHREAD_CANCELED);
  exit(7);
}
CASE_ENDING_WITH(7, main_can_be_cancelled) {
  static pthread_t id;
  id = pthread_self();
  start(cancel_main, &id);
  sleep(5);
}

CASE(a_cancelled_join_leaves_the_thread_to_others) {
  const pthread_t slept = start(with_cancellation_disabled_for_ever, &passed);
  static pthread_t of;
  of = slept;
  extern void* join_of(void*);
  const pthread_t id = start(join_of, &of);
  sleep_ms(2);
  pthread_cancel(id);
  expect_cancelled(id);
  EXPECT(join(slept) == &passed);
}
void* join_of(void* id) {
  pthread_join(*(pthread_t*)id, NULL);
  return NULL;
}

static void* wait_with_mutex(void* unused) {
  (void)unused;
  pthread_mutex_lock(&mutex);
  pthread_cleanup_push(unlock, NULL);
  atomic_store(&reached, 1);
  while (1) pthread_cond_wait(&condition, &mutex);
  pthread_cleanup_pop(0);
  return NULL;
}
CASE(a_cancelled_wait_for_a_condition_has_locked_its_mutex_again) {
  const pthread_t id = start(wait_with_mutex, NULL);
  let_others_wait();
  pthread_mutex_lock(&mutex);
  pthread_cancel(id);
  sleep_ms(3);
  EXPECT_IS(pthread_tryjoin_np(id, NULL), EBUSY);
  pthread_mutex_unlock(&mutex);
  expect_cancelled(id);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
}

static void* take_signal(void* unused) {
  pthread_mutex_lock(&mutex);
  atomic_fetch_add(&reached, 1);
  pthread_cond_wait(&condition, &mutex);
  atomic_fetch_add(&passed, 1);
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(a_cancelled_wait_takes_no_signal_from_others) {
  const pthread_t cancelled = start(wait_with_mutex, NULL);
  let_others_wait();
  const pthread_t other = start(take_signal, NULL);
  let_others_wait();
  pthread_mutex_lock(&mutex);
  pthread_cancel(cancelled);
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  expect_cancelled(cancelled);
  // POSIX lets the signal go to either waiter, but it must not be lost if both were waiting.
  pthread_mutex_lock(&mutex);
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  join(other);
  EXPECT_IS(passed, 1);
}
