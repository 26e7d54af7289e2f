// SPDX-License-Identifier: BSD-3-Clause
// Signals that another process sends: thousands at once, and to a thread that computes.
#include "tests/exec/conformance/signals.h"

#include <sys/wait.h>

enum { signals = 2000 };

/// Numbers them.
static pid_t begin_sender(int signal) {
  const pid_t here = getpid(), child = fork();
  EXPECT(child >= 0);
  if (child != 0) return child;
  for (int i = 0; i < signals;) {
    const union sigval value = {.sival_int = i};
    if (sigqueue(here, signal, value) == 0)
      ++i;
    else
      usleep(1000);  // as many as there may be of all processes
  }
  _exit(0);
}

static void end(pid_t child) {
  int status = -1;
  while (waitpid(child, &status, 0) < 0) EXPECT_IS(errno, EINTR);
  EXPECT_IS(status, 0);
}

CASE(all_that_are_blocked_are_taken_in_their_order) {
  block(SIGRTMIN, 0);
  const sigset_t set = set_of(SIGRTMIN, 0);
  const pid_t child = begin_sender(SIGRTMIN);
  for (int i = 0; i < signals; ++i) {
    siginfo_t information;
    EXPECT_IS(sigwaitinfo(&set, &information), SIGRTMIN);
    EXPECT_IS(information.si_int, i);
  }
  end(child);
}

CASE(all_are_handled_where_a_thread_makes_no_call_that_waits) {
  act(SIGRTMIN, handle, 0);
  const pid_t child = begin_sender(SIGRTMIN);
  while (handled < signals) getppid();
  end(child);
  EXPECT_IS(handled, signals);
}

static void* (*volatile fill)(void*, int, size_t) = memset;

CASE(one_is_handled_where_a_thread_computes_in_the_c_library) {
  enum { size = 16 << 20 };
  char* const bytes = malloc(size);
  EXPECT(bytes != NULL);
  act(SIGUSR1, handle, 0);
  const pid_t here = getpid(), child = fork();
  EXPECT(child >= 0);
  if (child == 0) {
    sleep_ms(20);
    _exit(kill(here, SIGUSR1));
  }
  while (handled == 0) fill(bytes, 1, size);
  end(child);
  free(bytes);
}
