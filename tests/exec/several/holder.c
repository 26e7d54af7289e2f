// SPDX-License-Identifier: BSD-3-Clause
//
// holder KEY: takes the only unit of a semaphore, and ends without releasing it. The system releases it, by SEM_UNDO.
#include <stdio.h>
#include <stdlib.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <unistd.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  struct sembuf give = {0, 1, 0}, take = {0, -1, SEM_UNDO};
  int id = semget(atoi(argv[1]), 1, IPC_CREAT | IPC_EXCL | 0600);
  if (id >= 0)
    semop(id, &give, 1);
  else
    id = semget(atoi(argv[1]), 1, 0600);
  if (semop(id, &take, 1) != 0) return 1;
  puts("has it");
  sleep(1);
  fflush(stdout);
  _exit(0);
}
