// SPDX-License-Identifier: BSD-3-Clause
// Process descriptors: pidfd_open() and its uses.
#include "tests/exec/conformance/harness.h"

#include <poll.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/pidfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>

static pid_t child_that_sleeps(int ms, int status) {
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(ms);
    _exit(status);
  }
  return child;
}

CASE(it_is_ready_when_its_process_has_ended) {
  const pid_t child = child_that_sleeps(20, 3);
  struct pollfd one = {pidfd_open(child, 0), POLLIN, 0};
  EXPECT_IS(poll(&one, 1, 0), 0);
  EXPECT_IS(poll(&one, 1, 5000), 1);
  siginfo_t information = {0};
  EXPECT_IS(waitid(P_PIDFD, (id_t)one.fd, &information, WEXITED), 0);
  EXPECT_IS(information.si_pid, child);
  EXPECT_IS(information.si_status, 3);
}
CASE(its_process_is_waited_for) {
  const int descriptor = pidfd_open(child_that_sleeps(20, 4), 0);
  siginfo_t information;
  memset(&information, 1, sizeof information);
  EXPECT_IS(waitid(P_PIDFD, (id_t)descriptor, &information, WEXITED | WNOHANG), 0);
  EXPECT_IS(information.si_pid, 0);
  EXPECT_IS(waitid(P_PIDFD, (id_t)descriptor, &information, WEXITED), 0);
  EXPECT_IS(information.si_status, 4);
}
CASE(it_can_be_watched) {
  const pid_t child = child_that_sleeps(20, 4);
  const int watch = epoll_create1(0);
  struct epoll_event event = {.events = EPOLLIN, .data.u32 = 5};
  EXPECT_IS(epoll_ctl(watch, EPOLL_CTL_ADD, pidfd_open(child, 0), &event), 0);
  memset(&event, 0, sizeof event);
  EXPECT_IS(epoll_wait(watch, &event, 1, 5000), 1);
  EXPECT_IS(event.data.u32, 5);
  EXPECT_IS(waitpid(child, NULL, 0), child);
}

CASE(a_signal_is_sent_to_a_child) {
  const pid_t child = child_that_sleeps(9000, 4);
  const int descriptor = pidfd_open(child, 0);
  EXPECT_IS(pidfd_send_signal(descriptor, SIGTERM, NULL, 0), 0);
  int status = 0;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  EXPECT_FAILS(pidfd_send_signal(descriptor, 0, NULL, 0), ESRCH);
}

static volatile sig_atomic_t handled, told;
static void handle(int signal, siginfo_t* information, void* context) {
  (void)context;
  handled = signal;
  told = information->si_value.sival_int;
}
CASE(a_signal_to_oneself_is_handled_before_the_call_returns) {
  const struct sigaction action = {.sa_sigaction = handle, .sa_flags = SA_SIGINFO};
  sigaction(SIGUSR1, &action, NULL);
  const int descriptor = pidfd_open(getpid(), 0);
  EXPECT_IS(pidfd_send_signal(descriptor, SIGUSR1, NULL, 0), 0);
  EXPECT_IS(handled, SIGUSR1);
  handled = 0;
  siginfo_t information = {.si_signo = SIGUSR1, .si_code = SI_QUEUE};
  information.si_pid = getpid();
  information.si_uid = getuid();
  information.si_value.sival_int = 77;
  EXPECT_IS(pidfd_send_signal(descriptor, SIGUSR1, &information, 0), 0);
  EXPECT_IS(handled, SIGUSR1);
  EXPECT_IS(told, 77);
  EXPECT_IS(pidfd_send_signal(descriptor, 0, NULL, 0), 0);
  EXPECT_FAILS(pidfd_send_signal(descriptor, 999, NULL, 0), EINVAL);
  EXPECT_FAILS(pidfd_send_signal(descriptor, SIGUSR1, NULL, 77), EINVAL);
}

static sigset_t only(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  return set;
}
static void* await_signal(void* unused) {
  const sigset_t set = only(SIGUSR2);
  return (char*)unused + sigwaitinfo(&set, NULL);
}
CASE(a_signal_to_oneself_wakes_who_waits_for_it) {
  const sigset_t set = only(SIGUSR2);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  const pthread_t waiting = start(await_signal, NULL);
  let_others_wait();
  EXPECT_IS(syscall(SYS_pidfd_send_signal, pidfd_open(getpid(), 0), SIGUSR2, NULL, 0), 0);
  EXPECT_IS((intptr_t)join(waiting), SIGUSR2);
}

static void* write_later(void* descriptor) {
  sleep_ms(5);
  EXPECT_IS(write((int)(intptr_t)descriptor, "y", 1), 1);
  return NULL;
}
CASE(what_is_taken_of_oneself_is_another_name_of_it) {
  int ends[2];
  char byte = 0;
  EXPECT_IS(pipe(ends), 0);
  const int copy = pidfd_getfd(pidfd_open(getpid(), 0), ends[1], 0);
  const pthread_t writing = start(write_later, (void*)(intptr_t)copy);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  join(writing);
  EXPECT_IS(byte, 'y');
  close(ends[1]);
  close(copy);
  EXPECT_IS(read(ends[0], &byte, 1), 0);
}

CASE(what_is_no_process_is_refused) {
  siginfo_t information;
  EXPECT_FAILS(pidfd_open(-1, 0), EINVAL);
  EXPECT_FAILS(pidfd_open(getpid(), ~0U), EINVAL);
  EXPECT_FAILS(pidfd_open(0x3FFFFFF, 0), ESRCH);
  EXPECT_FAILS(waitid(P_PIDFD, (id_t)-1, &information, WEXITED), EINVAL);
  EXPECT_FAILS(waitid(P_PIDFD, 999, &information, WEXITED), EBADF);
  EXPECT_FAILS(pidfd_send_signal(999, SIGUSR1, NULL, 0), EBADF);
  EXPECT_FAILS(pidfd_getfd(999, 0, 0), EBADF);
}
