// SPDX-License-Identifier: BSD-3-Clause
// One-time initialisation.
#include "tests/exec/conformance/harness.h"

#include <dlfcn.h>
#include <stdatomic.h>
#include <threads.h>

static pthread_once_t flag = PTHREAD_ONCE_INIT;
static once_flag c11_flag = ONCE_FLAG_INIT;
static atomic_int calls, attempts, done;

static void call_slowly(void) {
  atomic_fetch_add(&calls, 1);
  sleep_ms(3);
  atomic_store(&done, 1);
}
static void* by_posix(void* unused) {
  EXPECT_IS(pthread_once(&flag, call_slowly), 0);
  EXPECT_IS(done, 1);
  return unused;
}
static void* by_c11(void* unused) {
  call_once(&c11_flag, call_slowly);
  EXPECT_IS(done, 1);
  return unused;
}
static void by_many(void* (*function)(void*)) {
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(function, NULL);
  for (int i = 0; i < 4; ++i) join(ids[i]);
  EXPECT_IS(calls, 1);
}

CASE(pthread_once_calls_once_and_all_wait_for_it) { by_many(by_posix); }
CASE(call_once_calls_once_and_all_wait_for_it) { by_many(by_c11); }
CASE(a_second_call_does_nothing) {
  for (int i = 0; i < 3; ++i) by_posix(NULL);
  EXPECT_IS(calls, 1);
}

static void end_the_first_time(void) {
  if (atomic_fetch_add(&attempts, 1) == 0) pthread_exit(NULL);
}
static void* try_to_end(void* unused) {
  pthread_once(&flag, end_the_first_time);
  return unused;
}
CASE(a_function_left_by_pthread_exit_is_called_again) {
  join(start(try_to_end, NULL));
  EXPECT_IS(pthread_once(&flag, end_the_first_time), 0);
  EXPECT_IS(attempts, 2);
  EXPECT_IS(pthread_once(&flag, end_the_first_time), 0);
  EXPECT_IS(attempts, 2);
}

static void sleep_the_first_time(void) {
  if (atomic_fetch_add(&attempts, 1) == 0) sleep_ms(5000);
}
static void* try_to_sleep(void* unused) {
  pthread_once(&flag, sleep_the_first_time);
  return unused;
}
CASE(a_cancelled_function_is_called_again) {
  const pthread_t id = start(try_to_sleep, NULL);
  let_others_wait();
  pthread_cancel(id);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(pthread_once(&flag, sleep_the_first_time), 0);
  EXPECT_IS(attempts, 2);
}
CASE(who_waits_for_a_cancelled_function_calls_it) {
  const pthread_t id = start(try_to_sleep, NULL);
  let_others_wait();
  const pthread_t other = start(try_to_sleep, NULL);
  let_others_wait();
  pthread_cancel(id);
  EXPECT(join(id) == PTHREAD_CANCELED);
  join(other);
  EXPECT_IS(attempts, 2);
}

static pthread_once_t inner = PTHREAD_ONCE_INIT;
static void call_inner(void) {
  pthread_once(&inner, call_slowly);
  note("outer");
}
CASE(a_function_may_call_another_once) {
  pthread_once(&flag, call_inner);
  pthread_once(&flag, call_inner);
  EXPECT_IS(calls, 1);
  EXPECT_NOTED("outer");
}

CASE(a_flag_set_anew_counts_anew) {
  for (int i = 0; i < 3; ++i) {
    const pthread_once_t fresh = PTHREAD_ONCE_INIT;
    flag = fresh;
    by_posix(NULL);
  }
  EXPECT_IS(calls, 3);
}

static void* many_flags(void* flags) {
  for (int i = 0; i < 50; ++i) pthread_once((pthread_once_t*)flags + i, call_slowly);
  return NULL;
}
CASE(flags_beside_each_other_are_told_apart) {
  static pthread_once_t flags[50];
  done = 1;
  const pthread_t a = start(many_flags, flags);
  join(a);
  many_flags(flags);
  EXPECT_IS(calls, 50);
}

// Older programs and libraries were linked with this name.
CASE(the_older_name_of_pthread_once_means_the_same) {
  int (*const old)(pthread_once_t*, void (*)(void)) =
      (int (*)(pthread_once_t*, void (*)(void)))dlsym(RTLD_DEFAULT, "__pthread_once");
  if (old == NULL) return;
  EXPECT_IS(old(&flag, call_slowly), 0);
  EXPECT_IS(pthread_once(&flag, call_slowly), 0);
  EXPECT_IS(calls, 1);
}
static void* set_value(void* key) {
  pthread_setspecific(*(pthread_key_t*)key, "destroyed");
  return NULL;
}
static void note_value(void* value) { note((const char*)value); }
CASE(the_older_name_of_pthread_key_create_means_the_same) {
  int (*const old)(pthread_key_t*, void (*)(void*)) =
      (int (*)(pthread_key_t*, void (*)(void*)))dlsym(RTLD_DEFAULT, "__pthread_key_create");
  if (old == NULL) return;
  pthread_key_t key;
  EXPECT_IS(old(&key, note_value), 0);
  join(start(set_value, &key));
  EXPECT_NOTED("destroyed");
}
