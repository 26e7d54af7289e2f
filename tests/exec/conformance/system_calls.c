// SPDX-License-Identifier: BSD-3-Clause
// System calls by number, through syscall(): those whose C library functions are simulated.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/ipc.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
static int ends[2];
static void* write_later(void* p) {
  let_others_wait();
  note("w");
  EXPECT_IS(syscall(SYS_write, ends[1], "hello", 5), 5);
  return p;
}
#define WAITS(name, ...)                                     \
  CASE(name) {                                               \
    char b[16];                                              \
    (void)b;                                                 \
    EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0); \
    pthread_t t = start(write_later, NULL);                  \
    __VA_ARGS__;                                             \
    note("r");                                               \
    join(t);                                                 \
    EXPECT_NOTED("wr");                                      \
  }
WAITS(by_number_read, EXPECT_IS(syscall(SYS_read, ends[0], b, 5), 5))
WAITS(by_number_poll, struct pollfd p = {ends[0], POLLIN, 0}; EXPECT_IS(syscall(SYS_poll, &p, 1, -1), 1))
WAITS(by_number_ppoll, struct pollfd p = {ends[0], POLLIN, 0}; EXPECT_IS(syscall(SYS_ppoll, &p, 1, NULL, NULL, 8), 1))
WAITS(by_number_select, fd_set s; FD_ZERO(&s); FD_SET(ends[0], &s);
      EXPECT_IS(syscall(SYS_select, ends[0] + 1, &s, NULL, NULL, NULL), 1))
WAITS(by_number_pselect6, fd_set s; FD_ZERO(&s); FD_SET(ends[0], &s);
      EXPECT_IS(syscall(SYS_pselect6, ends[0] + 1, &s, NULL, NULL, NULL, NULL), 1))
WAITS(by_number_epoll, int d = syscall(SYS_epoll_create1, 0); struct epoll_event e = {.events = EPOLLIN};
      EXPECT_IS(syscall(SYS_epoll_ctl, d, EPOLL_CTL_ADD, ends[0], &e), 0);
      EXPECT_IS(syscall(SYS_epoll_wait, d, &e, 1, -1), 1))
WAITS(by_number_epoll_pwait, int d = syscall(SYS_epoll_create, 1); struct epoll_event e = {.events = EPOLLIN};
      EXPECT_IS(syscall(SYS_epoll_ctl, d, EPOLL_CTL_ADD, ends[0], &e), 0);
      EXPECT_IS(syscall(SYS_epoll_pwait, d, &e, 1, -1, NULL, 8), 1))
WAITS(by_number_recvfrom, EXPECT_IS(syscall(SYS_recvfrom, ends[0], b, 5, 0, NULL, NULL), 5))
WAITS(
    by_number_readv,
    struct iovec {
      void* p;
      size_t n;
    } v = {b, 5};
    EXPECT_IS(syscall(SYS_readv, ends[0], &v, 1), 5))
static void* unlock(void* p) {
  let_others_wait();
  note("w");
  struct sembuf o = {0, 1, 0};
  EXPECT_IS(syscall(SYS_semop, *(int*)p, &o, 1), 0);
  return NULL;
}
CASE(by_number_sem) {
  int id = syscall(SYS_semget, IPC_PRIVATE, 1, 0600);
  EXPECT(id >= 0);
  pthread_t t = start(unlock, &id);
  struct sembuf o = {0, -1, 0};
  EXPECT_IS(syscall(SYS_semtimedop, id, &o, 1, NULL), 0);
  note("r");
  join(t);
  EXPECT_IS(syscall(SYS_semctl, id, 0, IPC_RMID, 0), 0);
  EXPECT_NOTED("wr");
}
static void* sendm(void* p) {
  let_others_wait();
  note("w");
  struct {
    long t;
    char b[8];
  } m = {1, "x"};
  EXPECT_IS(syscall(SYS_msgsnd, *(int*)p, &m, 2, 0), 0);
  return NULL;
}
CASE(by_number_msg) {
  int id = syscall(SYS_msgget, IPC_PRIVATE, 0600);
  pthread_t t = start(sendm, &id);
  struct {
    long t;
    char b[8];
  } m;
  EXPECT_IS(syscall(SYS_msgrcv, id, &m, 8, 0, 0), 2);
  note("r");
  join(t);
  EXPECT_IS(syscall(SYS_msgctl, id, IPC_RMID, 0), 0);
  EXPECT_NOTED("wr");
}
CASE(by_number_shm) {
  int id = syscall(SYS_shmget, IPC_PRIVATE, 4096, 0600);
  char* m = (char*)syscall(SYS_shmat, id, 0, 0);
  m[0] = 5;
  char* n = shmat(id, 0, 0);
  EXPECT_IS(n[0], 5);
  EXPECT_IS(syscall(SYS_shmdt, m), 0);
  EXPECT_IS(syscall(SYS_shmctl, id, IPC_RMID, 0), 0);
}
static void on(int n) {
  (void)n;
  note("h");
}
CASE(by_number_sigprocmask) {
  signal(SIGUSR1, on);
  unsigned long s = 1UL << (SIGUSR1 - 1), o = 0;
  EXPECT_IS(syscall(SYS_rt_sigprocmask, SIG_BLOCK, &s, &o, 8), 0);
  EXPECT_IS(raise(SIGUSR1), 0);
  EXPECT_NOTED("");
  unsigned long p = 0;
  EXPECT_IS(syscall(SYS_rt_sigpending, &p, 8), 0);
  EXPECT(p & s);
  EXPECT_IS(syscall(SYS_rt_sigprocmask, SIG_SETMASK, &o, NULL, 8), 0);
  EXPECT_NOTED("h");
}
CASE(by_number_sigtimedwait) {
  unsigned long s = 1UL << (SIGUSR1 - 1);
  EXPECT_IS(syscall(SYS_rt_sigprocmask, SIG_BLOCK, &s, NULL, 8), 0);
  raise(SIGUSR1);
  siginfo_t i;
  EXPECT_IS(syscall(SYS_rt_sigtimedwait, &s, &i, NULL, 8), SIGUSR1);
}
struct kact {
  void (*h)(int);
  unsigned long f;
  void (*r)(void);
  unsigned long m;
};
CASE(by_number_sigaction) {
  signal(SIGUSR1, on);
  struct kact o;
  EXPECT_IS(syscall(SYS_rt_sigaction, SIGUSR1, NULL, &o, 8), 0);
  EXPECT(o.h == on);
  o.h = SIG_IGN;
  EXPECT_IS(syscall(SYS_rt_sigaction, SIGUSR1, &o, NULL, 8), 0);
  raise(SIGUSR1);
  EXPECT_NOTED("");
  struct sigaction a;
  sigaction(SIGUSR1, NULL, &a);
  EXPECT(a.sa_handler == SIG_IGN);
  EXPECT_FAILS(syscall(SYS_rt_sigaction, SIGUSR1, NULL, &o, 4), EINVAL);
}
CASE(by_number_sigqueueinfo) {
  signal(SIGUSR1, on);
  siginfo_t i;
  memset(&i, 0, sizeof i);
  i.si_code = SI_QUEUE;
  i.si_pid = getpid();
  i.si_value.sival_int = 4;
  EXPECT_IS(syscall(SYS_rt_sigqueueinfo, getpid(), SIGUSR1, &i), 0);
  EXPECT_NOTED("h");
}
static void* sig_later(void* p) {
  let_others_wait();
  pthread_kill(*(pthread_t*)p, SIGUSR1);
  return NULL;
}
CASE(by_number_sigsuspend) {
  signal(SIGUSR1, on);
  pthread_t self = pthread_self(), t = start(sig_later, &self);
  unsigned long s = 0;
  EXPECT_FAILS(syscall(SYS_rt_sigsuspend, &s, 8), EINTR);
  EXPECT_NOTED("h");
  join(t);
}
CASE(by_number_pause) {
  signal(SIGUSR1, on);
  pthread_t self = pthread_self(), t = start(sig_later, &self);
  EXPECT_FAILS(syscall(SYS_pause), EINTR);
  EXPECT_NOTED("h");
  join(t);
}
CASE(by_number_alarm) {
  signal(SIGALRM, on);
  EXPECT_IS(syscall(SYS_alarm, 1), 0);
  sleep(2);
  EXPECT_NOTED("h");
}
CASE(by_number_itimer) {
  signal(SIGALRM, on);
  struct itimerval v = {{0, 0}, {0, 1000}};
  EXPECT_IS(syscall(SYS_setitimer, ITIMER_REAL, &v, NULL), 0);
  EXPECT_IS(syscall(SYS_getitimer, ITIMER_REAL, &v), 0);
  sleep_ms(20);
  EXPECT_NOTED("h");
}
CASE(by_number_timer) {
  signal(SIGUSR1, on);
  int id;
  struct sigevent e;
  memset(&e, 0, sizeof e);
  e.sigev_notify = SIGEV_SIGNAL;
  e.sigev_signo = SIGUSR1;
  EXPECT_IS(syscall(SYS_timer_create, CLOCK_MONOTONIC, &e, &id), 0);
  struct itimerspec s = {{0, 0}, {0, 1000000}};
  EXPECT_IS(syscall(SYS_timer_settime, id, 0, &s, NULL), 0);
  EXPECT_IS(syscall(SYS_timer_gettime, id, &s), 0);
  sleep_ms(20);
  EXPECT_NOTED("h");
  EXPECT_IS(syscall(SYS_timer_getoverrun, id), 0);
  EXPECT_IS(syscall(SYS_timer_delete, id), 0);
  EXPECT_FAILS(syscall(SYS_timer_delete, id), EINVAL);
}
CASE(by_number_timerfd) {
  int d = syscall(SYS_timerfd_create, CLOCK_MONOTONIC, 0);
  struct itimerspec s = {{0, 0}, {0, 5000000}};
  EXPECT_IS(syscall(SYS_timerfd_settime, d, 0, &s, NULL), 0);
  EXPECT_IS(syscall(SYS_timerfd_gettime, d, &s), 0);
  unsigned long long n;
  EXPECT_IS(read(d, &n, 8), 8);
  EXPECT_IS(n, 1);
}
CASE(by_number_fork) {
  pid_t c = syscall(SYS_fork);
  if (c == 0) {
    sleep_ms(1);
    _exit(4);
  }
  int st;
  EXPECT_IS(syscall(SYS_wait4, c, &st, 0, NULL), c);
  EXPECT_IS(WEXITSTATUS(st), 4);
}
CASE(by_number_clone) {
  pid_t c = syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
  if (c == 0) {
    sleep_ms(1);
    _exit(4);
  }
  siginfo_t i;
  EXPECT_IS(syscall(SYS_waitid, P_PID, c, &i, WEXITED, NULL), 0);
  EXPECT_IS(i.si_status, 4);
}
CASE(by_number_exit_group) {
  pid_t c = fork();
  if (c == 0) syscall(SYS_exit_group, 6);
  int st;
  waitpid(c, &st, 0);
  EXPECT_IS(WEXITSTATUS(st), 6);
}
CASE(by_number_pipe_eventfd_dup) {
  int p[2];
  EXPECT_IS(syscall(SYS_pipe2, p, O_NONBLOCK), 0);
  char b;
  EXPECT_FAILS(syscall(SYS_read, p[0], &b, 1), EAGAIN);
  int d = syscall(SYS_eventfd2, 3, 0);
  unsigned long long v;
  EXPECT_IS(read(d, &v, 8), 8);
  EXPECT_IS(v, 3);
  int q = syscall(SYS_dup, p[1]);
  EXPECT_IS(syscall(SYS_close, p[1]), 0);
  EXPECT_IS(syscall(SYS_write, q, "x", 1), 1);
  EXPECT_IS(read(p[0], &b, 1), 1);
}
CASE(by_number_mq) {
  char name[32];
  sprintf(name, "waitpoint-raw-%d", getpid());
  mqd_t q = syscall(SYS_mq_open, name, O_CREAT | O_RDWR | O_NONBLOCK, 0600, NULL);
  EXPECT(q >= 0);
  syscall(SYS_mq_unlink, name);
  char b[8192];
  struct timespec z = {0, 0};
  EXPECT_FAILS(syscall(SYS_mq_timedreceive, q, b, 8192, NULL, &z), EAGAIN);
  EXPECT_IS(syscall(SYS_mq_timedsend, q, "a", 1, 0, NULL), 0);
  EXPECT_IS(syscall(SYS_mq_timedreceive, q, b, 8192, NULL, NULL), 1);
}
CASE(by_number_times) {
  struct timespec a, b;
  EXPECT_IS(syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &a), 0);
  struct timespec q = {0, 20000000};
  EXPECT_IS(syscall(SYS_nanosleep, &q, NULL), 0);
  EXPECT_IS(syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &b), 0);
  EXPECT((b.tv_sec - a.tv_sec) * 1000000000LL + b.tv_nsec - a.tv_nsec >= 20000000);
  EXPECT(syscall(SYS_times, NULL) > 0);
}
CASE(by_number_sched) {
  EXPECT_IS(syscall(SYS_sched_getscheduler, 0), SCHED_OTHER);
  unsigned long m[16];
  EXPECT(syscall(SYS_sched_getaffinity, 0, sizeof m, m) > 0);
  EXPECT_IS(syscall(SYS_getpid), getpid());
}
CASE(by_number_futex_efault) {
  EXPECT_FAILS(syscall(SYS_futex, NULL, FUTEX_WAIT, 0, NULL, NULL, 0), EFAULT);
  EXPECT_FAILS(syscall(SYS_futex, NULL, 99, 0, NULL, NULL, 0), ENOSYS);
}
CASE(by_number_accept_connect) {
  EXPECT_FAILS(syscall(SYS_accept, -1, NULL, NULL), EBADF);
  EXPECT_FAILS(syscall(SYS_connect, -1, NULL, 0), EBADF);
}
CASE(by_number_signalfd) {
  unsigned long s = 1UL << (SIGUSR1 - 1);
  syscall(SYS_rt_sigprocmask, SIG_BLOCK, &s, NULL, 8);
  int d = syscall(SYS_signalfd4, -1, &s, 8, 0);
  EXPECT(d >= 0);
  raise(SIGUSR1);
  char b[128];
  EXPECT_IS(read(d, b, 128), 128);
  EXPECT_IS(*(unsigned*)b, SIGUSR1);
}
