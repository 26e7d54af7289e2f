// SPDX-License-Identifier: BSD-3-Clause
// Aliases of calls: of the C library, and those inserted by the compiler with _FORTIFY_SOURCE.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

extern ssize_t __read_chk(int, void*, size_t, size_t);
extern ssize_t __pread_chk(int, void*, size_t, off_t, size_t);
extern ssize_t __pread64_chk(int, void*, size_t, off_t, size_t);
extern int __poll_chk(struct pollfd*, nfds_t, int, size_t);
extern int __ppoll_chk(struct pollfd*, nfds_t, const struct timespec*, const sigset_t*, size_t);
extern ssize_t __recv_chk(int, void*, size_t, size_t, int);
extern ssize_t __recvfrom_chk(int, void*, size_t, size_t, int, struct sockaddr*, socklen_t*);
extern int __open_2(const char*, int);
extern int __open64_2(const char*, int);
extern int __openat_2(int, const char*, int);
extern int __openat64_2(int, const char*, int);
extern ssize_t __read(int, void*, size_t);
extern ssize_t __write(int, const void*, size_t);
extern int __close(int);
extern int __pipe(int*);
extern int __dup2(int, int);
extern int __poll(struct pollfd*, nfds_t, int);
extern int __select(int, fd_set*, fd_set*, fd_set*, struct timeval*);
extern int __connect(int, const struct sockaddr*, socklen_t);
extern ssize_t __send(int, const void*, size_t, int);
extern int __nanosleep(const struct timespec*, struct timespec*);
extern int __sched_yield(void);
extern int __sigsuspend(const sigset_t*);
extern pid_t __fork(void);
extern pid_t __wait(int*);
extern pid_t __waitpid(pid_t, int*, int);

static int ends[2];
static void* write_later(void* unused) {
  let_others_wait();
  note("w");
  EXPECT_IS(__write(ends[1], "hello", 5), 5);
  return unused;
}
CASE(fortified_read_waits) {
  EXPECT_IS(pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  volatile size_t n = 5;
  char b[16];
  EXPECT_IS(__read_chk(ends[0], b, n, 16), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(fortified_poll_waits) {
  EXPECT_IS(pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  struct pollfd q = {ends[0], POLLIN, 0};
  EXPECT_IS(__poll_chk(&q, 1, -1, sizeof q), 1);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(fortified_ppoll_waits) {
  EXPECT_IS(pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  struct pollfd q = {ends[0], POLLIN, 0};
  EXPECT_IS(__ppoll_chk(&q, 1, NULL, NULL, sizeof q), 1);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(fortified_recv_waits) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  pthread_t id = start(write_later, NULL);
  char b[16];
  EXPECT_IS(__recv_chk(ends[0], b, 5, 16, 0), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(fortified_recvfrom_waits) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  pthread_t id = start(write_later, NULL);
  char b[16];
  EXPECT_IS(__recvfrom_chk(ends[0], b, 5, 16, 0, NULL, NULL), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(underscored_read_waits) {
  EXPECT_IS(pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  char b[16];
  EXPECT_IS(__read(ends[0], b, 5), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}

CASE_ENDING_WITH(-SIGABRT, too_little_room_is_found) {
  char b[4];
  EXPECT_IS(pipe(ends), 0);
  __read_chk(ends[0], b, 5, sizeof b);
}
CASE_ENDING_WITH(-SIGABRT, too_little_room_for_descriptors_is_found) {
  struct pollfd one = {0, 0, 0};
  __poll_chk(&one, 2, 0, sizeof one);
}
static char path_of_fifo[64];
static void* open_to_write(void* unused) {
  let_others_wait();
  note("w");
  EXPECT(open(path_of_fifo, O_WRONLY) >= 0);
  return unused;
}
static void expect_waits_for_writer(int (*opening)(void)) {
  sprintf(path_of_fifo, "/tmp/waitpoint-names-%d", getpid());
  EXPECT_IS(mkfifo(path_of_fifo, 0600), 0);
  const pthread_t id = start(open_to_write, NULL);
  const int opened = opening();
  unlink(path_of_fifo);
  EXPECT(opened >= 0);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
static int by_open(void) { return __open_2(path_of_fifo, O_RDONLY); }
static int by_open64(void) { return __open64_2(path_of_fifo, O_RDONLY); }
static int by_openat(void) { return __openat_2(AT_FDCWD, path_of_fifo, O_RDONLY); }
static int by_openat64(void) { return __openat64_2(AT_FDCWD, path_of_fifo, O_RDONLY); }
CASE(fortified_open_waits) { expect_waits_for_writer(by_open); }
CASE(fortified_open64_waits) { expect_waits_for_writer(by_open64); }
CASE(fortified_openat_waits) { expect_waits_for_writer(by_openat); }
CASE(fortified_openat64_waits) { expect_waits_for_writer(by_openat64); }
static void* in_pread(void* unused) {
  char b[4];
  pthread_cancel(pthread_self());
  (void)!__pread_chk(ends[0], b, 4, 0, 4);
  note("p");
  return unused;
}
static void* in_pread64(void* unused) {
  char b[4];
  pthread_cancel(pthread_self());
  (void)!__pread64_chk(ends[0], b, 4, 0, 4);
  note("p");
  return unused;
}
CASE(fortified_pread_is_a_cancellation_point) {
  EXPECT_IS(pipe(ends), 0);
  join(start(in_pread, NULL));
  join(start(in_pread64, NULL));
  EXPECT_NOTED("");
}
CASE(underscored_poll_and_select_wait) {
  EXPECT_IS(__pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  struct pollfd one = {ends[0], POLLIN, 0};
  EXPECT_IS(__poll(&one, 1, -1), 1);
  note("r");
  join(id);
  char b[8];
  EXPECT_IS(__read(ends[0], b, 8), 5);
  id = start(write_later, NULL);
  fd_set set;
  FD_ZERO(&set);
  FD_SET(ends[0], &set);
  EXPECT_IS(__select(ends[0] + 1, &set, NULL, NULL, NULL), 1);
  note("r");
  join(id);
  EXPECT_NOTED("wrwr");
}
CASE(underscored_dup2_and_close_tell_readers) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(__dup2(ends[1], 50), 50);
  EXPECT_IS(__close(ends[1]), 0);
  EXPECT_IS(write(50, "x", 1), 1);
  EXPECT_IS(__close(50), 0);
  char b[4];
  EXPECT_IS(read(ends[0], b, 4), 1);
  EXPECT_IS(read(ends[0], b, 4), 0);
}
CASE(underscored_nanosleep_sleeps) {
  const struct timespec t = {7200, 0};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  const struct timespec little = {0, 5000000};
  EXPECT_IS(__nanosleep(&little, NULL), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 5000000);
  (void)t;
}
static volatile int turn;
static void* take_turn(void* unused) {
  turn = 1;
  return unused;
}
CASE(underscored_yield_lets_others_go_on) {
  const pthread_t id = start(take_turn, NULL);
  while (!turn) __sched_yield();
  join(id);
}
static void note_it(int signal) {
  (void)signal;
  note("h");
}
static void* send_it(void* id) {
  let_others_wait();
  pthread_kill(*(pthread_t*)id, SIGUSR1);
  return NULL;
}
CASE(underscored_sigsuspend_waits) {
  struct sigaction a = {.sa_handler = note_it};
  sigaction(SIGUSR1, &a, NULL);
  pthread_t self = pthread_self();
  const pthread_t id = start(send_it, &self);
  sigset_t none;
  sigemptyset(&none);
  EXPECT_FAILS(__sigsuspend(&none), EINTR);
  EXPECT_NOTED("h");
  join(id);
}
CASE(underscored_fork_and_wait) {
  pid_t c = __fork();
  if (c == 0) _exit(3);
  int status = 0;
  EXPECT_IS(__wait(&status), c);
  EXPECT_IS(WEXITSTATUS(status), 3);
  c = __fork();
  if (c == 0) _exit(4);
  EXPECT_IS(__waitpid(c, &status, 0), c);
  EXPECT_IS(WEXITSTATUS(status), 4);
}
CASE(underscored_send_and_connect) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  EXPECT_IS(__send(ends[0], "x", 1, 0), 1);
  char b[4];
  EXPECT_IS(recv(ends[1], b, 4, 0), 1);
  struct sockaddr nowhere = {.sa_family = AF_UNSPEC};
  EXPECT_FAILS(__connect(-1, &nowhere, sizeof nowhere), EBADF);
}

// As linked with an older C library.
#define OLDER(result, name, ...)           \
  extern result older_##name(__VA_ARGS__); \
  __asm__(".symver older_" #name ", " #name "@GLIBC_2.2.5")
OLDER(int, __pthread_mutex_init, pthread_mutex_t*, const pthread_mutexattr_t*);
OLDER(int, __pthread_mutex_destroy, pthread_mutex_t*);
OLDER(int, __pthread_mutex_lock, pthread_mutex_t*);
OLDER(int, __pthread_mutex_trylock, pthread_mutex_t*);
OLDER(int, __pthread_mutex_unlock, pthread_mutex_t*);
OLDER(int, __pthread_rwlock_init, pthread_rwlock_t*, const pthread_rwlockattr_t*);
OLDER(int, __pthread_rwlock_destroy, pthread_rwlock_t*);
OLDER(int, __pthread_rwlock_rdlock, pthread_rwlock_t*);
OLDER(int, __pthread_rwlock_wrlock, pthread_rwlock_t*);
OLDER(int, __pthread_rwlock_tryrdlock, pthread_rwlock_t*);
OLDER(int, __pthread_rwlock_trywrlock, pthread_rwlock_t*);
OLDER(int, __pthread_rwlock_unlock, pthread_rwlock_t*);
OLDER(int, pthread_yield, void);
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;

static void* lock_by_older_name(void* unused) {
  EXPECT_IS(older___pthread_mutex_trylock(&mutex), EBUSY);
  EXPECT_IS(older___pthread_mutex_lock(&mutex), 0);
  note("l");
  EXPECT_IS(older___pthread_mutex_unlock(&mutex), 0);
  return unused;
}
CASE(older_names_of_mutexes_mean_the_same) {
  EXPECT_IS(older___pthread_mutex_init(&mutex, NULL), 0);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  const pthread_t id = start(lock_by_older_name, NULL);
  let_others_wait();
  note("u");
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  join(id);
  EXPECT_NOTED("ul");
  EXPECT_IS(older___pthread_mutex_destroy(&mutex), 0);
}
static void* write_by_older_name(void* unused) {
  EXPECT_IS(older___pthread_rwlock_trywrlock(&lock), EBUSY);
  EXPECT_IS(older___pthread_rwlock_wrlock(&lock), 0);
  note("w");
  EXPECT_IS(older___pthread_rwlock_unlock(&lock), 0);
  return unused;
}
CASE(older_names_of_locks_mean_the_same) {
  EXPECT_IS(older___pthread_rwlock_init(&lock, NULL), 0);
  EXPECT_IS(older___pthread_rwlock_rdlock(&lock), 0);
  EXPECT_IS(older___pthread_rwlock_tryrdlock(&lock), 0);
  const pthread_t id = start(write_by_older_name, NULL);
  let_others_wait();
  note("r");
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  EXPECT_IS(pthread_rwlock_unlock(&lock), 0);
  join(id);
  EXPECT_NOTED("rw");
  EXPECT_IS(older___pthread_rwlock_destroy(&lock), 0);
}
CASE(the_older_name_of_yielding_means_the_same) {
  const pthread_t id = start(take_turn, NULL);
  while (!turn) older_pthread_yield();
  join(id);
}
