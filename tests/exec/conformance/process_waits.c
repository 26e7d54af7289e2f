// SPDX-License-Identifier: BSD-3-Clause
// Waits for processes, and their SIGCHLD.
#include "tests/exec/conformance/processes.h"

#include <stdatomic.h>
#include <sys/resource.h>

CASE(wait_takes_any_child) {
  const pid_t child = fork();
  if (child == 0) _exit(9);
  int status = 0;
  EXPECT_IS(wait(&status), child);
  EXPECT_IS(WEXITSTATUS(status), 9);
  EXPECT_FAILS(wait(&status), ECHILD);
}
CASE(wait3_and_wait4_tell_what_was_used) {
  struct rusage usage;
  int status = 0;
  pid_t child = fork();
  if (child == 0) _exit(1);
  memset(&usage, 0x55, sizeof usage);
  EXPECT_IS(wait3(&status, 0, &usage), child);
  EXPECT(usage.ru_maxrss != 0x5555555555555555);
  child = fork();
  if (child == 0) _exit(2);
  EXPECT_IS(wait4(child, &status, 0, &usage), child);
  EXPECT_IS(WEXITSTATUS(status), 2);
}
CASE(each_child_is_waited_for_once) {
  pid_t children[4];
  for (int i = 0; i < 4; ++i) {
    children[i] = fork();
    if (children[i] == 0) _exit(10 + i);
  }
  for (int i = 3; i >= 0; --i) EXPECT_EXIT(children[i], 10 + i);
  EXPECT_FAILS(waitpid(children[0], NULL, 0), ECHILD);
  EXPECT_FAILS(waitpid(-1, NULL, WNOHANG), ECHILD);
}
CASE(WNOHANG_does_not_wait) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  char byte;
  if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
  EXPECT_IS(waitpid(child, NULL, WNOHANG), 0);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  int status = -1;
  while (waitpid(child, &status, WNOHANG) == 0) sleep_ms(1);
  EXPECT_IS(status, 0);
}
CASE(who_is_ended_by_a_signal_says_so) {
  pid_t child = fork();
  if (child == 0) {
    raise(SIGTERM);
    _exit(1);
  }
  int status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  child = fork();
  if (child == 0) abort();
  status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}
CASE(a_parent_can_end_its_child) {
  const pid_t child = fork();
  if (child == 0)
    for (;;) pause();
  EXPECT_IS(kill(child, SIGKILL), 0);
  const int status = status_of(child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}
CASE(a_stopped_child_is_told_of) {
  const pid_t child = fork();
  if (child == 0) {
    raise(SIGSTOP);
    usleep(100000);
    _exit(8);
  }
  int status = 0;
  EXPECT_IS(waitpid(child, &status, WUNTRACED), child);
  EXPECT(WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP);
  EXPECT_IS(kill(child, SIGCONT), 0);
  EXPECT_IS(waitpid(child, &status, WCONTINUED), child);
  EXPECT(WIFCONTINUED(status));
  EXPECT_EXIT(child, 8);
}
CASE(waitid_tells_in_a_record) {
  const pid_t child = fork();
  if (child == 0) _exit(21);
  siginfo_t information;
  memset(&information, 0, sizeof information);
  EXPECT_IS(waitid(P_PID, (id_t)child, &information, WEXITED | WNOWAIT), 0);
  EXPECT_IS(information.si_signo, SIGCHLD);
  EXPECT_IS(information.si_code, CLD_EXITED);
  EXPECT_IS(information.si_status, 21);
  EXPECT_IS(information.si_pid, child);
  EXPECT_IS(waitid(P_ALL, 0, &information, WEXITED), 0);
  EXPECT_IS(information.si_pid, child);
  EXPECT_FAILS(waitid(P_ALL, 0, &information, WEXITED), ECHILD);
  EXPECT_FAILS(waitid(P_ALL, 0, &information, 0), EINVAL);
}

static atomic_int children_ended;

static void count_child(int signal) {
  (void)signal;
  atomic_fetch_add(&children_ended, 1);
}
CASE(the_end_of_a_child_is_a_signal) {
  signal(SIGCHLD, count_child);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  while (children_ended == 0) sleep_ms(1);
  EXPECT_EXIT(child, 0);
}
CASE(the_signal_of_a_child_is_handled_before_it_is_waited_for) {
  signal(SIGCHLD, count_child);
  for (int i = 1; i <= 10; ++i) {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    EXPECT_EXIT(child, 0);
    EXPECT_IS(children_ended, i);
  }
}
CASE(pause_ends_with_a_child) {
  sigset_t set, before;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  signal(SIGCHLD, count_child);
  sigprocmask(SIG_BLOCK, &set, &before);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  while (children_ended == 0) sigsuspend(&before);
  EXPECT_EXIT(child, 0);
}
CASE(children_that_nobody_asks_for_leave_nothing) {
  signal(SIGCHLD, SIG_IGN);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  EXPECT_FAILS(waitpid(child, NULL, 0), ECHILD);
}
CASE(processes_wait_for_each_other_by_sleeping) {
  volatile int* const word = shared();
  const pid_t child = fork();
  if (child == 0) {
    usleep(20000);
    *word = 1;
    _exit(0);
  }
  usleep(400000);
  EXPECT_IS(*word, 1);
  EXPECT_EXIT(child, 0);
}
CASE(a_child_is_sent_a_signal_that_it_handles) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGUSR1, count_child);
    const unsigned left = sleep(10);
    _exit(children_ended == 1 && left >= 8 ? 0 : 1);
  }
  usleep(200000);
  EXPECT_IS(kill(child, SIGUSR1), 0);
  EXPECT_EXIT(child, 0);
}
CASE(a_parent_is_sent_a_signal_that_it_handles) {
  signal(SIGUSR1, count_child);
  const pid_t child = fork();
  if (child == 0) {
    usleep(50000);
    _exit(kill(getppid(), SIGUSR1));
  }
  while (children_ended == 0) pause();
  EXPECT_EXIT(child, 0);
}
CASE(a_thread_waits_for_a_child_while_others_go_on) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  char byte;
  if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
  int* const end = &ends[1];
  pthread_t id;
  extern void* write_later(void*);
  EXPECT_IS(pthread_create(&id, NULL, write_later, end), 0);
  EXPECT_EXIT(child, 0);
  join(id);
}

static pid_t wait_so(int way, pid_t child) {
  siginfo_t information;
  switch (way) {
    case 0: return wait(NULL);
    case 1: return wait3(NULL, 0, NULL);
    case 2: return wait4(child, NULL, 0, NULL);
    case 3: return waitpid(-1, NULL, 0);
    default: return waitid(P_PID, (id_t)child, &information, WEXITED) == 0 ? information.si_pid : -1;
  }
}
CASE(every_way_to_wait_lets_others_go_on) {
  extern void* write_later(void*);
  for (int way = 0; way < 5; ++way) {
    int ends[2];
    EXPECT_IS(pipe(ends), 0);
    const pid_t child = fork();
    char byte;
    if (child == 0) _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1);
    const pthread_t id = start(write_later, &ends[1]);
    EXPECT_IS(wait_so(way, child), child);
    join(id);
  }
}

void* write_later(void* end);

void* write_later(void* end) {
  sleep_ms(5);
  EXPECT_IS(write(*(int*)end, "x", 1), 1);
  return NULL;
}
