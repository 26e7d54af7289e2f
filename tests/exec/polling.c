// SPDX-License-Identifier: BSD-3-Clause
// Processes that poll a semaphore at one instant until another one posts it: polling CHILDREN US. The first process
// posts it for each child after US microseconds; with 0 children it polls itself, for its only child.
#include <sched.h>
#include <semaphore.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

static sem_t* semaphore;

static void poll_it(void) {
  while (sem_trywait(semaphore) != 0) sched_yield();
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int children = atoi(argv[1]), wait_us = atoi(argv[2]);
  semaphore = mmap(NULL, sizeof *semaphore, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  sem_init(semaphore, 1, 0);
  if (children == 0) {
    if (fork() == 0) return sem_post(semaphore);
    poll_it();
  }
  for (int i = 0; i < children; ++i) {
    if (fork() != 0) continue;
    poll_it();
    return 0;
  }
  if (wait_us > 0) usleep((useconds_t)wait_us);
  for (int i = 0; i < children; ++i) sem_post(semaphore);
  while (wait(NULL) > 0) continue;
  return 0;
}
