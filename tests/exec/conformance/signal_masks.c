// SPDX-License-Identifier: BSD-3-Clause
// Signal masks, and pending signals.
#include "tests/exec/conformance/signals.h"

static void note_signal(int signal) {
  char text[16];
  snprintf(text, sizeof text, "%d ", signal >= SIGRTMIN ? signal - SIGRTMIN + 100 : signal);
  note(text);
}
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
