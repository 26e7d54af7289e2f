// SPDX-License-Identifier: BSD-3-Clause
// Processes and threads created by clone(), and ended by system call number.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <linux/sched.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <sys/pidfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>

static char stack[65536] __attribute__((aligned(16)));
static char* const top = stack + sizeof stack;
static int value;

static int exit_status_of(pid_t child) {
  int status = 0;
  EXPECT_IS(waitpid(child, &status, __WALL), child);
  EXPECT(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static int set_value(void* to) {
  value = (int)(intptr_t)to;
  return 7;
}
static void* give_back(void* argument) { return argument; }

CASE(a_clone_has_memory_of_its_own) {
  EXPECT_IS(exit_status_of(clone(set_value, top, SIGCHLD, (void*)5)), 7);
  EXPECT_IS(value, 0);
}
CASE(a_clone_may_share_memory) {
  EXPECT_IS(exit_status_of(clone(set_value, top, CLONE_VM | SIGCHLD, (void*)5)), 7);
  EXPECT_IS(value, 5);
}
CASE(a_clone_may_keep_its_maker_until_its_end) {
  const pid_t child = clone(set_value, top, CLONE_VM | CLONE_VFORK | SIGCHLD, (void*)5);
  EXPECT_IS(value, 5);
  EXPECT_IS(exit_status_of(child), 7);
}

static int become_a_shell(void* unused) {
  (void)unused;
  execl("/bin/sh", "sh", "-c", "exit 3", NULL);
  return 1;
}
CASE(a_clone_may_become_another_program) {
  EXPECT_IS(exit_status_of(clone(become_a_shell, top, CLONE_VM | CLONE_VFORK | SIGCHLD, NULL)), 3);
}

static int close_it(void* descriptor) { return close((int)(intptr_t)descriptor); }
CASE(a_clone_may_share_descriptors) {
  const int descriptor = open("/dev/null", O_RDONLY);
  EXPECT_IS(exit_status_of(clone(close_it, top, CLONE_FILES | SIGCHLD, (void*)(intptr_t)descriptor)), 0);
  EXPECT_FAILS(fcntl(descriptor, F_GETFD), EBADF);
}

static int make_threads(void* unused) {
  (void)unused;
  return join(start(give_back, (void*)3)) == (void*)3 ? 21 : 22;
}
CASE(a_clone_makes_threads) { EXPECT_IS(exit_status_of(clone(make_threads, top, SIGCHLD, NULL)), 21); }

CASE(a_clone_needs_a_function_and_a_stack_and_what_goes_together) {
  EXPECT_FAILS(clone(NULL, top, SIGCHLD, NULL), EINVAL);
  EXPECT_FAILS(clone(set_value, NULL, SIGCHLD, NULL), EINVAL);
  EXPECT_FAILS(clone(set_value, top, CLONE_SIGHAND | SIGCHLD, NULL), EINVAL);
  EXPECT_FAILS(clone(set_value, top, CLONE_VM | CLONE_THREAD | SIGCHLD, NULL), EINVAL);
}

CASE(a_fork_by_number_tells_its_id_to_both) {
  int told_parent = 0, told_child = 0;
  const long flags = SIGCHLD | CLONE_PARENT_SETTID | CLONE_CHILD_SETTID | CLONE_CHILD_CLEARTID;
  const pid_t child = (pid_t)syscall(SYS_clone, flags, 0, &told_parent, &told_child, 0);
  if (child == 0) _exit(told_child == getpid() ? 1 : 2);
  EXPECT_IS(told_parent, child);
  EXPECT_IS(exit_status_of(child), 1);
}
CASE(clone3_forks) {
  int descriptor = -1;
  struct clone_args arguments = {.flags = CLONE_PIDFD, .pidfd = (uintptr_t)&descriptor, .exit_signal = SIGCHLD};
  const pid_t child = (pid_t)syscall(SYS_clone3, &arguments, sizeof arguments);
  if (child == 0) _exit(join(start(give_back, (void*)3)) == (void*)3 ? 12 : 13);
  siginfo_t information = {0};
  EXPECT_IS(waitid(P_PIDFD, (id_t)descriptor, &information, WEXITED), 0);
  EXPECT_IS(information.si_pid, child);
  EXPECT_IS(information.si_status, 12);
  EXPECT_FAILS(syscall(SYS_clone3, (void*)8, sizeof arguments), EFAULT);
}

static volatile int word, seen;
static void wait_until_cleared(void) {
  int now;
  while ((now = word) != 0) syscall(SYS_futex, &word, FUTEX_WAIT, now, NULL, NULL, 0);
}
static const int as_threads =
    CLONE_VM | CLONE_FS | CLONE_FILES | CLONE_SIGHAND | CLONE_THREAD | CLONE_SYSVSEM | CLONE_CHILD_CLEARTID;

static int see_and_return(void* what) {
  seen = (int)(intptr_t)what;
  return 0;
}
static int see_and_exit(void* what) {
  seen = (int)(intptr_t)what;
  syscall(SYS_exit, 0);
  seen = -1;
  return 0;
}
CASE(a_clone_may_be_a_thread_whose_end_clears_a_word) {
  word = 1;
  EXPECT(clone(see_and_return, top, as_threads, (void*)9, NULL, NULL, &word) > 0);
  wait_until_cleared();
  EXPECT_IS(seen, 9);
}
CASE(a_clone_that_is_a_thread_ends_by_number) {
  int told = 0;
  word = 1;
  const int id = clone(see_and_exit, top, as_threads | CLONE_PARENT_SETTID, (void*)9, &told, NULL, &word);
  EXPECT_IS(told, id);
  wait_until_cleared();
  EXPECT_IS(seen, 9);
}

static void* end_by_number(void* done) {
  *(int*)done = 1;
  syscall(SYS_exit, 0);
  *(int*)done = 2;
  return NULL;
}
CASE(a_thread_that_ends_by_number_is_joined) {
  int done = 0;
  EXPECT_IS(pthread_join(start(end_by_number, &done), NULL), 0);
  EXPECT_IS(done, 1);
}
static void* end_the_process_later(void* unused) {
  sleep_ms(20);
  _exit(6);
  return unused;
}
CASE_ENDING_WITH(6, main_that_ends_by_number_lets_the_others_go_on) {
  start(end_the_process_later, NULL);
  syscall(SYS_exit, 3);
}
CASE_ENDING_WITH(3, the_last_thread_that_ends_by_number_ends_the_process) { syscall(SYS_exit, 3); }
CASE(the_id_that_an_address_is_set_for_is_told) { EXPECT_IS(syscall(SYS_set_tid_address, &word), gettid()); }

static void* fork_here(void* unused) {
  const pid_t child = fork();
  if (child == 0) _exit(gettid() == getpid() ? 5 : 6);
  return (char*)unused + exit_status_of(child);
}
CASE(the_thread_that_forks_is_the_first_of_the_child) { EXPECT_IS((intptr_t)join(start(fork_here, NULL)), 5); }
