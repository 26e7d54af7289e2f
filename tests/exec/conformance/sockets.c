// SPDX-License-Identifier: BSD-3-Clause
// Socket pairs: streams, datagrams, timeouts, and ends.
#include "tests/exec/conformance/sockets.h"

#include <signal.h>

static atomic_int handled;

CASE(recv_waits) {
  make_pair(SOCK_STREAM);
  char byte = 0;
  const pthread_t id = start(send_one, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  EXPECT_IS(byte, 'x');
  EXPECT_IS(done, 1);
  join(id);
}
CASE(nothing_waits_with_MSG_DONTWAIT) {
  make_pair(SOCK_STREAM);
  char byte = 0;
  EXPECT_FAILS(recv(ends[0], &byte, 1, MSG_DONTWAIT), EAGAIN);
  ssize_t count;
  while ((count = send(ends[1], big, 100000, MSG_DONTWAIT)) > 0) {
  }
  EXPECT_IS(count, -1);
  EXPECT_IS(errno, EAGAIN);
}
CASE(a_look_takes_nothing) {
  make_pair(SOCK_STREAM);
  char text[8] = "";
  EXPECT_IS(send(ends[1], "abc", 3, 0), 3);
  EXPECT_IS(recv(ends[0], text, 7, MSG_PEEK), 3);
  EXPECT_IS(recv(ends[0], text, 7, 0), 3);
}
CASE(send_waits_for_room) {
  make_pair(SOCK_STREAM);
  fill_big();
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(send(ends[1], big, sizeof big, MSG_NOSIGNAL), (long long)sizeof big);
  join(id);
}
CASE(write_waits_for_room) {
  make_pair(SOCK_STREAM);
  fill_big();
  const pthread_t id = start(receive_big, &ends[0]);
  EXPECT_IS(write(ends[1], big, sizeof big), (long long)sizeof big);
  join(id);
}
CASE(datagrams_keep_their_ends) {
  make_pair(SOCK_DGRAM);
  char text[8] = "";
  EXPECT_IS(send(ends[1], "abc", 3, 0), 3);
  EXPECT_IS(send(ends[1], "de", 2, 0), 2);
  EXPECT_IS(recv(ends[0], text, 2, 0), 2);
  EXPECT_IS(recv(ends[0], text, 8, 0), 2);
  EXPECT_IS(memcmp(text, "de", 2), 0);
}

static void* take_datagrams(void* unused) {
  char text[1000];
  let_others_wait();
  for (int i = 0; i < 1000; ++i) EXPECT_IS(recv(ends[0], text, sizeof text, 0), (long long)sizeof text);
  return unused;
}
CASE(datagrams_wait_for_room) {
  make_pair(SOCK_DGRAM);
  const pthread_t id = start(take_datagrams, NULL);
  for (int i = 0; i < 1000; ++i) EXPECT_IS(send(ends[1], big, 1000, 0), 1000);
  join(id);
}
CASE(a_time_to_receive_ends_it) {
  make_pair(SOCK_STREAM);
  const struct timeval timeout = {0, 20000};
  EXPECT_IS(setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout), 0);
  char byte;
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EAGAIN);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
  EXPECT_FAILS(read(ends[0], &byte, 1), EAGAIN);
  const pthread_t id = start(send_one, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  join(id);
}
CASE(a_time_to_send_ends_it) {
  make_pair(SOCK_STREAM);
  const struct timeval timeout = {0, 20000};
  EXPECT_IS(setsockopt(ends[1], SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout), 0);
  const ssize_t sent = send(ends[1], big, sizeof big, 0);
  EXPECT(sent > 0 && sent < (ssize_t)sizeof big);
  EXPECT_FAILS(send(ends[1], big, sizeof big, 0), EAGAIN);
}

static void* shut_down(void* unused) {
  let_others_wait();
  EXPECT_IS(shutdown(ends[1], SHUT_WR), 0);
  return unused;
}
CASE(shutdown_ends_receiving) {
  make_pair(SOCK_STREAM);
  char byte;
  const pthread_t id = start(shut_down, NULL);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 0);
  join(id);
  EXPECT_IS(send(ends[0], "x", 1, 0), 1);
  EXPECT_IS(recv(ends[1], &byte, 1, 0), 1);
  EXPECT_FAILS(shutdown(ends[0], 77), EINVAL);
}

static void count_signal(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}
CASE(sending_to_nobody_is_an_error_and_a_signal) {
  make_pair(SOCK_STREAM);
  signal(SIGPIPE, count_signal);
  close(ends[0]);
  EXPECT_FAILS(send(ends[1], "x", 1, 0), EPIPE);
  EXPECT_IS(handled, 1);
  EXPECT_FAILS(send(ends[1], "x", 1, MSG_NOSIGNAL), EPIPE);
  EXPECT_IS(handled, 1);
}
CASE(what_is_no_socket_is_refused) {
  int pipe_ends[2];
  char byte = 0;
  EXPECT_IS(pipe(pipe_ends), 0);
  EXPECT_FAILS(recv(pipe_ends[0], &byte, 1, 0), ENOTSOCK);
  EXPECT_FAILS(send(pipe_ends[1], &byte, 1, 0), ENOTSOCK);
  EXPECT_FAILS(recv(999, &byte, 1, 0), EBADF);
  EXPECT_FAILS(accept(999, NULL, NULL), EBADF);
  make_pair(SOCK_STREAM);
  EXPECT_FAILS(accept(ends[0], NULL, NULL), EINVAL);
}

// Noticed at once, not only when all threads are idle.
static long long told_at_ns;

static void* receive_end(void* unused) {
  char byte;
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 0);
  told_at_ns = now_ns(CLOCK_MONOTONIC);
  return unused;
}
CASE(shutdown_wakes_who_receives) {
  make_pair(SOCK_STREAM);
  const pthread_t id = start(receive_end, NULL);
  let_others_wait();
  const long long begin_ns = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(shutdown(ends[1], SHUT_RDWR), 0);
  sleep_ms(200);
  join(id);
  EXPECT(told_at_ns - begin_ns < 150000000);
}
CASE(nobody_waits_for_what_is_beside_a_stream) {
  int both[2];
  char bytes[4];
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, both), 0);
  EXPECT_FAILS(recv(both[0], bytes, 4, MSG_OOB), EINVAL);
  int other = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_FAILS(recv(other, bytes, 4, MSG_ERRQUEUE), EAGAIN);
}
