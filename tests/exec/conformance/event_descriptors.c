// SPDX-License-Identifier: BSD-3-Clause
// Counting descriptors: eventfd and timerfd.
#include "tests/exec/conformance/harness.h"

#include <poll.h>
#include <stdatomic.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>

static atomic_int done;
static int counter;

static void* add_5(void* unused) {
  let_others_wait();
  EXPECT_IS(eventfd_write(counter, 5), 0);
  return unused;
}
CASE(a_counter_is_read_and_zero_again) {
  counter = eventfd(3, 0);
  uint64_t value = 0;
  EXPECT_IS(read(counter, &value, sizeof value), 8);
  EXPECT_IS(value, 3);
  const pthread_t id = start(add_5, NULL);
  EXPECT_IS(read(counter, &value, sizeof value), 8);
  EXPECT_IS(value, 5);
  join(id);
}
CASE(a_counter_may_give_ones) {
  counter = eventfd(2, EFD_SEMAPHORE | EFD_NONBLOCK);
  uint64_t value = 0;
  EXPECT_IS(read(counter, &value, sizeof value), 8);
  EXPECT_IS(value, 1);
  EXPECT_IS(read(counter, &value, sizeof value), 8);
  EXPECT_FAILS(read(counter, &value, sizeof value), EAGAIN);
  EXPECT_FAILS(read(counter, &value, 4), EINVAL);
  value = UINT64_MAX;
  EXPECT_FAILS(write(counter, &value, sizeof value), EINVAL);
}

static void* take_counter(void* unused) {
  uint64_t value;
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(read(counter, &value, sizeof value), 8);
  return unused;
}
CASE(adding_waits_while_the_counter_would_overflow) {
  counter = eventfd(0, 0);
  uint64_t value = UINT64_MAX - 1;
  EXPECT_IS(write(counter, &value, sizeof value), 8);
  const pthread_t id = start(take_counter, NULL);
  value = 1;
  EXPECT_IS(write(counter, &value, sizeof value), 8);
  EXPECT_IS(done, 1);
  join(id);
}
CASE(a_timer_is_read_when_it_has_run_out) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec time = {{0, 0}, {0, 20000000}};
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(timerfd_settime(timer, 0, &time, NULL), 0);
  uint64_t count = 0;
  EXPECT_IS(read(timer, &count, sizeof count), 8);
  EXPECT_IS(count, 1);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 20000000);
}
CASE(a_timer_counts_how_often_it_ran_out) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  const struct itimerspec time = {{0, 10000000}, {0, 10000000}};
  uint64_t count = 0;
  EXPECT_IS(timerfd_settime(timer, 0, &time, NULL), 0);
  EXPECT_FAILS(read(timer, &count, sizeof count), EAGAIN);
  const struct timespec span = {0, 55000000};
  nanosleep(&span, NULL);
  struct pollfd one = {timer, POLLIN, 0};
  EXPECT_IS(poll(&one, 1, 0), 1);
  EXPECT_IS(read(timer, &count, sizeof count), 8);
  EXPECT(count >= 5);
}
CASE(a_timer_may_have_a_date) {
  const int timer = timerfd_create(CLOCK_REALTIME, 0);
  const struct itimerspec time = {{0, 0}, in_ms(CLOCK_REALTIME, 20)};
  EXPECT_IS(timerfd_settime(timer, TFD_TIMER_ABSTIME, &time, NULL), 0);
  uint64_t count = 0;
  EXPECT_IS(read(timer, &count, sizeof count), 8);
  EXPECT_IS(count, 1);
}
CASE(a_timer_tells_what_is_left) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const struct itimerspec time = {{0, 7}, {100, 0}}, none = {{0, 0}, {0, 0}};
  struct itimerspec now;
  EXPECT_IS(timerfd_settime(timer, 0, &time, NULL), 0);
  EXPECT_IS(timerfd_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 99 || now.it_value.tv_sec == 100);
  EXPECT_IS(now.it_interval.tv_nsec, 7);
  EXPECT_IS(timerfd_settime(timer, 0, &none, &now), 0);
  EXPECT(now.it_value.tv_sec == 99 || now.it_value.tv_sec == 100);
  EXPECT_IS(timerfd_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 0 && now.it_value.tv_nsec == 0);
}
CASE(timers_refuse_what_they_are_not) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  struct itimerspec time = {{0, 0}, {0, 1000000000}};
  EXPECT_FAILS(timerfd_create(CLOCK_PROCESS_CPUTIME_ID, 0), EINVAL);
  EXPECT_FAILS(timerfd_create(CLOCK_MONOTONIC, 0x1234), EINVAL);
  EXPECT_FAILS(timerfd_settime(timer, 0, &time, NULL), EINVAL);
  time.it_value.tv_nsec = 1;
  EXPECT_FAILS(timerfd_settime(timer, 0x1234, &time, NULL), EINVAL);
  EXPECT_FAILS(timerfd_settime(999, 0, &time, NULL), EBADF);
  EXPECT_FAILS(timerfd_gettime(0, &time), EINVAL);
}
