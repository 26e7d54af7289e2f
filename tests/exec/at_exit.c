// SPDX-License-Identifier: BSD-3-Clause
// atexit(), which a program compiled with -fsanitize=thread takes from the compiler's runtime.
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

static int counted;

static void end(void) { _exit(counted == 1 ? 7 : 1); }

static void* count(void* none) {
  ++counted;
  return none;
}

int main(void) {
  pthread_t thread;
  atexit(end);
  pthread_create(&thread, NULL, count, NULL);
  pthread_join(thread, NULL);
  return 0;
}
