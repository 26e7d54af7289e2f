// SPDX-License-Identifier: BSD-3-Clause
// Bugs of time: two events coincide, and occur in the unexpected order. Computing is a sleep.
#include <errno.h>
#include <stdbool.h>
#include <time.h>

#include "tests/exec/zoo/crew.h"
#include "tests/exec/zoo/zoo.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed;
static struct timespec beginning;

static struct timespec after_ms(int ms) {
  const long ns = beginning.tv_nsec + ms * 1000000L;
  return (struct timespec){beginning.tv_sec + ns / 1000000000, ns % 1000000000};
}

static void sleep_until_ms(int ms) {
  const struct timespec at = after_ms(ms);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL);
}

static void begin(void) {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_cond_init(&changed, &attributes);
  clock_gettime(CLOCK_MONOTONIC, &beginning);
}

// Each period the planner gives a command, and the loop takes one. In a period in which the loop comes first it finds
// none; if the planner is first again in the next, there are two at once. Mended, there is room for two.
static int queued, dropped, taken;
enum { commands = 6 };

static void* give_commands(void* unused) {
  for (int period = 1; period <= commands; ++period) {
    sleep_until_ms(10 * period);
    pthread_mutex_lock(&lock);
    ++*(queued < (mended ? 2 : 1) ? &queued : &dropped);
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void* take_commands(void* unused) {
  bool is_over = false;
  for (int period = 1; !is_over; ++period) {
    sleep_until_ms(10 * period);
    pthread_mutex_lock(&lock);
    if (queued > 0) --queued, ++taken;
    is_over = taken + dropped == commands;
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void run_missed_period(int threads) {
  (void)threads;
  begin();
  start(give_commands);
  start(take_commands);
  join_all();
  check(dropped == 0, "a command is dropped");
}

// A request that timed out is repeated, and the answer to the first is taken for that to the second. Mended, answers
// have the number of their request.
static int asked, answered, answer;

static void* serve(void* unused) {
  for (int request = 1; request <= 2; ++request) {
    pthread_mutex_lock(&lock);
    while (asked < request) pthread_cond_wait(&changed, &lock);
    pthread_mutex_unlock(&lock);
    sleep_until_ms(5 * request);
    pthread_mutex_lock(&lock);
    answered = request;
    answer = 10 * request;
    pthread_cond_broadcast(&changed);
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void ask(int number) {
  answer = 0;
  asked = number;
  pthread_cond_broadcast(&changed);
}

static void* ask_twice(void* unused) {
  const struct timespec patience = after_ms(5);
  pthread_mutex_lock(&lock);
  ask(1);
  pthread_mutex_unlock(&lock);
  sleep_until_ms(1);
  pthread_mutex_lock(&lock);
  int error = 0;
  while (answered == 0 && error == 0) error = pthread_cond_timedwait(&changed, &lock, &patience);
  const bool is_answered = answered == 1;
  ask(2);
  while (!is_answered && (mended ? answered != 2 : answer == 0)) pthread_cond_wait(&changed, &lock);
  check(is_answered || answer == 20, "the answer to another question");
  pthread_mutex_unlock(&lock);
  return unused;
}

static void run_timeout_race(int threads) {
  (void)threads;
  begin();
  start(serve);
  start(ask_twice);
  join_all();
}

// The wait ends at its deadline, and at that instant the letter arrives: the reader leaves without it.
static bool has_letter;

static void* write_letter(void* unused) {
  sleep_until_ms(5);
  pthread_mutex_lock(&lock);
  has_letter = true;
  pthread_cond_signal(&changed);
  pthread_mutex_unlock(&lock);
  return unused;
}

static void* await_letter(void* unused) {
  const struct timespec deadline = after_ms(5);
  bool is_late = false;
  pthread_mutex_lock(&lock);
  while (!has_letter && !is_late) is_late = pthread_cond_timedwait(&changed, &lock, &deadline) == ETIMEDOUT;
  if (mended && has_letter) is_late = false;
  check(!is_late || !has_letter, "a letter is left behind");
  pthread_mutex_unlock(&lock);
  return unused;
}

static void run_deadline_tie(int threads) {
  (void)threads;
  begin();
  start(write_letter);
  start(await_letter);
  join_all();
}

// The watchdog reads the kick and then clears it: kicks in between are lost. Three in a row stop the robot. Mended, it
// reads and clears in one step.
static bool is_kicked;
enum { rounds = 5, missed_max = 2 };

static void* drive(void* unused) {
  for (int round = 1; round <= rounds; ++round) {
    sleep_until_ms(10 * round);
    pthread_mutex_lock(&lock);
    is_kicked = true;
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void* watch(void* unused) {
  for (int round = 1, missed = 0; round <= rounds; ++round) {
    sleep_until_ms(10 * round);
    pthread_mutex_lock(&lock);
    missed = is_kicked ? 0 : missed + 1;
    if (!mended) {
      pthread_mutex_unlock(&lock);
      pthread_mutex_lock(&lock);
    }
    is_kicked = false;
    pthread_mutex_unlock(&lock);
    check(missed <= missed_max, "the watchdog bites although it was kicked");
  }
  return unused;
}

static void run_watchdog_against_kick(int threads) {
  (void)threads;
  begin();
  start(drive);
  start(watch);
  join_all();
}

// Results of six images arrive at one instant, and are applied in order of arrival: some after a result taken three
// later. Three such jumps, and the robot is lost. Mended, results older than the estimate are left out.
static int estimate, jumps;

static void* measure(void* argument) {
  const int number = number_of(argument) + 1;
  sleep_until_ms(5 * number);
  sleep_until_ms(50);
  pthread_mutex_lock(&lock);
  if (!mended || number > estimate) {
    jumps += estimate - number > 2;
    estimate = number;
  }
  check(jumps < 3, "the robot jumps to where it was, again and again");
  pthread_mutex_unlock(&lock);
  return NULL;
}

static void run_late_measurement(int threads) {
  begin();
  for (int i = 0; i < threads; ++i) start(measure);
  join_all();
}

const struct specimen timings[] = {
    {"missed period", SYNCHRONIZATION, 2, run_missed_period},
    {"timeout race", SYNCHRONIZATION, 2, run_timeout_race},
    {"deadline tie", SYNCHRONIZATION, 2, run_deadline_tie},
    {"watchdog against kick", SYNCHRONIZATION, 2, run_watchdog_against_kick},
    {"late measurement", SYNCHRONIZATION, 6, run_late_measurement},
    {0},
};
