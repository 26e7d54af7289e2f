// SPDX-License-Identifier: BSD-3-Clause
// Futexes with an owner id, and waits for several futexes at once.
#include "tests/exec/conformance/harness.h"

#include <linux/futex.h>
#include <stdint.h>
#include <sys/syscall.h>

static unsigned word;
static long futex(unsigned* at, int operation, const struct timespec* timeout) {
  return syscall(SYS_futex, at, operation, 0, timeout, NULL, 0);
}

CASE(a_free_word_is_taken_with_ones_id) {
  EXPECT_IS(futex(&word, FUTEX_LOCK_PI, NULL), 0);
  EXPECT_IS(word, gettid());
  EXPECT_IS(futex(&word, FUTEX_UNLOCK_PI, NULL), 0);
  EXPECT_IS(word, 0);
  EXPECT_IS(futex(&word, FUTEX_TRYLOCK_PI, NULL), 0);
  EXPECT_IS(futex(&word, FUTEX_UNLOCK_PI_PRIVATE, NULL), 0);
}
CASE(who_owns_it_is_told) {
  EXPECT_IS(futex(&word, FUTEX_LOCK_PI, NULL), 0);
  EXPECT_FAILS(futex(&word, FUTEX_LOCK_PI, NULL), EDEADLK);
  EXPECT_FAILS(futex(&word, FUTEX_TRYLOCK_PI, NULL), EDEADLK);
}
CASE(who_does_not_own_it_cannot_unlock_it) { EXPECT_FAILS(futex(&word, FUTEX_UNLOCK_PI, NULL), EPERM); }

static void* lock_and_unlock(void* order) {
  EXPECT_IS(futex(&word, FUTEX_LOCK_PI, NULL), 0);
  EXPECT_IS(word & FUTEX_TID_MASK, gettid());
  note(order);
  EXPECT_IS(futex(&word, FUTEX_UNLOCK_PI, NULL), 0);
  return NULL;
}
CASE(who_waits_gets_it_from_its_owner) {
  EXPECT_IS(futex(&word, FUTEX_LOCK_PI, NULL), 0);
  const pthread_t one = start(lock_and_unlock, "b"), other = start(lock_and_unlock, "b");
  let_others_wait();
  EXPECT(word & FUTEX_WAITERS);
  note("a");
  EXPECT_IS(futex(&word, FUTEX_UNLOCK_PI, NULL), 0);
  join(one);
  join(other);
  EXPECT_NOTED("abb");
  EXPECT_IS(word, 0);
}
static void* try_and_time_out(void* unused) {
  EXPECT_FAILS(futex(&word, FUTEX_TRYLOCK_PI, NULL), EAGAIN);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 5);
  EXPECT_FAILS(futex(&word, FUTEX_LOCK_PI, &soon), ETIMEDOUT);
  EXPECT(now_ns(CLOCK_REALTIME) >= soon.tv_sec * 1000000000LL + soon.tv_nsec);
  return unused;
}
CASE(it_is_waited_for_until_a_date) {
  EXPECT_IS(futex(&word, FUTEX_LOCK_PI, NULL), 0);
  join(start(try_and_time_out, NULL));
}

static unsigned first, second;
static long wait_for_both(const struct timespec* deadline, clockid_t clock) {
  struct futex_waitv both[2] = {{0, (uintptr_t)&first, 2, 0}, {0, (uintptr_t)&second, 2, 0}};
  return syscall(SYS_futex_waitv, both, 2, 0, deadline, clock);
}
static void* wake_the_second(void* unused) {
  let_others_wait();
  __atomic_store_n(&second, 1, __ATOMIC_SEQ_CST);
  EXPECT_IS(syscall(SYS_futex, &second, FUTEX_WAKE, 1, NULL, NULL, 0), 1);
  return unused;
}
CASE(of_several_the_one_that_was_woken_is_told) {
  const pthread_t waking = start(wake_the_second, NULL);
  EXPECT_IS(wait_for_both(NULL, CLOCK_MONOTONIC), 1);
  join(waking);
}
CASE(several_are_not_waited_for_with_another_value) {
  second = 1;
  EXPECT_FAILS(wait_for_both(NULL, CLOCK_MONOTONIC), EAGAIN);
}
CASE(several_are_waited_for_until_a_time) {
  const struct timespec soon = in_ms(CLOCK_MONOTONIC, 5), late = in_ms(CLOCK_REALTIME, -5);
  EXPECT_FAILS(wait_for_both(&soon, CLOCK_MONOTONIC), ETIMEDOUT);
  EXPECT_FAILS(wait_for_both(&late, CLOCK_REALTIME), ETIMEDOUT);
  EXPECT_FAILS(wait_for_both(&soon, CLOCK_BOOTTIME), EINVAL);
}
CASE(what_is_no_vector_is_refused) {
  struct futex_waitv of_bytes = {0, (uintptr_t)&first, 0, 0}, nowhere = {0, 8, 2, 0},
                     odd = {0, (uintptr_t)&first + 1, 2, 0};
  EXPECT_FAILS(syscall(SYS_futex_waitv, NULL, 1, 0, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &odd, 0, 0, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &odd, 129, 0, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &odd, 1, 1, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &odd, 1, 0, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &of_bytes, 1, 0, NULL, 0), EINVAL);
  EXPECT_FAILS(syscall(SYS_futex_waitv, &nowhere, 1, 0, NULL, 0), EFAULT);
}
