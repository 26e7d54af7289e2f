// SPDX-License-Identifier: BSD-3-Clause
// Ends of the process.
#include "tests/exec/conformance/harness.h"

#include <assert.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <sys/socket.h>

static void* sleep_long(void* unused) {
  (void)unused;
  sleep_ms(5000);
  _exit(1);
}

CASE_ENDING_WITH(0, the_return_of_main_ends_the_other_threads) { start(sleep_long, NULL); }

CASE_ENDING_WITH(9, exit_of_main_ends_the_other_threads) {
  start(sleep_long, NULL);
  exit(9);
}

static void* exit_with(void* status) {
  exit((int)(intptr_t)status);
  return NULL;
}
CASE_ENDING_WITH(8, exit_of_another_thread_ends_the_process) {
  start(exit_with, (void*)8);
  sleep_ms(5000);
}

static void* quick_exit_with(void* status) { _exit((int)(intptr_t)status); }
CASE_ENDING_WITH(6, _exit_of_another_thread_ends_the_process) {
  start(quick_exit_with, (void*)6);
  sleep_ms(5000);
}

static void* do_nothing(void* unused) { return unused; }
CASE_ENDING_WITH(0, after_pthread_exit_of_all_threads_the_process_ends_with_0) {
  start(do_nothing, NULL);
  pthread_exit((void*)5);
}

static void* exit_later(void* status) {
  sleep_ms(5);
  exit((int)(intptr_t)status);
  return NULL;
}
CASE_ENDING_WITH(4, after_pthread_exit_of_main_the_others_go_on) {
  start(exit_later, (void*)4);
  pthread_exit(NULL);
}

static void first_at_exit(void) { note("1"); }
static void second_at_exit(void) { note("2"); }
static void check_at_exit(void) { _exit(strcmp(noted, "21") == 0 ? 3 : 1); }
CASE_ENDING_WITH(3, functions_of_atexit_are_called_in_reverse) {
  atexit(check_at_exit);
  atexit(first_at_exit);
  atexit(second_at_exit);
}

CASE_ENDING_WITH(3, functions_of_atexit_are_called_when_another_thread_exits) {
  atexit(check_at_exit);
  atexit(first_at_exit);
  atexit(second_at_exit);
  start(exit_with, NULL);
  sleep_ms(5000);
}

CASE_ENDING_WITH(3, functions_of_atexit_are_called_when_the_last_thread_ends) {
  atexit(check_at_exit);
  atexit(first_at_exit);
  atexit(second_at_exit);
  start(do_nothing, NULL);
  pthread_exit(NULL);
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static void lock_at_exit(void) {
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  _exit(5);
}
CASE_ENDING_WITH(5, functions_of_atexit_use_primitives) { atexit(lock_at_exit); }

static void* start_and_join(void* unused) {
  (void)unused;
  join(start(do_nothing, NULL));
  return NULL;
}
static void threads_at_exit(void) {
  join(start(start_and_join, NULL));
  _exit(2);
}
CASE_ENDING_WITH(2, functions_of_atexit_make_threads) { atexit(threads_at_exit); }

static void destroy(void* value) {
  (void)value;
  _exit(1);
}
CASE_ENDING_WITH(0, exit_calls_no_destructors_of_keys) {
  pthread_key_t key;
  pthread_key_create(&key, destroy);
  pthread_setspecific(key, &key);
}

static void destroy_and_note(void* value) { note((const char*)value); }
CASE_ENDING_WITH(3, pthread_exit_of_main_calls_destructors_of_keys) {
  pthread_key_t key;
  pthread_key_create(&key, destroy_and_note);
  pthread_setspecific(key, "2");
  atexit(check_at_exit);
  atexit(first_at_exit);
  pthread_exit(NULL);
}

CASE_ENDING_WITH(-6, abort_ends_by_its_signal) {
  start(sleep_long, NULL);
  abort();
}

static void* abort_there(void* unused) {
  (void)unused;
  abort();
}
CASE_ENDING_WITH(-6, abort_of_another_thread_ends_by_its_signal) {
  start(abort_there, NULL);
  sleep_ms(5000);
}

static void* write_to_null(void* unused) {
  *(volatile int*)unused = 1;
  return NULL;
}
CASE_ENDING_WITH(-11, a_bad_address_in_another_thread_ends_by_its_signal) {
  start(write_to_null, NULL);
  sleep_ms(5000);
}

static void at_quick_exit_7(void) { _exit(7); }
CASE_ENDING_WITH(7, quick_exit_calls_its_own_functions) {
  atexit(check_at_exit);
  at_quick_exit(at_quick_exit_7);
  quick_exit(1);
}

CASE_ENDING_WITH(0, a_thread_that_holds_a_mutex_at_exit_keeps_nobody) {
  pthread_mutex_lock(&mutex);
  start(sleep_long, NULL);
  exit(0);
}

CASE_ENDING_WITH(5, _Exit_calls_no_function_of_atexit) {
  atexit(check_at_exit);
  _Exit(5);
}

static void exit_6(int signal) {
  (void)signal;
  _exit(6);
}
CASE_ENDING_WITH(6, an_assertion_that_fails_aborts) {
  signal(SIGABRT, exit_6);
  assert(noted[0] != 0);
}

static void* open_socket(void* descriptor) {
  *(int*)descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  return NULL;
}
CASE(what_a_thread_has_opened_stays_open_after_its_end) {
  int descriptor = -1;
  pthread_t thread = start(open_socket, &descriptor);
  pthread_join(thread, NULL);
  EXPECT_IS(close(descriptor), 0);
}

static pthread_mutex_t left = PTHREAD_MUTEX_INITIALIZER, right = PTHREAD_MUTEX_INITIALIZER;
static void* lock_left_first(void* unused) {
  pthread_mutex_lock(&left);
  sleep_ms(5);
  pthread_mutex_lock(&right);
  return unused;
}
static void* lock_right_first(void* unused) {
  pthread_mutex_lock(&right);
  sleep_ms(5);
  pthread_mutex_lock(&left);
  return unused;
}
CASE_ENDING_WITH(3, threads_that_wait_for_each_other_keep_nobody) {
  start(lock_left_first, NULL);
  start(lock_right_first, NULL);
  sleep_ms(20);
  EXPECT_IS(pthread_mutex_trylock(&left), EBUSY);
  exit(3);
}
static void* lock_twice(void* unused) {
  pthread_mutex_lock(&left);
  pthread_mutex_lock(&left);
  return unused;
}
CASE_ENDING_WITH(4, a_thread_that_waits_for_itself_keeps_nobody) {
  start(lock_twice, NULL);
  sleep_ms(20);
  exit(4);
}
