// SPDX-License-Identifier: BSD-3-Clause
// Threads in loops without calls, which only an asynchronous cancellation or a timer on processor time ends.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <signal.h>
#include <sys/time.h>

static sem_t ready;
static volatile unsigned long rounds;
static volatile int cleaned, handled;
static void clean(void* unused) {
  (void)unused;
  cleaned = 1;
}
static void* compute(void* unused) {
  pthread_cleanup_push(clean, NULL);
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL), 0);
  sem_post(&ready);
  for (;;) ++rounds;
  pthread_cleanup_pop(0);
  return unused;
}
static pthread_t begin(void* (*body)(void*)) {
  sem_init(&ready, 0, 0);
  const pthread_t id = start(body, NULL);
  EXPECT_IS(sem_wait(&ready), 0);
  return id;
}
CASE(a_computing_thread_is_cancelled) {
  const pthread_t id = begin(compute);
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(cleaned, 1);
}
CASE(a_computing_thread_is_cancelled_after_a_while) {
  const pthread_t id = begin(compute);
  sleep_ms(500);
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT(rounds > 0);
}
CASE(computing_threads_are_cancelled) {
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = begin(compute);
  for (int i = 0; i < 3; ++i) EXPECT_IS(pthread_cancel(ids[i]), 0);
  for (int i = 0; i < 3; ++i) EXPECT(join(ids[i]) == PTHREAD_CANCELED);
}
static void* enable_late(void* unused) {
  EXPECT_IS(pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL), 0);
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL), 0);
  sem_post(&ready);
  EXPECT_IS(pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, NULL), 0);
  for (;;) ++rounds;
  return unused;
}
CASE(a_computing_thread_that_has_enabled_it_is_cancelled) {
  const pthread_t id = begin(enable_late);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
}
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static void* lock(void* unused) {
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL), 0);
  sem_post(&ready);
  pthread_mutex_lock(&mutex);
  return unused;
}
CASE(a_wait_for_a_mutex_is_cancelled) {
  pthread_mutex_lock(&mutex);
  const pthread_t id = begin(lock);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
}
static pthread_mutex_t other = PTHREAD_MUTEX_INITIALIZER;
static void* lock_and_unlock(void* unused) {
  EXPECT_IS(pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, NULL), 0);
  sem_post(&ready);
  for (;;) {
    pthread_mutex_lock(&other);
    pthread_mutex_unlock(&other);
  }
  return unused;
}
CASE(a_loop_of_locks_is_cancelled) {
  const pthread_t id = begin(lock_and_unlock);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
}

static void handle(int signal) {
  (void)signal;
  ++handled;
}
static void act(int signal) {
  struct sigaction action = {.sa_handler = handle};
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}
static timer_t set_timer(clockid_t clock, long ms, long interval_ms) {
  act(SIGUSR1);
  struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGUSR1};
  timer_t timer;
  EXPECT_IS(timer_create(clock, &event, &timer), 0);
  const struct itimerspec time = {{0, interval_ms * 1000000}, {0, ms * 1000000}};
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  return timer;
}
CASE(a_timer_on_the_processs_time_ends_a_loop) {
  set_timer(CLOCK_PROCESS_CPUTIME_ID, 20, 0);
  const long long before = now_ns(CLOCK_PROCESS_CPUTIME_ID);
  while (!handled) ++rounds;
  EXPECT(now_ns(CLOCK_PROCESS_CPUTIME_ID) - before >= 15000000);
}
CASE(a_timer_on_the_threads_time_ends_a_loop) {
  set_timer(CLOCK_THREAD_CPUTIME_ID, 20, 0);
  while (!handled) ++rounds;
  EXPECT(now_ns(CLOCK_THREAD_CPUTIME_ID) >= 15000000);
}
CASE(a_periodic_timer_on_processor_time_ends_a_loop) {
  const timer_t timer = set_timer(CLOCK_PROCESS_CPUTIME_ID, 20, 20);
  while (handled < 5) ++rounds;
  EXPECT_IS(timer_delete(timer), 0);
  EXPECT(now_ns(CLOCK_PROCESS_CPUTIME_ID) >= 90000000);
}
static void end_loop(int signal, __itimer_which_t which) {
  act(signal);
  const struct itimerval time = {{0, 0}, {0, 20000}};
  EXPECT_IS(setitimer(which, &time, NULL), 0);
  while (!handled) ++rounds;
}
CASE(ITIMER_PROF_ends_a_loop) { end_loop(SIGPROF, ITIMER_PROF); }
CASE(ITIMER_VIRTUAL_ends_a_loop) { end_loop(SIGVTALRM, ITIMER_VIRTUAL); }
static void* compute_until_handled(void* clock) {
  EXPECT_IS(pthread_getcpuclockid(pthread_self(), clock), 0);
  sem_wait(&ready);
  while (!handled) ++rounds;
  return NULL;
}
CASE(a_timer_on_another_threads_time_ends_its_loop) {
  clockid_t clock = -1;
  sem_init(&ready, 0, 0);
  const pthread_t id = start(compute_until_handled, &clock);
  while (clock == -1) sleep_ms(1);
  set_timer(clock, 20, 0);
  sem_post(&ready);
  join(id);
  EXPECT_IS(handled, 1);
}
static void* wait_long(void* unused) {
  sleep_ms(50);
  note("slept ");
  return unused;
}
CASE(others_continue_while_a_thread_computes) {
  const pthread_t id = start(wait_long, NULL);
  set_timer(CLOCK_PROCESS_CPUTIME_ID, 400, 0);
  while (!handled) ++rounds;
  note("handled");
  join(id);
  EXPECT_NOTED("slept handled");
}
