// SPDX-License-Identifier: BSD-3-Clause
// Bad addresses: system calls fail with EFAULT, simulated or not.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/msg.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/uio.h>

// Volatile prevents a compiler warning.
static void* volatile nowhere = (void*)8;
static volatile nfds_t too_many = ~0UL;

CASE(of_descriptors_to_be_polled) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  EXPECT_FAILS(poll(nowhere, 1, 0), EFAULT);
  EXPECT_FAILS(poll(nowhere, too_many, 0), EINVAL);
  EXPECT_FAILS(select(ends[1], nowhere, NULL, NULL, NULL), EFAULT);
  const int watch = epoll_create1(0);
  struct epoll_event event = {.events = EPOLLIN};
  EXPECT_FAILS(epoll_ctl(watch, EPOLL_CTL_ADD, ends[0], nowhere), EFAULT);
  EXPECT_IS(epoll_ctl(watch, EPOLL_CTL_ADD, ends[0], &event), 0);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  EXPECT_FAILS(epoll_wait(watch, nowhere, 1, 0), EFAULT);
  EXPECT_FAILS(pselect(0, NULL, NULL, NULL, NULL, nowhere), EFAULT);
  EXPECT_FAILS(epoll_pwait2(watch, &event, 1, nowhere, NULL), EFAULT);
}
CASE(of_messages) {
  int ends[2];
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  EXPECT_FAILS(send(ends[0], nowhere, 100, 0), EFAULT);
  EXPECT_FAILS(sendmsg(ends[0], nowhere, 0), EFAULT);
  EXPECT_FAILS(sendmmsg(ends[0], nowhere, 1, 0), EFAULT);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  EXPECT_FAILS(recv(ends[0], nowhere, 1, 0), EFAULT);
  EXPECT_FAILS(recvmsg(ends[0], nowhere, 0), EFAULT);
  EXPECT_FAILS(recvmsg(ends[0], nowhere, MSG_WAITALL), EFAULT);
  EXPECT_FAILS(recvmmsg(ends[0], nowhere, 1, 0, NULL), EFAULT);
  struct mmsghdr message = {0};
  EXPECT_FAILS(recvmmsg(ends[0], &message, 1, 0, nowhere), EFAULT);
  EXPECT_IS(pipe(ends), 0);
  EXPECT_FAILS(writev(ends[1], nowhere, 1), EFAULT);
}
CASE(of_timers_and_locks) {
  const int timer = timerfd_create(CLOCK_REALTIME, 0);
  EXPECT_FAILS(timerfd_settime(timer, 0, nowhere, NULL), EFAULT);
  EXPECT_FAILS(timerfd_gettime(timer, nowhere), EFAULT);
  EXPECT_FAILS(fcntl(open("/dev/null", O_RDWR), F_SETLKW, nowhere), EFAULT);
  EXPECT_FAILS(setitimer(ITIMER_REAL, nowhere, NULL), EFAULT);
  struct itimerval none = {{0, 0}, {0, 0}};
  EXPECT_FAILS(setitimer(ITIMER_REAL, &none, nowhere), EFAULT);
  EXPECT_FAILS(getitimer(ITIMER_REAL, nowhere), EFAULT);
}
CASE(of_clocks) {
  EXPECT_FAILS(clock_gettime(CLOCK_PROCESS_CPUTIME_ID, nowhere), EFAULT);
  EXPECT_FAILS(clock_gettime(CLOCK_THREAD_CPUTIME_ID, nowhere), EFAULT);
  EXPECT_FAILS(syscall(SYS_gettimeofday, nowhere, NULL), EFAULT);
  EXPECT_FAILS(syscall(SYS_times, nowhere), EFAULT);
  EXPECT_FAILS(syscall(SYS_time, nowhere), EFAULT);
}
CASE(of_random_bytes) {
  EXPECT_FAILS(syscall(SYS_getrandom, nowhere, 8, 0), EFAULT);
  EXPECT_FAILS(syscall(SYS_getrandom, nowhere, 1, 0), EFAULT);
#if !__GLIBC_PREREQ(2, 41)  // which fills the bytes within the process, where that is possible: there it crashes
  EXPECT_FAILS(getrandom(nowhere, 8, 0), EFAULT);
  EXPECT_FAILS(getentropy(nowhere, 8), EFAULT);
#endif
  char bytes[4] = {0, 0, 0, 1};
  EXPECT_IS(getrandom(bytes, 3, 0), 3);
  EXPECT_IS(bytes[3], 1);
}
CASE(of_what_is_asked_about_a_thread) {
  cpu_set_t set;
  EXPECT_FAILS(getrusage(RUSAGE_SELF, nowhere), EFAULT);
  EXPECT_FAILS(prctl(PR_SET_NAME, nowhere), EFAULT);
  EXPECT_FAILS(prctl(PR_GET_NAME, nowhere), EFAULT);
  EXPECT_FAILS(sched_setaffinity(0, sizeof set, nowhere), EFAULT);
  EXPECT_IS(sched_getaffinity(0, sizeof set, &set), 0);
  EXPECT_IS(sched_setaffinity(0, sizeof set, &set), 0);
  EXPECT_FAILS(sched_getaffinity(0, 4, &set), EINVAL);
  EXPECT_FAILS(sched_getparam(0, nowhere), EFAULT);
  EXPECT_FAILS(sched_setparam(0, nowhere), EFAULT);
  EXPECT_FAILS(sched_setscheduler(0, SCHED_OTHER, nowhere), EFAULT);
  EXPECT_FAILS(sched_rr_get_interval(0, nowhere), EFAULT);
  EXPECT_IS(pthread_getname_np(pthread_self(), nowhere, 16), EFAULT);
}
CASE(of_signals) {
  const long size = 8;
  EXPECT_FAILS(sigaltstack(nowhere, NULL), EFAULT);
  EXPECT_FAILS(sigpending(nowhere), EFAULT);
  EXPECT_FAILS(sigsuspend(nowhere), EFAULT);
  EXPECT_FAILS(sigwaitinfo(nowhere, NULL), EFAULT);
  int taken = 0;
  EXPECT_IS(sigwait(nowhere, &taken), EFAULT);
  EXPECT_FAILS(sigprocmask(SIG_BLOCK, NULL, nowhere), EFAULT);
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, NULL, nowhere), EFAULT);
  EXPECT_FAILS(signalfd(-1, nowhere, 0), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigprocmask, SIG_BLOCK, nowhere, NULL, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigprocmask, SIG_BLOCK, NULL, nowhere, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigaction, SIGUSR1, nowhere, NULL, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigaction, SIGUSR1, NULL, nowhere, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigsuspend, nowhere, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigsuspend, nowhere, 4L), EINVAL);
  EXPECT_FAILS(syscall(SYS_rt_sigtimedwait, nowhere, NULL, NULL, size), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_sigqueueinfo, getpid(), SIGUSR1, nowhere), EFAULT);
  EXPECT_FAILS(syscall(SYS_rt_tgsigqueueinfo, getpid(), gettid(), SIGUSR1, nowhere), EFAULT);
}
CASE(of_system_v) {
  const int set = semget(IPC_PRIVATE, 1, 0600), queue = msgget(IPC_PRIVATE, 0600),
            segment = shmget(IPC_PRIVATE, 1, 0600);
  struct sembuf operation = {0, 1, 0};
  long message[2] = {1, 0};
  EXPECT_FAILS(semop(set, nowhere, 1), EFAULT);
  EXPECT_FAILS(semtimedop(set, &operation, 1, nowhere), EFAULT);
  EXPECT_FAILS(semctl(set, 0, IPC_STAT, nowhere), EFAULT);
  EXPECT_FAILS(semctl(set, 0, IPC_SET, nowhere), EFAULT);
  EXPECT_FAILS(semctl(set, 0, GETALL, nowhere), EFAULT);
  EXPECT_FAILS(semctl(set, 0, SETALL, nowhere), EFAULT);
  EXPECT_FAILS(msgsnd(queue, nowhere, 1, 0), EFAULT);
  EXPECT_FAILS(msgctl(queue, IPC_STAT, nowhere), EFAULT);
  EXPECT_FAILS(msgctl(queue, IPC_SET, nowhere), EFAULT);
  EXPECT_IS(msgsnd(queue, message, 8, 0), 0);
  EXPECT_FAILS(msgrcv(queue, nowhere, 8, 0, 0), EFAULT);
  EXPECT_FAILS(shmctl(segment, IPC_STAT, nowhere), EFAULT);
  EXPECT_FAILS(shmctl(segment, IPC_SET, nowhere), EFAULT);
  semctl(set, 0, IPC_RMID);
  msgctl(queue, IPC_RMID, NULL);
  shmctl(segment, IPC_RMID, NULL);
}
