// SPDX-License-Identifier: BSD-3-Clause
// Signals between threads, and waits for signals.
#include "tests/exec/conformance/signals.h"

#include <fcntl.h>
#include <sys/socket.h>

static void* look_at_blocked(void* unused) {
  (void)unused;
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  EXPECT_IS(is_pending(SIGUSR1), 0);
  unblock(SIGUSR1, 0);
  return NULL;
}
CASE(a_thread_inherits_the_mask_but_not_what_pends) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  raise(SIGUSR1);
  join(start(look_at_blocked, NULL));
  EXPECT_IS(handled, 0);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  EXPECT_IS(is_pending(SIGUSR1), 1);
}

static atomic_int ready;

static void* sleep_long(void* unused) {
  ready = 1;
  struct timespec time = {100, 0};
  EXPECT_FAILS(nanosleep(&time, &time), EINTR);
  EXPECT(time.tv_sec >= 90);
  EXPECT(pthread_equal(handled_by, pthread_self()));
  return unused;
}
CASE(pthread_kill_runs_the_handler_in_that_thread) {
  act(SIGUSR1, handle, 0);
  const pthread_t id = start(sleep_long, NULL);
  while (!ready) sched_yield();
  let_others_wait();
  EXPECT_IS(pthread_kill(id, SIGUSR1), 0);
  join(id);
  EXPECT_IS(handled, 1);
}

static atomic_int thread_id;

static void* tell_and_sleep(void* unused) {
  thread_id = gettid();
  return sleep_long(unused);
}
CASE(tgkill_runs_the_handler_in_that_thread) {
  act(SIGUSR1, handle, 0);
  const pthread_t id = start(tell_and_sleep, NULL);
  while (!ready) sched_yield();
  let_others_wait();
  EXPECT_IS(tgkill(getpid(), thread_id, SIGUSR1), 0);
  join(id);
}

static void* take_what_comes(void* unused) {
  unblock(SIGUSR1, 0);
  ready = 1;
  EXPECT_IS(sleep(100) > 0, 1);
  EXPECT(pthread_equal(handled_by, pthread_self()));
  return unused;
}
CASE(a_signal_to_the_process_goes_to_a_thread_that_does_not_block_it) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  const pthread_t id = start(take_what_comes, NULL);
  while (!ready) sched_yield();
  let_others_wait();
  EXPECT_IS(kill(getpid(), SIGUSR1), 0);
  join(id);
  EXPECT_IS(handled, 1);
}

static void* exit_at_once(void* unused) { return unused; }
CASE(a_thread_that_has_ended_can_be_sent_nothing) {
  const pthread_t id = start(exit_at_once, NULL);
  let_others_wait();
  const int result = pthread_kill(id, 0);
  EXPECT(result == 0 || result == ESRCH);
  join(id);
}
CASE_ENDING_WITH(-10, a_signal_to_a_thread_ends_the_process) {
  const pthread_t id = start(sleep_long, NULL);
  pthread_kill(id, SIGUSR1);
  join(id);
}
CASE(sigwait_takes_what_pends) {
  block(SIGUSR1, 0);
  kill(getpid(), SIGUSR1);
  const sigset_t set = set_of(SIGUSR1, 0);
  int signal = 0;
  EXPECT_IS(sigwait(&set, &signal), 0);
  EXPECT_IS(signal, SIGUSR1);
  EXPECT_IS(is_pending(SIGUSR1), 0);
}

static void* send_to_process(void* unused) {
  let_others_wait();
  EXPECT_IS(kill(getpid(), SIGUSR1), 0);
  return unused;
}
CASE(sigwait_waits) {
  block(SIGUSR1, SIGUSR2);
  const pthread_t id = start(send_to_process, NULL);
  const sigset_t set = set_of(SIGUSR1, SIGUSR2);
  int signal = 0;
  EXPECT_IS(sigwait(&set, &signal), 0);
  EXPECT_IS(signal, SIGUSR1);
  join(id);
}
CASE(sigtimedwait_ends_at_its_time) {
  block(SIGUSR1, 0);
  const sigset_t set = set_of(SIGUSR1, 0);
  const struct timespec timeout = {0, 20000000}, none = {0, 0}, invalid = {0, 1000000000};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(sigtimedwait(&set, NULL, &timeout), EAGAIN);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT_FAILS(sigtimedwait(&set, NULL, &none), EAGAIN);
  EXPECT_FAILS(sigtimedwait(&set, NULL, &invalid), EINVAL);
  raise(SIGUSR1);
  siginfo_t information;
  EXPECT_IS(sigtimedwait(&set, &information, &none), SIGUSR1);
  EXPECT_IS(information.si_code, SI_USER);  // the C library sets it so here
}

static void* send_USR2_to_main(void* unused) {
  let_others_wait();
  EXPECT_IS(pthread_kill(main_id, SIGUSR2), 0);
  return unused;
}
CASE(sigwaitinfo_is_ended_by_another_signal_that_is_handled) {
  act(SIGUSR2, handle, SA_RESTART);
  block(SIGUSR1, 0);
  main_id = pthread_self();
  const pthread_t id = start(send_USR2_to_main, NULL);
  const sigset_t set = set_of(SIGUSR1, 0);
  EXPECT_FAILS(sigwaitinfo(&set, NULL), EINTR);
  EXPECT_IS(handled, 1);
  join(id);
}

static atomic_int takers;

static void* take_one_signal(void* unused) {
  const sigset_t set = set_of(SIGUSR1, 0);
  int signal = 0;
  EXPECT_IS(sigwait(&set, &signal), 0);
  atomic_fetch_add(&takers, 1);
  return unused;
}
CASE(of_several_that_wait_one_takes_it) {
  block(SIGUSR1, 0);
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = start(take_one_signal, NULL);
  let_others_wait();
  kill(getpid(), SIGUSR1);
  let_others_wait();
  EXPECT_IS(takers, 1);
  for (int i = 1; i < 3; ++i) {
    kill(getpid(), SIGUSR1);
    while (takers < i + 1) sched_yield();
  }
  for (int i = 0; i < 3; ++i) join(ids[i]);
}
CASE(sigsuspend_waits_with_its_mask) {
  act(SIGUSR1, look_at_mask, 0);
  block(SIGUSR1, 0);
  const pthread_t id = start(send_to_process, NULL);
  sigset_t set;
  sigfillset(&set);
  sigdelset(&set, SIGUSR1);
  EXPECT_FAILS(sigsuspend(&set), EINTR);
  EXPECT_IS(handled, 1);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  EXPECT_IS(is_blocked(SIGUSR2), 0);
  EXPECT_IS(blocked_USR2, 1);
  join(id);
}
CASE(sigsuspend_takes_what_pends) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  raise(SIGUSR1);
  sigset_t none;
  sigemptyset(&none);
  EXPECT_FAILS(sigsuspend(&none), EINTR);
  EXPECT_IS(handled, 1);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
}
CASE(pause_waits_for_a_handler) {
  act(SIGUSR1, handle, SA_RESTART);
  main_id = pthread_self();
  const pthread_t id = start(send_to_main, NULL);
  EXPECT_FAILS(pause(), EINTR);
  EXPECT_IS(handled, 1);
  join(id);
}

static void* cancel_main(void* unused) {
  let_others_wait();
  pthread_cancel(main_id);
  return unused;
}

static void* pause_in_thread(void* unused) {
  pause();
  return unused;
}

static void* suspend_in_thread(void* unused) {
  sigset_t set;
  sigemptyset(&set);
  sigsuspend(&set);
  return unused;
}

static void* wait_in_thread(void* unused) {
  const sigset_t set = set_of(SIGUSR1, 0);
  sigwaitinfo(&set, NULL);
  return unused;
}
CASE(waits_for_signals_are_cancellation_points) {
  (void)cancel_main;
  void* (*const waits[])(void*) = {pause_in_thread, suspend_in_thread, wait_in_thread};
  for (int i = 0; i < 3; ++i) {
    const pthread_t id = start(waits[i], NULL);
    let_others_wait();
    EXPECT_IS(pthread_cancel(id), 0);
    EXPECT(join(id) == PTHREAD_CANCELED);
  }
}
CASE(what_a_thread_writes_is_told_before_the_call_returns) {
  int pair[2];
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
  act(SIGIO, handle, 0);
  EXPECT_IS(fcntl(pair[0], F_SETOWN, getpid()), 0);
  EXPECT_IS(fcntl(pair[0], F_SETFL, O_ASYNC), 0);
  EXPECT_IS(write(pair[1], "a", 1), 1);
  EXPECT_IS(handled, 1);
  EXPECT_IS(last, SIGIO);
}
