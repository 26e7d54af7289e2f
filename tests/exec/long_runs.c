// SPDX-License-Identifier: BSD-3-Clause
// Runs that take long or do not end: long_runs flag|endless|second|failing.
#include <pthread.h>
#include <string.h>

enum { THREADS = 6 };

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static volatile int flag;
static int order[THREADS], ended;

static void compute(long steps) {
  for (volatile long i = 0; i != steps; ++i) {
  }
}

static void* set(void* unused) {
  flag = 1;
  return unused;
}

static void* note(void* number) {
  pthread_mutex_lock(&lock);
  order[ended++] = *(int*)number;
  pthread_mutex_unlock(&lock);
  return 0;
}

/* The threads end in the order of their making: so they do in the default order, and hardly in another one. */
static int is_default_order(void) {
  pthread_t threads[THREADS];
  int numbers[THREADS];
  for (int i = 0; i < THREADS; ++i) {
    numbers[i] = i;
    pthread_create(&threads[i], 0, note, &numbers[i]);
  }
  for (int i = 0; i < THREADS; ++i) pthread_join(threads[i], 0);
  for (int i = 0; i < THREADS; ++i)
    if (order[i] != i) return 0;
  return 1;
}

int main(int count, char** words) {
  const char* const way = count > 1 ? words[1] : "";
  if (strcmp(way, "flag") == 0) {
    pthread_t thread;
    pthread_create(&thread, 0, set, 0);
    while (!flag) {
    }
    return pthread_join(thread, 0);
  }
  if (strcmp(way, "endless") == 0) compute(-1);
  const int is_default = is_default_order();
  if (strcmp(way, "second") == 0 && !is_default) compute(-1);
  if (strcmp(way, "failing") == 0) compute(100000000);
  return is_default ? 0 : 9;
}
