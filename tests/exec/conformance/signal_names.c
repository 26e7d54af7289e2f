// SPDX-License-Identifier: BSD-3-Clause
// Signal calls of System V and BSD, and names that headers redefine.
#include "tests/exec/conformance/signals.h"

#include <dlfcn.h>
#include <setjmp.h>

#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

// No longer declared in any header.
extern void (*bsd_signal(int signal, void (*handler)(int)))(int);

static sigjmp_buf back;

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
  static const char name[] = "\0sigpause";  // not the tail of the other name
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
