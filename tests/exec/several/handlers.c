// SPDX-License-Identifier: BSD-3-Clause
// handlers NAME MS: sends signals to itself for MS ms, has timers of each kind, and prints NAME and what came: signals, one
// that is held back, signals and threads of timers. handlers NAME user|pipe: ends by the default action of a signal.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t users, alarms, timers, threads;

static void count(int signal) {
  if (signal == SIGUSR1) ++users;
  if (signal == SIGALRM) ++alarms;
}

static void count_timer(int signal) {
  (void)signal;
  ++timers;
}

static void count_thread(union sigval value) {
  (void)value;
  ++threads;
}

static void end_by_default(const char* way) {
  int ends[2];
  if (strcmp(way, "user") == 0) kill(getpid(), SIGUSR1);
  if (strcmp(way, "pipe") == 0 && pipe(ends) == 0 && close(ends[0]) == 0) _exit(write(ends[1], "", 1) == 1);
}

static void start(int notify, int signal) {
  struct sigevent event = {.sigev_notify = notify, .sigev_signo = signal};
  if (notify == SIGEV_THREAD) event.sigev_notify_function = count_thread;
  const struct itimerspec each_10_ms = {{0, 10000000}, {0, 10000000}};
  timer_t timer;
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0 || timer_settime(timer, 0, &each_10_ms, NULL) != 0) abort();
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  end_by_default(argv[2]);
  const int ms = atoi(argv[2]);
  signal(SIGUSR1, count);
  signal(SIGALRM, count);
  signal(SIGRTMIN, count_timer);
  sigset_t held, pending;
  sigemptyset(&held);
  sigaddset(&held, SIGUSR2);
  sigprocmask(SIG_BLOCK, &held, NULL);
  kill(getpid(), SIGUSR2);
  const struct itimerval each_20_ms = {{0, 20000}, {0, 20000}};
  setitimer(ITIMER_REAL, &each_20_ms, NULL);
  start(SIGEV_SIGNAL, SIGRTMIN);
  start(SIGEV_THREAD, 0);
  for (int i = 0; i < ms / 10; ++i) {
    for (struct timespec left = {0, 10000000}; nanosleep(&left, &left) != 0;) {
    }
    i % 2 == 0 ? kill(getpid(), SIGUSR1) : raise(SIGUSR1);
  }
  for (struct timespec left = {0, 1000000}; nanosleep(&left, &left) != 0;) {
  }
  sigpending(&pending);
  printf("%s: %d, %d held, %d %d %d\n", argv[1], (int)users, sigismember(&pending, SIGUSR2), (int)alarms, (int)timers,
         (int)threads);
  return 0;
}
