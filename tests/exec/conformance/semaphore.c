// SPDX-License-Identifier: BSD-3-Clause
// Unnamed semaphores.
#include "tests/exec/conformance/harness.h"

#include <limits.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdint.h>

static sem_t semaphore;
static atomic_int taken;

static int value_of(sem_t* of) {
  int value = -77;
  EXPECT_IS(sem_getvalue(of, &value), 0);
  return value;
}
static void* take(void* unused) {
  EXPECT_IS(sem_wait(&semaphore), 0);
  atomic_fetch_add(&taken, 1);
  return unused;
}

CASE(it_begins_with_its_count) {
  EXPECT_IS(sem_init(&semaphore, 0, 3), 0);
  EXPECT_IS(value_of(&semaphore), 3);
}
CASE(post_and_wait_count) {
  sem_init(&semaphore, 0, 0);
  EXPECT_IS(sem_post(&semaphore), 0);
  EXPECT_IS(sem_post(&semaphore), 0);
  EXPECT_IS(value_of(&semaphore), 2);
  EXPECT_IS(sem_wait(&semaphore), 0);
  EXPECT_IS(value_of(&semaphore), 1);
}
CASE(trywait_takes_what_is_there) {
  sem_init(&semaphore, 0, 1);
  EXPECT_IS(sem_trywait(&semaphore), 0);
  EXPECT_FAILS(sem_trywait(&semaphore), EAGAIN);
  EXPECT_IS(value_of(&semaphore), 0);
}
CASE(wait_waits_for_a_post) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = start(take, NULL);
  let_others_wait();
  EXPECT_IS(taken, 0);
  EXPECT_IS(value_of(&semaphore), 0);
  EXPECT_IS(sem_post(&semaphore), 0);
  join(id);
  EXPECT_IS(value_of(&semaphore), 0);
}
CASE(each_post_lets_one_go_on) {
  sem_init(&semaphore, 0, 0);
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(take, NULL);
  let_others_wait();
  for (int i = 1; i <= 4; ++i) {
    sem_post(&semaphore);
    while (taken < i) sched_yield();
    sleep_ms(1);
    EXPECT_IS(taken, i);
  }
  for (int i = 0; i < 4; ++i) join(ids[i]);
}
CASE(init_refuses_more_than_SEM_VALUE_MAX) {
  EXPECT_FAILS(sem_init(&semaphore, 0, SEM_VALUE_MAX + 1U), EINVAL);
  EXPECT_FAILS(sem_init(&semaphore, 0, UINT_MAX), EINVAL);
}
CASE(post_refuses_more_than_SEM_VALUE_MAX) {
  EXPECT_IS(sem_init(&semaphore, 0, SEM_VALUE_MAX), 0);
  EXPECT_FAILS(sem_post(&semaphore), EOVERFLOW);
  EXPECT_IS(value_of(&semaphore), SEM_VALUE_MAX);
}
CASE(a_destroyed_semaphore_can_be_made_again) {
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_IS(sem_init(&semaphore, 0, i), 0);
    EXPECT_IS(value_of(&semaphore), i);
    EXPECT_IS(sem_destroy(&semaphore), 0);
  }
}
CASE(a_semaphore_shared_by_processes_works_between_threads) {
  EXPECT_IS(sem_init(&semaphore, 1, 0), 0);
  const pthread_t id = start(take, NULL);
  let_others_wait();
  sem_post(&semaphore);
  join(id);
}

static int wait_until(clockid_t clock, int by_clock, struct timespec deadline) {
  return by_clock ? sem_clockwait(&semaphore, clock, &deadline) : sem_timedwait(&semaphore, &deadline);
}
static void timed_out(clockid_t clock, int by_clock) {
  sem_init(&semaphore, 0, 0);
  const long long begin = now_ns(clock);
  EXPECT_FAILS(wait_until(clock, by_clock, in_ms(clock, 6)), ETIMEDOUT);
  EXPECT(now_ns(clock) - begin >= 6000000);
}
CASE(timedwait_waits_until_its_deadline) { timed_out(CLOCK_REALTIME, 0); }
CASE(clockwait_waits_by_the_monotonic_clock) { timed_out(CLOCK_MONOTONIC, 1); }
CASE(clockwait_waits_by_the_realtime_clock) { timed_out(CLOCK_REALTIME, 1); }

CASE(a_past_deadline_is_timed_out) {
  sem_init(&semaphore, 0, 0);
  EXPECT_FAILS(wait_until(CLOCK_REALTIME, 0, (struct timespec){0, 0}), ETIMEDOUT);
  EXPECT_FAILS(wait_until(CLOCK_MONOTONIC, 1, (struct timespec){1, 0}), ETIMEDOUT);
  EXPECT_FAILS(wait_until(CLOCK_REALTIME, 0, (struct timespec){-1, 0}), ETIMEDOUT);
}
CASE(a_count_is_taken_after_the_deadline) {
  sem_init(&semaphore, 0, 2);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, (struct timespec){0, 0}), 0);
  EXPECT_IS(wait_until(CLOCK_MONOTONIC, 1, (struct timespec){1, 0}), 0);
  EXPECT_IS(value_of(&semaphore), 0);
}
CASE(invalid_nanoseconds_are_refused) {
  sem_init(&semaphore, 0, 0);
  EXPECT_FAILS(wait_until(CLOCK_REALTIME, 0, invalid_time(CLOCK_REALTIME)), EINVAL);
  EXPECT_FAILS(wait_until(CLOCK_MONOTONIC, 1, invalid_time(CLOCK_MONOTONIC)), EINVAL);
  EXPECT_FAILS(wait_until(CLOCK_REALTIME, 0, (struct timespec){5, -1}), EINVAL);
}
CASE(clockwait_refuses_clocks_of_processor_time) {
  sem_init(&semaphore, 0, 0);
  EXPECT_FAILS(wait_until(CLOCK_PROCESS_CPUTIME_ID, 1, (struct timespec){1, 0}), EINVAL);
}

static void* post_later(void* unused) {
  sleep_ms(3);
  sem_post(&semaphore);
  return unused;
}
CASE(timedwait_takes_what_comes_before_its_deadline) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = start(post_later, NULL);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, in_ms(CLOCK_REALTIME, 5000)), 0);
  join(id);
}
CASE(clockwait_takes_what_comes_before_its_deadline) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = start(post_later, NULL);
  EXPECT_IS(wait_until(CLOCK_MONOTONIC, 1, in_ms(CLOCK_MONOTONIC, 5000)), 0);
  join(id);
}

static sem_t ping, pong;
static void* answer(void* unused) {
  for (int i = 0; i < 100; ++i) {
    sem_wait(&ping);
    note(i < 5 ? "b" : "");
    sem_post(&pong);
  }
  return unused;
}
CASE(two_semaphores_make_two_threads_take_turns) {
  sem_init(&ping, 0, 0);
  sem_init(&pong, 0, 0);
  const pthread_t id = start(answer, NULL);
  for (int i = 0; i < 100; ++i) {
    note(i < 5 ? "a" : "");
    sem_post(&ping);
    sem_wait(&pong);
  }
  join(id);
  EXPECT_NOTED("ababababab");
}

static atomic_int inside, most;
static void* enter(void* unused) {
  for (int i = 0; i < 20; ++i) {
    sem_wait(&semaphore);
    const int now = atomic_fetch_add(&inside, 1) + 1;
    if (now > most) most = now;
    sched_yield();
    atomic_fetch_sub(&inside, 1);
    sem_post(&semaphore);
  }
  return unused;
}
CASE(no_more_than_its_count_are_inside) {
  sem_init(&semaphore, 0, 2);
  pthread_t ids[5];
  for (int i = 0; i < 5; ++i) ids[i] = start(enter, NULL);
  for (int i = 0; i < 5; ++i) join(ids[i]);
  EXPECT(most >= 1 && most <= 2);
  EXPECT_IS(value_of(&semaphore), 2);
}

static void post_at_end(void* unused) {
  (void)unused;
  sem_post(&semaphore);
}
static void* post_in_destructor(void* key) {
  pthread_setspecific(*(pthread_key_t*)key, key);
  return NULL;
}
CASE(destructors_of_keys_may_post) {
  sem_init(&semaphore, 0, 0);
  pthread_key_t key;
  pthread_key_create(&key, post_at_end);
  const pthread_t id = start(post_in_destructor, &key);
  EXPECT_IS(sem_wait(&semaphore), 0);
  join(id);
}
