// SPDX-License-Identifier: BSD-3-Clause
// Mutexes of the normal, recursive and errorcheck types, and their attributes. Robust ones: robust_mutex.c.
#include "tests/exec/conformance/harness.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static atomic_int inside;

static void make(int type) {
  pthread_mutexattr_t attributes;
  EXPECT_IS(pthread_mutexattr_init(&attributes), 0);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, type), 0);
  EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
  EXPECT_IS(pthread_mutexattr_destroy(&attributes), 0);
}

static void* try_it(void* unused) {
  (void)unused;
  const int error = pthread_mutex_trylock(&mutex);
  if (error == 0) pthread_mutex_unlock(&mutex);
  return (void*)(intptr_t)error;
}
static int tried_by_another(void) { return (int)(intptr_t)join(start(try_it, NULL)); }

static void* unlock_it(void* unused) {
  (void)unused;
  return (void*)(intptr_t)pthread_mutex_unlock(&mutex);
}
static int unlocked_by_another(void) { return (int)(intptr_t)join(start(unlock_it, NULL)); }

CASE(a_statically_initialised_mutex_is_free) {
  EXPECT_IS(tried_by_another(), 0);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
}

// Some programs look there whether they hold a mutex, as Fast DDS does.
static pthread_cond_t given_up = PTHREAD_COND_INITIALIZER;
static void* note_owner_during_a_wait(void* owner) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(mutex.__data.__owner, gettid());
  *(int*)owner = mutex.__data.__owner;
  EXPECT_IS(pthread_cond_signal(&given_up), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  return NULL;
}
CASE(the_owner_is_where_glibc_has_it) {
  int other = 0;
  EXPECT_IS(mutex.__data.__owner, 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(mutex.__data.__owner, gettid());
  const pthread_t id = start(note_owner_during_a_wait, &other);
  while (other == 0) EXPECT_IS(pthread_cond_wait(&given_up, &mutex), 0);
  EXPECT_IS(mutex.__data.__owner, gettid());
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  join(id);
  EXPECT_IS(mutex.__data.__owner, 0);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
  EXPECT_IS(mutex.__data.__owner, gettid());
}

CASE(a_locked_mutex_is_busy_for_others) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(tried_by_another(), EBUSY);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(tried_by_another(), 0);
}

static void* lock_it(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  return unused;
}
CASE(a_mutex_that_an_ended_thread_holds_is_held_by_no_other) {
  join(start(lock_it, NULL));
  for (int i = 0; i < 3; ++i) EXPECT_IS(tried_by_another(), EBUSY);
  make(PTHREAD_MUTEX_ERRORCHECK);
  join(start(lock_it, NULL));
  EXPECT_IS(unlocked_by_another(), EPERM);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}
CASE(a_mutex_that_was_tried_is_held) {
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
  EXPECT_IS(tried_by_another(), EBUSY);
}

static void* work_inside(void* unused) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_IS(pthread_mutex_lock(&mutex), 0);
    EXPECT_IS(atomic_fetch_add(&inside, 1), 0);
    if (i % 10 == 0) sched_yield();
    EXPECT_IS(atomic_fetch_sub(&inside, 1), 1);
    EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  }
  return unused;
}
static void many_inside(int type) {
  make(type);
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(work_inside, NULL);
  for (int i = 0; i < 4; ++i) join(ids[i]);
}
CASE(one_thread_at_a_time_holds_a_normal_mutex) { many_inside(PTHREAD_MUTEX_NORMAL); }
CASE(one_thread_at_a_time_holds_a_recursive_mutex) { many_inside(PTHREAD_MUTEX_RECURSIVE); }
CASE(one_thread_at_a_time_holds_an_errorcheck_mutex) { many_inside(PTHREAD_MUTEX_ERRORCHECK); }
CASE(one_thread_at_a_time_holds_an_adaptive_mutex) { many_inside(PTHREAD_MUTEX_ADAPTIVE_NP); }

static void* lock_and_note(void* unused) {
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  note("locked");
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(who_locks_a_held_mutex_waits_for_it) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(lock_and_note, NULL);
  let_others_wait();
  note("unlocked ");
  pthread_mutex_unlock(&mutex);
  join(id);
  EXPECT_NOTED("unlocked locked");
}

CASE(a_normal_mutex_of_oneself_is_busy) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}

CASE(a_normal_mutex_of_oneself_times_out) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 3);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &soon), ETIMEDOUT);
}

CASE(a_recursive_mutex_is_free_after_as_many_unlocks) {
  make(PTHREAD_MUTEX_RECURSIVE);
  for (int i = 0; i < 5; ++i) EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_IS(tried_by_another(), EBUSY);
    EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  }
  EXPECT_IS(tried_by_another(), 0);
}

CASE(a_recursive_mutex_is_unlocked_by_its_owner_alone) {
  make(PTHREAD_MUTEX_RECURSIVE);
  EXPECT_IS(pthread_mutex_unlock(&mutex), EPERM);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(unlocked_by_another(), EPERM);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), EPERM);
}

CASE(a_recursive_mutex_of_oneself_is_locked_by_a_timed_lock_too) {
  make(PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_lock(&mutex);
  const struct timespec past = in_ms(CLOCK_REALTIME, -1000), invalid = invalid_time(CLOCK_REALTIME);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &past), 0);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &invalid), 0);
  pthread_mutex_unlock(&mutex);
  pthread_mutex_unlock(&mutex);
  EXPECT_IS(tried_by_another(), EBUSY);
}

CASE(the_static_initialiser_of_recursive_mutexes) {
  static pthread_mutex_t recursive = PTHREAD_RECURSIVE_MUTEX_INITIALIZER_NP;
  EXPECT_IS(pthread_mutex_lock(&recursive), 0);
  EXPECT_IS(pthread_mutex_lock(&recursive), 0);
  EXPECT_IS(pthread_mutex_unlock(&recursive), 0);
  EXPECT_IS(pthread_mutex_unlock(&recursive), 0);
  EXPECT_IS(pthread_mutex_unlock(&recursive), EPERM);
}

CASE(the_static_initialiser_of_errorcheck_mutexes) {
  static pthread_mutex_t checked = PTHREAD_ERRORCHECK_MUTEX_INITIALIZER_NP;
  EXPECT_IS(pthread_mutex_lock(&checked), 0);
  EXPECT_IS(pthread_mutex_lock(&checked), EDEADLK);
  EXPECT_IS(pthread_mutex_unlock(&checked), 0);
  EXPECT_IS(pthread_mutex_unlock(&checked), EPERM);
}

CASE(an_errorcheck_mutex_tells_who_locks_twice) {
  make(PTHREAD_MUTEX_ERRORCHECK);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 1000), invalid = invalid_time(CLOCK_REALTIME);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(pthread_mutex_lock(&mutex), EDEADLK);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &soon), EDEADLK);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &invalid), EDEADLK);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}

CASE(an_errorcheck_mutex_is_unlocked_by_its_owner_alone) {
  make(PTHREAD_MUTEX_ERRORCHECK);
  EXPECT_IS(pthread_mutex_unlock(&mutex), EPERM);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(unlocked_by_another(), EPERM);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
}

static void timed_out(clockid_t clock, int by_clock) {
  make(PTHREAD_MUTEX_ERRORCHECK);
  pthread_mutex_lock(&mutex);
  extern void* lock_until(void*);
  static struct timespec deadline;
  static const struct timespec* argument[2];
  deadline = in_ms(clock, 6);
  argument[0] = &deadline;
  argument[1] = by_clock ? (clock == CLOCK_MONOTONIC ? argument[0] : NULL) : NULL;
  const long long begin = now_ns(clock);
  EXPECT_IS((intptr_t)join(start(lock_until, argument)), ETIMEDOUT);
  EXPECT(now_ns(clock) - begin >= 6000000 - 100000);
}
void* lock_until(void* argument) {
  const struct timespec* const* deadlines = argument;
  return (void*)(intptr_t)(deadlines[1] != NULL ? pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, deadlines[1])
                                                : pthread_mutex_timedlock(&mutex, deadlines[0]));
}
CASE(timedlock_waits_until_its_deadline) { timed_out(CLOCK_REALTIME, 0); }
CASE(clocklock_waits_until_its_deadline_by_the_monotonic_clock) { timed_out(CLOCK_MONOTONIC, 1); }

CASE(a_timed_lock_of_a_free_mutex_looks_at_no_deadline) {
  const struct timespec past = {0, 0};
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &past), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, &past), 0);
}

static struct timespec given;
static void* lock_by_given(void* unused) {
  (void)unused;
  return (void*)(intptr_t)pthread_mutex_timedlock(&mutex, &given);
}
static void* lock_by_given_clock(void* unused) {
  (void)unused;
  return (void*)(intptr_t)pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, &given);
}
static void refused(struct timespec time, int error) {
  given = time;
  pthread_mutex_lock(&mutex);
  EXPECT_IS((intptr_t)join(start(lock_by_given, NULL)), error);
  EXPECT_IS((intptr_t)join(start(lock_by_given_clock, NULL)), error);
}
CASE(a_timed_lock_with_a_past_deadline_is_timed_out) { refused((struct timespec){0, 0}, ETIMEDOUT); }
CASE(a_timed_lock_with_negative_seconds_is_timed_out) { refused((struct timespec){-1, 0}, ETIMEDOUT); }
CASE(a_timed_lock_refuses_too_many_nanoseconds) { refused(invalid_time(CLOCK_REALTIME), EINVAL); }
CASE(a_timed_lock_refuses_negative_nanoseconds) { refused((struct timespec){5, -1}, EINVAL); }

CASE(a_timed_lock_gets_what_is_unlocked_before_its_deadline) {
  given = in_ms(CLOCK_REALTIME, 5000);
  pthread_mutex_lock(&mutex);
  const pthread_t id = start(lock_by_given, NULL);
  let_others_wait();
  pthread_mutex_unlock(&mutex);
  EXPECT_IS((intptr_t)join(id), 0);
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
}

CASE(clocklock_refuses_clocks_of_processor_time) {
  const struct timespec time = in_ms(CLOCK_MONOTONIC, 5);
  EXPECT_IS(pthread_mutex_clocklock(&mutex, CLOCK_PROCESS_CPUTIME_ID, &time), EINVAL);
  EXPECT_IS(pthread_mutex_clocklock(&mutex, 77, &time), EINVAL);
}

CASE(a_destroyed_mutex_can_be_made_again) {
  for (int i = 0; i < 3; ++i) {
    make(i == 1 ? PTHREAD_MUTEX_RECURSIVE : PTHREAD_MUTEX_NORMAL);
    EXPECT_IS(pthread_mutex_lock(&mutex), 0);
    EXPECT_IS(pthread_mutex_trylock(&mutex), i == 1 ? 0 : EBUSY);
    if (i == 1) pthread_mutex_unlock(&mutex);
    EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
    EXPECT_IS(pthread_mutex_destroy(&mutex), 0);
  }
}

CASE(a_locked_mutex_is_not_destroyed) {
  make(PTHREAD_MUTEX_NORMAL);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(pthread_mutex_destroy(&mutex), EBUSY);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_destroy(&mutex), 0);
}

CASE(memory_of_a_mutex_is_used_for_another) {
  // std::mutex is never destroyed either.
  for (int i = 0; i < 20; ++i) {
    pthread_mutex_t* made = malloc(sizeof *made);
    *made = (pthread_mutex_t)PTHREAD_MUTEX_INITIALIZER;
    EXPECT_IS(pthread_mutex_trylock(made), 0);
    if (i % 2 == 0) pthread_mutex_unlock(made);
    free(made);
  }
}

static void* lock_and_end(void* unused) {
  pthread_mutex_lock(&mutex);
  return unused;
}
CASE(the_mutex_of_a_thread_that_ended_stays_locked) {
  join(start(lock_and_end, NULL));
  for (int i = 0; i < 3; ++i) EXPECT_IS(tried_by_another(), EBUSY);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 2);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &soon), ETIMEDOUT);
}

CASE(attributes_of_mutexes_have_defaults) {
  pthread_mutexattr_t attributes;
  int value = -1;
  EXPECT_IS(pthread_mutexattr_init(&attributes), 0);
  EXPECT_IS(pthread_mutexattr_gettype(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_MUTEX_DEFAULT);
  EXPECT_IS(pthread_mutexattr_getpshared(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_PROCESS_PRIVATE);
  EXPECT_IS(pthread_mutexattr_getprotocol(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_PRIO_NONE);
  EXPECT_IS(pthread_mutexattr_getrobust(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_MUTEX_STALLED);
}

CASE(attributes_of_mutexes_refuse_what_is_none) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_mutexattr_setpshared(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_mutexattr_setprotocol(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_mutexattr_setrobust(&attributes, 77), EINVAL);
}

CASE(a_mutex_shared_by_processes_works_between_threads) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  EXPECT_IS(pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
  pthread_mutex_lock(&mutex);
  EXPECT_IS(tried_by_another(), EBUSY);
}

CASE(a_mutex_with_priority_inheritance_works) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  EXPECT_IS(pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT), 0);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_RECURSIVE), 0);
  EXPECT_IS(pthread_mutex_init(&mutex, &attributes), 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  EXPECT_IS(tried_by_another(), EBUSY);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(tried_by_another(), 0);
}

CASE(a_ceiling_is_kept) {
  pthread_mutexattr_t attributes;
  pthread_mutex_t protecting;
  int ceiling = 0;
  EXPECT_IS(pthread_mutexattr_init(&attributes), 0);
  EXPECT_IS(pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_PROTECT), 0);
  EXPECT_IS(pthread_mutexattr_setprioceiling(&attributes, 30), 0);
  EXPECT_IS(pthread_mutex_init(&protecting, &attributes), 0);
  EXPECT_IS(pthread_mutex_getprioceiling(&protecting, &ceiling), 0);
  EXPECT_IS(ceiling, 30);
  EXPECT_IS(pthread_mutex_setprioceiling(&protecting, 200, &ceiling), EINVAL);
  if (geteuid() == 0) {
    EXPECT_IS(pthread_mutex_setprioceiling(&protecting, 40, &ceiling), 0);
    EXPECT_IS(ceiling, 30);
    EXPECT_IS(pthread_mutex_getprioceiling(&protecting, &ceiling), 0);
    EXPECT_IS(ceiling, 40);
  }
  pthread_mutex_t plain = PTHREAD_MUTEX_INITIALIZER;
  EXPECT_IS(pthread_mutex_setprioceiling(&plain, 40, &ceiling), EINVAL);
}
CASE(an_inheriting_mutex_is_a_mutex) {
  pthread_mutexattr_t attributes;
  pthread_mutex_t inheriting;
  EXPECT_IS(pthread_mutexattr_init(&attributes), 0);
  EXPECT_IS(pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT), 0);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK), 0);
  EXPECT_IS(pthread_mutex_init(&inheriting, &attributes), 0);
  EXPECT_IS(pthread_mutex_lock(&inheriting), 0);
  EXPECT_IS(pthread_mutex_lock(&inheriting), EDEADLK);
  EXPECT_IS(pthread_mutex_unlock(&inheriting), 0);
  EXPECT_IS(pthread_mutex_unlock(&inheriting), EPERM);
}

static void end_well(int signal) {
  (void)signal;
  _exit(3);
}
CASE_ENDING_WITH(3, who_waits_for_itself_is_left_by_a_timers_handler) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  signal(SIGALRM, end_well);
  alarm(1);
  pthread_mutex_lock(&mutex);
  pthread_mutex_lock(&mutex);
}
