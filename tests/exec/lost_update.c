// SPDX-License-Identifier: BSD-3-Clause
//
// Two threads read a balance and write it back later: with an argument under one lock, otherwise under two in sequence.
#include <pthread.h>
#include <stdio.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int balance, locked;

static void* pay_in(void* unused) {
  pthread_mutex_lock(&mutex);
  const int seen = balance;
  if (!locked) {
    pthread_mutex_unlock(&mutex);
    pthread_mutex_lock(&mutex);
  }
  balance = seen + 1;
  pthread_mutex_unlock(&mutex);
  return unused;
}

int main(int argc, char** argv) {
  (void)argv;
  locked = argc > 1;
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, pay_in, NULL);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  if (balance != 2) fprintf(stderr, "an update was lost\n");
  return balance == 2 ? 0 : 1;
}
