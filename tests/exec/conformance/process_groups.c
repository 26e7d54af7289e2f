// SPDX-License-Identifier: BSD-3-Clause
// Numbers of processes, groups and sessions.
#include "tests/exec/conformance/processes.h"

#include <sys/wait.h>
#include <termios.h>

extern pid_t __getpgid(pid_t);

CASE(a_child_is_in_its_parents_group_and_session) {
  const pid_t group = getpgrp(), session = getsid(0), parent = getpid();
  const pid_t child = fork();
  if (child == 0)
    _exit(getppid() == parent && getpgid(0) == group && getpgrp() == group && getsid(0) == session ? 21 : 22);
  EXPECT_IS(getpgid(child), group);
  EXPECT_IS(__getpgid(child), group);
  EXPECT_IS(getsid(child), session);
  EXPECT_EXIT(child, 21);
}

CASE(a_child_can_lead_a_group) {
  const pid_t child = fork();
  if (child == 0) {
    if (setpgid(0, 0) != 0) _exit(1);
    _exit(getpgrp() == getpid() ? 21 : 22);
  }
  EXPECT_EXIT(child, 21);
}

CASE(a_group_is_waited_for) {
  const pid_t first = fork();
  if (first == 0) {
    sleep_ms(20);
    _exit(23);
  }
  EXPECT_IS(setpgid(first, first), 0);
  const pid_t second = fork();
  if (second == 0) _exit(24);
  int status = 0;
  EXPECT_IS(waitpid(-first, &status, 0), first);
  EXPECT_IS(WEXITSTATUS(status), 23);
  EXPECT_EXIT(second, 24);
}

CASE(a_group_is_signalled) {
  const pid_t child = fork();
  if (child == 0) {
    setpgrp();
    for (;;) pause();
  }
  while (kill(-child, 0) != 0) let_others_wait();
  EXPECT_IS(kill(-child, SIGTERM), 0);
  int status = 0;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  EXPECT_FAILS(kill(-child, SIGTERM), ESRCH);
}

CASE(a_session_has_one_leader) {
  const pid_t child = fork();
  if (child == 0) {
    const pid_t session = setsid();
    if (session != getpid() || getsid(0) != session || getpgrp() != session) _exit(1);
    errno = 0;
    if (setsid() != -1 || errno != EPERM) _exit(2);
    errno = 0;
    _exit(setpgid(0, 0) == -1 && errno == EPERM ? 25 : 3);
  }
  EXPECT_EXIT(child, 25);
}

CASE(what_is_no_process_has_no_group) {
  EXPECT_FAILS(getpgid(0x3FFFFFF), ESRCH);
  EXPECT_FAILS(getsid(0x3FFFFFF), ESRCH);
  EXPECT_FAILS(setpgid(0x3FFFFFF, 0), ESRCH);
  EXPECT_FAILS(setpgid(0, -1), EINVAL);
}

CASE(what_is_no_terminal_has_no_group) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  EXPECT_FAILS(tcgetpgrp(ends[0]), ENOTTY);
  EXPECT_FAILS(tcsetpgrp(ends[0], getpgrp()), ENOTTY);
}
