// SPDX-License-Identifier: BSD-3-Clause
// A parent and its child each add one to a counter in shared memory: in two critical sections, or, with "locked", one.
#include <semaphore.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

struct account {
  sem_t lock;
  int count;
};

static void add(struct account* account, int is_locked) {
  sem_wait(&account->lock);
  const int count = account->count;
  if (!is_locked) {
    sem_post(&account->lock);
    sem_wait(&account->lock);
  }
  account->count = count + 1;
  sem_post(&account->lock);
}

int main(int argc, char** argv) {
  const int is_locked = argc > 1 && strcmp(argv[1], "locked") == 0;
  struct account* const account =
      mmap(NULL, sizeof *account, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  sem_init(&account->lock, 1, 1);
  const pid_t child = fork();
  add(account, is_locked);
  if (child == 0) return 0;
  waitpid(child, NULL, 0);
  return account->count == 2 ? 0 : 1;
}
