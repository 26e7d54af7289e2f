// SPDX-License-Identifier: BSD-3-Clause
// Condition variables.
#include "tests/exec/conformance/harness.h"

#include <sys/mman.h>

#include <stdatomic.h>
#include <stdint.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static int waiting, woken, tickets;

static void make_mutex(int type) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_settype(&attributes, type);
  EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
}
static void make_condition(clockid_t clock) {
  pthread_condattr_t attributes;
  EXPECT_IS(pthread_condattr_init(&attributes), 0);
  EXPECT_IS(pthread_condattr_setclock(&attributes, clock), 0);
  EXPECT_IS(pthread_cond_init(&condition, &attributes), 0);
  EXPECT_IS(pthread_condattr_destroy(&attributes), 0);
}

static void* take_ticket(void* unused) {
  pthread_mutex_lock(&mutex);
  ++waiting;
  while (tickets == 0) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  --tickets;
  ++woken;
  pthread_mutex_unlock(&mutex);
  return unused;
}
/// Locks the mutex once `count` threads wait.
static void lock_when_waiting(int count) {
  pthread_mutex_lock(&mutex);
  while (waiting < count) {
    pthread_mutex_unlock(&mutex);
    sched_yield();
    pthread_mutex_lock(&mutex);
  }
}

CASE(signal_wakes_one_that_waits) {
  const pthread_t id = start(take_ticket, NULL);
  lock_when_waiting(1);
  tickets = 1;
  EXPECT_IS(pthread_cond_signal(&condition), 0);
  pthread_mutex_unlock(&mutex);
  join(id);
  EXPECT_IS(woken, 1);
}

CASE(as_many_signals_wake_as_many) {
  pthread_t ids[5];
  for (int i = 0; i < 5; ++i) ids[i] = start(take_ticket, NULL);
  lock_when_waiting(5);
  for (int i = 0; i < 5; ++i) {
    ++tickets;
    pthread_cond_signal(&condition);
  }
  pthread_mutex_unlock(&mutex);
  for (int i = 0; i < 5; ++i) join(ids[i]);
  EXPECT_IS(woken, 5);
}

CASE(broadcast_wakes_all) {
  pthread_t ids[5];
  for (int i = 0; i < 5; ++i) ids[i] = start(take_ticket, NULL);
  lock_when_waiting(5);
  tickets = 5;
  EXPECT_IS(pthread_cond_broadcast(&condition), 0);
  pthread_mutex_unlock(&mutex);
  for (int i = 0; i < 5; ++i) join(ids[i]);
}

CASE(a_signal_without_the_mutex_wakes_too) {
  const pthread_t id = start(take_ticket, NULL);
  lock_when_waiting(1);
  tickets = 1;
  pthread_mutex_unlock(&mutex);
  pthread_cond_signal(&condition);
  join(id);
}

CASE(signal_and_broadcast_without_waiters_do_nothing) {
  EXPECT_IS(pthread_cond_signal(&condition), 0);
  EXPECT_IS(pthread_cond_broadcast(&condition), 0);
  pthread_mutex_lock(&mutex);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 3);
  EXPECT_IS(pthread_cond_timedwait(&condition, &mutex, &soon), ETIMEDOUT);
}

static void* signal_it(void* unused) {
  pthread_mutex_lock(&mutex);
  note("signalled ");
  tickets = 1;
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(a_wait_gives_up_the_mutex_and_has_it_again) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(signal_it, NULL);
  note("waiting ");
  while (tickets == 0) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  note("holding");
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
  pthread_mutex_unlock(&mutex);
  join(id);
  EXPECT_NOTED("waiting signalled holding");
}

CASE(a_signalled_wait_comes_back_when_the_mutex_is_unlocked) {
  const pthread_t id = start(take_ticket, NULL);
  lock_when_waiting(1);
  tickets = 1;
  pthread_cond_signal(&condition);
  sleep_ms(4);
  EXPECT_IS(pthread_tryjoin_np(id, NULL), EBUSY);
  EXPECT_IS(woken, 0);
  pthread_mutex_unlock(&mutex);
  join(id);
}

static int wait_until(clockid_t clock, int by_clock, struct timespec deadline) {
  return by_clock ? pthread_cond_clockwait(&condition, &mutex, clock, &deadline)
                  : pthread_cond_timedwait(&condition, &mutex, &deadline);
}
static void timed_out(clockid_t clock, int by_clock) {
  pthread_mutex_lock(&mutex);
  const long long begin = now_ns(clock);
  EXPECT_IS(wait_until(clock, by_clock, in_ms(clock, 6)), ETIMEDOUT);
  EXPECT(now_ns(clock) - begin >= 6000000);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}
CASE(timedwait_waits_until_its_deadline) { timed_out(CLOCK_REALTIME, 0); }
CASE(timedwait_waits_by_the_clock_of_its_attributes) {
  make_condition(CLOCK_MONOTONIC);
  timed_out(CLOCK_MONOTONIC, 0);
}
CASE(timedwait_waits_by_the_realtime_clock_of_its_attributes) {
  make_condition(CLOCK_REALTIME);
  timed_out(CLOCK_REALTIME, 0);
}
CASE(clockwait_waits_by_the_monotonic_clock) { timed_out(CLOCK_MONOTONIC, 1); }
CASE(clockwait_waits_by_the_realtime_clock) {
  make_condition(CLOCK_MONOTONIC);
  timed_out(CLOCK_REALTIME, 1);
}

CASE(a_past_deadline_is_timed_out_with_the_mutex) {
  pthread_mutex_lock(&mutex);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, (struct timespec){0, 0}), ETIMEDOUT);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, in_ms(CLOCK_REALTIME, -1)), ETIMEDOUT);
  EXPECT_IS(wait_until(CLOCK_MONOTONIC, 1, (struct timespec){1, 0}), ETIMEDOUT);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}
CASE(negative_seconds_are_timed_out) {
  pthread_mutex_lock(&mutex);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, (struct timespec){-1, 0}), ETIMEDOUT);
}
CASE(invalid_nanoseconds_are_refused_with_the_mutex) {
  pthread_mutex_lock(&mutex);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, invalid_time(CLOCK_REALTIME)), EINVAL);
  EXPECT_IS(wait_until(CLOCK_MONOTONIC, 1, invalid_time(CLOCK_MONOTONIC)), EINVAL);
  EXPECT_IS(wait_until(CLOCK_REALTIME, 0, (struct timespec){5, -1}), EINVAL);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}
CASE(clockwait_refuses_clocks_of_processor_time) {
  pthread_mutex_lock(&mutex);
  EXPECT_IS(wait_until(CLOCK_PROCESS_CPUTIME_ID, 1, (struct timespec){0, 0}), EINVAL);
}

CASE(a_timed_wait_is_signalled_before_its_deadline) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(signal_it, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  while (tickets == 0) EXPECT_IS(pthread_cond_timedwait(&condition, &mutex, &deadline), 0);
  pthread_mutex_unlock(&mutex);
  join(id);
  EXPECT(now_ns(CLOCK_REALTIME) < deadline.tv_sec * 1000000000LL + deadline.tv_nsec);
}
CASE(a_clocked_wait_is_signalled_before_its_deadline) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(signal_it, NULL);
  const struct timespec deadline = in_ms(CLOCK_MONOTONIC, 5000);
  while (tickets == 0) EXPECT_IS(pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &deadline), 0);
  pthread_mutex_unlock(&mutex);
  join(id);
}

static void* hold_long(void* unused) {
  pthread_mutex_lock(&mutex);
  sleep_ms(12);
  note("unlocked ");
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(a_timed_out_wait_still_waits_for_its_mutex) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(hold_long, NULL);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_cond_timedwait(&condition, &mutex, &soon), ETIMEDOUT);
  note("back");
  pthread_mutex_unlock(&mutex);
  join(id);
  EXPECT_NOTED("unlocked back");
}

static void* lock_and_signal(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  tickets = 1;
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(a_recursive_mutex_locked_once_is_given_up) {
  make_mutex(PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(lock_and_signal, NULL);
  while (tickets == 0) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), EPERM);
  join(id);
}
CASE(an_errorcheck_mutex_of_another_is_refused) {
  make_mutex(PTHREAD_MUTEX_ERRORCHECK);
  EXPECT_IS(pthread_cond_wait(&condition, &mutex), EPERM);
}
CASE(an_errorcheck_mutex_is_given_up_and_taken_again) {
  make_mutex(PTHREAD_MUTEX_ERRORCHECK);
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(lock_and_signal, NULL);
  while (tickets == 0) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), EDEADLK);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  join(id);
}

static int buffer[4], filled, got;
static pthread_cond_t not_full = PTHREAD_COND_INITIALIZER, not_empty = PTHREAD_COND_INITIALIZER;
static void* produce(void* unused) {
  for (int i = 1; i <= 200; ++i) {
    pthread_mutex_lock(&mutex);
    while (filled == 4) pthread_cond_wait(&not_full, &mutex);
    buffer[filled++] = i;
    pthread_cond_signal(&not_empty);
    pthread_mutex_unlock(&mutex);
  }
  return unused;
}
static void* consume(void* unused) {
  for (int i = 1; i <= 200; ++i) {
    pthread_mutex_lock(&mutex);
    while (filled == 0) pthread_cond_wait(&not_empty, &mutex);
    got += buffer[--filled];
    pthread_cond_signal(&not_full);
    pthread_mutex_unlock(&mutex);
  }
  return unused;
}
CASE(producers_and_consumers_lose_nothing) {
  pthread_t ids[6];
  for (int i = 0; i < 6; ++i) ids[i] = start(i % 2 == 0 ? produce : consume, NULL);
  for (int i = 0; i < 6; ++i) join(ids[i]);
  EXPECT_IS(got, 3 * 200 * 201 / 2);
}

CASE(a_condition_is_made_and_destroyed_again) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_IS(pthread_cond_init(&condition, NULL), 0);
    waiting = 0;
    const pthread_t id = start(take_ticket, NULL);
    lock_when_waiting(1);
    tickets = 1;
    pthread_cond_broadcast(&condition);
    pthread_mutex_unlock(&mutex);
    join(id);
    EXPECT_IS(pthread_cond_destroy(&condition), 0);
  }
}

CASE(a_condition_can_be_destroyed_after_its_broadcast) {
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = start(take_ticket, NULL);
  lock_when_waiting(3);
  tickets = 3;
  pthread_cond_broadcast(&condition);
  pthread_mutex_unlock(&mutex);
  EXPECT_IS(pthread_cond_destroy(&condition), 0);
  for (int i = 0; i < 3; ++i) join(ids[i]);
}

// glibc: destruction waits for those who were woken, so that the memory can be given back.
struct in_page {
  pthread_cond_t condition;
};
static struct in_page* page;
static void make_in_page(int shared) {
  pthread_condattr_t attributes;
  EXPECT_IS(pthread_condattr_init(&attributes), 0);
  EXPECT_IS(pthread_condattr_setpshared(&attributes, shared), 0);
  page = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  EXPECT(page != MAP_FAILED);
  EXPECT_IS(pthread_cond_init(&page->condition, &attributes), 0);
}
static void* wait_in_page(void* unused) {
  pthread_mutex_lock(&mutex);
  ++waiting;
  while (tickets == 0) pthread_cond_wait(&page->condition, &mutex);
  --tickets;
  pthread_mutex_unlock(&mutex);
  return unused;
}
static void destroy_behind(int shared, int all) {
  for (int i = 0; i < 10; ++i) {
    pthread_t ids[3];
    const int count = all ? 3 : 1;
    waiting = 0;
    make_in_page(shared);
    for (int k = 0; k < count; ++k) ids[k] = start(wait_in_page, NULL);
    lock_when_waiting(count);
    tickets = count;
    if (all)
      pthread_cond_broadcast(&page->condition);
    else
      pthread_cond_signal(&page->condition);
    pthread_mutex_unlock(&mutex);
    EXPECT_IS(pthread_cond_destroy(&page->condition), 0);
    EXPECT_IS(munmap(page, 4096), 0);
    for (int k = 0; k < count; ++k) join(ids[k]);
  }
}
CASE(the_memory_of_a_condition_can_be_freed_behind_a_broadcast) { destroy_behind(PTHREAD_PROCESS_PRIVATE, 1); }
CASE(the_memory_of_a_condition_can_be_freed_behind_a_signal) { destroy_behind(PTHREAD_PROCESS_PRIVATE, 0); }
CASE(the_memory_of_a_shared_condition_can_be_freed_behind_a_broadcast) { destroy_behind(PTHREAD_PROCESS_SHARED, 1); }
CASE(the_memory_of_a_shared_condition_can_be_freed_behind_a_signal) { destroy_behind(PTHREAD_PROCESS_SHARED, 0); }

CASE(attributes_of_conditions_have_defaults) {
  pthread_condattr_t attributes;
  clockid_t clock = 77;
  int shared = -1;
  EXPECT_IS(pthread_condattr_init(&attributes), 0);
  EXPECT_IS(pthread_condattr_getclock(&attributes, &clock), 0);
  EXPECT_IS(clock, CLOCK_REALTIME);
  EXPECT_IS(pthread_condattr_getpshared(&attributes, &shared), 0);
  EXPECT_IS(shared, PTHREAD_PROCESS_PRIVATE);
}
CASE(attributes_of_conditions_refuse_clocks_of_processor_time) {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  EXPECT_IS(pthread_condattr_setclock(&attributes, CLOCK_PROCESS_CPUTIME_ID), EINVAL);
  EXPECT_IS(pthread_condattr_setpshared(&attributes, 77), EINVAL);
}
CASE(a_condition_shared_by_processes_works_between_threads) {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_cond_init(&condition, &attributes);
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(signal_it, NULL);
  while (tickets == 0) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  pthread_mutex_unlock(&mutex);
  join(id);
}
