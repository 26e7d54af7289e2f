// SPDX-License-Identifier: BSD-3-Clause
// Cleanup handlers, thread-specific data, and the order of their release.
#include "tests/exec/conformance/harness.h"

#include <limits.h>
#include <stdatomic.h>
#include <stdint.h>

static void note_it(void* what) { note((const char*)what); }

CASE(a_popped_handler_is_called_if_asked_for) {
  pthread_cleanup_push(note_it, "a");
  pthread_cleanup_push(note_it, "b");
  pthread_cleanup_pop(0);
  pthread_cleanup_pop(1);
  EXPECT_NOTED("a");
}

static void* exit_within(void* unused) {
  pthread_cleanup_push(note_it, "1");
  pthread_cleanup_push(note_it, "2");
  pthread_cleanup_push(note_it, "3");
  pthread_cleanup_pop(0);
  pthread_exit(NULL);
  pthread_cleanup_pop(0);
  pthread_cleanup_pop(0);
  return unused;
}
CASE(pthread_exit_calls_handlers_last_in_first_out) {
  join(start(exit_within, NULL));
  EXPECT_NOTED("21");
}

static void inner_frame(void) {
  pthread_cleanup_push(note_it, "inner ");
  pthread_exit(NULL);
  pthread_cleanup_pop(0);
}
static void* outer_frame(void* unused) {
  pthread_cleanup_push(note_it, "outer");
  inner_frame();
  pthread_cleanup_pop(0);
  return unused;
}
CASE(pthread_exit_calls_handlers_of_all_frames) {
  join(start(outer_frame, NULL));
  EXPECT_NOTED("inner outer");
}

static void* return_after_pop(void* unused) {
  pthread_cleanup_push(note_it, "x");
  pthread_cleanup_pop(0);
  return unused;
}
CASE(a_return_calls_no_handlers_that_were_popped) {
  join(start(return_after_pop, NULL));
  EXPECT_NOTED("");
}

static void* sleep_within(void* unused) {
  pthread_cleanup_push(note_it, "1");
  pthread_cleanup_push(note_it, "2");
  sleep_ms(5000);
  pthread_cleanup_pop(0);
  pthread_cleanup_pop(0);
  return unused;
}
CASE(cancellation_calls_handlers_last_in_first_out) {
  const pthread_t id = start(sleep_within, NULL);
  let_others_wait();
  pthread_cancel(id);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_NOTED("21");
}

static void sleep_and_note(void* what) {
  pthread_testcancel();
  sleep_ms(1);
  note((const char*)what);
}
static void* sleep_within_and_clean_slowly(void* unused) {
  pthread_cleanup_push(sleep_and_note, "slept");
  sleep_ms(5000);
  pthread_cleanup_pop(0);
  return unused;
}
CASE(handlers_pass_cancellation_points) {
  const pthread_t id = start(sleep_within_and_clean_slowly, NULL);
  let_others_wait();
  pthread_cancel(id);
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_NOTED("slept");
}

static pthread_key_t key, other_key;

static void* set_and_exit(void* unused) {
  pthread_setspecific(key, "k");
  pthread_cleanup_push(note_it, "c");
  pthread_exit(NULL);
  pthread_cleanup_pop(0);
  return unused;
}
CASE(handlers_come_before_destructors_of_keys) {
  pthread_key_create(&key, note_it);
  join(start(set_and_exit, NULL));
  EXPECT_NOTED("ck");
}

static void* look_and_set(void* value) {
  EXPECT(pthread_getspecific(key) == NULL);
  EXPECT_IS(pthread_setspecific(key, value), 0);
  sched_yield();
  EXPECT(pthread_getspecific(key) == value);
  return NULL;
}
CASE(each_thread_has_a_value_of_its_own) {
  EXPECT_IS(pthread_key_create(&key, NULL), 0);
  pthread_setspecific(key, "mine");
  const pthread_t a = start(look_and_set, "a"), b = start(look_and_set, "b");
  join(a);
  join(b);
  EXPECT(strcmp(pthread_getspecific(key), "mine") == 0);
}

static pthread_key_t made_later;
static void* look_at_later_key(void* unused) {
  while (pthread_getspecific(key) == NULL) {
    sleep_ms(1);
    if (made_later != 0) break;
  }
  EXPECT(pthread_getspecific(made_later) == NULL);
  return unused;
}
CASE(a_new_key_is_null_in_threads_that_live) {
  pthread_key_create(&key, NULL);
  const pthread_t id = start(look_at_later_key, NULL);
  pthread_key_t made;
  pthread_key_create(&made, NULL);
  pthread_setspecific(made, &made);
  made_later = made;
  join(id);
}

static void check_null_and_note(void* value) {
  EXPECT(pthread_getspecific(key) == NULL);
  note((const char*)value);
}
static void* set_value(void* value) {
  pthread_setspecific(key, value);
  return NULL;
}
CASE(a_destructor_gets_the_value_and_finds_null) {
  pthread_key_create(&key, check_null_and_note);
  join(start(set_value, "v"));
  EXPECT_NOTED("v");
}

CASE(a_destructor_is_not_called_for_null) {
  pthread_key_create(&key, note_it);
  join(start(set_value, NULL));
  EXPECT_NOTED("");
}

static int rounds;
static void set_again(void* value) {
  ++rounds;
  pthread_setspecific(key, value);
}
CASE(destructors_are_called_again_while_values_are_left) {
  pthread_key_create(&key, set_again);
  join(start(set_value, &rounds));
  EXPECT_IS(rounds, PTHREAD_DESTRUCTOR_ITERATIONS);
}

static void set_other(void* value) {
  note("1");
  pthread_setspecific(other_key, value);
}
CASE(a_value_that_a_destructor_sets_is_destroyed_too) {
  pthread_key_create(&other_key, note_it);
  pthread_key_create(&key, set_other);
  join(start(set_value, "2"));
  EXPECT_NOTED("12");
}

static void* set_both(void* unused) {
  pthread_setspecific(key, "1");
  pthread_setspecific(other_key, "2");
  return unused;
}
CASE(the_values_of_all_keys_are_destroyed) {
  pthread_key_create(&key, note_it);
  pthread_key_create(&other_key, note_it);
  join(start(set_both, NULL));
  EXPECT_IS(strlen(noted), 2);
}

static atomic_int turn;
static void* set_and_wait(void* value) {
  pthread_setspecific(key, value);
  atomic_store(&turn, 1);
  while (turn != 2) sched_yield();
  return NULL;
}
CASE(a_deleted_key_calls_no_destructor) {
  pthread_key_create(&key, note_it);
  const pthread_t id = start(set_and_wait, "v");
  while (turn != 1) sched_yield();
  EXPECT_IS(pthread_key_delete(key), 0);
  turn = 2;
  join(id);
  EXPECT_NOTED("");
}

CASE(a_key_made_after_a_deletion_is_null) {
  pthread_key_create(&key, NULL);
  pthread_setspecific(key, &key);
  pthread_key_delete(key);
  pthread_key_create(&other_key, NULL);
  EXPECT(pthread_getspecific(other_key) == NULL);
}

CASE(a_deleted_key_cannot_be_deleted_or_set) {
  pthread_key_create(&key, NULL);
  EXPECT_IS(pthread_key_delete(key), 0);
  EXPECT_IS(pthread_key_delete(key), EINVAL);
  EXPECT_IS(pthread_setspecific(key, &key), EINVAL);
}

CASE(a_key_that_was_never_made_is_invalid) {
  EXPECT_IS(pthread_key_delete(PTHREAD_KEYS_MAX), EINVAL);
  EXPECT_IS(pthread_setspecific(PTHREAD_KEYS_MAX, &key), EINVAL);
}

CASE(there_are_as_many_keys_as_PTHREAD_KEYS_MAX_says) {
  int made = 0, error;
  while ((error = pthread_key_create(&key, NULL)) == 0) ++made;
  EXPECT_IS(error, EAGAIN);
  EXPECT(made >= PTHREAD_KEYS_MAX - 2 && made <= PTHREAD_KEYS_MAX);
}

static void* set_many(void* unused) {
  for (pthread_key_t each = 0; each < 100; ++each) pthread_setspecific(each, "x");
  return unused;
}
CASE(a_hundred_keys_are_destroyed) {
  for (int i = 0; i < 100; ++i) pthread_key_create(&key, note_it);
  join(start(set_many, NULL));
  EXPECT(strlen(noted) >= 98);
}

static void lock_and_note(void* value) {
  static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  sleep_ms(1);
  note((const char*)value);
  pthread_mutex_unlock(&mutex);
}
CASE(destructors_may_block) {
  pthread_key_create(&key, lock_and_note);
  const pthread_t a = start(set_value, "x"), b = start(set_value, "x");
  join(a);
  join(b);
  EXPECT_NOTED("xx");
}

static void* cancelled_with_value(void* unused) {
  pthread_setspecific(key, "k");
  sleep_ms(5000);
  return unused;
}
CASE(cancellation_destroys_values_of_keys) {
  pthread_key_create(&key, note_it);
  const pthread_t id = start(cancelled_with_value, NULL);
  let_others_wait();
  pthread_cancel(id);
  join(id);
  EXPECT_NOTED("k");
}
