// SPDX-License-Identifier: BSD-3-Clause
// The programs of a robot's session, each a process of its own:
//
//   session init      makes the devices: a poster in System V shared memory, and a set of a lock and a doorbell
//   session serve     a server: a thread is ticked by a timer's signal at 100 Hz and writes the poster; another answers
//   session ask N     a client: rings the server N times, and prints the poster's count and the time
//   session end       ends the server and removes the devices
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { key = 0x68320001, lock = 0, doorbell = 1, answer = 2 };

struct poster {
  int server;
  int count;
  int copy;  // equal to the count, unless a reader comes between
  int ends;
};

static int devices(int flags) { return semget(key, 3, flags); }

static struct poster* poster(int flags) {
  const int segment = shmget(key, sizeof(struct poster), flags);
  if (segment < 0) {
    fprintf(stderr, "could not find the devices\n");
    exit(3);
  }
  return shmat(segment, NULL, 0);
}

static void operate(int number, int by) {
  struct sembuf one = {(unsigned short)number, (short)by, 0};
  while (semop(devices(0), &one, 1) != 0) continue;
}

static double now_s(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)(time.tv_sec - 3600) + 1e-9 * (double)time.tv_nsec;
}

static struct poster* written;

static void* tick(void* unused) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGALRM);
  const struct itimerval period = {{0, 10000}, {0, 10000}};
  setitimer(ITIMER_REAL, &period, NULL);
  for (int number; sigwait(&set, &number) == 0;) {
    operate(lock, -1);
    ++written->count;
    ++written->copy;
    operate(lock, 1);
  }
  return unused;
}

static int serve(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGALRM);
  sigprocmask(SIG_BLOCK, &set, NULL);
  written = poster(0);
  written->server = getpid();
  pthread_t ticking;
  pthread_create(&ticking, NULL, tick, NULL);
  for (;;) {
    operate(doorbell, -1);
    if (written->ends) return 0;
    operate(answer, 1);
  }
}

static int ask(int times) {
  const struct poster* const read = poster(0);
  for (int i = 0; i < times; ++i) {
    operate(doorbell, 1);
    operate(answer, -1);
    operate(lock, -1);
    printf("%d %s at %.3f s from %d\n", read->count, read->count == read->copy ? "ticks" : "TORN", now_s(),
           read->server);
    operate(lock, 1);
    usleep(50000);
  }
  return 0;
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  if (strcmp(what, "init") == 0) {
    poster(IPC_CREAT | 0600);
    if (devices(IPC_CREAT | 0600) < 0) return 1;
    operate(lock, 1);
    return 0;
  }
  if (strcmp(what, "serve") == 0) return serve();
  if (strcmp(what, "ask") == 0 && argc > 2) return ask(atoi(argv[2]));
  if (strcmp(what, "end") != 0) return 2;
  poster(0)->ends = 1;
  operate(doorbell, 1);
  usleep(1000);
  shmctl(shmget(key, 0, 0), IPC_RMID, NULL);
  return semctl(devices(0), 0, IPC_RMID) == 0 ? 0 : 1;
}
