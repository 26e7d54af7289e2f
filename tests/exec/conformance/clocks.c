// SPDX-License-Identifier: BSD-3-Clause
// Readings of clocks.
#include "tests/exec/conformance/harness.h"

#include <stdint.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/times.h>

static const clockid_t all_clocks[] = {CLOCK_REALTIME,          CLOCK_MONOTONIC,     CLOCK_PROCESS_CPUTIME_ID,
                                       CLOCK_THREAD_CPUTIME_ID, CLOCK_MONOTONIC_RAW, CLOCK_REALTIME_COARSE,
                                       CLOCK_MONOTONIC_COARSE,  CLOCK_BOOTTIME,      CLOCK_TAI};
enum { clock_count = sizeof all_clocks / sizeof *all_clocks };

CASE(all_clocks_can_be_read) {
  for (int i = 0; i < clock_count; ++i) {
    struct timespec time = {-1, -1};
    EXPECT_IS(clock_gettime(all_clocks[i], &time), 0);
    EXPECT(time.tv_sec >= 0 && time.tv_nsec >= 0 && time.tv_nsec < 1000000000);
  }
}
CASE(all_clocks_have_a_resolution) {
  for (int i = 0; i < clock_count; ++i) {
    struct timespec time = {-1, -1};
    EXPECT_IS(clock_getres(all_clocks[i], &time), 0);
    EXPECT(time.tv_sec == 0 && time.tv_nsec > 0);
    EXPECT_IS(clock_getres(all_clocks[i], NULL), 0);
  }
}
CASE(what_is_no_clock_is_refused) {
  struct timespec time;
  EXPECT_FAILS(clock_gettime(77, &time), EINVAL);
  EXPECT_FAILS(clock_getres(77, &time), EINVAL);
  EXPECT_FAILS(clock_gettime(10, &time), EINVAL);
}
CASE(no_clock_goes_back) {
  for (int i = 0; i < clock_count; ++i) {
    const long long first = now_ns(all_clocks[i]);
    EXPECT(now_ns(all_clocks[i]) >= first);
  }
}
CASE(a_loop_that_polls_a_clock_ends) {
  const long long end = now_ns(CLOCK_MONOTONIC) + 2000000;
  while (now_ns(CLOCK_MONOTONIC) < end) continue;
}
CASE(a_loop_that_polls_the_time_of_day_ends) {
  struct timeval begin, now;
  gettimeofday(&begin, NULL);
  do EXPECT_IS(gettimeofday(&now, NULL), 0);
  while ((now.tv_sec - begin.tv_sec) * 1000000 + now.tv_usec - begin.tv_usec < 2000);
}
static void advances_with_sleep(clockid_t clock) {
  const long long begin = now_ns(clock);
  sleep_ms(10);
  const long long passed = now_ns(clock) - begin;
  EXPECT(passed >= 10000000 - 4000000);  // coarse clocks have ticks of 4 ms
}
CASE(the_realtime_clock_goes_on_while_a_thread_sleeps) { advances_with_sleep(CLOCK_REALTIME); }
CASE(the_monotonic_clock_goes_on_while_a_thread_sleeps) { advances_with_sleep(CLOCK_MONOTONIC); }
CASE(the_raw_clock_goes_on_while_a_thread_sleeps) { advances_with_sleep(CLOCK_MONOTONIC_RAW); }
CASE(the_boot_clock_goes_on_while_a_thread_sleeps) { advances_with_sleep(CLOCK_BOOTTIME); }
CASE(coarse_clocks_go_on_while_a_thread_sleeps) {
  advances_with_sleep(CLOCK_REALTIME_COARSE);
  advances_with_sleep(CLOCK_MONOTONIC_COARSE);
}
static void stands_still(clockid_t clock) {
  const long long begin = now_ns(clock);
  sleep_ms(15);
  EXPECT(now_ns(clock) - begin < 7000000);
}
CASE(processor_time_stands_while_the_process_sleeps) { stands_still(CLOCK_PROCESS_CPUTIME_ID); }
CASE(processor_time_of_a_thread_stands_while_it_sleeps) { stands_still(CLOCK_THREAD_CPUTIME_ID); }
CASE(clock_stands_while_the_process_sleeps) {
  const clock_t begin = clock();
  EXPECT(begin >= 0);
  sleep_ms(15);
  EXPECT(clock() - begin < 7 * CLOCKS_PER_SEC / 1000);
}
CASE(a_loop_that_polls_clock_ends) {
  const clock_t end = clock() + CLOCKS_PER_SEC / 500;
  while (clock() < end) continue;
}
CASE(a_loop_that_polls_processor_time_ends) {
  const long long end = now_ns(CLOCK_THREAD_CPUTIME_ID) + 2000000;
  while (now_ns(CLOCK_THREAD_CPUTIME_ID) < end) continue;
}
static void* poll_clock(void* unused) {
  const long long end = now_ns(CLOCK_THREAD_CPUTIME_ID) + 8000000;
  while (now_ns(CLOCK_THREAD_CPUTIME_ID) < end) continue;
  return unused;
}
CASE(processor_time_is_each_threads_own) {
  const long long own = now_ns(CLOCK_THREAD_CPUTIME_ID), of_all = now_ns(CLOCK_PROCESS_CPUTIME_ID);
  join(start(poll_clock, NULL));
  EXPECT(now_ns(CLOCK_THREAD_CPUTIME_ID) - own < 4000000);
  EXPECT(now_ns(CLOCK_PROCESS_CPUTIME_ID) - of_all >= 8000000);
}
static void* sleep_long(void* unused) {
  sleep_ms(5000);
  return unused;
}
CASE(the_processor_clock_of_another_thread_can_be_read) {
  clockid_t clock = 77;
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_getcpuclockid(id, &clock), 0);
  let_others_wait();
  stands_still(clock);
}
CASE(the_processor_clock_of_oneself_is_that_of_the_thread) {
  clockid_t clock = 77;
  EXPECT_IS(pthread_getcpuclockid(pthread_self(), &clock), 0);
  const long long before = now_ns(CLOCK_THREAD_CPUTIME_ID), between = now_ns(clock);
  EXPECT(before <= between && between <= now_ns(CLOCK_THREAD_CPUTIME_ID));
}
CASE(the_processor_clock_of_the_process_has_a_number) {
  clockid_t clock = 77;
  EXPECT_IS(clock_getcpuclockid(0, &clock), 0);
  const long long before = now_ns(CLOCK_PROCESS_CPUTIME_ID), between = now_ns(clock);
  EXPECT(before <= between && between <= now_ns(CLOCK_PROCESS_CPUTIME_ID));
}

CASE(time_tells_seconds_of_the_realtime_clock) {
  time_t stored = 0;
  const time_t before = now_ns(CLOCK_REALTIME) / 1000000000;
  const time_t said = time(&stored);
  EXPECT_IS(stored, said);
  const time_t after = now_ns(CLOCK_REALTIME) / 1000000000;
  EXPECT(before - 1 <= said && said <= after);  // the second may change a tick later there
  EXPECT(time(NULL) >= said);
}
CASE(gettimeofday_tells_what_is_asked_for) {
  struct timeval* volatile no_time = NULL;
  struct timezone zone = {1, 1};
  EXPECT_IS(gettimeofday(no_time, &zone), 0);
  EXPECT_IS(zone.tz_dsttime, 0);
  EXPECT_IS(gettimeofday(no_time, NULL), 0);
}
CASE(gettimeofday_tells_microseconds_of_the_realtime_clock) {
  struct timeval said = {-1, -1};
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(gettimeofday(&said, NULL), 0);
  const long long after = now_ns(CLOCK_REALTIME), ns = said.tv_sec * 1000000000LL + said.tv_usec * 1000;
  EXPECT(before - 1000 <= ns && ns <= after);
  EXPECT(said.tv_usec >= 0 && said.tv_usec < 1000000);
}
CASE(timespec_get_tells_the_realtime_clock) {
  struct timespec said = {-1, -1};
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(timespec_get(&said, TIME_UTC), TIME_UTC);
  const long long ns = said.tv_sec * 1000000000LL + said.tv_nsec;
  EXPECT(before <= ns && ns <= now_ns(CLOCK_REALTIME));
}
CASE(timespec_get_refuses_what_is_no_base) {
  struct timespec said;
  EXPECT_IS(timespec_get(&said, 0), 0);
  EXPECT_IS(timespec_get(&said, 77), 0);
}
CASE(times_counts_ticks_of_elapsed_time) {
  struct tms said = {-1, -1, -1, -1};
  const clock_t begin = times(&said);
  EXPECT(begin != (clock_t)-1);
  EXPECT(said.tms_utime >= 0 && said.tms_stime >= 0 && said.tms_cutime == 0 && said.tms_cstime == 0);
  sleep_ms(20);
  const clock_t passed = times(NULL) - begin;
  EXPECT(passed >= 1 && passed < 500);
}
CASE(times_of_the_process_stand_while_it_sleeps) {
  struct tms before, after;
  times(&before);
  sleep_ms(5000 / 250);
  times(&after);
  EXPECT(after.tms_utime - before.tms_utime <= 1);
}
CASE(clocks_read_by_syscall_are_the_same) {
  struct timespec said;
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &said), 0);
  const long long ns = said.tv_sec * 1000000000LL + said.tv_nsec;
  EXPECT(before <= ns && ns <= now_ns(CLOCK_MONOTONIC));
}
CASE(the_time_of_day_read_by_syscall_is_the_same) {
  struct timeval said;
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(syscall(SYS_gettimeofday, &said, NULL), 0);
  const long long ns = said.tv_sec * 1000000000LL + said.tv_usec * 1000;
  EXPECT(before - 1000 <= ns && ns <= now_ns(CLOCK_REALTIME));
  const time_t seconds = (time_t)syscall(SYS_time, NULL);
  EXPECT(seconds >= before / 1000000000 - 1 && seconds <= now_ns(CLOCK_REALTIME) / 1000000000);
}
CASE(the_resolution_asked_for_by_syscall_is_the_same) {
  struct timespec said = {-1, -1}, expected;
  EXPECT_IS(syscall(SYS_clock_getres, CLOCK_MONOTONIC, &said), 0);
  clock_getres(CLOCK_MONOTONIC, &expected);
  EXPECT(said.tv_sec == expected.tv_sec && said.tv_nsec == expected.tv_nsec);
}
CASE(all_threads_see_one_monotonic_clock) {
  extern void* read_monotonic(void*);
  long long read = 0;
  const long long before = now_ns(CLOCK_MONOTONIC);
  join(start(read_monotonic, &read));
  EXPECT(before <= read && read <= now_ns(CLOCK_MONOTONIC));
}
void* read_monotonic(void* to) {
  *(long long*)to = now_ns(CLOCK_MONOTONIC);
  return NULL;
}

static void* sleep_a_little(void* unused) {
  sleep_ms(20);
  return unused;
}
static void* end_at_once(void* unused) { return unused; }
CASE(a_thread_that_has_ended_has_no_clock) {
  const pthread_t id = start(end_at_once, NULL);
  sleep_ms(20);
  clockid_t clock;
  EXPECT_IS(pthread_getcpuclockid(id, &clock), ESRCH);
  join(id);
}
CASE(the_clock_of_a_thread_has_a_resolution) {
  const pthread_t id = start(sleep_a_little, NULL);
  clockid_t clock;
  struct timespec resolution = {7, 7};
  EXPECT_IS(pthread_getcpuclockid(id, &clock), 0);
  EXPECT_IS(clock_getres(clock, &resolution), 0);
  EXPECT(resolution.tv_sec == 0 && resolution.tv_nsec > 0);
  join(id);
}
CASE(what_is_no_date_cannot_be_set) {
  struct timespec time = {0, 1000000000};
  const struct timeval invalid = {0, 1000000};
  EXPECT_FAILS(clock_settime(CLOCK_REALTIME, &time), EINVAL);
  time.tv_nsec = 0;
  EXPECT_FAILS(clock_settime(CLOCK_MONOTONIC, &time), EINVAL);
  EXPECT_FAILS(clock_settime(77, &time), EINVAL);
  time.tv_sec = INT64_MAX;  // nanoseconds could not count it
  EXPECT_FAILS(clock_settime(CLOCK_REALTIME, &time), EINVAL);
  EXPECT_FAILS(settimeofday(&invalid, NULL), EINVAL);
}

// Negative numbers: the kind of processor time in two bits, a bit for threads, and the complement of an id, here 0.
CASE(the_fourth_kind_of_processor_time_is_no_clock) {
  struct timespec time = {0, 0};
  timer_t timer;
  EXPECT_FAILS(clock_gettime(-1, &time), EINVAL);
  EXPECT_FAILS(clock_getres(-1, &time), EINVAL);
  EXPECT_FAILS(clock_settime(-1, &time), EINVAL);
  EXPECT_IS(clock_nanosleep(-1, 0, &time, NULL), EINVAL);
  EXPECT_FAILS(timer_create(-1, NULL, &timer), EINVAL);
  EXPECT_FAILS(syscall(SYS_clock_gettime, -1, &time), EINVAL);
}
CASE(what_is_no_device_has_no_clock) {
  struct timespec time = {0, 0};
  timer_t timer;
  EXPECT_FAILS(clock_gettime(-5, &time), EINVAL);
  EXPECT_FAILS(clock_getres(-5, &time), EINVAL);
  EXPECT_IS(clock_nanosleep(-5, 0, &time, NULL), ENOTSUP);
  EXPECT_FAILS(timer_create(-5, NULL, &timer), ENOTSUP);
}
CASE(all_kinds_of_processor_time_are_clocks) {
  for (clockid_t clock = -8; clock < -1; ++clock) {
    if (clock == -5) continue;
    struct timespec time = {-1, -1};
    timer_t timer;
    EXPECT_IS(clock_gettime(clock, &time), 0);
    EXPECT(time.tv_sec >= 0);
    EXPECT_IS(clock_getres(clock, &time), 0);
    EXPECT_FAILS(clock_settime(clock, &time), EPERM);
    EXPECT_IS(timer_create(clock, NULL, &timer), 0);
    EXPECT_IS(timer_delete(timer), 0);
  }
}
CASE(no_thread_sleeps_by_its_own_processor_time) {
  const struct timespec time = {0, 1};
  clockid_t clock;
  EXPECT_IS(clock_nanosleep(-2, 0, &time, NULL), EINVAL);
  EXPECT_IS(clock_nanosleep(CLOCK_THREAD_CPUTIME_ID, 0, &time, NULL), EINVAL);
  EXPECT_IS(pthread_getcpuclockid(pthread_self(), &clock), 0);
  EXPECT_IS(clock_nanosleep(clock, 0, &time, NULL), EINVAL);
}
CASE(the_processor_clock_of_oneself_is_the_callers) {
  while (now_ns(CLOCK_THREAD_CPUTIME_ID) == 0) clock();
  const long long before = now_ns(CLOCK_THREAD_CPUTIME_ID), between = now_ns(-2),
                  after = now_ns(CLOCK_THREAD_CPUTIME_ID);
  EXPECT(before <= between && between <= after);
}
