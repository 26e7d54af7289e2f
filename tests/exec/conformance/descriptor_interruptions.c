// SPDX-License-Identifier: BSD-3-Clause
// Signals during waits for descriptors: which calls end, and which continue.
#include "tests/exec/conformance/interruptions.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/uio.h>

static int ends[2];
static void write_one(void) { EXPECT_IS(write(ends[1], "x", 1), 1); }

static void read_all(void) {
  static char bytes[1 << 20];
  EXPECT(read(ends[0], bytes, sizeof bytes) > 0);
}
CASE(read_ends) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(read(ends[0], &byte, 1), EINTR);
  end(id);
}
CASE(read_goes_on_if_asked) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, write_one);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  end(id);
}
CASE(readv_ends) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const struct iovec piece = {&byte, 1};
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(readv(ends[0], &piece, 1), EINTR);
  end(id);
}

static void fill(int descriptor) {
  static const char bytes[4096];
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  while (write(descriptor, bytes, sizeof bytes) > 0) {
  }
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
}
CASE(write_ends) {
  EXPECT_IS(pipe(ends), 0);
  fill(ends[1]);
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(write(ends[1], "x", 1), EINTR);
  end(id);
}
CASE(write_goes_on_if_asked) {
  EXPECT_IS(pipe(ends), 0);
  fill(ends[1]);
  const pthread_t id = begin(SA_RESTART, read_all);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  end(id);
}
CASE(write_that_was_begun_tells_how_much) {
  EXPECT_IS(pipe(ends), 0);
  static char bytes[1 << 20];
  const pthread_t id = begin(0, NULL);
  const ssize_t written = write(ends[1], bytes, sizeof bytes);
  EXPECT(written > 0 && written < (ssize_t)sizeof bytes);
  end(id);
}
CASE(recv_ends) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  char byte;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EINTR);
  end(id);
}
CASE(recv_goes_on_if_asked) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, write_one);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  end(id);
}
CASE(recv_with_a_timeout_ends_whatever_is_asked) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  const struct timeval timeout = {5, 0};
  EXPECT_IS(setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EINTR);
  end(id);
}
CASE(an_eventfd_ends) {
  const int descriptor = eventfd(0, 0);
  eventfd_t value;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(read(descriptor, &value, sizeof value), EINTR);
  end(id);
}
CASE(poll_ends_whatever_is_asked) {
  EXPECT_IS(pipe(ends), 0);
  struct pollfd one = {ends[0], POLLIN, 0};
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(poll(&one, 1, -1), EINTR);
  end(id);
}
CASE(poll_with_a_timeout_ends) {
  EXPECT_IS(pipe(ends), 0);
  struct pollfd one = {ends[0], POLLIN, 0};
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(poll(&one, 1, 5000), EINTR);
  end(id);
}
CASE(select_ends) {
  EXPECT_IS(pipe(ends), 0);
  fd_set set;
  FD_ZERO(&set);
  FD_SET(ends[0], &set);
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(select(ends[0] + 1, &set, NULL, NULL, NULL), EINTR);
  end(id);
}
CASE(epoll_ends) {
  EXPECT_IS(pipe(ends), 0);
  const int descriptor = epoll_create1(0);
  struct epoll_event event = {.events = EPOLLIN};
  EXPECT_IS(epoll_ctl(descriptor, EPOLL_CTL_ADD, ends[0], &event), 0);
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(epoll_wait(descriptor, &event, 1, -1), EINTR);
  end(id);
}
static void handle_and_block(sigset_t* none) {
  act(0);
  sigset_t set;
  sigemptyset(none);
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
}
CASE(ppoll_waits_with_its_mask) {
  sigset_t none;
  handle_and_block(&none);
  const struct timespec none_at_all = {0, 0};
  raise(SIGUSR1);
  EXPECT_IS(ppoll(NULL, 0, &none_at_all, NULL), 0);
  EXPECT_IS(handled, 0);
  EXPECT_FAILS(ppoll(NULL, 0, NULL, &none), EINTR);
  EXPECT_IS(handled, 1);
  sigset_t now;
  pthread_sigmask(SIG_BLOCK, NULL, &now);
  EXPECT_IS(sigismember(&now, SIGUSR1), 1);
}
CASE(pselect_waits_with_its_mask) {
  sigset_t none;
  handle_and_block(&none);
  raise(SIGUSR1);
  EXPECT_FAILS(pselect(0, NULL, NULL, NULL, NULL, &none), EINTR);
  EXPECT_IS(handled, 1);
}
CASE(epoll_pwait_waits_with_its_mask) {
  sigset_t none;
  handle_and_block(&none);
  const int descriptor = epoll_create1(0);
  struct epoll_event event;
  raise(SIGUSR1);
  EXPECT_FAILS(epoll_pwait(descriptor, &event, 1, -1, &none), EINTR);
  EXPECT_IS(handled, 1);
}
