// SPDX-License-Identifier: BSD-3-Clause
//
// Computes for long before its threads start, and again when they have met half way. The sum depends on the order. The
// argument names what the program does in the beginning, and keeps using: a file, a pipe, its input; or "fail": some
// orders fail, and the output is shown; or "once": there are few orders.
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { pages = 4000 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_barrier_t half_way;
static volatile char* memory;
static const char* what = "";
static long sum = 1;
static int descriptors[2] = {-1, -1};
static FILE* file;

static void compute(void) {
  for (int round = 0; round < 150; ++round)
    for (int page = 0; page < pages; ++page) memory[4096L * page] += round;
}

// What was kept open, or in the process, since the beginning, has its state of then.
static void use(void) {
  char text[8] = "";
  if (file != NULL && strcmp(what, "write") == 0) fprintf(file, "line\n");
  if (file != NULL && strcmp(what, "read") == 0 && fgets(text, sizeof text, file) == NULL) exit(3);
  if (descriptors[0] >= 0 && (write(descriptors[1], "x", 1) != 1 || read(descriptors[0], text, 1) != 1)) exit(4);
  if (strcmp(what, "input") == 0 && (read(STDIN_FILENO, text, 6) != 6 || strncmp(text, "second", 6) != 0)) exit(5);
}

static void* work(void* number) {
  const long own = (long)number;
  if (strcmp(what, "once") == 0) {
    pthread_mutex_lock(&mutex);
    sum = sum * 3 + own;
    pthread_mutex_unlock(&mutex);
    return NULL;
  }
  for (int i = 0; i < 2; ++i) {
    pthread_mutex_lock(&mutex);
    sum = sum * 3 + own;
    pthread_mutex_unlock(&mutex);
  }
  if (pthread_barrier_wait(&half_way) == PTHREAD_BARRIER_SERIAL_THREAD) {
    compute();
    use();
  }
  pthread_mutex_lock(&mutex);
  sum = sum * 5 + own;
  pthread_mutex_unlock(&mutex);
  return NULL;
}

int main(int argc, char** argv) {
  if (argc > 1) what = argv[1];
  char text[16];
  if (strcmp(what, "read") == 0) file = fopen(argv[0], "r");
  if (strcmp(what, "write") == 0) file = fopen(argv[2], "w");
  if (strcmp(what, "pipe") == 0 && pipe(descriptors) != 0) return 6;
  if (strcmp(what, "input") == 0 && read(STDIN_FILENO, text, 6) != 6) return 7;
  memory = malloc(4096L * pages);
  compute();
  printf("has begun\n");
  fflush(stdout);
  pthread_barrier_init(&half_way, NULL, 2);
  pthread_t threads[2];
  for (long i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, work, (void*)i);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  return strcmp(what, "fail") == 0 && sum % 5 == 1;
}
