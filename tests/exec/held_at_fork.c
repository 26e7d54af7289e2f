// SPDX-License-Identifier: BSD-3-Clause
// A process is forked while another thread holds a mutex: in the child it stays locked. `try` asks for that, `lock`
// waits for it, which never ends.
#include <pthread.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_barrier_t barrier;

static void* hold(void* none) {
  pthread_mutex_lock(&mutex);
  pthread_barrier_wait(&barrier);
  pthread_barrier_wait(&barrier);
  pthread_mutex_unlock(&mutex);
  return none;
}

int main(int count, char** words) {
  const int waits = count == 2 && strcmp(words[1], "lock") == 0;
  pthread_t thread;
  int status = 0;
  pthread_barrier_init(&barrier, NULL, 2);
  pthread_create(&thread, NULL, hold, NULL);
  pthread_barrier_wait(&barrier);
  const pid_t child = fork();
  if (child == 0) _exit((waits ? pthread_mutex_lock(&mutex) : pthread_mutex_trylock(&mutex)) == 0);
  waitpid(child, &status, 0);
  pthread_barrier_wait(&barrier);
  pthread_join(thread, NULL);
  return status != 0;
}
