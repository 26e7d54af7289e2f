// SPDX-License-Identifier: BSD-3-Clause
// Life of a thread: creation, join, detachment, end.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <stdint.h>

static void* give_back(void* argument) { return argument; }

CASE(a_thread_gets_its_argument_and_gives_its_result) {
  int value;
  EXPECT(join(start(give_back, &value)) == &value);
}

CASE(join_takes_no_result_where_none_is_wanted) { EXPECT_IS(pthread_join(start(give_back, NULL), NULL), 0); }

static void* exit_with(void* argument) { pthread_exit(argument); }
CASE(pthread_exit_gives_the_result) { EXPECT_IS((intptr_t)join(start(exit_with, (void*)7)), 7); }

static void* exit_deep(void* argument) {
  volatile char frame[100];
  frame[0] = 1;
  if (argument == NULL) pthread_exit((void*)5);
  return frame[0] == 1 ? exit_deep((void*)((intptr_t)argument - 1)) : NULL;
}
CASE(pthread_exit_leaves_nested_calls) { EXPECT_IS((intptr_t)join(start(exit_deep, (void*)20)), 5); }

static void* own_id(void* id) {
  *(pthread_t*)id = pthread_self();
  return NULL;
}
CASE(pthread_self_is_what_pthread_create_gave) {
  pthread_t said;
  const pthread_t id = start(own_id, &said);
  join(id);
  EXPECT(pthread_equal(id, said));
}

CASE(threads_are_not_equal_to_each_other) {
  const pthread_t a = start(give_back, NULL), b = start(give_back, NULL);
  EXPECT(!pthread_equal(a, b));
  EXPECT(!pthread_equal(a, pthread_self()));
  EXPECT(pthread_equal(a, a));
  join(a);
  join(b);
}

static atomic_int counter;
static void* count(void* unused) {
  (void)unused;
  atomic_fetch_add(&counter, 1);
  return NULL;
}
CASE(many_threads_can_be_made_before_one_is_joined) {
  pthread_t ids[200];
  for (int i = 0; i < 200; ++i) ids[i] = start(count, NULL);
  for (int i = 0; i < 200; ++i) join(ids[i]);
  EXPECT_IS(counter, 200);
}

CASE(threads_can_be_made_and_joined_over_and_over) {
  for (int i = 0; i < 1000; ++i) EXPECT_IS((intptr_t)join(start(give_back, (void*)(intptr_t)i)), i);
}

static void* make_another(void* depth) {
  if (depth == NULL) return NULL;
  return (char*)join(start(make_another, (char*)depth - 1)) + 1;
}
CASE(a_thread_makes_and_joins_threads_of_its_own) { EXPECT_IS((intptr_t)join(start(make_another, (void*)10)), 10); }

static pthread_t main_id;
static void* join_main(void* unused) {
  (void)unused;
  void* result = NULL;
  if (pthread_join(main_id, &result) != 0 || (intptr_t)result != 3) _exit(1);
  exit(7);
}
CASE_ENDING_WITH(7, main_can_be_joined_after_pthread_exit) {
  main_id = pthread_self();
  start(join_main, NULL);
  pthread_exit((void*)3);
}

CASE(joining_oneself_is_a_deadlock) { EXPECT_IS(pthread_join(pthread_self(), NULL), EDEADLK); }

static void* wait_a_little(void* unused) {
  (void)unused;
  sleep_ms(10);
  return NULL;
}

CASE(a_detached_thread_cannot_be_joined) {
  const pthread_t id = start(wait_a_little, NULL);
  EXPECT_IS(pthread_detach(id), 0);
  EXPECT_IS(pthread_join(id, NULL), EINVAL);
}

CASE(a_detached_thread_cannot_be_detached) {
  const pthread_t id = start(wait_a_little, NULL);
  EXPECT_IS(pthread_detach(id), 0);
  EXPECT_IS(pthread_detach(id), EINVAL);
}

CASE(a_thread_made_detached_cannot_be_joined) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  EXPECT_IS(pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED), 0);
  pthread_t id;
  EXPECT_IS(pthread_create(&id, &attributes, wait_a_little, NULL), 0);
  EXPECT_IS(pthread_join(id, NULL), EINVAL);
}

static void* detach_oneself(void* unused) {
  (void)unused;
  EXPECT_IS(pthread_detach(pthread_self()), 0);
  atomic_fetch_add(&counter, 1);
  return NULL;
}
CASE(a_thread_can_detach_itself) {
  for (int i = 0; i < 10; ++i) start(detach_oneself, NULL);
  while (counter < 10) sleep_ms(1);
}

CASE(a_thread_that_has_ended_can_still_be_detached) {
  const pthread_t id = start(count, NULL);
  while (counter == 0) sleep_ms(1);
  sleep_ms(2);
  EXPECT_IS(pthread_detach(id), 0);
}

CASE(a_thread_that_has_ended_waits_to_be_joined) {
  const pthread_t id = start(give_back, &counter);
  sleep_ms(5);
  EXPECT(join(id) == &counter);
}

CASE(tryjoin_of_a_running_thread_is_busy) {
  const pthread_t id = start(wait_a_little, NULL);
  EXPECT_IS(pthread_tryjoin_np(id, NULL), EBUSY);
  EXPECT_IS(pthread_join(id, NULL), 0);
}

CASE(tryjoin_of_oneself_is_busy) { EXPECT_IS(pthread_tryjoin_np(pthread_self(), NULL), EBUSY); }

CASE(tryjoin_takes_the_result_of_an_ended_thread) {
  const pthread_t id = start(give_back, &counter);
  void* result = NULL;
  int error;
  while ((error = pthread_tryjoin_np(id, &result)) == EBUSY) sched_yield();
  EXPECT_IS(error, 0);
  EXPECT(result == &counter);
}

static void* sleep_long(void* unused) {
  (void)unused;
  sleep_ms(5000);
  return NULL;
}
static void join_timed_out(clockid_t clock, int by_clock) {
  const pthread_t id = start(sleep_long, NULL);
  const long long begin = now_ns(clock);
  const struct timespec deadline = in_ms(clock, 6);
  EXPECT_IS(by_clock ? pthread_clockjoin_np(id, NULL, clock, &deadline) : pthread_timedjoin_np(id, NULL, &deadline),
            ETIMEDOUT);
  EXPECT(now_ns(clock) - begin >= 6000000);
}
CASE(timedjoin_waits_until_its_deadline) { join_timed_out(CLOCK_REALTIME, 0); }
CASE(clockjoin_waits_until_its_deadline_by_the_monotonic_clock) { join_timed_out(CLOCK_MONOTONIC, 1); }
CASE(clockjoin_waits_until_its_deadline_by_the_realtime_clock) { join_timed_out(CLOCK_REALTIME, 1); }

CASE(timedjoin_takes_the_result_before_its_deadline) {
  const pthread_t id = start(wait_a_little, NULL), other = start(give_back, &counter);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  void* result = NULL;
  EXPECT_IS(pthread_timedjoin_np(id, NULL, &deadline), 0);
  EXPECT_IS(pthread_clockjoin_np(other, &result, CLOCK_REALTIME, &deadline), 0);
  EXPECT(result == &counter);
  EXPECT(now_ns(CLOCK_REALTIME) < deadline.tv_sec * 1000000000LL + deadline.tv_nsec);
}

CASE(timedjoin_with_a_past_deadline_is_timed_out_or_done) {
  const struct timespec past = in_ms(CLOCK_REALTIME, -1000);
  const pthread_t id = start(wait_a_little, NULL);
  EXPECT_IS(pthread_timedjoin_np(id, NULL, &past), ETIMEDOUT);
  sleep_ms(20);
  EXPECT_IS(pthread_timedjoin_np(id, NULL, &past), 0);
}

CASE(clockjoin_refuses_clocks_of_processor_time) {
  const pthread_t id = start(wait_a_little, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_IS(pthread_clockjoin_np(id, NULL, CLOCK_PROCESS_CPUTIME_ID, &deadline), EINVAL);
  join(id);
}

CASE(a_join_that_is_timed_out_can_be_tried_again) {
  const pthread_t id = start(wait_a_little, NULL);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 1);
  EXPECT_IS(pthread_timedjoin_np(id, NULL, &soon), ETIMEDOUT);
  EXPECT_IS(pthread_join(id, NULL), 0);
}

static void* wait_by_yields(void* flag) {
  while (!atomic_load((atomic_int*)flag)) EXPECT_IS(sched_yield(), 0);
  return NULL;
}
CASE(sched_yield_lets_others_go_on) {
  atomic_int flag = 0;
  const pthread_t id = start(wait_by_yields, &flag);
  sleep_ms(1);
  atomic_store(&flag, 1);
  join(id);
}

static void* id_of_kernel(void* unused) {
  (void)unused;
  return (void*)(intptr_t)gettid();
}
CASE(threads_of_one_process_have_different_gettid) {
  const pthread_t a = start(id_of_kernel, NULL), b = start(id_of_kernel, NULL);
  const intptr_t id_a = (intptr_t)join(a), id_b = (intptr_t)join(b);
  EXPECT(id_a != id_b && id_a != gettid() && id_a > 0 && id_b > 0);
  EXPECT_IS(gettid(), getpid());
}

static void* set_errno(void* unused) {
  (void)unused;
  EXPECT_IS(errno, 0);
  errno = ENOMEM;
  sched_yield();
  EXPECT_IS(errno, ENOMEM);
  return NULL;
}
CASE(errno_is_each_threads_own) {
  errno = EDOM;
  const pthread_t a = start(set_errno, NULL), b = start(set_errno, NULL);
  sleep_ms(1);
  EXPECT_IS(errno, EDOM);
  join(a);
  join(b);
  EXPECT_IS(errno, EDOM);
}

// The function: the header has it inline.
static pthread_t current;
static void* change_id(void* unused) {
  current = pthread_self();
  return unused;
}
CASE(a_loop_of_comparisons_ends) {
  int (*volatile equal)(pthread_t, pthread_t) = pthread_equal;
  current = pthread_self();
  const pthread_t id = start(change_id, NULL);
  while (equal(*(volatile pthread_t*)&current, pthread_self())) continue;
  EXPECT(equal(current, id));
  join(id);
}
