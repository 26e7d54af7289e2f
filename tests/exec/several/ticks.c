// SPDX-License-Identifier: BSD-3-Clause
// A handler counts the ticks of a timer at 100 Hz for a second.
#include <signal.h>
#include <stdio.h>
#include <sys/time.h>
#include <unistd.h>

static volatile sig_atomic_t ticks;

static void count(int signal) {
  (void)signal;
  ++ticks;
}

int main(void) {
  const struct itimerval period = {{0, 10000}, {0, 10000}};
  signal(SIGALRM, count);
  setitimer(ITIMER_REAL, &period, NULL);
  while (ticks < 100) pause();
  printf("%d ticks\n", (int)ticks);
  return 0;
}
