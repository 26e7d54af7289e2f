// SPDX-License-Identifier: BSD-3-Clause
// A program of cases. Each compares the calls' behaviour with a sentence of POSIX, C11 or the Linux manual pages:
//
//   PROGRAM --list    its cases, one per line: the exit status that means conformance, and the name
//   PROGRAM CASE      runs one; on a mismatch, prints it and ends with status 1
//
// This harness does not depend on waitpoint: the same program runs on system threads and on simulated ones. A case's
// output must be the same in each simulated run of one seed.
// case writes to its output must be the same in each simulated run of one seed.
#pragma once

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct conformance_case {
  const char* name;
  void (*body)(void);
  int status;
  struct conformance_case* next;
};

static struct conformance_case* first_case;
static struct conformance_case** last_link = &first_case;

#define CASE(name) CASE_ENDING_WITH(0, name)
#define CASE_ENDING_WITH(status, name)                                   \
  static void name(void);                                                \
  static struct conformance_case case_##name = {#name, name, status, 0}; \
  __attribute__((constructor)) static void add_##name(void) {            \
    *last_link = &case_##name;                                           \
    last_link = &case_##name.next;                                       \
  }                                                                      \
  static void name(void)

static inline void expect_equal(const char* file, int line, const char* text, long long is, long long expected) {
  if (is == expected) return;
  fprintf(stderr, "%s:%d: %s is %lld, not %lld (errno %d)\n", file, line, text, is, expected, errno);
  _exit(1);
}

#define EXPECT(condition) expect_equal(__FILE__, __LINE__, #condition, (condition) ? 1 : 0, 1)
#define EXPECT_IS(value, expected) expect_equal(__FILE__, __LINE__, #value, (long long)(value), (long long)(expected))
/// For calls that return -1 and set errno.
#define EXPECT_FAILS(call, number)                              \
  do {                                                          \
    errno = 0;                                                  \
    EXPECT_IS(call, -1);                                        \
    expect_equal(__FILE__, __LINE__, "errno", errno, (number)); \
  } while (0)

static inline long long now_ns(clockid_t clock) {
  struct timespec time;
  EXPECT_IS(clock_gettime(clock, &time), 0);
  return time.tv_sec * 1000000000LL + time.tv_nsec;
}

/// Factor on the short waits of a case: on a loaded machine, threads are late.
static inline long patience(void) {
  const char* const text = getenv("CONFORMANCE_PATIENCE");
  return text != NULL ? atol(text) : 1;
}

/// The clock's present time plus `ms`, which may be negative.
static inline struct timespec in_ms(clockid_t clock, long long ms) {
  const long long ns = now_ns(clock) + (ms < 1000 ? ms * patience() : ms) * 1000000;
  const struct timespec time = {ns / 1000000000, ns % 1000000000};
  return time;
}

/// A time in the future with too many nanoseconds.
static inline struct timespec invalid_time(clockid_t clock) {
  struct timespec time = in_ms(clock, 5000);
  time.tv_nsec = 1000000000;
  return time;
}

static inline void sleep_ms(long ms) {
  const long long ns = (ms < 1000 ? ms * patience() : ms) * 1000000LL;
  const struct timespec time = {ns / 1000000000, ns % 1000000000};
  nanosleep(&time, NULL);
}
/// Long enough for the other threads to reach their waits.
static inline void let_others_wait(void) { sleep_ms(4); }

static inline pthread_t start(void* (*function)(void*), void* argument) {
  pthread_t id;
  EXPECT_IS(pthread_create(&id, NULL, function, argument), 0);
  return id;
}

static inline void* join(pthread_t id) {
  void* result = NULL;
  EXPECT_IS(pthread_join(id, &result), 0);
  return result;
}

/// The actions of a case's threads, in order.
static char noted[256];
static inline void note(const char* what) { strncat(noted, what, sizeof noted - strlen(noted) - 1); }
static inline void expect_noted(const char* file, int line, const char* expected) {
  if (strcmp(noted, expected) == 0) return;
  fprintf(stderr, "%s:%d: what was done is \"%s\", not \"%s\"\n", file, line, noted, expected);
  _exit(1);
}
#define EXPECT_NOTED(expected) expect_noted(__FILE__, __LINE__, expected)

int main(int argc, char** argv) {
  const struct conformance_case* each;
  if (argc == 2 && strcmp(argv[1], "--list") == 0) {
    for (each = first_case; each != NULL; each = each->next) printf("%d %s\n", each->status, each->name);
    return 0;
  }
  for (each = first_case; argc == 2 && each != NULL; each = each->next) {
    if (strcmp(argv[1], each->name) != 0) continue;
    each->body();
    return 0;
  }
  fprintf(stderr, "expected --list or a case\n");
  return 2;
}
