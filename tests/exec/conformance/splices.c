// SPDX-License-Identifier: BSD-3-Clause
// Calls that move pipe contents without copying to the program, and eventfd_read() and eventfd_write().
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/sendfile.h>
#include <sys/socket.h>
#include <sys/uio.h>

static int ends[2], others[2];
static char bytes[65536];
static int temp(void) {
  char path[] = "/tmp/waitpoint-splices-XXXXXX";
  const int d = mkstemp(path);
  EXPECT(d >= 0 && unlink(path) == 0);
  return d;
}
static void* write_later(void* unused) {
  let_others_wait();
  note("w");
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  return unused;
}
static void* add_later(void* p) {
  let_others_wait();
  note("w");
  EXPECT_IS(eventfd_write((int)(long)p, 3), 0);
  return NULL;
}
CASE(eventfd_read_waits) {
  int d = eventfd(0, 0);
  eventfd_t v = 0;
  pthread_t id = start(add_later, (void*)(long)d);
  EXPECT_IS(eventfd_read(d, &v), 0);
  EXPECT_IS(v, 3);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
static void* take_later(void* p) {
  let_others_wait();
  note("r");
  eventfd_t v;
  EXPECT_IS(eventfd_read((int)(long)p, &v), 0);
  return NULL;
}
CASE(eventfd_write_waits) {
  int d = eventfd(0, 0);
  EXPECT_IS(eventfd_write(d, 0xfffffffffffffffeULL), 0);
  pthread_t id = start(take_later, (void*)(long)d);
  EXPECT_IS(eventfd_write(d, 1), 0);
  note("w");
  join(id);
  EXPECT_NOTED("rw");
}
CASE(splice_waits_for_bytes) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(others), 0);
  pthread_t id = start(write_later, NULL);
  EXPECT_IS(splice(ends[0], NULL, others[1], NULL, 100, 0), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
  EXPECT_IS(read(others[0], bytes, 100), 5);
  EXPECT(memcmp(bytes, "hello", 5) == 0);
}
CASE(splice_nonblock) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(others), 0);
  EXPECT_FAILS(splice(ends[0], NULL, others[1], NULL, 100, SPLICE_F_NONBLOCK), EAGAIN);
}
static void* read_all_later(void* p) {
  let_others_wait();
  note("r");
  EXPECT(read(others[0], bytes, 65536) > 0);
  return p;
}
CASE(splice_waits_for_room) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(others), 0);
  EXPECT_IS(write(others[1], bytes, 65536), 65536);
  EXPECT_IS(write(ends[1], "abc", 3), 3);
  pthread_t id = start(read_all_later, NULL);
  EXPECT_IS(splice(ends[0], NULL, others[1], NULL, 100, 0), 3);
  note("w");
  join(id);
  EXPECT_NOTED("rw");
}
CASE(tee_waits_and_leaves) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(others), 0);
  pthread_t id = start(write_later, NULL);
  EXPECT_IS(tee(ends[0], others[1], 100, 0), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
  EXPECT_IS(read(others[0], bytes, 100), 5);
  EXPECT_IS(read(ends[0], bytes, 100), 5);
}
CASE(vmsplice_waits_for_room) {
  EXPECT_IS(pipe(others), 0);
  EXPECT_IS(write(others[1], bytes, 65536), 65536);
  pthread_t id = start(read_all_later, NULL);
  struct iovec v = {"xyz", 3};
  EXPECT_IS(vmsplice(others[1], &v, 1, 0), 3);
  note("w");
  join(id);
  EXPECT_NOTED("rw");
}
CASE(descriptors_beyond_files_and_pipes_are_refused) {
  const int file = temp();
  EXPECT_FAILS(splice(file, NULL, file, NULL, 1, 0), EINVAL);
  EXPECT_IS(pipe(ends), 0);
  EXPECT_FAILS(tee(ends[0], file, 1, 0), EINVAL);
  EXPECT_FAILS(splice(ends[1], NULL, ends[0], NULL, 1, 0), EBADF);
}
CASE(sendfile_waits_for_room) {
  int f = temp();
  EXPECT_IS(write(f, "abcdef", 6), 6);
  EXPECT_IS(pipe(others), 0);
  EXPECT_IS(write(others[1], bytes, 65536), 65536);
  pthread_t id = start(read_all_later, NULL);
  off_t o = 0;
  EXPECT_IS(sendfile(others[1], f, &o, 6), 6);
  note("w");
  EXPECT_IS(o, 6);
  join(id);
  EXPECT_NOTED("rw");
}
static int filled_file(void) {
  const int f = temp();
  EXPECT_IS(ftruncate(f, 100000), 0);
  return f;
}
CASE(sendfile_into_a_pipe_moves_what_has_room) {
  EXPECT_IS(pipe(others), 0);
  off_t o = 0;
  EXPECT_IS(sendfile(others[1], filled_file(), &o, 100000), 65536);
  EXPECT_IS(o, 65536);
}
static void* send_file(void* unused) {
  off_t o = 0;
  EXPECT_IS(sendfile(others[1], filled_file(), &o, 6), 6);
  note("s");
  pthread_testcancel();
  return unused;
}
CASE(sendfile_is_no_cancellation_point) {
  EXPECT_IS(pipe(others), 0);
  EXPECT_IS(write(others[1], bytes, 65536), 65536);
  const pthread_t id = start(send_file, NULL);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  let_others_wait();
  EXPECT_NOTED("");
  EXPECT_IS(read(others[0], bytes, 65536), 65536);
  void* result = NULL;
  EXPECT_IS(pthread_join(id, &result), 0);
  EXPECT(result == PTHREAD_CANCELED);
  EXPECT_NOTED("s");
}
CASE(preadv2_of_a_pipe_waits) {
  EXPECT_IS(pipe(ends), 0);
  pthread_t id = start(write_later, NULL);
  struct iovec v = {bytes, 5};
  EXPECT_IS(preadv2(ends[0], &v, 1, -1, 0), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}

CASE(vmsplice_takes_out_of_a_pipe_too) {
  EXPECT_IS(pipe(ends), 0);
  const pthread_t id = start(write_later, NULL);
  struct iovec v = {bytes, 5};
  EXPECT_IS(vmsplice(ends[0], &v, 1, 0), 5);
  note("r");
  join(id);
  EXPECT_NOTED("wr");
}
CASE(splice_into_a_socket_goes_on) {
  int pair[2];
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
  const pthread_t id = start(write_later, NULL);
  EXPECT_IS(splice(ends[0], NULL, pair[1], NULL, 100, 0), 5);
  note("r");
  EXPECT_IS(recv(pair[0], bytes, 100, 0), 5);
  join(id);
  EXPECT_NOTED("wr");
}
CASE(splice_ends_with_the_last_writer) {
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(pipe(others), 0);
  EXPECT_IS(close(ends[1]), 0);
  EXPECT_IS(splice(ends[0], NULL, others[1], NULL, 100, 0), 0);
  EXPECT_FAILS(splice(others[0], NULL, -1, NULL, 100, 0), EBADF);
}
