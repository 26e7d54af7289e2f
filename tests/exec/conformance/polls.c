// SPDX-License-Identifier: BSD-3-Clause
// Waiting for several descriptors: poll, select, epoll.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <poll.h>
#include <stdatomic.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/select.h>

static int one[2], other[2];
static void make_pipes(void) {
  EXPECT_IS(pipe(one), 0);
  EXPECT_IS(pipe(other), 0);
}
static void* write_to_other(void* unused) {
  let_others_wait();
  EXPECT_IS(write(other[1], "x", 1), 1);
  return unused;
}
static void* close_other(void* unused) {
  let_others_wait();
  EXPECT_IS(close(other[1]), 0);
  return unused;
}

CASE(poll_tells_what_is_ready) {
  make_pipes();
  struct pollfd both[] = {{one[0], POLLIN, 0}, {one[1], POLLOUT, 0}};
  EXPECT_IS(poll(both, 2, -1), 1);
  EXPECT_IS(both[0].revents, 0);
  EXPECT_IS(both[1].revents, POLLOUT);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(poll(both, 2, -1), 2);
  EXPECT_IS(both[0].revents, POLLIN);
}
CASE(poll_waits_for_any) {
  make_pipes();
  struct pollfd both[] = {{one[0], POLLIN, 0}, {other[0], POLLIN, 0}};
  const pthread_t id = start(write_to_other, NULL);
  EXPECT_IS(poll(both, 2, -1), 1);
  EXPECT_IS(both[0].revents, 0);
  EXPECT_IS(both[1].revents, POLLIN);
  join(id);
}
CASE(poll_ends_at_its_time) {
  make_pipes();
  struct pollfd both[] = {{one[0], POLLIN, 0x7F}, {-5, POLLIN, 0x7F}};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(poll(both, 2, 20), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT_IS(both[0].revents, 0);
  EXPECT_IS(both[1].revents, 0);
  EXPECT_IS(poll(both, 2, 0), 0);
  EXPECT_IS(poll(NULL, 0, 1), 0);
}
CASE(poll_tells_of_ends_and_of_what_is_not_open) {
  make_pipes();
  struct pollfd both[] = {{other[0], POLLIN, 0}, {999, POLLIN, 0}};
  EXPECT_IS(poll(both, 2, -1), 1);
  EXPECT_IS(both[1].revents, POLLNVAL);
  const pthread_t id = start(close_other, NULL);
  EXPECT_IS(poll(both, 1, -1), 1);
  EXPECT_IS(both[0].revents, POLLHUP);
  join(id);
  close(one[0]);
  both[0].fd = one[1];
  both[0].events = 0;
  EXPECT_IS(poll(both, 1, -1), 1);
  EXPECT_IS(both[0].revents, POLLERR);
}
CASE(ppoll_has_a_finer_time) {
  make_pipes();
  struct pollfd only = {one[0], POLLIN, 0};
  const struct timespec timeout = {0, 5000000}, invalid = {0, 1000000000}, negative = {-1, 0};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(ppoll(&only, 1, &timeout, NULL), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 5000000);
  EXPECT_FAILS(ppoll(&only, 1, &invalid, NULL), EINVAL);
  EXPECT_FAILS(ppoll(&only, 1, &negative, NULL), EINVAL);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(ppoll(&only, 1, NULL, NULL), 1);
}
CASE(regular_files_are_always_ready) {
  struct pollfd only = {open("/etc/passwd", O_RDONLY), POLLIN | POLLOUT, 0};
  EXPECT_IS(poll(&only, 1, -1), 1);
  EXPECT_IS(only.revents, POLLIN | POLLOUT);
}

static fd_set set_of(int first, int second) {
  fd_set set;
  FD_ZERO(&set);
  FD_SET(first, &set);
  if (second >= 0) FD_SET(second, &set);
  return set;
}
CASE(select_leaves_what_is_ready) {
  make_pipes();
  fd_set readable = set_of(one[0], other[0]), writable = set_of(one[1], -1);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(select(other[1] + 1, &readable, &writable, NULL, NULL), 2);
  EXPECT(FD_ISSET(one[0], &readable) && !FD_ISSET(other[0], &readable) && FD_ISSET(one[1], &writable));
}
CASE(select_waits_for_any) {
  make_pipes();
  fd_set readable = set_of(one[0], other[0]);
  const pthread_t id = start(write_to_other, NULL);
  EXPECT_IS(select(other[1] + 1, &readable, NULL, NULL, NULL), 1);
  EXPECT(!FD_ISSET(one[0], &readable) && FD_ISSET(other[0], &readable));
  join(id);
}
CASE(select_ends_at_its_time_and_tells_what_is_left) {
  make_pipes();
  fd_set readable = set_of(one[0], -1);
  struct timeval timeout = {0, 20000};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(select(one[0] + 1, &readable, NULL, NULL, &timeout), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT(!FD_ISSET(one[0], &readable));
  EXPECT(timeout.tv_sec == 0 && timeout.tv_usec == 0);
  timeout.tv_sec = 100;
  readable = set_of(other[0], -1);
  const pthread_t id = start(write_to_other, NULL);
  EXPECT_IS(select(other[0] + 1, &readable, NULL, NULL, &timeout), 1);
  EXPECT(timeout.tv_sec >= 98 && timeout.tv_sec < 100);
  join(id);
  timeout.tv_sec = 0;
  timeout.tv_usec = 1000;
  EXPECT_IS(select(0, NULL, NULL, NULL, &timeout), 0);
}
CASE(select_refuses_what_is_not_open) {
  fd_set readable = set_of(60, -1);
  struct timeval timeout = {-1, 0};
  EXPECT_FAILS(select(61, &readable, NULL, NULL, NULL), EBADF);
  EXPECT_FAILS(select(-1, NULL, NULL, NULL, NULL), EINVAL);
  EXPECT_FAILS(select(0, NULL, NULL, NULL, &timeout), EINVAL);
}
CASE(pselect_leaves_its_time) {
  make_pipes();
  fd_set readable = set_of(one[0], -1);
  const struct timespec timeout = {0, 5000000}, invalid = {0, -1};
  EXPECT_IS(pselect(one[0] + 1, &readable, NULL, NULL, &timeout, NULL), 0);
  EXPECT_FAILS(pselect(0, NULL, NULL, NULL, &invalid, NULL), EINVAL);
  readable = set_of(one[0], -1);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(pselect(one[0] + 1, &readable, NULL, NULL, NULL, NULL), 1);
}

static int watch(int watched, unsigned events) {
  const int descriptor = epoll_create1(EPOLL_CLOEXEC);
  EXPECT(descriptor >= 0);
  struct epoll_event event = {.events = events, .data.fd = watched};
  EXPECT_IS(epoll_ctl(descriptor, EPOLL_CTL_ADD, watched, &event), 0);
  return descriptor;
}
CASE(epoll_tells_what_is_ready) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event events[4];
  EXPECT_IS(epoll_wait(descriptor, events, 4, 0), 0);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(epoll_wait(descriptor, events, 4, -1), 1);
  EXPECT_IS(events[0].events, EPOLLIN);
  EXPECT_IS(events[0].data.fd, one[0]);
  EXPECT_IS(epoll_wait(descriptor, events, 4, -1), 1);  // level-triggered
}
CASE(epoll_waits_for_any) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event event = {.events = EPOLLIN, .data.fd = other[0]};
  EXPECT_IS(epoll_ctl(descriptor, EPOLL_CTL_ADD, other[0], &event), 0);
  const pthread_t id = start(write_to_other, NULL);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
  EXPECT_IS(event.data.fd, other[0]);
  join(id);
}
CASE(epoll_ends_at_its_time) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event event;
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, 20), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
}
CASE(epoll_pwait2_has_a_finer_time) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event event;
  const struct timespec timeout = {0, 5000000}, invalid = {0, 1000000000};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(epoll_pwait2(descriptor, &event, 1, &timeout, NULL), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 5000000);
  EXPECT_FAILS(epoll_pwait2(descriptor, &event, 1, &invalid, NULL), EINVAL);
}
CASE(at_an_edge_epoll_tells_once) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN | EPOLLET);
  struct epoll_event event;
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, 5), 0);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
}
CASE(asked_for_once_epoll_tells_once) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN | EPOLLONESHOT);
  struct epoll_event event;
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, 5), 0);
  event.events = EPOLLIN | EPOLLONESHOT;
  EXPECT_IS(epoll_ctl(descriptor, EPOLL_CTL_MOD, one[0], &event), 0);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
}
static int waited_on;
static atomic_int told;
static void* wait_for_one(void* unused) {
  struct epoll_event event;
  EXPECT_IS(epoll_wait(waited_on, &event, 1, -1), 1);
  atomic_fetch_add(&told, 1);
  return unused;
}
CASE(at_an_edge_one_of_several_is_told) {
  make_pipes();
  waited_on = watch(one[0], EPOLLIN | EPOLLET);
  const pthread_t first = start(wait_for_one, NULL), second = start(wait_for_one, NULL);
  let_others_wait();
  EXPECT_IS(write(one[1], "x", 1), 1);
  sleep_ms(10);
  EXPECT_IS(told, 1);
  EXPECT_IS(write(one[1], "x", 1), 1);
  join(first);
  join(second);
}
static void* watch_more(void* descriptor) {
  let_others_wait();
  struct epoll_event event = {.events = EPOLLOUT, .data.fd = 77};
  EXPECT_IS(epoll_ctl(*(int*)descriptor, EPOLL_CTL_ADD, other[1], &event), 0);
  return NULL;
}
CASE(what_is_added_wakes_who_waits) {
  make_pipes();
  int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event event;
  const pthread_t id = start(watch_more, &descriptor);
  EXPECT_IS(epoll_wait(descriptor, &event, 1, -1), 1);
  EXPECT_IS(event.data.fd, 77);
  join(id);
}
CASE(an_epoll_can_be_watched) {
  make_pipes();
  const int inner = watch(one[0], EPOLLIN);
  const int outer = watch(inner, EPOLLIN);
  struct epoll_event event;
  struct pollfd only = {outer, POLLIN, 0};
  EXPECT_IS(poll(&only, 1, 0), 0);
  EXPECT_IS(write(one[1], "x", 1), 1);
  EXPECT_IS(poll(&only, 1, -1), 1);
  EXPECT_IS(epoll_wait(outer, &event, 1, -1), 1);
}
CASE(epoll_refuses_what_it_is_not) {
  make_pipes();
  const int descriptor = watch(one[0], EPOLLIN);
  struct epoll_event event = {.events = EPOLLIN};
  EXPECT_FAILS(epoll_ctl(descriptor, EPOLL_CTL_ADD, one[0], &event), EEXIST);
  EXPECT_FAILS(epoll_ctl(descriptor, EPOLL_CTL_MOD, other[0], &event), ENOENT);
  EXPECT_FAILS(epoll_ctl(descriptor, EPOLL_CTL_ADD, 999, &event), EBADF);
  EXPECT_FAILS(epoll_ctl(descriptor, EPOLL_CTL_ADD, descriptor, &event), EINVAL);
  EXPECT_FAILS(epoll_wait(descriptor, &event, 0, 0), EINVAL);
  EXPECT_FAILS(epoll_wait(999, &event, 1, -1), EBADF);
  EXPECT_FAILS(epoll_wait(one[0], &event, 1, -1), EINVAL);
  EXPECT_IS(epoll_create(1) >= 0, 1);
  EXPECT_FAILS(epoll_create(0), EINVAL);
  EXPECT_FAILS(epoll_create1(0x1234), EINVAL);
}

CASE(poll_refuses_more_than_may_be_open) {
  const struct rlimit few = {16, 16};
  EXPECT_IS(setrlimit(RLIMIT_NOFILE, &few), 0);
  struct pollfd many[20];
  memset(many, 0, sizeof many);
  EXPECT_FAILS(poll(many, 20, 0), EINVAL);
}
