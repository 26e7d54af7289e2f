// SPDX-License-Identifier: BSD-3-Clause
// futex(2) by syscall(2), as run-time libraries use it.
#include "tests/exec/conformance/harness.h"

#include <linux/futex.h>
#include <stdatomic.h>
#include <stdint.h>
#include <sys/syscall.h>

static atomic_uint word, second;
static atomic_int woken;

static long futex(atomic_uint* address, int operation, unsigned value, const struct timespec* timeout,
                  atomic_uint* other, unsigned third) {
  return syscall(SYS_futex, address, operation, value, timeout, other, third);
}
static long wake(atomic_uint* address, int most) { return futex(address, FUTEX_WAKE, (unsigned)most, NULL, NULL, 0); }

struct wait {
  atomic_uint* address;
  unsigned mask;
};
static void* wait_for(void* argument) {
  const struct wait* of = argument;
  const long result = of->mask == 0 ? futex(of->address, FUTEX_WAIT, 0, NULL, NULL, 0)
                                    : futex(of->address, FUTEX_WAIT_BITSET, 0, NULL, NULL, of->mask);
  EXPECT_IS(result, 0);
  atomic_fetch_add(&woken, 1);
  return NULL;
}
static struct wait at_word = {&word, 0}, at_second = {&second, 0};
static void start_waiting(pthread_t* ids, int count, struct wait* at) {
  for (int i = 0; i < count; ++i) ids[i] = start(wait_for, at);
  let_others_wait();
}
static void join_all(pthread_t* ids, int count) {
  for (int i = 0; i < count; ++i) join(ids[i]);
}
static void settle(int expected) {
  for (int i = 0; i < 1000 && woken < expected; ++i) sleep_ms(1);
  sleep_ms(2);
  EXPECT_IS(woken, expected);
}

CASE(wait_with_another_value_does_not_wait) {
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 1, NULL, NULL, 0), EAGAIN);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT_BITSET, 1, NULL, NULL, FUTEX_BITSET_MATCH_ANY), EAGAIN);
}
CASE(wake_without_waiters_wakes_nobody) { EXPECT_IS(wake(&word, 1), 0); }
CASE(wake_wakes_one_that_waits) {
  pthread_t id;
  start_waiting(&id, 1, &at_word);
  EXPECT_IS(woken, 0);
  EXPECT_IS(wake(&word, 1), 1);
  join(id);
}
CASE(wake_wakes_as_many_as_it_says) {
  pthread_t ids[4];
  start_waiting(ids, 4, &at_word);
  EXPECT_IS(wake(&word, 3), 3);
  settle(3);
  EXPECT_IS(wake(&word, INT32_MAX), 1);
  join_all(ids, 4);
}
CASE(wake_at_another_address_wakes_nobody) {
  pthread_t id;
  start_waiting(&id, 1, &at_word);
  EXPECT_IS(wake(&second, 1), 0);
  EXPECT_IS(wake(&word, 1), 1);
  join(id);
}

static const struct timespec short_time = {0, 5000000};
CASE(wait_waits_for_its_timeout) {
  const long long begin = now_ns(CLOCK_MONOTONIC);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &short_time, NULL, 0), ETIMEDOUT);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 5000000);
}
CASE(wait_without_time_is_timed_out) {
  const struct timespec none = {0, 0};
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &none, NULL, 0), ETIMEDOUT);
}
CASE(wait_refuses_invalid_timeouts) {
  const struct timespec invalid = {0, 1000000000}, negative = {-1, 0}, too_small = {0, -1};
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &invalid, NULL, 0), EINVAL);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &negative, NULL, 0), EINVAL);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &too_small, NULL, 0), EINVAL);
}
CASE(wait_bitset_waits_until_its_deadline) {
  const long long begin = now_ns(CLOCK_MONOTONIC);
  const struct timespec deadline = in_ms(CLOCK_MONOTONIC, 5);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT_BITSET, 0, &deadline, NULL, FUTEX_BITSET_MATCH_ANY), ETIMEDOUT);
  EXPECT(now_ns(CLOCK_MONOTONIC) - begin >= 5000000);
}
CASE(wait_bitset_waits_by_the_realtime_clock) {
  const long long begin = now_ns(CLOCK_REALTIME);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5);
  EXPECT_FAILS(futex(&word, FUTEX_WAIT_BITSET | FUTEX_CLOCK_REALTIME, 0, &deadline, NULL, FUTEX_BITSET_MATCH_ANY),
               ETIMEDOUT);
  EXPECT(now_ns(CLOCK_REALTIME) - begin >= 5000000);
}
CASE(wait_bitset_with_a_past_deadline_is_timed_out) {
  const struct timespec past = {1, 0};
  EXPECT_FAILS(futex(&word, FUTEX_WAIT_BITSET, 0, &past, NULL, FUTEX_BITSET_MATCH_ANY), ETIMEDOUT);
}
CASE(a_bitset_without_bits_is_refused) {
  EXPECT_FAILS(futex(&word, FUTEX_WAIT_BITSET, 0, NULL, NULL, 0), EINVAL);
  EXPECT_FAILS(futex(&word, FUTEX_WAKE_BITSET, 1, NULL, NULL, 0), EINVAL);
}
CASE(wake_bitset_wakes_those_with_one_of_its_bits) {
  static struct wait with_1 = {&word, 1}, with_2 = {&word, 2}, with_3 = {&word, 3};
  pthread_t ids[3];
  start_waiting(ids, 1, &with_1);
  start_waiting(ids + 1, 1, &with_2);
  start_waiting(ids + 2, 1, &with_3);
  EXPECT_IS(futex(&word, FUTEX_WAKE_BITSET, INT32_MAX, NULL, NULL, 4), 0);
  EXPECT_IS(futex(&word, FUTEX_WAKE_BITSET, INT32_MAX, NULL, NULL, 2), 2);
  settle(2);
  EXPECT_IS(wake(&word, 1), 1);
  join_all(ids, 3);
}
CASE(a_wait_without_bits_of_its_own_has_all) {
  pthread_t id;
  start_waiting(&id, 1, &at_word);
  EXPECT_IS(futex(&word, FUTEX_WAKE_BITSET, 1, NULL, NULL, 16), 1);
  join(id);
}

static const struct timespec* number(unsigned long value) { return (const struct timespec*)value; }
CASE(requeue_moves_those_that_it_does_not_wake) {
  pthread_t ids[4];
  start_waiting(ids, 4, &at_word);
  EXPECT(futex(&word, FUTEX_REQUEUE, 1, number(2), &second, 0) >= 1);
  settle(1);
  EXPECT_IS(wake(&word, 10), 1);
  settle(2);
  EXPECT_IS(wake(&second, 10), 2);
  join_all(ids, 4);
}
CASE(cmp_requeue_counts_who_was_woken_or_moved) {
  pthread_t ids[3];
  start_waiting(ids, 3, &at_word);
  EXPECT_IS(futex(&word, FUTEX_CMP_REQUEUE, 1, number(INT32_MAX), &second, 0), 3);
  settle(1);
  EXPECT_IS(wake(&word, 10), 0);
  EXPECT_IS(wake(&second, 10), 2);
  join_all(ids, 3);
}
CASE(cmp_requeue_with_another_value_does_nothing) {
  EXPECT_FAILS(futex(&word, FUTEX_CMP_REQUEUE, 1, number(1), &second, 5), EAGAIN);
}
static void* wait_short(void* unused) {
  const struct timespec deadline = {0, 15000000 * patience()};
  EXPECT_FAILS(futex(&word, FUTEX_WAIT, 0, &deadline, NULL, 0), ETIMEDOUT);
  return unused;
}
CASE(who_was_moved_still_times_out) {
  const pthread_t id = start(wait_short, NULL);
  let_others_wait();
  EXPECT_IS(futex(&word, FUTEX_CMP_REQUEUE, 0, number(1), &second, 0), 1);
  join(id);
  EXPECT_IS(wake(&second, 1), 0);
}

CASE(wake_op_changes_the_second_word_and_wakes_at_both) {
  pthread_t ids[2];
  start_waiting(ids, 1, &at_word);
  start_waiting(ids + 1, 1, &at_second);
  // second = 7; it was 0, which is less than 1: its waiters are woken, too.
  EXPECT_IS(futex(&word, FUTEX_WAKE_OP, 1, number(1), &second, FUTEX_OP(FUTEX_OP_SET, 7, FUTEX_OP_CMP_LT, 1)), 2);
  EXPECT_IS(second, 7);
  join_all(ids, 2);
}
CASE(wake_op_wakes_at_the_first_alone_if_it_does_not_compare) {
  pthread_t ids[2];
  start_waiting(ids, 1, &at_word);
  start_waiting(ids + 1, 1, &at_second);
  EXPECT_IS(futex(&word, FUTEX_WAKE_OP, 1, number(1), &second, FUTEX_OP(FUTEX_OP_ADD, 3, FUTEX_OP_CMP_GT, 1)), 1);
  EXPECT_IS(second, 3);
  settle(1);
  EXPECT_IS(wake(&second, 1), 1);
  join_all(ids, 2);
}
static unsigned operated(unsigned before, int operation, int operand) {
  second = before;
  // FUTEX_OP would shift a negative number.
  const unsigned code = (unsigned)operation << 28 | (unsigned)FUTEX_OP_CMP_EQ << 24 | (unsigned)operand << 12 | 0xFFF;
  EXPECT_IS(futex(&word, FUTEX_WAKE_OP, 1, number(1), &second, code), 0);
  return second;
}
CASE(wake_op_has_five_operations) {
  EXPECT_IS(operated(12, FUTEX_OP_SET, 5), 5);
  EXPECT_IS(operated(12, FUTEX_OP_ADD, 5), 17);
  EXPECT_IS(operated(12, FUTEX_OP_OR, 5), 13);
  EXPECT_IS(operated(12, FUTEX_OP_ANDN, 5), 8);
  EXPECT_IS(operated(12, FUTEX_OP_XOR, 5), 9);
  EXPECT_IS(operated(12, FUTEX_OP_OR | FUTEX_OP_OPARG_SHIFT, 5), 12 | 32);
}
CASE(wake_op_adds_a_negative_number) { EXPECT_IS(operated(12, FUTEX_OP_ADD, 0xFFF), 11); }

CASE(an_operation_that_is_none_is_refused) { EXPECT_FAILS(futex(&word, 77, 0, NULL, NULL, 0), ENOSYS); }
CASE(an_address_that_is_not_aligned_is_refused) {
  EXPECT_FAILS(syscall(SYS_futex, (char*)&word + 1, FUTEX_WAIT, 0, NULL, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex, (char*)&word + 1, FUTEX_WAKE, 1, NULL, NULL, 0), EINVAL);
}

static atomic_uint lock_word;
static int counted;
static void* lock_and_count(void* unused) {
  // The lock of Drepper's "Futexes are tricky": 0 free, 1 taken, 2 taken with waiters.
  for (int i = 0; i < 100; ++i) {
    unsigned state = 0;
    if (!atomic_compare_exchange_strong(&lock_word, &state, 1)) {
      if (state != 2) state = atomic_exchange(&lock_word, 2);
      while (state != 0) {
        futex(&lock_word, FUTEX_WAIT, 2, NULL, NULL, 0);
        state = atomic_exchange(&lock_word, 2);
      }
    }
    const int before = counted;
    if (i % 10 == 0) sched_yield();
    counted = before + 1;
    if (atomic_fetch_sub(&lock_word, 1) != 1) {
      lock_word = 0;
      wake(&lock_word, 1);
    }
  }
  return unused;
}
CASE(a_lock_can_be_made_of_it) {
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(lock_and_count, NULL);
  join_all(ids, 4);
  EXPECT_IS(counted, 400);
}
