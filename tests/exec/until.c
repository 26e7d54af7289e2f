// SPDX-License-Identifier: BSD-3-Clause
//
// Does something until a signal's handler or another thread has set a flag, and prints how often. The first argument
// names what it does, the second what sets the flag.
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t is_set;
static void set(int unused) {
  (void)unused;
  is_set = 1;
}
static void* set_later(void* unused) {
  sleep(1);
  is_set = 1;
  return unused;
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static sem_t semaphore;

static long lock_until_set(void) {
  long count = 0;
  for (; !is_set; ++count) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
  }
  return count;
}

static long post_until_set(void) {
  long count = 0;
  for (; !is_set; ++count) {
    sem_post(&semaphore);
    sem_wait(&semaphore);
  }
  return count;
}

static long spin_until_set(void) {
  long count = 0;
  while (!is_set) ++count;
  return count > 0;
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  const char* const by = argc > 2 ? argv[2] : "";
  pthread_t other;
  if (strcmp(by, "handler") == 0) {
    signal(SIGALRM, set);
    alarm(1);
  } else if (strcmp(by, "thread") == 0) {
    pthread_create(&other, NULL, set_later, NULL);
  }
  sem_init(&semaphore, 0, 0);
  long count = 0;
  if (strcmp(what, "lock") == 0) count = lock_until_set();
  if (strcmp(what, "post") == 0) count = post_until_set();
  if (strcmp(what, "ready spin") == 0) puts("ready"), fflush(stdout), count = spin_until_set();
  if (strcmp(what, "spin") == 0) count = spin_until_set();
  printf("%ld\n", count);
  return 0;
}
