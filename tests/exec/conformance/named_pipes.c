// SPDX-License-Identifier: BSD-3-Clause
// Named pipes: opening, and file locks.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <sys/file.h>
#include <sys/stat.h>

static atomic_int done;

// Headers redefine these names.
extern int plain_open(const char* path, int flags, ...) __asm__("open");

extern int plain_openat(int folder, const char* path, int flags, ...) __asm__("openat");
static char path[64];

static void make_fifo(void) {
  snprintf(path, sizeof path, "/tmp/conformance-fifo-%d", (int)getpid());
  unlink(path);
  EXPECT_IS(mkfifo(path, 0600), 0);
}

static void* open_to_write(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  const int descriptor = open(path, O_WRONLY);
  EXPECT(descriptor >= 0);
  EXPECT_IS(write(descriptor, "named", 5), 5);
  close(descriptor);
  return unused;
}
CASE(opening_to_read_waits_for_a_writer) {
  make_fifo();
  const pthread_t id = start(open_to_write, NULL);
  const int descriptor = plain_open(path, O_RDONLY);
  EXPECT(descriptor >= 0);
  EXPECT_IS(done, 1);
  EXPECT_IS(fcntl(descriptor, F_GETFL) & O_NONBLOCK, 0);
  char text[8] = "";
  EXPECT_IS(read(descriptor, text, 7), 5);
  EXPECT_IS(strcmp(text, "named"), 0);
  EXPECT_IS(read(descriptor, text, 7), 0);
  join(id);
  unlink(path);
}

static void* open_to_read(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  const int descriptor = open(path, O_RDONLY);
  EXPECT(descriptor >= 0);
  char byte;
  EXPECT_IS(read(descriptor, &byte, 1), 1);
  return unused;
}
CASE(opening_to_write_waits_for_a_reader) {
  make_fifo();
  const pthread_t id = start(open_to_read, NULL);
  const int descriptor = plain_openat(AT_FDCWD, path, O_WRONLY);
  EXPECT(descriptor >= 0);
  EXPECT_IS(done, 1);
  EXPECT_IS(write(descriptor, "x", 1), 1);
  join(id);
  unlink(path);
}
CASE(openat64_waits_for_a_writer) {
  make_fifo();
  const pthread_t id = start(open_to_write, NULL);
  const int descriptor = openat64(AT_FDCWD, path, O_RDONLY);
  EXPECT(descriptor >= 0);
  char text[8] = "";
  EXPECT_IS(read(descriptor, text, 7), 5);
  join(id);
  unlink(path);
}
CASE(without_blocking_opening_does_not_wait) {
  make_fifo();
  EXPECT_FAILS(open(path, O_WRONLY | O_NONBLOCK), ENXIO);
  const int reader = open(path, O_RDONLY | O_NONBLOCK);
  EXPECT(reader >= 0);
  char byte;
  EXPECT_IS(read(reader, &byte, 1), 0);
  const int writer = open(path, O_WRONLY | O_NONBLOCK);
  EXPECT(writer >= 0);
  EXPECT_FAILS(read(reader, &byte, 1), EAGAIN);
  unlink(path);
}
CASE(other_names_open_too) {
  int (*const opens[])(const char*, int, ...) = {plain_open, open64};
  for (int i = 0; i < 2; ++i) {
    const int descriptor = opens[i]("/dev/null", O_RDONLY);
    EXPECT(descriptor >= 0);
    EXPECT_FAILS(opens[i]("/nonexistent/file", O_RDONLY), ENOENT);
    close(descriptor);
  }
  const int descriptor = openat64(AT_FDCWD, "/dev/null", O_RDONLY);
  EXPECT(descriptor >= 0);
  snprintf(path, sizeof path, "/tmp/conformance-file-%d", (int)getpid());
  const int made = open(path, O_CREAT | O_EXCL | O_WRONLY, 0640);
  struct stat of;
  EXPECT_IS(fstat(made, &of), 0);
  EXPECT_IS(of.st_mode & 0600, 0600);
  unlink(path);
}

static int first_lock, second_lock;

static void* unlock_file(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(flock(first_lock, LOCK_UN), 0);
  return unused;
}
CASE(flock_waits_for_another_opening) {
  snprintf(path, sizeof path, "/tmp/conformance-lock-%d", (int)getpid());
  first_lock = open(path, O_CREAT | O_RDWR, 0600);
  second_lock = open(path, O_RDWR);
  EXPECT_IS(flock(first_lock, LOCK_EX), 0);
  EXPECT_FAILS(flock(second_lock, LOCK_EX | LOCK_NB), EWOULDBLOCK);
  const pthread_t id = start(unlock_file, NULL);
  EXPECT_IS(flock(second_lock, LOCK_EX), 0);
  EXPECT_IS(done, 1);
  join(id);
  EXPECT_FAILS(flock(999, LOCK_EX), EBADF);
  unlink(path);
}
