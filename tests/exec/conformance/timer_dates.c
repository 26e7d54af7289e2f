// SPDX-License-Identifier: BSD-3-Clause
// Timers with past dates, their overruns, and arguments rejected by clocks and sleeps.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>

static volatile int hits;
static siginfo_t last;
static void on(int n, siginfo_t* i, void* c) {
  (void)n;
  (void)c;
  ++hits;
  last = *i;
}
static void handle(int s) {
  struct sigaction a = {.sa_sigaction = on, .sa_flags = SA_SIGINFO};
  sigemptyset(&a.sa_mask);
  EXPECT_IS(sigaction(s, &a, NULL), 0);
}
static timer_t make(clockid_t c, int s) {
  timer_t t;
  struct sigevent e;
  memset(&e, 0, sizeof e);
  e.sigev_notify = SIGEV_SIGNAL;
  e.sigev_signo = s;
  e.sigev_value.sival_int = 55;
  EXPECT_IS(timer_create(c, &e, &t), 0);
  return t;
}
static void set(timer_t t, int flags, long long ns, long long i) {
  struct itimerspec s = {{i / 1000000000, i % 1000000000}, {ns / 1000000000, ns % 1000000000}};
  EXPECT_IS(timer_settime(t, flags, &s, NULL), 0);
}
static sem_t sem;
static void by_thread(union sigval v) {
  *(int*)v.sival_ptr += 1;
  sem_post(&sem);
}
CASE(overrun_counts) {
  handle(SIGRTMIN);
  timer_t t = make(CLOCK_MONOTONIC, SIGRTMIN);
  sigset_t s;
  sigemptyset(&s);
  sigaddset(&s, SIGRTMIN);
  sigprocmask(SIG_BLOCK, &s, NULL);
  set(t, 0, 1000000, 1000000);
  sleep_ms(50);
  struct itimerspec z = {{0, 0}, {0, 0}};
  sigprocmask(SIG_UNBLOCK, &s, NULL);
  EXPECT(timer_getoverrun(t) >= 40);
  EXPECT(last.si_overrun >= 40);
  EXPECT_IS(last.si_value.sival_int, 55);
  EXPECT_IS(last.si_code, SI_TIMER);
  (void)z;
}
CASE(abs_past_fires_at_once) {
  handle(SIGRTMIN);
  timer_t t = make(CLOCK_REALTIME, SIGRTMIN);
  set(t, TIMER_ABSTIME, 1, 0);
  sleep_ms(2);
  EXPECT_IS(hits, 1);
}
CASE(abs_past_with_interval_overruns) {
  handle(SIGRTMIN);
  timer_t t = make(CLOCK_MONOTONIC, SIGRTMIN);
  set(t, TIMER_ABSTIME, now_ns(CLOCK_MONOTONIC) - 50000000, 10000000);
  sleep_ms(1);
  EXPECT_IS(hits, 1);
  EXPECT(timer_getoverrun(t) >= 4);
}
CASE(disarm_by_zero) {
  handle(SIGRTMIN);
  timer_t t = make(CLOCK_MONOTONIC, SIGRTMIN);
  set(t, 0, 5000000, 0);
  set(t, 0, 0, 5000000);
  sleep_ms(20);
  EXPECT_IS(hits, 0);
  struct itimerspec g;
  EXPECT_IS(timer_gettime(t, &g), 0);
  EXPECT_IS(g.it_value.tv_nsec + g.it_value.tv_sec, 0);
}
CASE(settime_tells_old) {
  timer_t t = make(CLOCK_MONOTONIC, SIGRTMIN);
  set(t, 0, 1000000000000LL, 2000000000LL);
  struct itimerspec s = {{0, 0}, {0, 0}}, o;
  EXPECT_IS(timer_settime(t, 0, &s, &o), 0);
  EXPECT(o.it_value.tv_sec >= 999);
  EXPECT_IS(o.it_interval.tv_sec, 2);
}
CASE(many_timers) {
  handle(SIGRTMIN);
  for (int i = 0; i < 200; ++i) set(make(CLOCK_MONOTONIC, SIGRTMIN), 0, 1000000 + i * 1000, 0);
  for (int i = 0; i < 300 && hits < 200; ++i) sleep_ms(1);
  EXPECT_IS(hits, 200);
}
CASE(thread_timer_with_attributes) {
  timer_t t;
  struct sigevent e;
  int n = 0;
  pthread_attr_t a;
  pthread_attr_init(&a);
  pthread_attr_setstacksize(&a, 1 << 20);
  memset(&e, 0, sizeof e);
  sem_init(&sem, 0, 0);
  e.sigev_notify = SIGEV_THREAD;
  e.sigev_notify_function = by_thread;
  e.sigev_notify_attributes = &a;
  e.sigev_value.sival_ptr = &n;
  EXPECT_IS(timer_create(CLOCK_MONOTONIC, &e, &t), 0);
  pthread_attr_destroy(&a);
  set(t, 0, 2000000, 0);
  sem_wait(&sem);
  EXPECT_IS(n, 1);
}
CASE(boottime_timer) {
  handle(SIGRTMIN);
  timer_t t = make(CLOCK_BOOTTIME, SIGRTMIN);
  set(t, 0, 1000000, 0);
  sleep_ms(20);
  EXPECT_IS(hits, 1);
}
CASE(clock_getres_sane) {
  struct timespec r;
  EXPECT_IS(clock_getres(CLOCK_REALTIME, &r), 0);
  EXPECT_IS(r.tv_sec, 0);
  EXPECT(r.tv_nsec <= 20000000);
  EXPECT_IS(clock_getres(CLOCK_REALTIME, NULL), 0);
  EXPECT_FAILS(clock_getres(77, &r), EINVAL);
  EXPECT_FAILS(clock_getres(-1000, &r), EINVAL);
}
CASE(clock_gettime_errors) {
  struct timespec r;
  EXPECT_FAILS(clock_gettime(77, &r), EINVAL);
  EXPECT_FAILS(clock_settime(CLOCK_MONOTONIC, &r), EINVAL);
  r.tv_sec = 0;
  r.tv_nsec = 1000000000;
  EXPECT_FAILS(clock_settime(CLOCK_REALTIME, &r), EINVAL);
  r.tv_nsec = -1;
  EXPECT_FAILS(clock_settime(CLOCK_REALTIME, &r), EINVAL);
}
CASE(getcpuclockid_of_process) {
  clockid_t c;
  EXPECT_IS(clock_getcpuclockid(0, &c), 0);
  struct timespec r;
  EXPECT_IS(clock_gettime(c, &r), 0);
  EXPECT_IS(clock_getcpuclockid(getpid(), &c), 0);
  EXPECT_IS(clock_gettime(c, &r), 0);
  EXPECT(clock_getcpuclockid(0x3fffff, &c) != 0);
}
CASE(nanosleep_null_faults) { EXPECT_FAILS(nanosleep(NULL, NULL), EFAULT); }
CASE(alarm_and_itimer_are_one) {
  alarm(100);
  struct itimerval o;
  EXPECT_IS(getitimer(ITIMER_REAL, &o), 0);
  EXPECT(o.it_value.tv_sec >= 99);
}
CASE(calls_on_timers_refuse_bad_addresses) {
  char* const none = mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  EXPECT(none != MAP_FAILED);
  timer_t t = make(CLOCK_MONOTONIC, SIGRTMIN);
  struct itimerspec s = {{0, 0}, {0, 0}};
  EXPECT_FAILS(timer_settime(t, 0, (struct itimerspec*)none, NULL), EFAULT);
  EXPECT_FAILS(timer_settime(t, 0, &s, (struct itimerspec*)none), EFAULT);
  EXPECT_FAILS(timer_gettime(t, (struct itimerspec*)none), EFAULT);
  EXPECT_FAILS(nanosleep((struct timespec*)none, NULL), EFAULT);
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC, 0, (struct timespec*)none, NULL), EFAULT);
}
