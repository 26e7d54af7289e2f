// SPDX-License-Identifier: BSD-3-Clause
//
// Two threads write their letters, twice each: the exit status tells which of the six orders occurred.
#include <pthread.h>
#include <string.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static char letters[5];

static void* write_twice(void* letter) {
  for (int i = 0; i < 2; ++i) {
    pthread_mutex_lock(&mutex);
    letters[strlen(letters)] = *(const char*)letter;
    pthread_mutex_unlock(&mutex);
  }
  return NULL;
}

int main(void) {
  static const char* const orders[] = {"aabb", "abab", "abba", "baab", "baba", "bbaa"};
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, write_twice, "a\0b" + 2 * i);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  int order = 0;
  while (strcmp(orders[order], letters) != 0) ++order;
  return order;
}
