// SPDX-License-Identifier: BSD-3-Clause
// Jumps out of handlers, alternate stacks, faults, and abort().
#include "tests/exec/conformance/signals.h"

#include <setjmp.h>

static sigjmp_buf back;
static volatile char on_alternate;

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
// From that release of glibc on, a handler is not called for a blocked one.
CASE_ENDING_WITH(__GLIBC_PREREQ(2, 41) ? -6 : 3, abort_unblocks_its_signal_before_glibc_2_41) {
  block(SIGABRT, 0);
  act(SIGABRT, leave_with_3, 0);
  abort();
}
CASE_ENDING_WITH(-6, abort_cannot_be_blocked_or_ignored) {
  block(SIGABRT, 0);
  signal(SIGABRT, SIG_IGN);
  abort();
}
