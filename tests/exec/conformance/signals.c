// SPDX-License-Identifier: BSD-3-Clause
// Signals: sent, blocked, pending, handled, and what they end.
#include "tests/exec/conformance/harness.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

// No header has it any more.
extern void (*bsd_signal(int signal, void (*handler)(int)))(int);

static atomic_int handled, last;
// Volatile: of the calls that send, the compiler knows that they touch nothing of this file.
static volatile siginfo_t told;
static volatile pthread_t handled_by;
static atomic_int blocked_USR1, blocked_USR2;
static volatile char on_alternate;

static void handle(int signal) {
  handled_by = pthread_self();
  last = signal;
  atomic_fetch_add(&handled, 1);
}
static void handle_with_information(int signal, siginfo_t* information, void* context) {
  EXPECT(context != NULL);
  told = *information;
  handle(signal);
}
static void look_at_mask(int signal) {
  sigset_t set;
  pthread_sigmask(SIG_SETMASK, NULL, &set);
  blocked_USR1 = sigismember(&set, SIGUSR1);
  blocked_USR2 = sigismember(&set, SIGUSR2);
  handle(signal);
}
static void note_signal(int signal) {
  char text[16];
  snprintf(text, sizeof text, "%d ", signal >= SIGRTMIN ? signal - SIGRTMIN + 100 : signal);
  note(text);
}

static sigset_t set_of(int first, int second) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, first);
  if (second != 0) sigaddset(&set, second);
  return set;
}
static void act(int signal, void (*handler)(int), int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  action.sa_flags = flags;
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}
static void act_with_information(int signal, int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = handle_with_information;
  action.sa_flags = flags | SA_SIGINFO;
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}
static void block(int first, int second) {
  const sigset_t set = set_of(first, second);
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, &set, NULL), 0);
}
static void unblock(int first, int second) {
  const sigset_t set = set_of(first, second);
  EXPECT_IS(pthread_sigmask(SIG_UNBLOCK, &set, NULL), 0);
}
static int is_blocked(int signal) {
  sigset_t set;
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, NULL, &set), 0);
  return sigismember(&set, signal);
}
static int is_pending(int signal) {
  sigset_t set;
  EXPECT_IS(sigpending(&set), 0);
  return sigismember(&set, signal);
}

// Sending and handling.

CASE(raise_is_handled_before_it_returns) {
  act(SIGUSR1, handle, 0);
  EXPECT_IS(raise(SIGUSR1), 0);
  EXPECT_IS(handled, 1);
  EXPECT_IS(last, SIGUSR1);
  EXPECT(pthread_equal(handled_by, pthread_self()));
}
CASE(gsignal_raises_within_the_c_library) {
  act(SIGUSR1, handle, 0);
  EXPECT_IS(gsignal(SIGUSR1), 0);
  EXPECT_IS(handled, 1);
}
CASE(kill_of_oneself_is_handled_before_it_returns) {
  act(SIGUSR1, handle, 0);
  EXPECT_IS(kill(getpid(), SIGUSR1), 0);
  EXPECT_IS(handled, 1);
}
CASE(what_is_not_a_signal_is_refused) {
  EXPECT_FAILS(kill(getpid(), -1), EINVAL);
  EXPECT_FAILS(kill(getpid(), 65), EINVAL);
  errno = 0;
  EXPECT(raise(65) != 0);
  EXPECT_IS(pthread_kill(pthread_self(), 65), EINVAL);
  EXPECT_FAILS(tgkill(getpid(), gettid(), 65), EINVAL);
  const union sigval none = {0};
  EXPECT_FAILS(sigqueue(getpid(), 65, none), EINVAL);
  struct sigaction action;
  EXPECT_FAILS(sigaction(65, NULL, &action), EINVAL);
  EXPECT_FAILS(sigaction(0, NULL, &action), EINVAL);
  EXPECT(signal(65, handle) == SIG_ERR);
}
CASE(signal_0_only_asks) {
  EXPECT_IS(kill(getpid(), 0), 0);
  EXPECT_IS(pthread_kill(pthread_self(), 0), 0);
  EXPECT_IS(tgkill(getpid(), gettid(), 0), 0);
}
CASE(nobody_there_cannot_be_sent_to) {
  EXPECT_FAILS(kill(0x3FFFFFF0, SIGUSR1), ESRCH);
  EXPECT_FAILS(tgkill(getpid(), 0x3FFFFFF0, SIGUSR1), ESRCH);
  EXPECT_FAILS(tgkill(getpid(), -1, SIGUSR1), EINVAL);
}
CASE(KILL_and_STOP_cannot_be_handled) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = SIG_IGN;
  EXPECT_FAILS(sigaction(SIGKILL, &action, NULL), EINVAL);
  EXPECT_FAILS(sigaction(SIGSTOP, &action, NULL), EINVAL);
  EXPECT_IS(sigaction(SIGKILL, NULL, &action), 0);
  EXPECT(action.sa_handler == SIG_DFL);
}
CASE(sigaction_tells_what_was_before) {
  struct sigaction action, old;
  memset(&action, 0, sizeof action);
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  sigaddset(&action.sa_mask, SIGUSR2);
  EXPECT_IS(sigaction(SIGUSR1, &action, &old), 0);
  EXPECT(old.sa_handler == SIG_DFL);
  EXPECT_IS(sigaction(SIGUSR1, NULL, &old), 0);
  EXPECT(old.sa_handler == handle);
  EXPECT((old.sa_flags & SA_RESTART) != 0);
  EXPECT_IS(sigismember(&old.sa_mask, SIGUSR2), 1);
  EXPECT_IS(sigismember(&old.sa_mask, SIGUSR1), 0);
}
CASE(signal_tells_what_was_before) {
  EXPECT(signal(SIGUSR1, handle) == SIG_DFL);
  EXPECT(signal(SIGUSR1, SIG_IGN) == handle);
  EXPECT(signal(SIGUSR1, SIG_DFL) == SIG_IGN);
}
CASE(a_handler_of_signal_stays) {
  signal(SIGUSR1, handle);
  raise(SIGUSR1);
  raise(SIGUSR1);
  EXPECT_IS(handled, 2);
}
CASE(a_handler_of_sysv_signal_goes) {
  EXPECT(sysv_signal(SIGCHLD, handle) == SIG_DFL);
  raise(SIGCHLD);
  raise(SIGCHLD);
  EXPECT_IS(handled, 1);
}
CASE(bsd_names_do_as_signal) {
  EXPECT(bsd_signal(SIGUSR1, handle) == SIG_DFL);
  raise(SIGUSR1);
  EXPECT(ssignal(SIGUSR1, SIG_IGN) == handle);
  raise(SIGUSR1);
  EXPECT_IS(handled, 1);
}
CASE(an_ignored_signal_does_nothing) {
  signal(SIGUSR1, SIG_IGN);
  EXPECT_IS(raise(SIGUSR1), 0);
  EXPECT_IS(sigignore(SIGUSR2), 0);
  EXPECT_IS(raise(SIGUSR2), 0);
}
CASE(some_are_ignored_by_default) {
  EXPECT_IS(raise(SIGCHLD), 0);
  EXPECT_IS(raise(SIGURG), 0);
  EXPECT_IS(raise(SIGWINCH), 0);
  EXPECT_IS(raise(SIGCONT), 0);
}
CASE_ENDING_WITH(-10, by_default_it_ends_the_process) { raise(SIGUSR1); }
CASE_ENDING_WITH(-15, TERM_ends_the_process) { kill(getpid(), SIGTERM); }
CASE_ENDING_WITH(-9, KILL_ends_the_process) { kill(getpid(), SIGKILL); }
CASE_ENDING_WITH(-34, a_real_time_signal_ends_the_process) { raise(SIGRTMIN); }
CASE_ENDING_WITH(-14, a_blocked_signal_ends_it_when_it_is_unblocked) {
  block(SIGALRM, 0);
  raise(SIGALRM);
  EXPECT_IS(is_pending(SIGALRM), 1);
  unblock(SIGALRM, 0);
}
CASE(RESETHAND_makes_it_the_default_once) {
  act(SIGURG, handle, SA_RESETHAND);
  raise(SIGURG);
  raise(SIGURG);
  EXPECT_IS(handled, 1);
  struct sigaction action;
  sigaction(SIGURG, NULL, &action);
  EXPECT(action.sa_handler == SIG_DFL);
}
CASE(its_information_says_who_sent_it) {
  act_with_information(SIGUSR1, 0);
  EXPECT_IS(kill(getpid(), SIGUSR1), 0);
  EXPECT_IS(told.si_signo, SIGUSR1);
  EXPECT_IS(told.si_code, SI_USER);
  EXPECT_IS(told.si_pid, getpid());
  EXPECT_IS(told.si_uid, getuid());
  EXPECT_IS(raise(SIGUSR1), 0);
  EXPECT_IS(told.si_code, SI_TKILL);
  EXPECT_IS(told.si_pid, getpid());
}
CASE(sigqueue_brings_a_value) {
  act_with_information(SIGRTMIN, 0);
  const union sigval value = {.sival_int = 4711};
  EXPECT_IS(sigqueue(getpid(), SIGRTMIN, value), 0);
  EXPECT_IS(told.si_code, SI_QUEUE);
  EXPECT_IS(told.si_value.sival_int, 4711);
  EXPECT_IS(told.si_pid, getpid());
  EXPECT_IS(pthread_sigqueue(pthread_self(), SIGRTMIN, value), 0);
  EXPECT_IS(handled, 2);
  EXPECT_IS(told.si_code, SI_QUEUE);
}

// Masks and what pends.

CASE(a_blocked_signal_pends) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  EXPECT_IS(is_pending(SIGUSR1), 0);
  raise(SIGUSR1);
  EXPECT_IS(handled, 0);
  EXPECT_IS(is_pending(SIGUSR1), 1);
  unblock(SIGUSR1, 0);
  EXPECT_IS(handled, 1);
  EXPECT_IS(is_pending(SIGUSR1), 0);
}
CASE(a_standard_signal_pends_once) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  for (int i = 0; i < 5; ++i) kill(getpid(), SIGUSR1);
  unblock(SIGUSR1, 0);
  EXPECT_IS(handled, 1);
}
CASE(what_pends_for_thread_and_process_is_two) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  kill(getpid(), SIGUSR1);
  raise(SIGUSR1);
  unblock(SIGUSR1, 0);
  EXPECT_IS(handled, 2);
}
CASE(real_time_signals_queue_in_their_order) {
  act_with_information(SIGRTMIN + 1, 0);
  block(SIGRTMIN + 1, 0);
  for (int i = 0; i < 5; ++i) EXPECT_IS(sigqueue(getpid(), SIGRTMIN + 1, (union sigval){.sival_int = i}), 0);
  const sigset_t set = set_of(SIGRTMIN + 1, 0);
  for (int i = 0; i < 3; ++i) {
    siginfo_t information;
    EXPECT_IS(sigwaitinfo(&set, &information), SIGRTMIN + 1);
    EXPECT_IS(information.si_value.sival_int, i);
  }
  unblock(SIGRTMIN + 1, 0);
  EXPECT_IS(handled, 2);
  EXPECT_IS(told.si_value.sival_int, 4);
}
CASE(the_least_signal_is_taken_first) {
  block(SIGRTMIN + 2, SIGRTMIN + 1);
  block(SIGUSR2, SIGUSR1);
  raise(SIGRTMIN + 2), raise(SIGRTMIN + 1), raise(SIGUSR2), raise(SIGUSR1);
  sigset_t set;
  sigfillset(&set);
  const int expected[] = {SIGUSR1, SIGUSR2, SIGRTMIN + 1, SIGRTMIN + 2};
  for (int i = 0; i < 4; ++i) EXPECT_IS(sigwaitinfo(&set, NULL), expected[i]);
}
CASE(handlers_of_what_pends_together_are_stacked) {
  act(SIGUSR1, note_signal, 0);
  act(SIGUSR2, note_signal, 0);
  block(SIGUSR1, SIGUSR2);
  raise(SIGUSR1), raise(SIGUSR2);
  unblock(SIGUSR1, SIGUSR2);
  EXPECT_NOTED("12 10 ");
}
CASE(handlers_that_block_each_other_run_in_order) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = note_signal;
  sigfillset(&action.sa_mask);
  sigaction(SIGUSR1, &action, NULL);
  sigaction(SIGUSR2, &action, NULL);
  block(SIGUSR1, SIGUSR2);
  raise(SIGUSR2), raise(SIGUSR1);
  unblock(SIGUSR1, SIGUSR2);
  EXPECT_NOTED("10 12 ");
}
CASE(a_handler_blocks_its_own_signal_and_its_mask) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = look_at_mask;
  sigaddset(&action.sa_mask, SIGUSR2);
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
  raise(SIGUSR1);
  EXPECT_IS(blocked_USR1, 1);
  EXPECT_IS(blocked_USR2, 1);
  EXPECT_IS(is_blocked(SIGUSR1), 0);
  EXPECT_IS(is_blocked(SIGUSR2), 0);
}
CASE(with_NODEFER_a_handler_does_not_block_its_signal) {
  act(SIGUSR1, look_at_mask, SA_NODEFER);
  raise(SIGUSR1);
  EXPECT_IS(blocked_USR1, 0);
}
static void raise_again(int signal) {
  const int depth = atomic_fetch_add(&handled, 1);
  if (depth == 0) {
    raise(signal);
    last = handled;
  }
}
CASE(its_own_signal_waits_until_the_handler_is_done) {
  act(SIGUSR1, raise_again, 0);
  raise(SIGUSR1);
  EXPECT_IS(last, 1);
  EXPECT_IS(handled, 2);
}
CASE(with_NODEFER_its_own_signal_comes_at_once) {
  act(SIGUSR1, raise_again, SA_NODEFER);
  raise(SIGUSR1);
  EXPECT_IS(last, 2);
}
CASE(masks_are_set_added_to_and_taken_from) {
  sigset_t set = set_of(SIGUSR1, SIGUSR2), old;
  EXPECT_IS(sigprocmask(SIG_SETMASK, &set, &old), 0);
  EXPECT_IS(sigismember(&old, SIGUSR1), 0);
  set = set_of(SIGUSR1, 0);
  EXPECT_IS(sigprocmask(SIG_UNBLOCK, &set, &old), 0);
  EXPECT_IS(sigismember(&old, SIGUSR1), 1);
  EXPECT_IS(is_blocked(SIGUSR1), 0);
  EXPECT_IS(is_blocked(SIGUSR2), 1);
  EXPECT_FAILS(sigprocmask(77, &set, NULL), EINVAL);
  EXPECT_IS(pthread_sigmask(77, &set, NULL), EINVAL);
  EXPECT_IS(sigprocmask(77, NULL, &old), 0);
}
CASE(KILL_and_STOP_cannot_be_blocked) {
  block(SIGKILL, SIGSTOP);
  EXPECT_IS(is_blocked(SIGKILL), 0);
  EXPECT_IS(is_blocked(SIGSTOP), 0);
}
CASE(ignoring_a_signal_drops_what_pends) {
  act(SIGUSR1, handle, 0);
  block(SIGUSR1, 0);
  raise(SIGUSR1);
  kill(getpid(), SIGUSR1);
  signal(SIGUSR1, SIG_IGN);
  EXPECT_IS(is_pending(SIGUSR1), 0);
  signal(SIGUSR1, handle);
  unblock(SIGUSR1, 0);
  EXPECT_IS(handled, 0);
}
CASE(what_is_ignored_and_blocked_pends) {
  block(SIGUSR1, 0);
  signal(SIGUSR1, SIG_IGN);
  raise(SIGUSR1);
  EXPECT_IS(is_pending(SIGUSR1), 1);
}
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

// Threads.

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

// Waiting for signals.

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
  EXPECT_IS(information.si_code, SI_USER);  // so the C library says it here
}
static pthread_t main_id;
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
static void* send_to_main(void* unused) {
  let_others_wait();
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  return unused;
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

// The calls of System V and BSD.

CASE(sighold_and_sigrelse_block) {
  act(SIGUSR1, handle, 0);
  EXPECT_IS(sighold(SIGUSR1), 0);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  raise(SIGUSR1);
  EXPECT_IS(handled, 0);
  EXPECT_IS(sigrelse(SIGUSR1), 0);
  EXPECT_IS(handled, 1);
  EXPECT_FAILS(sighold(65), EINVAL);
}
CASE(sigset_holds_too) {
  EXPECT(sigset(SIGUSR1, handle) == SIG_DFL);
  EXPECT(sigset(SIGUSR1, SIG_HOLD) == handle);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
  EXPECT(sigset(SIGUSR1, SIG_IGN) == SIG_HOLD);
  EXPECT_IS(is_blocked(SIGUSR1), 0);
}
CASE(sigpause_waits_without_a_signal) {
  act(SIGUSR1, handle, 0);
  sighold(SIGUSR1);
  raise(SIGUSR1);
  EXPECT_FAILS(sigpause(SIGUSR1), EINTR);
  EXPECT_IS(handled, 1);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
}
CASE(siginterrupt_says_whether_calls_go_on) {
  signal(SIGUSR1, handle);
  struct sigaction action;
  sigaction(SIGUSR1, NULL, &action);
  EXPECT((action.sa_flags & SA_RESTART) != 0);
  EXPECT_IS(siginterrupt(SIGUSR1, 1), 0);
  sigaction(SIGUSR1, NULL, &action);
  EXPECT((action.sa_flags & SA_RESTART) == 0);
  EXPECT_IS(siginterrupt(SIGUSR1, 0), 0);
  sigaction(SIGUSR1, NULL, &action);
  EXPECT((action.sa_flags & SA_RESTART) != 0);
  EXPECT_FAILS(siginterrupt(65, 1), EINVAL);
}

CASE(masks_of_bsd_are_words) {
  EXPECT_IS(sigblock(1 << (SIGUSR1 - 1)), 0);
  EXPECT_IS(siggetmask(), 1 << (SIGUSR1 - 1));
  EXPECT_IS(sigsetmask(1 << (SIGUSR2 - 1)), 1 << (SIGUSR1 - 1));
  EXPECT_IS(is_blocked(SIGUSR1), 0);
  EXPECT_IS(is_blocked(SIGUSR2), 1);
}

// Jumps, stacks, faults.

static sigjmp_buf back;
static void jump_back(int signal) {
  handle(signal);
  siglongjmp(back, 5);
}
CASE(a_jump_out_of_a_handler_brings_the_mask_back) {
  act(SIGUSR1, jump_back, 0);
  for (volatile int i = 0; i < 3; ++i) {
    const int value = sigsetjmp(back, 1);
    if (value == 0) {
      raise(SIGUSR1);
      EXPECT(0);
    }
    EXPECT_IS(value, 5);
    EXPECT_IS(is_blocked(SIGUSR1), 0);
  }
  EXPECT_IS(handled, 3);
}
CASE(without_a_mask_a_jump_leaves_it) {
  act(SIGUSR1, jump_back, 0);
  if (sigsetjmp(back, 0) == 0) raise(SIGUSR1);
  EXPECT_IS(is_blocked(SIGUSR1), 1);
}
static void jump_plainly(int signal) {
  handle(signal);
  longjmp(back, 0);
}
CASE(longjmp_of_0_gives_1) {
  act(SIGUSR1, jump_plainly, 0);
  volatile int times = 0;
  const int value = setjmp(back);
  if (++times == 1) {
    EXPECT_IS(value, 0);
    raise(SIGUSR1);
  }
  EXPECT_IS(value, 1);
  EXPECT_IS(times, 2);
}
CASE(a_jump_may_leave_a_wait) {
  act(SIGUSR1, jump_back, 0);
  main_id = pthread_self();
  const pthread_t id = start(send_to_main, NULL);
  if (sigsetjmp(back, 1) == 0) {
    sleep(100);
    EXPECT(0);
  }
  join(id);
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pthread_t again = start(send_to_main, NULL);
  char byte;
  if (sigsetjmp(back, 1) == 0) {
    EXPECT_IS(read(ends[0], &byte, 1), 1);
    EXPECT(0);
  }
  join(again);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
}
CASE(longjmp_brings_back_a_mask_that_was_kept) {
  act(SIGUSR1, jump_plainly, 0);
  if (sigsetjmp(back, 1) == 0) raise(SIGUSR1);
  EXPECT_IS(handled, 1);
  EXPECT_IS(is_blocked(SIGUSR1), 0);
}
static char alternate[65536];
static void look_at_stack(int signal) {
  char here;
  on_alternate = &here >= alternate && &here < alternate + sizeof alternate;
  stack_t state;
  sigaltstack(NULL, &state);
  if (on_alternate) EXPECT((state.ss_flags & SS_ONSTACK) != 0);
  handle(signal);
}
CASE(a_handler_runs_on_the_alternate_stack) {
  const stack_t stack = {.ss_sp = alternate, .ss_size = sizeof alternate};
  stack_t old;
  EXPECT_IS(sigaltstack(&stack, &old), 0);
  EXPECT((old.ss_flags & SS_DISABLE) != 0);
  act(SIGUSR1, look_at_stack, SA_ONSTACK);
  raise(SIGUSR1);
  EXPECT_IS(on_alternate, 1);
  act(SIGUSR1, look_at_stack, 0);
  raise(SIGUSR1);
  EXPECT_IS(on_alternate, 0);
  EXPECT_IS(handled, 2);
}
static void* ask_for_alternate(void* unused) {
  stack_t state;
  EXPECT_IS(sigaltstack(NULL, &state), 0);
  EXPECT((state.ss_flags & SS_DISABLE) != 0);
  return unused;
}
CASE(each_thread_has_an_alternate_stack_of_its_own) {
  const stack_t stack = {.ss_sp = alternate, .ss_size = sizeof alternate};
  EXPECT_IS(sigaltstack(&stack, NULL), 0);
  join(start(ask_for_alternate, NULL));
  stack_t state;
  EXPECT_IS(sigaltstack(NULL, &state), 0);
  EXPECT(state.ss_sp == alternate && state.ss_flags == 0);
}
CASE(an_alternate_stack_is_large_enough) {
  stack_t stack = {.ss_sp = alternate, .ss_size = 100};
  EXPECT_FAILS(sigaltstack(&stack, NULL), ENOMEM);
  stack.ss_flags = 77;
  EXPECT_FAILS(sigaltstack(&stack, NULL), EINVAL);
}
static volatile char* volatile nowhere = (volatile char*)8;
static void jump_from_fault(int signal, siginfo_t* information, void* context) {
  (void)context;
  told = *information;
  handle(signal);
  siglongjmp(back, 1);
}
CASE(a_fault_is_handled_and_can_be_left) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = jump_from_fault;
  action.sa_flags = SA_SIGINFO;
  EXPECT_IS(sigaction(SIGSEGV, &action, NULL), 0);
  for (volatile int i = 0; i < 2; ++i)
    if (sigsetjmp(back, 1) == 0) *nowhere = 1;
  EXPECT_IS(handled, 2);
  EXPECT(told.si_addr == (void*)8);
  EXPECT_IS(is_blocked(SIGSEGV), 0);
}
static void* fault_in_thread(void* unused) {
  if (sigsetjmp(back, 1) == 0) *nowhere = 1;
  EXPECT(pthread_equal(handled_by, pthread_self()));
  return unused;
}
CASE(a_fault_is_handled_in_its_thread) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = jump_from_fault;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &action, NULL);
  join(start(fault_in_thread, NULL));
  EXPECT_IS(handled, 1);
}
CASE_ENDING_WITH(-11, a_fault_without_a_handler_ends_the_process) { *nowhere = 1; }
CASE_ENDING_WITH(-11, a_fault_whose_signal_is_ignored_ends_the_process) {
  signal(SIGSEGV, SIG_IGN);
  *nowhere = 1;
}
CASE(a_raised_fault_is_as_any_signal) {
  act(SIGSEGV, handle, 0);
  raise(SIGSEGV);
  EXPECT_IS(handled, 1);
}
CASE_ENDING_WITH(-6, abort_ends_the_process_after_its_handler) {
  act(SIGABRT, handle, 0);
  abort();
}
CASE_ENDING_WITH(3, abort_may_be_left_by_a_jump) {
  act(SIGABRT, jump_back, 0);
  if (sigsetjmp(back, 1) == 0) abort();
  _exit(3);
}
static void leave_with_3(int signal) {
  (void)signal;
  _exit(3);
}
CASE_ENDING_WITH(3, abort_unblocks_its_signal) {
  block(SIGABRT, 0);
  act(SIGABRT, leave_with_3, 0);
  abort();
}
CASE_ENDING_WITH(-6, abort_cannot_be_blocked_or_ignored) {
  block(SIGABRT, 0);
  signal(SIGABRT, SIG_IGN);
  abort();
}

// Names that headers give to what is above.

static void* named(const char* name) {
  void* const found = dlsym(RTLD_DEFAULT, name);
  EXPECT(found != NULL);
  return found;
}
CASE(sigaction_has_another_name) {
  int (*const other)(int, const struct sigaction*, struct sigaction*) = named("__sigaction");
  struct sigaction action;
  act(SIGUSR1, handle, 0);
  EXPECT_IS(other(SIGUSR1, NULL, &action), 0);
  EXPECT(action.sa_handler == handle);
}
CASE(sysv_signal_has_another_name) {
  void (*(*const other)(int, void (*)(int)))(int) = named("__sysv_signal");
  EXPECT(other(SIGCHLD, handle) == SIG_DFL);
  raise(SIGCHLD);
  raise(SIGCHLD);
  EXPECT_IS(handled, 1);
}
CASE(sigpause_of_bsd_takes_a_mask) {
  static const char name[] = "\0sigpause";  // not the end of the other one
  int (*const plain)(int) = named(name + 1);
  int (*const other)(int, int) = named("__sigpause");
  act(SIGUSR1, handle, 0);
  sighold(SIGUSR1);
  raise(SIGUSR1);
  EXPECT_FAILS(plain(1 << (SIGUSR2 - 1)), EINTR);
  raise(SIGUSR1);
  EXPECT_FAILS(other(SIGUSR1, 1), EINTR);
  EXPECT_IS(handled, 2);
}
static void (*other_jump)(struct __jmp_buf_tag*, int);
static void jump_by_another(int signal) {
  handle(signal);
  other_jump(back, 4);
}
CASE(jumps_have_other_names) {
  static const char* const names[] = {"_longjmp", "__longjmp_chk"};
  act(SIGUSR1, jump_by_another, 0);
  for (volatile int i = 0; i < 2; ++i) {
    other_jump = named(names[i]);
    const int value = sigsetjmp(back, 1);
    if (value == 0) raise(SIGUSR1);
    EXPECT_IS(value, 4);
    EXPECT_IS(is_blocked(SIGUSR1), 0);
  }
  EXPECT_IS(handled, 2);
}

static volatile int counted;
static void count(int signal) {
  (void)signal;
  ++counted;
}
CASE(a_signal_to_the_group_is_handled_before_it_returns) {
  setpgid(0, 0);
  signal(SIGUSR1, count);
  EXPECT_IS(killpg(0, SIGUSR1), 0);
  EXPECT_IS(counted, 1);
  EXPECT_IS(kill(0, SIGUSR1), 0);
  EXPECT_IS(counted, 2);
  EXPECT_IS(kill(-getpgrp(), SIGUSR1), 0);
  EXPECT_IS(counted, 3);
  EXPECT_FAILS(killpg(-1, 0), EINVAL);
}
