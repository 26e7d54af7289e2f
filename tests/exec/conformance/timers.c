// SPDX-License-Identifier: BSD-3-Clause
// alarm(), setitimer(), timer_create() and signalfd().
#include "tests/exec/conformance/harness.h"

#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/time.h>

#ifndef sigev_notify_thread_id
#define sigev_notify_thread_id _sigev_un._tid
#endif

static atomic_int handled;
static volatile siginfo_t told;
static volatile pthread_t handled_by;
static void handle(int signal, siginfo_t* information, void* context) {
  (void)signal;
  (void)context;
  told = *information;
  handled_by = pthread_self();
  atomic_fetch_add(&handled, 1);
}
static void act(int signal) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = handle;
  action.sa_flags = SA_SIGINFO;
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}
static void block(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, &set, NULL), 0);
}
static struct itimerval every_us(long first, long interval) {
  const struct itimerval time = {{interval / 1000000, interval % 1000000}, {first / 1000000, first % 1000000}};
  return time;
}
static struct itimerspec in_ns(long first, long interval) {
  const struct itimerspec time = {{interval / 1000000000, interval % 1000000000},
                                  {first / 1000000000, first % 1000000000}};
  return time;
}

CASE(alarm_sends_after_its_seconds) {
  act(SIGALRM);
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(alarm(1), 0);
  EXPECT_FAILS(pause(), EINTR);
  EXPECT_IS(handled, 1);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 990000000);
  EXPECT_IS(told.si_signo, SIGALRM);
}
CASE(alarm_tells_what_was_left) {
  act(SIGALRM);
  EXPECT_IS(alarm(100), 0);
  EXPECT_IS(alarm(50), 100);
  EXPECT_IS(alarm(0), 50);
  EXPECT_IS(alarm(0), 0);
}
CASE_ENDING_WITH(-14, an_alarm_ends_the_process_by_default) {
  alarm(1);
  for (;;) pause();
}
CASE(ualarm_ends_a_sleep) {
  act(SIGALRM);
  EXPECT_IS(ualarm(500000, 0), 0);
  EXPECT(sleep(4) > 0);
  EXPECT_IS(handled, 1);
}
CASE(ualarm_repeats) {
  act(SIGALRM);
  EXPECT_IS(ualarm(5000, 5000), 0);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_FAILS(pause(), EINTR);
    EXPECT(handled >= i);
  }
  EXPECT(ualarm(0, 0) <= 5000);
}
CASE(setitimer_repeats) {
  act(SIGALRM);
  const struct itimerval time = every_us(10000, 20000), none = every_us(0, 0);
  struct itimerval old;
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(setitimer(ITIMER_REAL, &time, NULL), 0);
  while (handled < 3) pause();
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 50000000);
  EXPECT_IS(setitimer(ITIMER_REAL, &none, &old), 0);
  EXPECT_IS(old.it_interval.tv_usec, 20000);
  EXPECT(old.it_value.tv_usec <= 20000);
  const int so_far = handled;
  sleep_ms(30);
  EXPECT_IS(handled, so_far);
}
CASE(getitimer_tells_what_is_left) {
  const struct itimerval time = every_us(100000000, 30);
  struct itimerval now;
  EXPECT_IS(getitimer(ITIMER_REAL, &now), 0);
  EXPECT(now.it_value.tv_sec == 0 && now.it_value.tv_usec == 0);
  EXPECT_IS(setitimer(ITIMER_REAL, &time, &now), 0);
  EXPECT_IS(getitimer(ITIMER_REAL, &now), 0);
  EXPECT(now.it_value.tv_sec == 99 || now.it_value.tv_sec == 100);
  EXPECT_IS(now.it_interval.tv_usec, 30);
  EXPECT_IS(alarm(0), 100);
}
CASE(itimers_refuse_what_they_are_not) {
  const struct itimerval bad = {{0, 0}, {0, 1000000}}, negative = {{0, 0}, {-1, 0}}, good = every_us(5, 0);
  struct itimerval now;
  EXPECT_FAILS(setitimer(ITIMER_REAL, &bad, NULL), EINVAL);
  EXPECT_FAILS(setitimer(ITIMER_REAL, &negative, NULL), EINVAL);
  EXPECT_FAILS(setitimer((__itimer_which_t)77, &good, NULL), EINVAL);
  EXPECT_FAILS(getitimer((__itimer_which_t)77, &now), EINVAL);
}
static void spend(int signal) {
  act(signal);
  const struct itimerval time = every_us(3000, 3000), none = every_us(0, 0);
  const __itimer_which_t which = signal == SIGPROF ? ITIMER_PROF : ITIMER_VIRTUAL;
  EXPECT_IS(setitimer(which, &time, NULL), 0);
  while (handled < 2) clock();
  EXPECT_IS(setitimer(which, &none, NULL), 0);
  EXPECT_IS(told.si_signo, signal);
}
CASE(processor_time_ends_ITIMER_PROF) { spend(SIGPROF); }
CASE(processor_time_ends_ITIMER_VIRTUAL) { spend(SIGVTALRM); }
CASE(sleeping_spends_no_processor_time) {
  act(SIGPROF);
  const struct itimerval time = every_us(100000, 0);
  EXPECT_IS(setitimer(ITIMER_PROF, &time, NULL), 0);
  sleep_ms(300);
  EXPECT_IS(handled, 0);
}

static timer_t make(clockid_t clock, int notify, int signal, int value) {
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = notify;
  event.sigev_signo = signal;
  event.sigev_value.sival_int = value;
  timer_t timer;
  EXPECT_IS(timer_create(clock, &event, &timer), 0);
  return timer;
}
CASE(a_timer_sends_its_signal_with_its_value) {
  act(SIGRTMIN);
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN, 42);
  const struct itimerspec time = in_ns(10000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  EXPECT_FAILS(pause(), EINTR);
  EXPECT_IS(told.si_signo, SIGRTMIN);
  EXPECT_IS(told.si_code, SI_TIMER);
  EXPECT_IS(told.si_value.sival_int, 42);
  EXPECT_IS(told.si_overrun, 0);
  EXPECT_IS(timer_delete(timer), 0);
}
CASE(without_an_event_a_timer_sends_ALRM) {
  act(SIGALRM);
  timer_t timer;
  EXPECT_IS(timer_create(CLOCK_REALTIME, NULL, &timer), 0);
  const struct itimerspec time = in_ns(1000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  EXPECT_FAILS(pause(), EINTR);
  EXPECT_IS(told.si_signo, SIGALRM);
  EXPECT_IS(timer_delete(timer), 0);
}
CASE(a_timer_may_have_a_date) {
  act(SIGRTMIN);
  const timer_t timer = make(CLOCK_REALTIME, SIGEV_SIGNAL, SIGRTMIN, 0);
  struct itimerspec time = {{0, 0}, in_ms(CLOCK_REALTIME, 20)};
  EXPECT_IS(timer_settime(timer, TIMER_ABSTIME, &time, NULL), 0);
  EXPECT_FAILS(pause(), EINTR);
  EXPECT_IS(handled, 1);
  // A past date expires at once.
  time.it_value.tv_sec -= 100;
  EXPECT_IS(timer_settime(timer, TIMER_ABSTIME, &time, NULL), 0);
  sleep_ms(10);
  EXPECT_IS(handled, 2);
}
CASE(a_timer_repeats) {
  act(SIGRTMIN);
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN, 0);
  const struct itimerspec time = in_ns(10000000, 20000000);
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  while (handled < 3) pause();
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 50000000);
  timer_delete(timer);
  const int so_far = handled;
  sleep_ms(30);
  EXPECT_IS(handled, so_far);
}
CASE(a_timer_tells_what_is_left) {
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGALRM, 0);
  struct itimerspec now, old;
  EXPECT_IS(timer_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 0 && now.it_value.tv_nsec == 0);
  const struct itimerspec time = in_ns(100000000000, 7), none = in_ns(0, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  EXPECT_IS(timer_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 99 || now.it_value.tv_sec == 100);
  EXPECT_IS(now.it_interval.tv_nsec, 7);
  EXPECT_IS(timer_settime(timer, 0, &none, &old), 0);
  EXPECT(old.it_value.tv_sec == 99 || old.it_value.tv_sec == 100);
  EXPECT_IS(timer_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 0 && now.it_value.tv_nsec == 0);
}
CASE(a_timer_that_notifies_nobody_runs_out) {
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_NONE, 0, 0);
  const struct itimerspec time = in_ns(5000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  sleep_ms(10);
  struct itimerspec now;
  EXPECT_IS(timer_gettime(timer, &now), 0);
  EXPECT(now.it_value.tv_sec == 0 && now.it_value.tv_nsec == 0);
}
CASE(a_pending_signal_of_a_timer_counts_how_often) {
  block(SIGRTMIN);
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN, 0);
  const struct itimerspec time = in_ns(10000000, 10000000);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  const struct timespec span = {0, 105000000};
  nanosleep(&span, NULL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGRTMIN);
  siginfo_t information;
  EXPECT_IS(sigwaitinfo(&set, &information), SIGRTMIN);
  EXPECT(information.si_overrun >= 9);
  EXPECT(timer_getoverrun(timer) >= 9);
  timer_delete(timer);
}
CASE(timers_refuse_what_they_are_not) {
  struct sigevent event;
  memset(&event, 0, sizeof event);
  timer_t timer;
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = 65;
  EXPECT_FAILS(timer_create(CLOCK_REALTIME, &event, &timer), EINVAL);
  event.sigev_notify = 77;
  event.sigev_signo = SIGUSR1;
  EXPECT_FAILS(timer_create(CLOCK_REALTIME, &event, &timer), EINVAL);
  EXPECT_FAILS(timer_create((clockid_t)77, NULL, &timer), EINVAL);
  timer = make(CLOCK_REALTIME, SIGEV_NONE, 0, 0);
  struct itimerspec bad = in_ns(5, 0);
  bad.it_value.tv_nsec = 1000000000;
  EXPECT_FAILS(timer_settime(timer, 0, &bad, NULL), EINVAL);
  bad.it_value.tv_nsec = -1;
  EXPECT_FAILS(timer_settime(timer, 0, &bad, NULL), EINVAL);
  EXPECT_IS(timer_delete(timer), 0);
  EXPECT_FAILS(timer_delete(timer), EINVAL);
  EXPECT_FAILS(timer_getoverrun(timer), EINVAL);
  EXPECT_FAILS(timer_gettime(timer, &bad), EINVAL);
  bad = in_ns(5, 0);
  EXPECT_FAILS(timer_settime(timer, 0, &bad, NULL), EINVAL);
}
static atomic_int called;
static pthread_t called_in;
static void note_call(union sigval value) {
  called_in = pthread_self();
  atomic_fetch_add(&called, value.sival_int);
}
CASE(a_timer_may_start_threads) {
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_THREAD;
  event.sigev_notify_function = note_call;
  event.sigev_value.sival_int = 10;
  timer_t timer;
  EXPECT_IS(timer_create(CLOCK_MONOTONIC, &event, &timer), 0);
  const struct itimerspec time = in_ns(5000000, 5000000);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  for (int i = 0; i < 1000 && called < 30; ++i) sleep_ms(5);
  EXPECT(called >= 30);
  EXPECT(!pthread_equal(called_in, pthread_self()));
  EXPECT_IS(timer_delete(timer), 0);
}
static atomic_int other;
static void* sleep_until_handled(void* unused) {
  other = gettid();
  while (!handled) sleep_ms(50);
  EXPECT(pthread_equal(handled_by, pthread_self()));
  return unused;
}
CASE(a_timer_may_send_to_a_thread) {
  act(SIGRTMIN);
  const pthread_t id = start(sleep_until_handled, NULL);
  while (other == 0) sched_yield();
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SIGRTMIN;
  event.sigev_notify_thread_id = other;
  timer_t timer;
  EXPECT_IS(timer_create(CLOCK_MONOTONIC, &event, &timer), 0);
  const struct itimerspec time = in_ns(5000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  join(id);
  EXPECT_IS(handled, 1);
}
CASE(a_timer_may_count_processor_time) {
  act(SIGRTMIN);
  const timer_t timer = make(CLOCK_PROCESS_CPUTIME_ID, SIGEV_SIGNAL, SIGRTMIN, 0);
  const struct itimerspec time = in_ns(2000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  while (!handled) clock();
  EXPECT_IS(told.si_code, SI_TIMER);
}
CASE(a_deleted_timer_sends_nothing) {
  act(SIGRTMIN);
  const timer_t timer = make(CLOCK_MONOTONIC, SIGEV_SIGNAL, SIGRTMIN, 0);
  const struct itimerspec time = in_ns(5000000, 0);
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  EXPECT_IS(timer_delete(timer), 0);
  sleep_ms(20);
  EXPECT_IS(handled, 0);
}

static int open_for(int signal, int flags) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  const int descriptor = signalfd(-1, &set, flags);
  EXPECT(descriptor >= 0);
  return descriptor;
}
CASE(signalfd_reads_what_pends) {
  block(SIGUSR1);
  const int descriptor = open_for(SIGUSR1, SFD_NONBLOCK | SFD_CLOEXEC);
  struct signalfd_siginfo read_one;
  EXPECT_FAILS(read(descriptor, &read_one, sizeof read_one), EAGAIN);
  struct pollfd one = {descriptor, POLLIN, 0};
  EXPECT_IS(poll(&one, 1, 0), 0);
  kill(getpid(), SIGUSR1);
  EXPECT_IS(poll(&one, 1, 1000), 1);
  EXPECT_IS(read(descriptor, &read_one, sizeof read_one), (long long)sizeof read_one);
  EXPECT_IS(read_one.ssi_signo, SIGUSR1);
  EXPECT_IS(read_one.ssi_pid, getpid());
  EXPECT_FAILS(read(descriptor, &read_one, sizeof read_one), EAGAIN);
  EXPECT_IS(poll(&one, 1, 0), 0);
  EXPECT_FAILS(read(descriptor, &read_one, 3), EINVAL);
  EXPECT_IS(close(descriptor), 0);
}
CASE(signalfd_waits_for_a_timer) {
  block(SIGALRM);
  const int descriptor = open_for(SIGALRM, 0);
  const struct itimerval time = every_us(10000, 0);
  EXPECT_IS(setitimer(ITIMER_REAL, &time, NULL), 0);
  struct signalfd_siginfo read_one;
  EXPECT_IS(read(descriptor, &read_one, sizeof read_one), (long long)sizeof read_one);
  EXPECT_IS(read_one.ssi_signo, SIGALRM);
}
CASE(signalfd_can_be_given_another_set) {
  block(SIGUSR1);
  block(SIGUSR2);
  const int descriptor = open_for(SIGUSR1, SFD_NONBLOCK);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR2);
  EXPECT_IS(signalfd(descriptor, &set, 0), descriptor);
  raise(SIGUSR1);
  struct signalfd_siginfo read_one;
  EXPECT_FAILS(read(descriptor, &read_one, sizeof read_one), EAGAIN);
  raise(SIGUSR2);
  EXPECT_IS(read(descriptor, &read_one, sizeof read_one), (long long)sizeof read_one);
  EXPECT_IS(read_one.ssi_signo, SIGUSR2);
  EXPECT_FAILS(signalfd(1000, &set, 0), EBADF);
  EXPECT_FAILS(signalfd(-1, &set, 77), EINVAL);
}

static timer_t shared_timer;
static atomic_int deleted;
static void* delete_timer(void* unused) {
  (void)unused;
  if (timer_delete(shared_timer) == 0) atomic_fetch_add(&deleted, 1);
  return NULL;
}
CASE(a_timer_is_deleted_once) {
  EXPECT_IS(timer_create(CLOCK_MONOTONIC, NULL, &shared_timer), 0);
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) EXPECT_IS(pthread_create(&threads[i], NULL, delete_timer, NULL), 0);
  for (int i = 0; i < 2; ++i) EXPECT_IS(pthread_join(threads[i], NULL), 0);
  EXPECT_IS(deleted, 1);
}
static void do_nothing(union sigval value) { (void)value; }
static void* make_timer(void* to) {
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_THREAD;
  event.sigev_notify_function = do_nothing;
  EXPECT_IS(timer_create(CLOCK_MONOTONIC, &event, to), 0);
  return NULL;
}
CASE(timers_of_two_threads_are_two) {
  timer_t timers[2];
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) EXPECT_IS(pthread_create(&threads[i], NULL, make_timer, &timers[i]), 0);
  for (int i = 0; i < 2; ++i) EXPECT_IS(pthread_join(threads[i], NULL), 0);
  EXPECT(timers[0] != timers[1]);
  for (int i = 0; i < 2; ++i) EXPECT_IS(timer_delete(timers[i]), 0);
}

static void* tell_clock(void* to) {
  EXPECT_IS(pthread_getcpuclockid(pthread_self(), to), 0);
  sleep_ms(20);
  return NULL;
}
CASE(a_timer_of_a_thread_that_has_ended_cannot_be_set) {
  clockid_t clock = -1;
  timer_t timer;
  const pthread_t id = start(tell_clock, &clock);
  let_others_wait();
  EXPECT_IS(timer_create(clock, NULL, &timer), 0);
  const struct itimerspec time = in_ns(1000000000, 0);
  struct itimerspec now;
  EXPECT_IS(timer_settime(timer, 0, &time, NULL), 0);
  join(id);
  EXPECT_FAILS(timer_settime(timer, 0, &time, NULL), ESRCH);
  EXPECT_IS(timer_gettime(timer, &now), 0);
  EXPECT_IS(now.it_value.tv_sec + now.it_value.tv_nsec, 0);
  EXPECT_IS(timer_delete(timer), 0);
}
