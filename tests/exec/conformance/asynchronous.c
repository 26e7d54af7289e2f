// SPDX-License-Identifier: BSD-3-Clause
// Asynchronous input and output.
#include "tests/exec/conformance/harness.h"

#include <aio.h>
#include <fcntl.h>
#include <signal.h>

static int ends[2];
static char bytes[64];
static int temp(void) {
  char path[] = "/tmp/waitpoint-asynchronous-XXXXXX";
  const int d = mkstemp(path);
  EXPECT(d >= 0 && unlink(path) == 0);
  return d;
}
static void on(int signal) {
  (void)signal;
  note("h");
}
static void* kill_later(void* id) {
  let_others_wait();
  pthread_kill(*(pthread_t*)id, SIGUSR1);
  return NULL;
}
static struct aiocb of(int d, void* b, size_t n, off_t o) {
  struct aiocb c;
  memset(&c, 0, sizeof c);
  c.aio_fildes = d;
  c.aio_buf = b;
  c.aio_nbytes = n;
  c.aio_offset = o;
  return c;
}
static int finish(struct aiocb* c) {
  const struct aiocb* l[] = {c};
  while (aio_error(c) == EINPROGRESS) EXPECT_IS(aio_suspend(l, 1, NULL), 0);
  return aio_error(c);
}
CASE(aio_write_then_read) {
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 3);
  EXPECT_IS(aio_write(&w), 0);
  EXPECT_IS(finish(&w), 0);
  EXPECT_IS(aio_return(&w), 5);
  char b[8] = {0};
  struct aiocb r = of(f, b, 5, 3);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_IS(finish(&r), 0);
  EXPECT_IS(aio_return(&r), 5);
  EXPECT(strcmp(b, "hello") == 0);
}
CASE(aio_read_past_the_end) {
  int f = temp();
  struct aiocb r = of(f, bytes, 5, 3);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_IS(finish(&r), 0);
  EXPECT_IS(aio_return(&r), 0);
}
CASE(aio_bad_descriptor) {
  struct aiocb r = of(-1, bytes, 5, 0);
  int n = aio_read(&r);
  if (n == 0) {
    EXPECT_IS(finish(&r), EBADF);
    EXPECT_IS(aio_return(&r), -1);
  } else
    EXPECT_IS(errno, EBADF);
}
CASE(aio_write_of_a_read_only) {
  int f = open("/dev/null", O_RDONLY);
  struct aiocb r = of(f, bytes, 5, 0);
  EXPECT_IS(aio_write(&r), 0);
  EXPECT_IS(finish(&r), EBADF);
}
CASE(aio_negative_offset) {
  int f = temp();
  struct aiocb r = of(f, bytes, 5, -1);
  int n = aio_read(&r);
  if (n == 0)
    EXPECT_IS(finish(&r), EINVAL);
  else
    EXPECT_IS(errno, EINVAL);
}
CASE(aio_bad_priority) {
  int f = temp();
  struct aiocb r = of(f, bytes, 5, 0);
  r.aio_reqprio = -1;
  EXPECT_FAILS(aio_read(&r), EINVAL);
}
CASE(aio_bad_priority_high) {
  int f = temp();
  struct aiocb r = of(f, bytes, 5, 0);
  r.aio_reqprio = sysconf(_SC_AIO_PRIO_DELTA_MAX) + 1;
  EXPECT_FAILS(aio_read(&r), EINVAL);
}
CASE(aio_read_of_a_pipe_waits) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_IS(aio_error(&r), EINPROGRESS);
  let_others_wait();
  EXPECT_IS(aio_error(&r), EINPROGRESS);
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  EXPECT_IS(finish(&r), 0);
  EXPECT_IS(aio_return(&r), 5);
}
static volatile int got, got_value, got_code;
static void on_aio(int n, siginfo_t* i, void* c) {
  (void)n;
  (void)c;
  got = 1;
  got_value = i->si_value.sival_int;
  got_code = i->si_code;
}
CASE(aio_notifies_by_signal) {
  struct sigaction a = {.sa_sigaction = on_aio, .sa_flags = SA_SIGINFO};
  sigaction(SIGRTMIN + 1, &a, NULL);
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 0);
  w.aio_sigevent.sigev_notify = SIGEV_SIGNAL;
  w.aio_sigevent.sigev_signo = SIGRTMIN + 1;
  w.aio_sigevent.sigev_value.sival_int = 42;
  EXPECT_IS(aio_write(&w), 0);
  while (!got) sleep_ms(1);
  EXPECT_IS(got_value, 42);
  EXPECT_IS(got_code, SI_ASYNCIO);
  EXPECT_IS(aio_error(&w), 0);
  EXPECT_IS(aio_return(&w), 5);
}
static pthread_t notified_in;
static void in_thread(union sigval v) {
  notified_in = pthread_self();
  got_value = v.sival_int;
  got = 1;
}
CASE(aio_notifies_by_thread) {
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 0);
  w.aio_sigevent.sigev_notify = SIGEV_THREAD;
  w.aio_sigevent.sigev_notify_function = in_thread;
  w.aio_sigevent.sigev_value.sival_int = 42;
  EXPECT_IS(aio_write(&w), 0);
  while (!got) sleep_ms(1);
  EXPECT_IS(got_value, 42);
  EXPECT(!pthread_equal(notified_in, pthread_self()));
  EXPECT_IS(aio_return(&w), 5);
}
CASE(aio_suspend_times_out) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  const struct aiocb* l[] = {&r, NULL};
  struct timespec t = {0, 10000000};
  long long b = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(aio_suspend(l, 2, &t), EAGAIN);
  EXPECT(now_ns(CLOCK_MONOTONIC) - b >= 10000000);
}
CASE(aio_suspend_past_is_at_once) {
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 0);
  EXPECT_IS(aio_write(&w), 0);
  finish(&w);
  const struct aiocb* l[] = {NULL, &w};
  struct timespec t = {0, 0};
  EXPECT_IS(aio_suspend(l, 2, &t), 0);
}
CASE(aio_suspend_is_interrupted) {
  struct sigaction a = {.sa_handler = on};
  sigaction(SIGUSR1, &a, NULL);
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  const struct aiocb* l[] = {&r};
  pthread_t self = pthread_self();
  pthread_t id = start(kill_later, &self);
  EXPECT_FAILS(aio_suspend(l, 1, NULL), EINTR);
  EXPECT_NOTED("h");
  join(id);
}
CASE(aio_cancel_of_what_is_done) {
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 0);
  EXPECT_IS(aio_write(&w), 0);
  finish(&w);
  EXPECT_IS(aio_cancel(f, &w), AIO_ALLDONE);
  EXPECT_IS(aio_cancel(f, NULL), AIO_ALLDONE);
}
CASE(aio_cancel_bad_descriptor) { EXPECT_FAILS(aio_cancel(-1, NULL), EBADF); }
CASE(aio_cancel_of_what_waits_behind_another) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb a = of(ends[0], bytes, 5, 0), b = of(ends[0], bytes + 10, 5, 0);
  EXPECT_IS(aio_read(&a), 0);
  sleep_ms(5);
  EXPECT_IS(aio_read(&b), 0);
  EXPECT_IS(aio_cancel(ends[0], &b), AIO_CANCELED);
  EXPECT_IS(aio_error(&b), ECANCELED);
  EXPECT_IS(aio_return(&b), -1);
  EXPECT_IS(aio_cancel(ends[0], &a), AIO_NOTCANCELED);
  EXPECT_IS(aio_error(&a), EINPROGRESS);
}
CASE(aio_fsync_follows) {
  int f = temp();
  struct aiocb w = of(f, "hello", 5, 0), s = of(f, NULL, 0, 0);
  EXPECT_IS(aio_write(&w), 0);
  EXPECT_IS(aio_fsync(O_SYNC, &s), 0);
  EXPECT_IS(finish(&s), 0);
  EXPECT_IS(aio_return(&s), 0);
  EXPECT_IS(aio_error(&w), 0);
}
CASE(aio_fsync_bad_op) {
  int f = temp();
  struct aiocb s = of(f, NULL, 0, 0);
  EXPECT_FAILS(aio_fsync(1234567, &s), EINVAL);
}
CASE(aio_fsync_bad_descriptor) {
  struct aiocb s = of(-1, NULL, 0, 0);
  EXPECT_FAILS(aio_fsync(O_SYNC, &s), EBADF);
}
CASE(lio_listio_waits_for_all) {
  int f = temp();
  struct aiocb a = of(f, "abc", 3, 0), b = of(f, "def", 3, 3), n = of(f, 0, 0, 0);
  a.aio_lio_opcode = b.aio_lio_opcode = LIO_WRITE;
  n.aio_lio_opcode = LIO_NOP;
  struct aiocb* l[] = {&a, NULL, &n, &b};
  EXPECT_IS(lio_listio(LIO_WAIT, l, 4, NULL), 0);
  EXPECT_IS(aio_error(&a), 0);
  EXPECT_IS(aio_error(&b), 0);
  EXPECT_IS(aio_return(&a), 3);
  EXPECT_IS(pread(f, bytes, 6, 0), 6);
  EXPECT(memcmp(bytes, "abcdef", 6) == 0);
}
CASE(lio_listio_tells_of_failures) {
  int f = temp();
  struct aiocb a = of(f, "abc", 3, 0), b = of(-1, "def", 3, 3);
  a.aio_lio_opcode = b.aio_lio_opcode = LIO_WRITE;
  struct aiocb* l[] = {&a, &b};
  EXPECT_FAILS(lio_listio(LIO_WAIT, l, 2, NULL), EIO);
  EXPECT_IS(aio_error(&b), EBADF);
  EXPECT_IS(aio_error(&a), 0);
}
CASE(lio_listio_bad_mode) { EXPECT_FAILS(lio_listio(77, (struct aiocb*[]){NULL}, 0, NULL), EINVAL); }
CASE(lio_listio_bad_opcode) {
  int f = temp();
  struct aiocb a = of(f, "abc", 3, 0);
  a.aio_lio_opcode = 77;
  struct aiocb* l[] = {&a};
  EXPECT_FAILS(lio_listio(LIO_WAIT, l, 1, NULL), EIO);
  EXPECT_IS(aio_error(&a), EINVAL);
}
CASE(lio_listio_notifies_once) {
  struct sigaction sa = {.sa_sigaction = on_aio, .sa_flags = SA_SIGINFO};
  sigaction(SIGRTMIN + 1, &sa, NULL);
  int f = temp();
  struct aiocb a = of(f, "abc", 3, 0), b = of(f, "def", 3, 3);
  a.aio_lio_opcode = b.aio_lio_opcode = LIO_WRITE;
  struct aiocb* l[] = {&a, &b};
  struct sigevent e = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGRTMIN + 1};
  e.sigev_value.sival_int = 7;
  EXPECT_IS(lio_listio(LIO_NOWAIT, l, 2, &e), 0);
  while (!got) sleep_ms(1);
  EXPECT_IS(got_value, 7);
  EXPECT_IS(got_code, SI_ASYNCIO);
  EXPECT_IS(aio_error(&a), 0);
  EXPECT_IS(aio_error(&b), 0);
}
CASE(lio_listio_of_nothing_notifies) {
  struct sigaction sa = {.sa_sigaction = on_aio, .sa_flags = SA_SIGINFO};
  sigaction(SIGRTMIN + 1, &sa, NULL);
  struct aiocb* l[] = {NULL};
  struct sigevent e = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGRTMIN + 1};
  EXPECT_IS(lio_listio(LIO_NOWAIT, l, 1, &e), 0);
  for (int i = 0; i < 100 && !got; ++i) sleep_ms(1);
  EXPECT_IS(got, 1);
}
CASE(aio_error_of_none) {
  struct aiocb a = of(0, 0, 0, 0);
  EXPECT_IS(aio_error(&a), 0);
}
CASE(aio_append) {
  char p[] = "/tmp/waitpoint-asynchronous-XXXXXX";
  int d = mkstemp(p);
  int f = open(p, O_RDWR | O_APPEND);
  unlink(p);
  close(d);
  struct aiocb a = of(f, "abc", 3, 100), b = of(f, "def", 3, 0);
  EXPECT_IS(aio_write(&a), 0);
  EXPECT_IS(aio_write(&b), 0);
  finish(&a);
  finish(&b);
  EXPECT_IS(pread(f, bytes, 10, 0), 6);
  EXPECT(memcmp(bytes, "abcdef", 6) == 0);
}
CASE(aio_many) {
  int f = temp();
  static struct aiocb c[64];
  static char b[64];
  for (int i = 0; i < 64; ++i) {
    b[i] = 'a' + i % 26;
    c[i] = of(f, b + i, 1, i);
    EXPECT_IS(aio_write(&c[i]), 0);
  }
  for (int i = 0; i < 64; ++i) {
    EXPECT_IS(finish(&c[i]), 0);
    EXPECT_IS(aio_return(&c[i]), 1);
  }
  EXPECT_IS(pread(f, bytes, 64, 0), 64);
  EXPECT(memcmp(b, bytes, 64) == 0);
}

CASE(aio_fsync_has_no_priority) {
  struct aiocb s = of(temp(), NULL, 0, 0);
  s.aio_reqprio = -1;
  EXPECT_IS(aio_fsync(O_SYNC, &s), 0);
  EXPECT_IS(finish(&s), 0);
  EXPECT_IS(s.aio_reqprio, 0);
}
CASE(aio_fsync_of_what_cannot_be_synchronised) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb s = of(ends[1], NULL, 0, 0);
  EXPECT_IS(aio_fsync(O_SYNC, &s), 0);
  EXPECT_IS(finish(&s), EINVAL);
  EXPECT_IS(aio_return(&s), -1);
}
CASE(aio_suspend_of_nothing_is_at_once) {
  const struct aiocb* l[] = {NULL, NULL};
  const struct timespec t = {5, 0};
  EXPECT_IS(aio_suspend(l, 2, &t), 0);
  EXPECT_IS(aio_suspend(l, 0, NULL), 0);
  EXPECT_FAILS(aio_suspend(l, -1, NULL), EINVAL);
}
CASE(aio_suspend_without_time_left) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  const struct aiocb* l[] = {&r};
  EXPECT_IS(aio_read(&r), 0);
  struct timespec t = {0, 0};
  EXPECT_FAILS(aio_suspend(l, 1, &t), EAGAIN);
  t.tv_sec = -1;
  EXPECT_FAILS(aio_suspend(l, 1, &t), EAGAIN);
}
CASE(aio_suspend_returns_for_one_of_several) {
  int f = temp();
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0), w = of(f, "hello", 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_IS(aio_write(&w), 0);
  EXPECT_IS(finish(&w), 0);
  const struct aiocb* l[] = {&r, NULL, &w};
  EXPECT_IS(aio_suspend(l, 3, NULL), 0);
  EXPECT_IS(aio_error(&r), EINPROGRESS);
}
static struct aiocb awaited;
static void* suspend_for_ever(void* unused) {
  const struct aiocb* l[] = {&awaited};
  aio_suspend(l, 1, NULL);
  return unused;
}
CASE(aio_suspend_can_be_cancelled) {
  EXPECT_IS(pipe(ends), 0);
  awaited = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&awaited), 0);
  pthread_t id = start(suspend_for_ever, NULL);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(aio_error(&awaited), EINPROGRESS);
}
static void* kill_then_write(void* id) {
  let_others_wait();
  pthread_kill(*(pthread_t*)id, SIGUSR1);
  let_others_wait();
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  return NULL;
}
static int suspend_disturbed(const struct timespec* timeout) {
  struct sigaction a = {.sa_handler = on, .sa_flags = SA_RESTART};
  sigaction(SIGUSR1, &a, NULL);
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  const struct aiocb* l[] = {&r};
  pthread_t self = pthread_self();
  pthread_t id = start(kill_then_write, &self);
  const int result = aio_suspend(l, 1, timeout), error = errno;
  EXPECT_NOTED("h");
  EXPECT_IS(aio_error(&r), result == 0 ? 0 : EINPROGRESS);
  join(id);
  EXPECT_IS(finish(&r), 0);
  errno = error;
  return result;
}
CASE(aio_suspend_goes_on_if_asked) { EXPECT_IS(suspend_disturbed(NULL), 0); }
CASE(aio_suspend_with_a_timeout_is_interrupted_whatever_is_asked) {
  const struct timespec t = {5, 0};
  EXPECT_IS(suspend_disturbed(&t), -1);
  EXPECT_IS(errno, EINTR);
}
static void* write_soon(void* unused) {
  let_others_wait();
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  return unused;
}
CASE(aio_fsync_follows_the_least_urgent) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb a = of(ends[0], bytes, 5, 0), b = of(ends[0], bytes + 10, 5, 0), s = of(ends[0], NULL, 0, 0);
  EXPECT_IS(aio_read(&a), 0);
  EXPECT_IS(aio_read(&b), 0);
  EXPECT_IS(aio_fsync(O_SYNC, &s), 0);
  pthread_t id = start(write_soon, NULL);
  EXPECT_IS(finish(&a), 0);
  EXPECT_IS(aio_error(&s), EINPROGRESS);
  join(id);
}
CASE(aio_cancel_of_what_has_just_begun) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_IS(aio_cancel(ends[0], &r), AIO_NOTCANCELED);
  EXPECT_IS(aio_cancel(ends[0], NULL), AIO_NOTCANCELED);
  EXPECT_IS(aio_error(&r), EINPROGRESS);
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  EXPECT_IS(finish(&r), 0);
  EXPECT_IS(aio_return(&r), 5);
}
CASE(aio_cancel_of_all_leaves_what_has_begun) {
  EXPECT_IS(pipe(ends), 0);
  struct aiocb a = of(ends[0], bytes, 5, 0), b = of(ends[0], bytes + 10, 5, 0), c = of(ends[0], bytes + 20, 5, 0);
  EXPECT_IS(aio_read(&a), 0);
  EXPECT_IS(aio_read(&b), 0);
  EXPECT_IS(aio_read(&c), 0);
  EXPECT_IS(aio_cancel(ends[0], NULL), AIO_NOTCANCELED);
  EXPECT_IS(aio_error(&a), EINPROGRESS);
  EXPECT_IS(aio_error(&b), ECANCELED);
  EXPECT_IS(aio_error(&c), ECANCELED);
  EXPECT_IS(aio_return(&c), -1);
  EXPECT_IS(write(ends[1], "hello", 5), 5);
  EXPECT_IS(finish(&a), 0);
}
CASE(aio_cancel_notifies) {
  struct sigaction sa = {.sa_sigaction = on_aio, .sa_flags = SA_SIGINFO};
  sigaction(SIGRTMIN + 1, &sa, NULL);
  EXPECT_IS(pipe(ends), 0);
  struct aiocb a = of(ends[0], bytes, 5, 0), b = of(ends[0], bytes + 10, 5, 0);
  b.aio_sigevent.sigev_notify = SIGEV_SIGNAL;
  b.aio_sigevent.sigev_signo = SIGRTMIN + 1;
  b.aio_sigevent.sigev_value.sival_int = 9;
  EXPECT_IS(aio_read(&a), 0);
  EXPECT_IS(aio_read(&b), 0);
  EXPECT_IS(aio_cancel(ends[0], &b), AIO_CANCELED);
  for (int i = 0; i < 100 && !got; ++i) sleep_ms(1);
  EXPECT_IS(got_value, 9);
  EXPECT_IS(got_code, SI_ASYNCIO);
}
CASE(aio_cancel_of_another_descriptors) {
  int f = temp();
  EXPECT_IS(pipe(ends), 0);
  struct aiocb r = of(ends[0], bytes, 5, 0);
  EXPECT_IS(aio_read(&r), 0);
  EXPECT_FAILS(aio_cancel(f, &r), EINVAL);
  EXPECT_IS(aio_cancel(f, NULL), AIO_ALLDONE);
}
CASE(aio_cancel_of_a_request_that_was_never_made) {
  int f = temp();
  struct aiocb r = of(f, bytes, 5, 0);
  EXPECT_IS(aio_cancel(f, &r), AIO_ALLDONE);
}
CASE(lio_listio_of_no_requests) {
  struct aiocb* l[] = {NULL};
  EXPECT_IS(lio_listio(LIO_WAIT, l, 0, NULL), 0);
}
