// SPDX-License-Identifier: BSD-3-Clause
//
// Ends from a second thread in the way named by the first argument.
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pthread_mutex_t left = PTHREAD_MUTEX_INITIALIZER, right = PTHREAD_MUTEX_INITIALIZER;
static const char* way;

static void* end(void* unused) {
  (void)unused;
  sleep(2);
  if (strcmp(way, "exit") == 0) exit(3);
  if (strcmp(way, "_exit") == 0) _exit(4);
  if (strcmp(way, "abort") == 0) abort();
  if (strcmp(way, "crash") == 0) *(volatile int*)8 = 1;
  if (strcmp(way, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(way, "overflow") == 0) return end(memset(alloca(1 << 20), 0, 1 << 20));
  if (strcmp(way, "deadlock") == 0) {
    pthread_mutex_lock(&right);
    sleep(1);
    pthread_mutex_lock(&left);
  }
  return NULL;
}

static void* lock_left_first(void* unused) {
  pthread_mutex_lock(&left);
  sleep(4);
  pthread_mutex_lock(&right);
  return unused;
}

int main(int argc, char** argv) {
  way = argc > 1 ? argv[1] : "";
  pthread_t other;
  pthread_create(&other, NULL, end, NULL);
  if (strcmp(way, "deadlock") == 0) {
    pthread_mutex_lock(&left);
    sleep(4);
    pthread_mutex_lock(&right);
  }
  if (strcmp(way, "cycle") == 0) {
    way = "deadlock";
    pthread_t one;
    pthread_create(&one, NULL, lock_left_first, NULL);
    sleep(9);
    return 5;
  }
  if (strcmp(way, "main leaves") == 0) pthread_exit(NULL);
  pthread_join(other, NULL);
  return 7;
}
