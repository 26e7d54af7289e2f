// SPDX-License-Identifier: BSD-3-Clause
// Implicit closing of descriptors: ranges, streams, and replacement by others.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>

static int ends[2];

CASE(a_range_is_closed) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(close_range((unsigned)ends[0], (unsigned)ends[1], 0), 0);
  EXPECT_FAILS(fcntl(ends[0], F_GETFD), EBADF);
  EXPECT_FAILS(fcntl(ends[1], F_GETFD), EBADF);
  EXPECT_FAILS(close_range(5, 3, 0), EINVAL);
  EXPECT_FAILS(close_range(3, 5, 64), EINVAL);
}
CASE(a_range_may_be_closed_by_the_next_program_alone) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(close_range((unsigned)ends[0], (unsigned)ends[1], CLOSE_RANGE_CLOEXEC), 0);
  EXPECT_IS(fcntl(ends[0], F_GETFD), FD_CLOEXEC);
}

// One thread reads while another closes the last write end.
static void expect_the_end(void* (*close_it)(void*), void* argument) {
  const pthread_t closing = start(close_it, argument);
  char byte;
  EXPECT_IS(read(ends[0], &byte, 1), 0);
  join(closing);
}
static void* close_range_later(void* unused) {
  sleep_ms(5);
  EXPECT_IS(close_range((unsigned)ends[1], (unsigned)ends[1], 0), 0);
  return unused;
}
static void* close_range_by_number_later(void* unused) {
  sleep_ms(5);
  EXPECT_IS(syscall(SYS_close_range, ends[1], ends[1], 0), 0);
  return unused;
}
static void* close_stream_later(void* stream) {
  sleep_ms(5);
  EXPECT_IS(fclose(stream), 0);
  return NULL;
}
static void* replace_later(void* unused) {
  sleep_ms(5);
  EXPECT_IS(dup2(open("/dev/null", O_WRONLY), ends[1]), ends[1]);
  return unused;
}
CASE(a_closed_range_ends_reading) {
  EXPECT_IS(pipe(ends), 0);
  expect_the_end(close_range_later, NULL);
}
CASE(a_range_closed_by_number_ends_reading) {
  EXPECT_IS(pipe(ends), 0);
  expect_the_end(close_range_by_number_later, NULL);
}
CASE(a_closed_stream_ends_reading) {
  EXPECT_IS(pipe(ends), 0);
  expect_the_end(close_stream_later, fdopen(ends[1], "w"));
}
CASE(another_in_its_place_ends_reading) {
  EXPECT_IS(pipe(ends), 0);
  expect_the_end(replace_later, NULL);
}

// An armed timer, and the descriptor that reuses its number after it was closed.
static int timer_due_soon(void) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec soon = {{0, 0}, {0, 1000000}};
  EXPECT_IS(timerfd_settime(timer, 0, &soon, NULL), 0);
  return timer;
}
static void expect_nothing_comes_to(int number) {
  struct pollfd one = {eventfd(0, 0), POLLIN, 0};
  EXPECT_IS(one.fd, number);
  sleep_ms(5);
  EXPECT_IS(poll(&one, 1, 0), 0);
}
CASE(a_timer_ends_with_its_range) {
  const int timer = timer_due_soon();
  closefrom(timer);
  expect_nothing_comes_to(timer);
}
CASE(a_timer_ends_with_its_stream) {
  const int timer = timer_due_soon();
  EXPECT_IS(fclose(fdopen(timer, "r")), 0);
  expect_nothing_comes_to(timer);
}
CASE(timers_and_signals_cannot_be_written) {
  const uint64_t one = 1;
  EXPECT_FAILS(write(timer_due_soon(), &one, sizeof one), EINVAL);
}
