// SPDX-License-Identifier: BSD-3-Clause
// Signals: sending, handling, ignoring, and default actions.
#include "tests/exec/conformance/signals.h"

#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

// No longer declared in any header.
extern void (*bsd_signal(int signal, void (*handler)(int)))(int);

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
