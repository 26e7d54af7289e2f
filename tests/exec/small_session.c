// SPDX-License-Identifier: BSD-3-Clause
// A session with few events, for searches of many or all orders. Its devices are a poster, and a semaphore that is free
// while the poster may be read:
//
//   small_session init        makes the devices
//   small_session serve HOW   a server: initialises the poster and frees it; if HOW is "updates", updates it then, if
//                             it is "torn", without the semaphore
//   small_session ask HOW     a client: reads the poster; with "hasty" without the semaphore, with "updates" frees it
//                             again. Its status is 1 if the poster was not consistent
//   small_session all HOW     forks these processes, and is the client
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <unistd.h>

enum { key = 0x68320002 };

struct poster {
  int count;
  int copy;  // equal to the count
};

static int segment, set;
static const char* how;

static void open_devices(int flags) {
  segment = shmget(key, sizeof(struct poster), flags);
  set = semget(key, 1, flags);
  if (segment < 0 || set < 0) exit(3);
}

static int make_devices(void) {
  open_devices(IPC_CREAT | 0600);
  return 0;
}

static void operate(int by) {
  struct sembuf one = {0, (short)by, 0};
  if (semop(set, &one, 1) != 0) exit(3);
}

static void write_count(struct poster* poster, int count) {
  poster->count = count;
  sched_yield();
  poster->copy = count;
}

static int serve(void) {
  struct poster* const poster = shmat(segment, NULL, 0);
  poster->count = poster->copy = 1;
  operate(1);
  if (strcmp(how, "torn") == 0) write_count(poster, 2);
  if (strcmp(how, "updates") != 0) return 0;
  operate(-1);
  write_count(poster, 2);
  operate(1);
  return 0;
}

static int ask(void) {
  if (strcmp(how, "hasty") != 0) operate(-1);
  const struct poster* const poster = shmat(segment, NULL, 0);
  const int is_consistent = poster->count > 0 && poster->count == poster->copy;
  if (strcmp(how, "updates") == 0) operate(1);
  return is_consistent ? 0 : 1;
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  how = argc > 2 ? argv[2] : "";
  if (strcmp(what, "init") == 0) return make_devices();
  if (strcmp(what, "all") == 0) {
    if (fork() == 0) return make_devices();
    wait(NULL);
  }
  open_devices(0);
  if (strcmp(what, "serve") == 0) return serve();
  if (strcmp(what, "all") == 0 && fork() == 0) return serve();
  return ask();
}
