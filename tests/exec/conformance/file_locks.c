// SPDX-License-Identifier: BSD-3-Clause
// Locks on file ranges, owned by processes and by open file descriptions.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

static int ends[2];
static char bytes[8];
static int temp(void) {
  char path[] = "/tmp/waitpoint-locks-XXXXXX";
  const int d = mkstemp(path);
  EXPECT(d >= 0 && unlink(path) == 0);
  return d;
}
static int f1, f2;
static void* unlock_later(void* p) {
  let_others_wait();
  note("u");
  struct flock l = {.l_type = F_UNLCK};
  EXPECT_IS(fcntl(f1, F_OFD_SETLK, &l), 0);
  return p;
}
CASE(ofd_lock_waits) {
  f1 = temp();
  char n[32];
  sprintf(n, "/proc/self/fd/%d", f1);
  f2 = open(n, O_RDWR);
  EXPECT(f2 >= 0);
  struct flock l = {.l_type = F_WRLCK};
  EXPECT_IS(fcntl(f1, F_OFD_SETLK, &l), 0);
  EXPECT_FAILS(fcntl(f2, F_OFD_SETLK, &l), EAGAIN);
  pthread_t id = start(unlock_later, NULL);
  EXPECT_IS(fcntl(f2, F_OFD_SETLKW, &l), 0);
  note("l");
  join(id);
  EXPECT_NOTED("ul");
}
CASE(setlkw_waits_for_a_child_while_others_go_on) {
  f1 = temp();
  EXPECT_IS(pipe(ends), 0);
  pid_t c = fork();
  if (c == 0) {
    struct flock l = {.l_type = F_WRLCK};
    EXPECT_IS(fcntl(f1, F_SETLK, &l), 0);
    if (write(ends[1], "x", 1)) {
    }
    sleep_ms(100);
    _exit(0);
  }
  EXPECT_IS(read(ends[0], bytes, 1), 1);
  struct flock l = {.l_type = F_WRLCK};
  EXPECT_IS(fcntl(f1, F_SETLKW, &l), 0);
  EXPECT_IS(waitpid(c, NULL, 0), c);
}
static void on(int n) {
  (void)n;
  note("h");
}
static void* kill_later(void* p) {
  let_others_wait();
  pthread_kill(*(pthread_t*)p, SIGUSR1);
  return NULL;
}
CASE(setlkw_is_interrupted) {
  f1 = temp();
  EXPECT_IS(pipe(ends), 0);
  struct sigaction a = {.sa_handler = on};
  sigaction(SIGUSR1, &a, NULL);
  pid_t c = fork();
  if (c == 0) {
    struct flock l = {.l_type = F_WRLCK};
    EXPECT_IS(fcntl(f1, F_SETLK, &l), 0);
    if (write(ends[1], "x", 1)) {
    }
    sleep(2);
    _exit(0);
  }
  EXPECT_IS(read(ends[0], bytes, 1), 1);
  pthread_t self = pthread_self();
  pthread_t id = start(kill_later, &self);
  struct flock l = {.l_type = F_WRLCK};
  EXPECT_FAILS(fcntl(f1, F_SETLKW, &l), EINTR);
  EXPECT_NOTED("h");
  kill(c, SIGKILL);
  join(id);
}
CASE(lockf_waits_for_a_child) {
  f1 = temp();
  EXPECT_IS(pipe(ends), 0);
  pid_t c = fork();
  if (c == 0) {
    EXPECT_IS(lockf(f1, F_LOCK, 0), 0);
    if (write(ends[1], "x", 1)) {
    }
    sleep_ms(50);
    _exit(0);
  }
  EXPECT_IS(read(ends[0], bytes, 1), 1);
  EXPECT_FAILS(lockf(f1, F_TLOCK, 0), EAGAIN);
  EXPECT_FAILS(lockf(f1, F_TEST, 0), EACCES);
  EXPECT_IS(lockf(f1, F_LOCK, 0), 0);
  EXPECT_IS(lockf(f1, F_ULOCK, 0), 0);
  waitpid(c, NULL, 0);
}

static struct flock part(short type, off_t at) {
  const struct flock lock = {.l_type = type, .l_start = at, .l_len = 1};
  return lock;
}
CASE(two_that_wait_for_each_other_are_told) {
  int back[2];
  f1 = temp();
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(back), 0);
  struct flock first = part(F_WRLCK, 0), second = part(F_WRLCK, 1);
  EXPECT_IS(fcntl(f1, F_SETLK, &first), 0);
  const pid_t c = fork();
  if (c == 0) {
    EXPECT_IS(fcntl(f1, F_SETLK, &second), 0);
    EXPECT_IS(write(ends[1], "x", 1), 1);
    const int result = fcntl(f1, F_SETLKW, &first);
    _exit(result == 0 ? 0 : errno == EDEADLK ? 35 : 1);
  }
  EXPECT_IS(read(ends[0], bytes, 1), 1);
  sleep_ms(50);
  const int result = fcntl(f1, F_SETLKW, &second);
  const int error = errno;
  struct flock none = {.l_type = F_UNLCK};
  EXPECT_IS(fcntl(f1, F_SETLK, &none), 0);
  int status = 0;
  EXPECT_IS(waitpid(c, &status, 0), c);
  EXPECT_IS((result < 0 && error == EDEADLK) + (WEXITSTATUS(status) == 35), 1);
}
CASE(readers_lock_together) {
  f1 = temp();
  struct flock shared = {.l_type = F_RDLCK};
  EXPECT_IS(fcntl(f1, F_SETLKW, &shared), 0);
  const pid_t c = fork();
  if (c == 0) {
    EXPECT_IS(fcntl(f1, F_SETLKW, &shared), 0);
    struct flock alone = {.l_type = F_WRLCK};
    EXPECT_FAILS(fcntl(f1, F_SETLK, &alone), EAGAIN);
    _exit(0);
  }
  int status = -1;
  EXPECT_IS(waitpid(c, &status, 0), c);
  EXPECT_IS(status, 0);
}
CASE(what_is_not_open_is_not_locked) {
  struct flock all = {.l_type = F_WRLCK};
  EXPECT_FAILS(fcntl(999, F_SETLKW, &all), EBADF);
  EXPECT_FAILS(lockf(999, F_LOCK, 0), EBADF);
  f1 = temp();
  EXPECT_FAILS(lockf(f1, 77, 0), EINVAL);
}
