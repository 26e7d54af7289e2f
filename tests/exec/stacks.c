// SPDX-License-Identifier: BSD-3-Clause
//
// Fails in a second thread, in functions, in the way named by the first argument.
#include <pthread.h>
#include <semaphore.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* way;
static sem_t never;
static sigjmp_buf before;

static void crash(void) { *(volatile int*)8 = 1; }
static void wait_in_vain(void) { sem_wait(&never); }

static void leave(int signal) {
  printf("handled %d\n", signal);
  siglongjmp(before, 1);
}

static void handle_both(void) {
  signal(SIGABRT, leave);
  signal(SIGSEGV, leave);
  if (sigsetjmp(before, 1) == 0) abort();
  if (sigsetjmp(before, 1) == 0) crash();
}

static void* run(void* unused) {
  if (strcmp(way, "crash") == 0) crash();
  if (strcmp(way, "abort") == 0) abort();
  if (strcmp(way, "null") == 0) pthread_mutex_lock(NULL);
  if (strcmp(way, "deadlock") == 0) wait_in_vain();
  if (strcmp(way, "handled") == 0) handle_both();
  return unused;
}

int main(int argc, char** argv) {
  way = argc > 1 ? argv[1] : "";
  sem_init(&never, 0, 0);
  pthread_t other;
  pthread_create(&other, NULL, run, NULL);
  return pthread_join(other, NULL);
}
