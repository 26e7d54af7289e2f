// SPDX-License-Identifier: BSD-3-Clause
// Message queues of POSIX.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <mqueue.h>
#include <signal.h>
#include <stdatomic.h>

static mqd_t queue;
static atomic_int done, handled;

static mqd_t make(long messages, int flags) {
  char name[64];
  struct mq_attr attributes = {.mq_maxmsg = messages, .mq_msgsize = 16};
  snprintf(name, sizeof name, "/conformance-%d", (int)getpid());
  mq_unlink(name);
  queue = mq_open(name, O_CREAT | O_EXCL | O_RDWR | flags, 0600, &attributes);
  EXPECT(queue >= 0);
  EXPECT_IS(mq_unlink(name), 0);
  return queue;
}
static void expect_letter(const char* file, int line, const char* text, unsigned expected) {
  char bytes[17] = "";
  unsigned priority = 77;
  expect_equal(file, line, "size", mq_receive(queue, bytes, 16, &priority), (long long)strlen(text));
  expect_equal(file, line, text, strcmp(bytes, text), 0);
  expect_equal(file, line, "priority", priority, expected);
}
#define EXPECT_LETTER(text, priority) expect_letter(__FILE__, __LINE__, text, priority)

CASE(messages_come_by_priority) {
  make(5, 0);
  EXPECT_IS(mq_send(queue, "low", 3, 1), 0);
  EXPECT_IS(mq_send(queue, "high", 4, 9), 0);
  EXPECT_IS(mq_send(queue, "low too", 7, 1), 0);
  EXPECT_LETTER("high", 9);
  EXPECT_LETTER("low", 1);
  EXPECT_LETTER("low too", 1);
}
static void* send_later(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(mq_send(queue, "late", 4, 3), 0);
  return unused;
}
CASE(receiving_waits) {
  make(5, 0);
  const pthread_t id = start(send_later, NULL);
  EXPECT_LETTER("late", 3);
  EXPECT_IS(done, 1);
  join(id);
}
static void* receive_later(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_LETTER("first", 0);
  return unused;
}
CASE(sending_waits_for_room) {
  make(1, 0);
  EXPECT_IS(mq_send(queue, "first", 5, 0), 0);
  const pthread_t id = start(receive_later, NULL);
  EXPECT_IS(mq_send(queue, "second", 6, 0), 0);
  EXPECT_IS(done, 1);
  join(id);
}
CASE(a_time_ends_waiting) {
  make(1, 0);
  char bytes[16];
  struct timespec deadline = in_ms(CLOCK_REALTIME, 20);
  EXPECT_FAILS(mq_timedreceive(queue, bytes, 16, NULL, &deadline), ETIMEDOUT);
  EXPECT(now_ns(CLOCK_REALTIME) >= deadline.tv_sec * 1000000000LL + deadline.tv_nsec);
  EXPECT_IS(mq_timedsend(queue, "first", 5, 0, &deadline), 0);  // there is room: the deadline does not matter
  deadline = in_ms(CLOCK_REALTIME, 20);
  EXPECT_FAILS(mq_timedsend(queue, "second", 6, 0, &deadline), ETIMEDOUT);
  deadline = invalid_time(CLOCK_REALTIME);
  EXPECT_FAILS(mq_timedsend(queue, "second", 6, 0, &deadline), EINVAL);
  EXPECT_FAILS(mq_timedreceive(queue, bytes, 16, NULL, &deadline), EINVAL);
}
CASE(without_blocking_nothing_waits) {
  make(1, O_NONBLOCK);
  char bytes[16];
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_FAILS(mq_receive(queue, bytes, 16, NULL), EAGAIN);
  EXPECT_FAILS(mq_timedreceive(queue, bytes, 16, NULL, &deadline), EAGAIN);
  EXPECT_IS(mq_send(queue, "first", 5, 0), 0);
  EXPECT_FAILS(mq_send(queue, "second", 6, 0), EAGAIN);
  EXPECT_FAILS(mq_timedsend(queue, "second", 6, 0, &deadline), EAGAIN);
}
CASE(sizes_and_priorities_are_bounded) {
  make(2, 0);
  char bytes[32] = "";
  EXPECT_FAILS(mq_send(queue, bytes, 17, 0), EMSGSIZE);
  EXPECT_FAILS(mq_receive(queue, bytes, 15, NULL), EMSGSIZE);
  EXPECT_FAILS(mq_send(queue, bytes, 1, 32768), EINVAL);
  EXPECT_FAILS(mq_send(999, bytes, 1, 0), EBADF);
  EXPECT_FAILS(mq_receive(999, bytes, 16, NULL), EBADF);
}
static pthread_t main_id;
static void handle(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}
static void* disturb(void* unused) {
  let_others_wait();
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  return unused;
}
CASE(a_signal_ends_waiting) {
  make(1, 0);
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handle;
  sigaction(SIGUSR1, &action, NULL);
  main_id = pthread_self();
  char bytes[16];
  const pthread_t id = start(disturb, NULL);
  EXPECT_FAILS(mq_receive(queue, bytes, 16, NULL), EINTR);
  EXPECT_IS(handled, 1);
  join(id);
}
CASE(a_message_may_be_notified_by_a_signal) {
  make(1, 0);
  signal(SIGUSR1, handle);
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGUSR1;
  EXPECT_IS(mq_notify(queue, &event), 0);
  EXPECT_FAILS(mq_notify(queue, &event), EBUSY);
  EXPECT_IS(mq_send(queue, "first", 5, 0), 0);
  EXPECT_IS(handled, 1);
}
static void* receive_forever(void* unused) {
  char bytes[16];
  mq_receive(queue, bytes, 16, NULL);
  return unused;
}
CASE(receiving_is_a_cancellation_point) {
  make(1, 0);
  const pthread_t id = start(receive_forever, NULL);
  let_others_wait();
  EXPECT_IS(pthread_cancel(id), 0);
  EXPECT(join(id) == PTHREAD_CANCELED);
}

static pthread_t told_by;
static volatile int told;
static void tell(union sigval value) {
  told_by = pthread_self();
  told = value.sival_int;
}
CASE(a_message_may_be_notified_by_a_thread) {
  make(1, 0);
  struct sigevent event = {
      .sigev_notify = SIGEV_THREAD, .sigev_notify_function = tell, .sigev_value = {.sival_int = 7}};
  EXPECT_IS(mq_notify(queue, &event), 0);
  EXPECT_FAILS(mq_notify(queue, &event), EBUSY);
  EXPECT_IS(mq_send(queue, "a", 1, 0), 0);
  while (told == 0) sleep_ms(1);
  EXPECT_IS(told, 7);
  EXPECT(!pthread_equal(told_by, pthread_self()));
  EXPECT_LETTER("a", 0);
  // One notification per request.
  told = 0;
  EXPECT_IS(mq_send(queue, "a", 1, 0), 0);
  sleep_ms(5);
  EXPECT_IS(told, 0);
}

static void* take_one(void* unused) {
  char bytes[16];
  let_others_wait();
  EXPECT_IS(mq_receive(queue, bytes, 16, NULL), 5);
  return unused;
}
CASE(sending_waits_for_room_until_its_time) {
  make(1, 0);
  EXPECT_IS(mq_send(queue, "first", 5, 0), 0);
  const pthread_t id = start(take_one, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 2000);
  EXPECT_IS(mq_timedsend(queue, "second", 6, 0, &deadline), 0);
  join(id);
  EXPECT_LETTER("second", 0);
}
