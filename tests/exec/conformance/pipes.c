// SPDX-License-Identifier: BSD-3-Clause
// Pipes, and copies of their ends.
#include "tests/exec/conformance/harness.h"

#include <limits.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/file.h>
#include <sys/uio.h>

static int ends[2];
static atomic_int done, handled;
static char big[300000];
static void make_pipe(void) { EXPECT_IS(pipe(ends), 0); }

static void set_nonblocking(int descriptor) {
  EXPECT_IS(fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK), 0);
}

static void* write_one(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  return unused;
}

static void* close_writer(void* unused) {
  let_others_wait();
  EXPECT_IS(close(ends[1]), 0);
  return unused;
}

static void* close_reader(void* unused) {
  let_others_wait();
  EXPECT_IS(close(ends[0]), 0);
  return unused;
}

static void* read_big(void* unused) {
  static char read_bytes[sizeof big];
  size_t count = 0;
  let_others_wait();
  while (count < sizeof big) {
    const ssize_t got = read(ends[0], read_bytes + count, sizeof big - count);
    EXPECT(got > 0);
    count += (size_t)got;
  }
  EXPECT_IS(memcmp(read_bytes, big, sizeof big), 0);
  return unused;
}

static void fill_big(void) {
  for (size_t i = 0; i < sizeof big; ++i) big[i] = (char)(i * 7 + i / 1000);
}

static void count_signal(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}
CASE(read_waits_for_what_is_written) {
  make_pipe();
  char byte = 0;
  const pthread_t id = start(write_one, NULL);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  EXPECT_IS(byte, 'x');
  EXPECT_IS(done, 1);
  join(id);
}
CASE(read_gives_what_is_there) {
  make_pipe();
  char text[10] = "";
  EXPECT_IS(write(ends[1], "abc", 3), 3);
  EXPECT_IS(read(ends[0], text, 10), 3);
  EXPECT_IS(strcmp(text, "abc"), 0);
  EXPECT_IS(read(ends[0], text, 0), 0);
}
CASE(read_ends_with_the_last_writer) {
  make_pipe();
  char byte;
  const int copy = dup(ends[1]);
  const pthread_t id = start(close_writer, NULL);
  EXPECT_IS(write(copy, "y", 1), 1);
  EXPECT_IS(close(copy), 0);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  EXPECT_IS(read(ends[0], &byte, 1), 0);
  join(id);
}
CASE(write_waits_for_room) {
  make_pipe();
  fill_big();
  const pthread_t id = start(read_big, NULL);
  EXPECT_IS(write(ends[1], big, sizeof big), (long long)sizeof big);
  join(id);
}
CASE(writev_and_readv_take_pieces) {
  make_pipe();
  char first[3] = "", second[10] = "";
  const struct iovec out[] = {{"abc", 3}, {NULL, 0}, {"defg", 4}};
  const struct iovec in[] = {{first, 2}, {second, 9}};
  EXPECT_IS(writev(ends[1], out, 3), 7);
  EXPECT_IS(readv(ends[0], in, 2), 7);
  EXPECT_IS(strcmp(first, "ab"), 0);
  EXPECT_IS(strcmp(second, "cdefg"), 0);
}
CASE(writev_waits_for_room) {
  make_pipe();
  fill_big();
  const struct iovec out[] = {{big, 100000}, {big + 100000, sizeof big - 100000}};
  const pthread_t id = start(read_big, NULL);
  EXPECT_IS(writev(ends[1], out, 2), (long long)sizeof big);
  join(id);
}
CASE(without_blocking_nothing_waits) {
  make_pipe();
  char byte;
  set_nonblocking(ends[0]);
  set_nonblocking(ends[1]);
  EXPECT_FAILS(read(ends[0], &byte, 1), EAGAIN);
  ssize_t count, all = 0;
  while ((count = write(ends[1], big, sizeof big)) > 0) all += count;
  EXPECT_IS(count, -1);
  EXPECT_IS(errno, EAGAIN);
  EXPECT(all >= PIPE_BUF);
  EXPECT_FAILS(write(ends[1], big, PIPE_BUF), EAGAIN);
}
CASE(pipe2_sets_flags) {
  EXPECT_IS(pipe2(ends, O_NONBLOCK | O_CLOEXEC), 0);
  char byte;
  EXPECT_FAILS(read(ends[0], &byte, 1), EAGAIN);
  EXPECT_IS(fcntl(ends[0], F_GETFD), FD_CLOEXEC);
  EXPECT_FAILS(pipe2(ends, 0x1234), EINVAL);
}
CASE(writing_without_readers_is_an_error_and_a_signal) {
  make_pipe();
  signal(SIGPIPE, count_signal);
  close(ends[0]);
  EXPECT_FAILS(write(ends[1], "x", 1), EPIPE);
  EXPECT_IS(handled, 1);
  signal(SIGPIPE, SIG_IGN);
  EXPECT_FAILS(write(ends[1], "x", 1), EPIPE);
}
CASE_ENDING_WITH(-13, writing_without_readers_ends_the_process) {
  make_pipe();
  close(ends[0]);
  write(ends[1], "x", 1) == 1 ? _exit(1) : _exit(2);
}

static atomic_int pipe_signal_of;
static pthread_t sender;

static void note_thread(int signal) {
  (void)signal;
  pipe_signal_of = pthread_equal(pthread_self(), sender) ? 1 : 2;
}

static void* write_in_vain(void* unused) {
  sender = pthread_self();
  EXPECT_FAILS(write(ends[1], "x", 1), EPIPE);
  EXPECT_IS(pipe_signal_of, 1);
  return unused;
}
CASE(the_signal_of_a_broken_pipe_is_the_writers) {
  make_pipe();
  signal(SIGPIPE, note_thread);
  close(ends[0]);
  join(start(write_in_vain, NULL));
}
CASE(a_waiting_writer_learns_that_nobody_reads) {
  make_pipe();
  signal(SIGPIPE, SIG_IGN);
  const pthread_t id = start(close_reader, NULL);
  const ssize_t written = write(ends[1], big, sizeof big);
  EXPECT(written > 0 ? written < (ssize_t)sizeof big : errno == EPIPE);
  join(id);
}

static long long ended_ns;

static void* read_to_the_end(void* unused) {
  char byte;
  EXPECT_IS(read(ends[0], &byte, 1), 0);
  ended_ns = now_ns(CLOCK_MONOTONIC);
  return unused;
}
CASE(a_reader_learns_at_once_that_nobody_writes) {
  make_pipe();
  const pthread_t id = start(read_to_the_end, NULL);
  let_others_wait();
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(close(ends[1]), 0);
  sleep_ms(1500);
  join(id);
  EXPECT(ended_ns - begin < 1000000000);
}
CASE(what_is_not_open_is_refused) {
  char byte;
  struct iovec piece = {&byte, 1};
  EXPECT_FAILS(read(999, &byte, 1), EBADF);
  EXPECT_FAILS(write(999, &byte, 1), EBADF);
  EXPECT_FAILS(readv(999, &piece, 1), EBADF);
  EXPECT_FAILS(writev(999, &piece, 1), EBADF);
  EXPECT_FAILS(close(999), EBADF);
  EXPECT_FAILS(dup(999), EBADF);
  EXPECT_FAILS(dup2(999, 5), EBADF);
  make_pipe();
  EXPECT_FAILS(read(ends[1], &byte, 1), EBADF);
  EXPECT_FAILS(write(ends[0], &byte, 1), EBADF);
  volatile int less_than_none = -1;
  EXPECT_FAILS(readv(ends[0], &piece, less_than_none), EINVAL);
}

static void* read_once(void* unused) {
  char byte;
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  atomic_fetch_add(&done, 1);
  return unused;
}
CASE(each_byte_goes_to_one_of_several_readers) {
  make_pipe();
  pthread_t ids[3];
  for (int i = 0; i < 3; ++i) ids[i] = start(read_once, NULL);
  let_others_wait();
  for (int i = 1; i <= 3; ++i) {
    EXPECT_IS(write(ends[1], "x", 1), 1);
    while (done < i) sched_yield();
    sleep_ms(1);
    EXPECT_IS(done, i);
  }
  for (int i = 0; i < 3; ++i) join(ids[i]);
}
CASE(copies_are_of_the_same_pipe) {
  make_pipe();
  char byte;
  const int copy = dup(ends[0]), again = dup2(ends[1], 60), third = dup3(ends[1], 61, O_CLOEXEC);
  EXPECT(copy >= 0);
  EXPECT_IS(again, 60);
  EXPECT_IS(third, 61);
  EXPECT_IS(fcntl(61, F_GETFD), FD_CLOEXEC);
  EXPECT_IS(write(again, "x", 1), 1);
  EXPECT_IS(read(copy, &byte, 1), 1);
  const int fourth = fcntl(ends[0], F_DUPFD, 70);
  EXPECT_IS(fourth, 70);
  const int fifth = fcntl(ends[0], F_DUPFD_CLOEXEC, 80);
  EXPECT_IS(fifth, 80);
  EXPECT_IS(write(third, "x", 1), 1);
  EXPECT_IS(read(fourth, &byte, 1), 1);
  EXPECT_FAILS(dup3(ends[0], ends[0], 0), EINVAL);
  EXPECT_IS(dup2(ends[0], ends[0]), ends[0]);
}

static void* write_to_60(void* unused) {
  let_others_wait();
  EXPECT_IS(write(60, "x", 1), 1);
  return unused;
}
CASE(a_copy_wakes_who_reads) {
  make_pipe();
  char byte;
  EXPECT_IS(dup2(ends[1], 60), 60);
  const pthread_t id = start(write_to_60, NULL);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  join(id);
}
