// SPDX-License-Identifier: BSD-3-Clause
#include "lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>

enum { is_free, is_full };

struct lines {
  int memory, semaphores;
  char line[line_size];
};

static void fail(const char* what) {
  perror(what);
  exit(1);
}

// The creator of the semaphores initialises them; the others wait until this is done.
static int open_semaphores(int key) {
  int id = semget(key, 2, IPC_CREAT | IPC_EXCL | 0600);
  if (id >= 0) {
    struct sembuf give = {is_free, 1, 0};
    if (semop(id, &give, 1) != 0) fail("semop");
    return id;
  }
  if (errno != EEXIST || (id = semget(key, 2, 0600)) < 0) fail("semget");
  return id;
}

struct lines* lines_open(int key) {
  const int id = shmget(key, sizeof(struct lines), IPC_CREAT | 0600);
  if (id < 0) fail("shmget");
  struct lines* lines = shmat(id, NULL, 0);
  if (lines == (void*)-1) fail("shmat");
  lines->memory = id;
  lines->semaphores = open_semaphores(key);
  return lines;
}

static void pass_on(struct lines* lines, unsigned short from, unsigned short to, void* destination,
                    const void* source) {
  struct sembuf take = {from, -1, 0}, give = {to, 1, 0};
  if (semop(lines->semaphores, &take, 1) != 0) fail("semop");
  memcpy(destination, source, line_size);
  if (semop(lines->semaphores, &give, 1) != 0) fail("semop");
}

void lines_put(struct lines* lines, const char* line) {
  char whole[line_size] = {0};
  strncpy(whole, line, line_size - 1);
  pass_on(lines, is_free, is_full, lines->line, whole);
}

void lines_take(struct lines* lines, char line[line_size]) { pass_on(lines, is_full, is_free, line, lines->line); }

void lines_remove(struct lines* lines) {
  semctl(lines->semaphores, 0, IPC_RMID);
  shmctl(lines->memory, IPC_RMID, NULL);
  shmdt(lines);
}
