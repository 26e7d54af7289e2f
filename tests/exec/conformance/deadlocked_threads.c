// SPDX-License-Identifier: BSD-3-Clause
// Threads and processes that wait for themselves for ever, as they are meant to: the program ends without them.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <signal.h>
#include <stdint.h>
#include <sys/timerfd.h>
#include <sys/wait.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static sem_t semaphore;
static void* lock_twice(void* unused) {
  pthread_mutex_lock(&mutex);
  pthread_mutex_lock(&mutex);
  return unused;
}
static pid_t fork_one(void (*body)(void)) {
  const pid_t child = fork();
  EXPECT(child >= 0);
  if (child > 0) return child;
  body();
  _exit(3);
}
static void lock_both(void) { lock_twice(NULL); }
static int end_of(pid_t child) {
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  return status;
}
static void handle(int signal) {
  (void)signal;
  sem_post(&semaphore);
}
static void act(int signal) {
  struct sigaction action = {.sa_handler = handle};
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}

CASE(main_returns) {
  start(lock_twice, NULL);
  sleep_ms(2);
}
CASE(main_exits_while_a_detached_one_is_blocked) {
  EXPECT_IS(pthread_detach(start(lock_twice, NULL)), 0);
  sleep_ms(2);
  exit(0);
}
CASE(main_waits_for_an_alarm) {
  act(SIGALRM);
  alarm(1);
  start(lock_twice, NULL);
  while (sem_wait(&semaphore) != 0) EXPECT_IS(errno, EINTR);
}
CASE(main_waits_for_a_timer_descriptor) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec soon = {{0, 0}, {0, 20000000}};
  EXPECT_IS(timerfd_settime(timer, 0, &soon, NULL), 0);
  start(lock_twice, NULL);
  uint64_t count = 0;
  EXPECT_IS(read(timer, &count, sizeof count), (long long)sizeof count);
}
static void sleep_a_little(void) { sleep_ms(20); }
CASE(main_waits_for_a_child) {
  const pid_t child = fork_one(sleep_a_little);
  start(lock_twice, NULL);
  EXPECT_IS(WEXITSTATUS(end_of(child)), 3);
}
CASE(main_waits_for_a_command) {
  start(lock_twice, NULL);
  EXPECT_IS(system("sleep 0.02; exit 4"), 4 << 8);
}
static int ends[2];
static void write_soon(void) {
  sleep_ms(20);
  EXPECT_IS(write(ends[1], "x", 1), 1);
}
CASE(main_reads_what_a_child_writes) {
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork_one(write_soon);
  start(lock_twice, NULL);
  char byte;
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  end_of(child);
}
static void send_soon(void) {
  sleep_ms(20);
  EXPECT_IS(kill(getppid(), SIGUSR1), 0);
}
CASE(main_waits_for_a_signal_of_a_child) {
  act(SIGUSR1);
  const pid_t child = fork_one(send_soon);
  start(lock_twice, NULL);
  while (sem_wait(&semaphore) != 0) EXPECT_IS(errno, EINTR);
  end_of(child);
}
static void expect_killed_by(int signal) {
  const pid_t child = fork_one(lock_both);
  sleep_ms(20);
  EXPECT_IS(kill(child, signal), 0);
  const int status = end_of(child);
  EXPECT(WIFSIGNALED(status));
  EXPECT_IS(WTERMSIG(status), signal);
}
CASE(a_child_is_killed) { expect_killed_by(SIGKILL); }
CASE(a_child_is_terminated) { expect_killed_by(SIGTERM); }
static void end_in_handler(int signal) {
  (void)signal;
  _exit(7);
}
static void lock_twice_with_a_handler(void) {
  struct sigaction action = {.sa_handler = end_in_handler};
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
  lock_twice(NULL);
}
CASE(a_child_ends_in_a_handler) {
  const pid_t child = fork_one(lock_twice_with_a_handler);
  sleep_ms(20);
  EXPECT_IS(kill(child, SIGUSR1), 0);
  EXPECT_IS(WEXITSTATUS(end_of(child)), 7);
}
