// SPDX-License-Identifier: BSD-3-Clause
// Pipes whose bytes pass by several kinds of calls: read() and write(), vectors, splices, streams, other processes.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>

extern int __dprintf_chk(int, int, const char*, ...);
extern int __vdprintf_chk(int, int, const char*, va_list);

static int ends[2], others[2];
static char bytes[200000];
static void make_pipe(void) { EXPECT_IS(pipe(ends), 0); }
static void put(const char* text) { EXPECT_IS(write(ends[1], text, strlen(text)), (ssize_t)strlen(text)); }
static void expect_next(const char* text) {
  const size_t size = strlen(text);
  EXPECT_IS(read(ends[0], bytes, size), (ssize_t)size);
  EXPECT_IS(memcmp(bytes, text, size), 0);
}

CASE(ioctl_makes_an_end_nonblocking) {
  make_pipe();
  int on = 1, held = -1;
  put("ab");
  EXPECT_IS(ioctl(ends[0], FIONREAD, &held), 0);
  EXPECT_IS(held, 2);
  EXPECT_IS(ioctl(ends[0], FIONBIO, &on), 0);
  expect_next("ab");
  EXPECT_FAILS(read(ends[0], bytes, 1), EAGAIN);
  on = 0;
  EXPECT_IS(ioctl(ends[0], FIONBIO, &on), 0);
  put("c");
  expect_next("c");
  EXPECT_FAILS(ioctl(-1, FIONREAD, &held), EBADF);
}

CASE(vectors_take_what_calls_have_written) {
  make_pipe();
  put("abcdef");
  char first[2], second[2];
  const struct iovec parts[] = {{first, 2}, {second, 2}};
  EXPECT_IS(readv(ends[0], parts, 2), 4);
  expect_next("ef");
  EXPECT_IS(writev(ends[1], parts, 2), 4);
  expect_next("abcd");
}

CASE(a_splice_takes_what_calls_have_written) {
  make_pipe();
  EXPECT_IS(pipe(others), 0);
  put("abcd");
  EXPECT_IS(splice(ends[0], NULL, others[1], NULL, 2, 0), 2);
  expect_next("cd");
  EXPECT_IS(read(others[0], bytes, 10), 2);
  put("e");
  expect_next("e");
}

static int print_by_vector(int descriptor, const char* format, ...) {
  va_list words;
  va_start(words, format);
  const int size = vdprintf(descriptor, format, words);
  va_end(words);
  return size;
}
static int print_checked(int descriptor, const char* format, ...) {
  va_list words;
  va_start(words, format);
  const int size = __vdprintf_chk(descriptor, 1, format, words);
  va_end(words);
  return size;
}
static void* print(void* unused) {
  let_others_wait();
  EXPECT_IS(dprintf(ends[1], "%d apples", 7), 8);
  EXPECT_IS(print_by_vector(ends[1], ", %s", "3 pears"), 9);
  EXPECT_IS(__dprintf_chk(ends[1], 1, ".%c", '.'), 2);
  EXPECT_IS(print_checked(ends[1], "%s", "!"), 1);
  return unused;
}
CASE(dprintf_wakes_a_reader) {
  make_pipe();
  const pthread_t id = start(print, NULL);
  expect_next("7 apples");
  join(id);
  expect_next(", 3 pears..!");
  EXPECT_FAILS(dprintf(-1, "x"), EBADF);
}

CASE(a_pipe_takes_its_capacity_and_gives_it_back) {
  make_pipe();
  const int capacity = fcntl(ends[1], F_GETPIPE_SZ);
  EXPECT(capacity >= 4096 && (size_t)capacity <= sizeof bytes);
  for (int round = 0; round < 3; ++round) {
    EXPECT_IS(write(ends[1], bytes, (size_t)capacity), capacity);
    size_t count = 0;
    while (count < (size_t)capacity) {
      const ssize_t got = read(ends[0], bytes, 3000);
      EXPECT(got > 0);
      count += (size_t)got;
    }
  }
  EXPECT_IS(fcntl(ends[1], F_SETPIPE_SZ, 4096), 4096);
  EXPECT_IS(write(ends[1], bytes, 4096), 4096);
  EXPECT_IS(read(ends[0], bytes, sizeof bytes), 4096);
}

static void* read_slowly(void* unused) {
  size_t count = 0;
  char some[1000];
  for (ssize_t got; (got = read(ends[0], some, sizeof some)) > 0; count += (size_t)got)
    if (count % 7000 == 0) sleep_ms(1);
  EXPECT_IS(count, sizeof bytes);
  return unused;
}
CASE(a_writer_waits_for_a_slow_reader) {
  make_pipe();
  const pthread_t id = start(read_slowly, NULL);
  EXPECT_IS(write(ends[1], bytes, sizeof bytes), (ssize_t)sizeof bytes);
  EXPECT_IS(close(ends[1]), 0);
  join(id);
}

static char* volatile nowhere = (char*)8;
CASE(bad_addresses_take_nothing_from_a_pipe) {
  make_pipe();
  put("abc");
  EXPECT_FAILS(read(ends[0], nowhere, 2), EFAULT);
  expect_next("abc");
  EXPECT_FAILS(write(ends[1], nowhere, 2), EFAULT);
  put("d");
  expect_next("d");
}

static ssize_t send_descriptor(int by, int passed) {
  char byte = 0, control[CMSG_SPACE(sizeof(int))];
  struct iovec part = {&byte, 1};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
  struct cmsghdr* const head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof(int));
  memcpy(CMSG_DATA(head), &passed, sizeof passed);
  return sendmsg(by, &message, 0);
}
static int receive_descriptor(int by) {
  char byte = 0, control[CMSG_SPACE(sizeof(int))];
  struct iovec part = {&byte, 1};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
  EXPECT_IS(recvmsg(by, &message, 0), 1);
  int passed = -1;
  memcpy(&passed, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof passed);
  return passed;
}
CASE(a_passed_duplicate_takes_bytes) {
  make_pipe();
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, others), 0);
  put("abc");
  EXPECT_IS(send_descriptor(others[0], ends[0]), 1);
  const int duplicate = receive_descriptor(others[1]);
  EXPECT_IS(read(duplicate, bytes, 2), 2);
  expect_next("c");
  EXPECT_IS(write(ends[1], "d", 1), 1);
  EXPECT_IS(read(duplicate, bytes, 2), 1);
}

// More than a pipe holds: the child's stream waits in the C library.
CASE(a_forked_child_prints_by_its_standard_stream) {
  enum { lines = 20000 };
  make_pipe();
  const pid_t child = fork();
  if (child == 0) {
    if (dup2(ends[1], STDOUT_FILENO) < 0 || close(ends[0]) != 0 || close(ends[1]) != 0) _exit(1);
    for (int i = 0; i < lines; ++i) printf("%07d\n", i);
    fflush(stdout);
    _exit(0);
  }
  EXPECT_IS(close(ends[1]), 0);
  size_t count = 0;
  for (ssize_t got; (got = read(ends[0], bytes, sizeof bytes)) > 0;) count += (size_t)got;
  EXPECT_IS(count, lines * 8);
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(status, 0);
}

CASE(processes_pass_bytes_to_and_fro) {
  make_pipe();
  EXPECT_IS(pipe(others), 0);
  const pid_t child = fork();
  if (child == 0) {
    char byte = 0;
    for (int i = 0; i < 100; ++i) {
      if (read(ends[0], &byte, 1) != 1) _exit(1);
      ++byte;
      if (write(others[1], &byte, 1) != 1) _exit(2);
    }
    _exit(byte);
  }
  char byte = 0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_IS(write(ends[1], &byte, 1), 1);
    EXPECT_IS(read(others[0], &byte, 1), 1);
    EXPECT_IS(byte, i + 1);
  }
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(WEXITSTATUS(status), 100);
}
