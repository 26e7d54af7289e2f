// SPDX-License-Identifier: BSD-3-Clause
// Calls that sleep.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <stdint.h>
#include <sys/syscall.h>

static long long begin_ns;
static void begin(void) { begin_ns = now_ns(CLOCK_MONOTONIC); }
static void expect_passed_ms(long ms) { EXPECT(now_ns(CLOCK_MONOTONIC) - begin_ns >= ms * 1000000); }

CASE(nanosleep_sleeps_so_long) {
  begin();
  EXPECT_IS(nanosleep(&(struct timespec){0, 5000000}, NULL), 0);
  expect_passed_ms(5);
}
CASE(nanosleep_of_no_time_comes_back) { EXPECT_IS(nanosleep(&(struct timespec){0, 0}, NULL), 0); }
CASE(nanosleep_refuses_invalid_times) {
  EXPECT_FAILS(nanosleep(&(struct timespec){0, 1000000000}, NULL), EINVAL);
  EXPECT_FAILS(nanosleep(&(struct timespec){0, -1}, NULL), EINVAL);
  EXPECT_FAILS(nanosleep(&(struct timespec){-1, 0}, NULL), EINVAL);
}
CASE(nanosleep_that_is_not_disturbed_tells_no_rest) {
  struct timespec rest = {77, 77};
  EXPECT_IS(nanosleep(&(struct timespec){0, 1000000}, &rest), 0);
  EXPECT(rest.tv_sec == 77 && rest.tv_nsec == 77);
}
static void sleeps_for(clockid_t clock) {
  begin();
  EXPECT_IS(clock_nanosleep(clock, 0, &(struct timespec){0, 5000000}, NULL), 0);
  expect_passed_ms(5);
}
CASE(clock_nanosleep_sleeps_so_long_by_the_realtime_clock) { sleeps_for(CLOCK_REALTIME); }
CASE(clock_nanosleep_sleeps_so_long_by_the_monotonic_clock) { sleeps_for(CLOCK_MONOTONIC); }
CASE(clock_nanosleep_sleeps_so_long_by_the_boot_clock) { sleeps_for(CLOCK_BOOTTIME); }
static void sleeps_until(clockid_t clock) {
  begin();
  const struct timespec time = in_ms(clock, 5);
  EXPECT_IS(clock_nanosleep(clock, TIMER_ABSTIME, &time, NULL), 0);
  expect_passed_ms(5);
  EXPECT(now_ns(clock) >= time.tv_sec * 1000000000LL + time.tv_nsec);
}
CASE(clock_nanosleep_sleeps_until_a_time_of_the_realtime_clock) { sleeps_until(CLOCK_REALTIME); }
CASE(clock_nanosleep_sleeps_until_a_time_of_the_monotonic_clock) { sleeps_until(CLOCK_MONOTONIC); }
CASE(clock_nanosleep_until_the_past_comes_back) {
  EXPECT_IS(clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &(struct timespec){5, 0}, NULL), 0);
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &(struct timespec){0, 0}, NULL), 0);
}
CASE(clock_nanosleep_returns_its_error) {
  errno = 0;
  EXPECT_IS(clock_nanosleep(CLOCK_REALTIME, 0, &(struct timespec){0, 1000000000}, NULL), EINVAL);
  EXPECT_IS(clock_nanosleep(CLOCK_REALTIME, 0, &(struct timespec){-1, 0}, NULL), EINVAL);
  EXPECT_IS(clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &(struct timespec){5, -1}, NULL), EINVAL);
  EXPECT_IS(errno, 0);
}
CASE(clock_nanosleep_refuses_what_is_no_clock_to_sleep_by) {
  const struct timespec time = {0, 1000};
  EXPECT_IS(clock_nanosleep(77, 0, &time, NULL), EINVAL);
  EXPECT_IS(clock_nanosleep(CLOCK_THREAD_CPUTIME_ID, 0, &time, NULL), EINVAL);
}
CASE(clock_nanosleep_does_not_know_raw_and_coarse_clocks) {
  const struct timespec time = {0, 1000};
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC_RAW, 0, &time, NULL), ENOTSUP);
  EXPECT_IS(clock_nanosleep(CLOCK_REALTIME_COARSE, 0, &time, NULL), ENOTSUP);
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC_COARSE, 0, &time, NULL), ENOTSUP);
}
CASE(usleep_sleeps_so_long) {
  begin();
  EXPECT_IS(usleep(5000), 0);
  expect_passed_ms(5);
}
CASE(sleep_and_usleep_of_no_time_come_back) {
  EXPECT_IS(sleep(0), 0);
  EXPECT_IS(usleep(0), 0);
}
static void* sleep_a_second(void* unused) {
  begin();
  EXPECT_IS(sleep(1), 0);
  _exit(1);
  return unused;
}
CASE(sleep_sleeps_for_seconds) {
  start(sleep_a_second, NULL);
  sleep_ms(20);  // no earlier: it would have ended the process
}

static void* sleep_and_note(void* ms) {
  sleep_ms((intptr_t)ms);
  note((intptr_t)ms == 4 ? "a" : (intptr_t)ms == 12 ? "b" : "c");
  return NULL;
}
CASE(who_sleeps_less_wakes_first) {
  const pthread_t c = start(sleep_and_note, (void*)20), b = start(sleep_and_note, (void*)12),
                  a = start(sleep_and_note, (void*)4);
  join(a);
  join(b);
  join(c);
  EXPECT_NOTED("abc");
}
static void* sleep_5(void* unused) {
  sleep_ms(5);
  return unused;
}
CASE(threads_sleep_beside_each_other) {
  pthread_t ids[20];
  begin();
  for (int i = 0; i < 20; ++i) ids[i] = start(sleep_5, NULL);
  for (int i = 0; i < 20; ++i) join(ids[i]);
  expect_passed_ms(5);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin_ns < 95000000);
}
CASE(nanosleep_by_syscall_sleeps_so_long) {
  begin();
  const struct timespec time = {0, 5000000}, invalid = {0, -1};
  EXPECT_IS(syscall(SYS_nanosleep, &time, NULL), 0);
  expect_passed_ms(5);
  EXPECT_FAILS(syscall(SYS_nanosleep, &invalid, NULL), EINVAL);
}
CASE(clock_nanosleep_by_syscall_sleeps_until_its_time) {
  begin();
  const struct timespec time = in_ms(CLOCK_MONOTONIC, 5), invalid = {0, -1};
  EXPECT_IS(syscall(SYS_clock_nanosleep, CLOCK_MONOTONIC, TIMER_ABSTIME, &time, NULL), 0);
  expect_passed_ms(5);
  EXPECT_FAILS(syscall(SYS_clock_nanosleep, CLOCK_MONOTONIC, 0, &invalid, NULL), EINVAL);
}
static atomic_int flag;
static void* set_flag(void* unused) {
  sleep_ms(1);
  flag = 1;
  return unused;
}
CASE(a_loop_of_sched_yield_by_syscall_ends) {
  const pthread_t id = start(set_flag, NULL);
  while (!flag) EXPECT_IS(syscall(SYS_sched_yield), 0);
  join(id);
}
