// SPDX-License-Identifier: BSD-3-Clause
// <threads.h>.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <stdint.h>
#include <threads.h>

static mtx_t mutex;
static cnd_t condition;
static tss_t key;
static atomic_int counted, ready;

static thrd_t begin(thrd_start_t function, void* argument) {
  thrd_t id;
  EXPECT_IS(thrd_create(&id, function, argument), thrd_success);
  return id;
}
static int result_of(thrd_t id) {
  int result = -77;
  EXPECT_IS(thrd_join(id, &result), thrd_success);
  return result;
}

static int twice(void* argument) { return 2 * *(int*)argument; }
CASE(a_thread_gets_its_argument_and_gives_its_result) {
  int value = 21;
  EXPECT_IS(result_of(begin(twice, &value)), 42);
}
static int negative(void* unused) {
  (void)unused;
  return -5;
}
CASE(a_result_may_be_negative) { EXPECT_IS(result_of(begin(negative, NULL)), -5); }
static int exit_with_9(void* unused) {
  (void)unused;
  thrd_exit(9);
}
CASE(thrd_exit_gives_the_result) { EXPECT_IS(result_of(begin(exit_with_9, NULL)), 9); }
CASE(thrd_join_takes_no_result_where_none_is_wanted) {
  EXPECT_IS(thrd_join(begin(negative, NULL), NULL), thrd_success);
}
static int same(void* id) { return thrd_equal(thrd_current(), *(thrd_t*)id) != 0; }
CASE(thrd_current_tells_threads_apart) {
  thrd_t own = thrd_current();
  EXPECT_IS(result_of(begin(same, &own)), 0);
  EXPECT(thrd_equal(own, thrd_current()));
}
static int count(void* unused) {
  (void)unused;
  atomic_fetch_add(&counted, 1);
  return 0;
}
CASE(a_detached_thread_runs_to_its_end) {
  for (int i = 0; i < 5; ++i) EXPECT_IS(thrd_detach(begin(count, NULL)), thrd_success);
  while (counted < 5) thrd_yield();
}
static int wait_by_yields(void* unused) {
  (void)unused;
  while (!ready) thrd_yield();
  return 3;
}
CASE(thrd_yield_lets_others_go_on) {
  const thrd_t id = begin(wait_by_yields, NULL);
  thrd_sleep(&(struct timespec){0, 1000000}, NULL);
  ready = 1;
  EXPECT_IS(result_of(id), 3);
}
CASE(thrd_sleep_sleeps_so_long) {
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(thrd_sleep(&(struct timespec){0, 5000000}, NULL), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - before >= 5000000);
}
CASE(thrd_sleep_refuses_invalid_nanoseconds) {
  EXPECT(thrd_sleep(&(struct timespec){0, 1000000000}, NULL) < 0);
  EXPECT(thrd_sleep(&(struct timespec){0, 1000000000}, NULL) != -1);
}

static int try_it(void* unused) {
  (void)unused;
  const int result = mtx_trylock(&mutex);
  if (result == thrd_success) mtx_unlock(&mutex);
  return result;
}
CASE(a_plain_mutex_is_busy_while_it_is_held) {
  EXPECT_IS(mtx_init(&mutex, mtx_plain), thrd_success);
  EXPECT_IS(mtx_lock(&mutex), thrd_success);
  EXPECT_IS(result_of(begin(try_it, NULL)), thrd_busy);
  EXPECT_IS(mtx_unlock(&mutex), thrd_success);
  EXPECT_IS(result_of(begin(try_it, NULL)), thrd_success);
  mtx_destroy(&mutex);
}
CASE(a_plain_mutex_of_oneself_is_busy) {
  mtx_init(&mutex, mtx_plain);
  EXPECT_IS(mtx_trylock(&mutex), thrd_success);
  EXPECT_IS(mtx_trylock(&mutex), thrd_busy);
}
CASE(a_recursive_mutex_is_locked_again) {
  EXPECT_IS(mtx_init(&mutex, mtx_plain | mtx_recursive), thrd_success);
  EXPECT_IS(mtx_lock(&mutex), thrd_success);
  EXPECT_IS(mtx_lock(&mutex), thrd_success);
  EXPECT_IS(mtx_trylock(&mutex), thrd_success);
  for (int i = 0; i < 3; ++i) {
    EXPECT_IS(result_of(begin(try_it, NULL)), thrd_busy);
    EXPECT_IS(mtx_unlock(&mutex), thrd_success);
  }
  EXPECT_IS(result_of(begin(try_it, NULL)), thrd_success);
}
CASE(a_recursive_mutex_of_another_is_not_unlocked) {
  mtx_init(&mutex, mtx_plain | mtx_recursive);
  EXPECT_IS(mtx_unlock(&mutex), thrd_error);
}
static int lock_until(void* deadline) { return mtx_timedlock(&mutex, deadline); }
static struct timespec in_utc_ms(long ms) {
  struct timespec time;
  EXPECT_IS(timespec_get(&time, TIME_UTC), TIME_UTC);
  time.tv_nsec += ms * 1000000;
  time.tv_sec += time.tv_nsec / 1000000000;
  time.tv_nsec %= 1000000000;
  return time;
}
CASE(timedlock_waits_until_its_deadline) {
  EXPECT_IS(mtx_init(&mutex, mtx_timed), thrd_success);
  mtx_lock(&mutex);
  struct timespec deadline = in_utc_ms(5);
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(result_of(begin(lock_until, &deadline)), thrd_timedout);
  EXPECT(now_ns(CLOCK_MONOTONIC) - before >= 4000000);
}
CASE(timedlock_gets_a_free_mutex) {
  mtx_init(&mutex, mtx_timed);
  struct timespec past = {0, 0};
  EXPECT_IS(result_of(begin(lock_until, &past)), thrd_success);
}
CASE(timedlock_refuses_invalid_nanoseconds) {
  mtx_init(&mutex, mtx_timed);
  mtx_lock(&mutex);
  struct timespec invalid = invalid_time(CLOCK_REALTIME);
  EXPECT_IS(result_of(begin(lock_until, &invalid)), thrd_error);
}
static int count_inside(void* unused) {
  (void)unused;
  for (int i = 0; i < 50; ++i) {
    mtx_lock(&mutex);
    const int before = counted;
    if (i % 8 == 0) thrd_yield();
    counted = before + 1;
    mtx_unlock(&mutex);
  }
  return 0;
}
CASE(one_thread_at_a_time_holds_a_mutex) {
  mtx_init(&mutex, mtx_plain);
  thrd_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = begin(count_inside, NULL);
  for (int i = 0; i < 4; ++i) result_of(ids[i]);
  EXPECT_IS(counted, 200);
}

static int tickets, waiting;
static int take_ticket(void* unused) {
  (void)unused;
  mtx_lock(&mutex);
  ++waiting;
  while (tickets == 0) EXPECT_IS(cnd_wait(&condition, &mutex), thrd_success);
  --tickets;
  mtx_unlock(&mutex);
  return 0;
}
static void wake(int threads, int (*how)(cnd_t*)) {
  mtx_init(&mutex, mtx_plain);
  EXPECT_IS(cnd_init(&condition), thrd_success);
  thrd_t ids[4];
  for (int i = 0; i < threads; ++i) ids[i] = begin(take_ticket, NULL);
  mtx_lock(&mutex);
  while (waiting < threads) {
    mtx_unlock(&mutex);
    thrd_yield();
    mtx_lock(&mutex);
  }
  tickets = threads;
  EXPECT_IS(how(&condition), thrd_success);
  mtx_unlock(&mutex);
  for (int i = 0; i < threads; ++i) result_of(ids[i]);
  cnd_destroy(&condition);
}
CASE(cnd_signal_wakes_one) { wake(1, cnd_signal); }
CASE(cnd_broadcast_wakes_all) { wake(4, cnd_broadcast); }
CASE(cnd_timedwait_waits_until_its_deadline) {
  mtx_init(&mutex, mtx_plain);
  cnd_init(&condition);
  mtx_lock(&mutex);
  const struct timespec deadline = in_utc_ms(5), past = {0, 0};
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(cnd_timedwait(&condition, &mutex, &deadline), thrd_timedout);
  EXPECT(now_ns(CLOCK_MONOTONIC) - before >= 4000000);
  EXPECT_IS(cnd_timedwait(&condition, &mutex, &past), thrd_timedout);
  EXPECT_IS(mtx_unlock(&mutex), thrd_success);
}
static int signal_it(void* unused) {
  (void)unused;
  mtx_lock(&mutex);
  tickets = 1;
  cnd_signal(&condition);
  mtx_unlock(&mutex);
  return 0;
}
CASE(cnd_timedwait_is_signalled_before_its_deadline) {
  mtx_init(&mutex, mtx_plain);
  cnd_init(&condition);
  mtx_lock(&mutex);
  const thrd_t id = begin(signal_it, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  while (tickets == 0) EXPECT_IS(cnd_timedwait(&condition, &mutex, &deadline), thrd_success);
  mtx_unlock(&mutex);
  result_of(id);
}

static void note_value(void* value) { note((const char*)value); }
static int set_value(void* value) {
  EXPECT(tss_get(key) == NULL);
  EXPECT_IS(tss_set(key, value), thrd_success);
  EXPECT(tss_get(key) == value);
  return 0;
}
CASE(tss_values_are_each_threads_own_and_destroyed) {
  EXPECT_IS(tss_create(&key, note_value), thrd_success);
  tss_set(key, "main");
  result_of(begin(set_value, "a"));
  EXPECT(strcmp(tss_get(key), "main") == 0);
  EXPECT_NOTED("a");
}
static int set_and_wait(void* value) {
  tss_set(key, value);
  ready = 1;
  while (ready != 2) thrd_yield();
  return 0;
}
CASE(a_deleted_tss_key_calls_no_destructor) {
  tss_create(&key, note_value);
  const thrd_t id = begin(set_and_wait, "a");
  while (ready != 1) thrd_yield();
  tss_delete(key);
  ready = 2;
  result_of(id);
  EXPECT_NOTED("");
}
CASE(tss_keys_run_out) {
  int made = 0, result;
  while ((result = tss_create(&key, NULL)) == thrd_success && made < 5000) ++made;
  EXPECT_IS(result, thrd_error);
}

static thrd_t current;
static int change_current(void* unused) {
  (void)unused;
  current = thrd_current();
  return 0;
}
CASE(a_loop_of_comparisons_ends) {
  int (*volatile equal)(thrd_t, thrd_t) = thrd_equal;
  thrd_t id;
  current = thrd_current();
  EXPECT_IS(thrd_create(&id, change_current, NULL), thrd_success);
  while (equal(*(volatile thrd_t*)&current, thrd_current())) continue;
  EXPECT(equal(current, id));
  EXPECT_IS(thrd_join(id, NULL), thrd_success);
}
