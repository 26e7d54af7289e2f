// SPDX-License-Identifier: BSD-3-Clause
//
// Goes on without end, or for a long time, in the way named by the first argument.
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;
static int is_set, rounds;

// Each looks whether the other has set the flag.
static void* poll_flag(void* unused) {
  for (int found = 0; !found; usleep(10000)) {
    pthread_mutex_lock(&lock);
    found = is_set;
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void* wait_with_timeouts(void* unused) {
  pthread_mutex_lock(&lock);
  while (!is_set) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += 1;
    pthread_cond_timedwait(&changed, &lock, &until);
  }
  pthread_mutex_unlock(&lock);
  return unused;
}

static void ignore(int unused) { (void)unused; }

// 100 Hz; blocked, it wakes nobody.
static void start_timer(int blocked) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGALRM);
  if (blocked) sigprocmask(SIG_BLOCK, &set, NULL);
  signal(SIGALRM, ignore);
  const struct itimerval tick = {{0, 10000}, {0, 10000}};
  setitimer(ITIMER_REAL, &tick, NULL);
}

static void count_ticks(int rounds_max) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec tick = {{0, 10000000}, {0, 10000000}};
  timerfd_settime(timer, 0, &tick, NULL);
  unsigned long expirations;
  for (int i = 0; i != rounds_max; ++i)
    if (read(timer, &expirations, sizeof expirations) < 0) return;
}

static void* wake_other(void* unused) {
  for (;; usleep(1000000)) {
    pthread_mutex_lock(&lock);
    ++rounds;
    pthread_cond_signal(&changed);
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

int main(int argc, char** argv) {
  const char* const way = argc > 1 ? argv[1] : "";
  pthread_t other;
  if (strcmp(way, "poll") == 0) {
    pthread_create(&other, NULL, poll_flag, NULL);
    poll_flag(NULL);
  } else if (strcmp(way, "timeouts") == 0) {
    wait_with_timeouts(NULL);
  } else if (strcmp(way, "ticks") == 0) {
    count_ticks(-1);
  } else if (strcmp(way, "unheard") == 0) {  // another thread never ends, and nobody hears the timer
    start_timer(1);
    pthread_mutex_lock(&lock);
    pthread_create(&other, NULL, poll_flag, NULL);
    pthread_join(other, NULL);
  } else if (strcmp(way, "processes") == 0) {
    if (fork() == 0) poll_flag(NULL);
    wait(NULL);
  } else if (strcmp(way, "working") == 0) {  // for three hours
    pthread_create(&other, NULL, wake_other, NULL);
    pthread_mutex_lock(&lock);
    while (rounds < 3 * 3600) pthread_cond_wait(&changed, &lock);
  } else if (strcmp(way, "printing") == 0) {
    for (int i = 0; i < 3 * 3600; ++i) {
      if (i % 600 == 0) printf("%d\n", i), fflush(stdout);
      sleep(1);
    }
  } else if (strcmp(way, "sleeping") == 0) {
    for (int i = 0; i < 30; ++i) sleep(3600);
  } else if (strcmp(way, "reading") == 0) {  // until a line comes
    puts("ready");
    fflush(stdout);
    char line[10];
    return (int)read(0, line, sizeof line);
  } else if (strcmp(way, "timed") == 0) {  // for half an hour
    count_ticks(180000);
  }
  return 0;
}
