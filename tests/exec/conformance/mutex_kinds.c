// SPDX-License-Identifier: BSD-3-Clause
// Results of each kind of mutex: of every type, robust, and with priority inheritance.
#include "tests/exec/conformance/harness.h"

static pthread_mutex_t m;
static pthread_mutexattr_t ma;
static pthread_cond_t c;
static void make(int type, int proto, int robust) {
  pthread_mutexattr_init(&ma);
  EXPECT_IS(pthread_mutexattr_settype(&ma, type), 0);
  EXPECT_IS(pthread_mutexattr_setprotocol(&ma, proto), 0);
  EXPECT_IS(pthread_mutexattr_setrobust(&ma, robust), 0);
  EXPECT_IS(pthread_mutex_init(&m, &ma), 0);
}
static void* die_locked(void* p) {
  pthread_mutex_lock(&m);
  return p;
}
static void* try_it(void* p) {
  *(int*)p = pthread_mutex_trylock(&m);
  if (*(int*)p == 0) pthread_mutex_unlock(&m);
  return NULL;
}
static void* unlock_it(void* p) {
  *(int*)p = pthread_mutex_unlock(&m);
  return NULL;
}
#define OF_KIND(case_name, type_of_kind, protocol, robust, ...)                   \
  CASE(case_name) {                                                               \
    make(type_of_kind, protocol, robust);                                         \
    const int type = type_of_kind, inherits = (protocol) == PTHREAD_PRIO_INHERIT; \
    (void)type;                                                                   \
    (void)inherits;                                                               \
    __VA_ARGS__                                                                   \
  }
#define EACH(name, ...)                                                                         \
  OF_KIND(name##_normal, PTHREAD_MUTEX_NORMAL, 0, 0, __VA_ARGS__)                               \
  OF_KIND(name##_errorcheck, PTHREAD_MUTEX_ERRORCHECK, 0, 0, __VA_ARGS__)                       \
  OF_KIND(name##_recursive, PTHREAD_MUTEX_RECURSIVE, 0, 0, __VA_ARGS__)                         \
  OF_KIND(name##_pi_normal, PTHREAD_MUTEX_NORMAL, PTHREAD_PRIO_INHERIT, 0, __VA_ARGS__)         \
  OF_KIND(name##_pi_errorcheck, PTHREAD_MUTEX_ERRORCHECK, PTHREAD_PRIO_INHERIT, 0, __VA_ARGS__) \
  OF_KIND(name##_robust, PTHREAD_MUTEX_ERRORCHECK, 0, 1, __VA_ARGS__)                           \
  OF_KIND(name##_pp, PTHREAD_MUTEX_ERRORCHECK, PTHREAD_PRIO_INHERIT, 1, __VA_ARGS__)
EACH(trylock_of_held, {
  int r;
  pthread_mutex_lock(&m);
  join(start(try_it, &r));
  EXPECT_IS(r, EBUSY);
  EXPECT_IS(pthread_mutex_unlock(&m), 0);
})
EACH(timedlock_own, {
  pthread_mutex_lock(&m);
  struct timespec t = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_mutex_timedlock(&m, &t), type == PTHREAD_MUTEX_RECURSIVE ? 0
                                             : type == PTHREAD_MUTEX_ERRORCHECK || inherits
                                                 ? (type == PTHREAD_MUTEX_ERRORCHECK ? EDEADLK : ETIMEDOUT)
                                                 : ETIMEDOUT);
})
EACH(timedlock_invalid_of_free, {
  struct timespec t = {0, -1};
  EXPECT_IS(pthread_mutex_timedlock(&m, &t), 0);
})
EACH(unlock_of_others, {
  int r;
  pthread_mutex_lock(&m);
  join(start(unlock_it, &r));
  if (type != PTHREAD_MUTEX_NORMAL || inherits) EXPECT_IS(r, EPERM);
})
EACH(unlock_of_free, {
  if (type != PTHREAD_MUTEX_NORMAL || inherits) EXPECT_IS(pthread_mutex_unlock(&m), EPERM);
})
EACH(clocklock_bad_clock, {
  struct timespec t = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_mutex_clocklock(&m, 77, &t), EINVAL);
})

CASE(trylock_of_ones_own_tells_of_a_deadlock_if_it_is_robust) {
  make(PTHREAD_MUTEX_ERRORCHECK, 0, 1);
  pthread_mutex_lock(&m);
  EXPECT_IS(pthread_mutex_trylock(&m), EDEADLK);
  make(PTHREAD_MUTEX_ERRORCHECK, PTHREAD_PRIO_INHERIT, 0);
  pthread_mutex_lock(&m);
  EXPECT_IS(pthread_mutex_trylock(&m), EDEADLK);
  make(PTHREAD_MUTEX_ERRORCHECK, 0, 0);
  pthread_mutex_lock(&m);
  EXPECT_IS(pthread_mutex_trylock(&m), EBUSY);
}
CASE(a_wait_with_a_mutex_that_was_not_put_right_loses_it) {
  make(PTHREAD_MUTEX_NORMAL, 0, 1);
  join(start(die_locked, NULL));
  pthread_cond_init(&c, NULL);
  EXPECT_IS(pthread_mutex_lock(&m), EOWNERDEAD);
  struct timespec t = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_cond_timedwait(&c, &m, &t), ENOTRECOVERABLE);
  EXPECT_IS(pthread_mutex_lock(&m), ENOTRECOVERABLE);
}
CASE(lock_own_errorcheck) {
  make(PTHREAD_MUTEX_ERRORCHECK, 0, 0);
  pthread_mutex_lock(&m);
  EXPECT_IS(pthread_mutex_lock(&m), EDEADLK);
}
CASE(lock_own_pi_errorcheck) {
  make(PTHREAD_MUTEX_ERRORCHECK, PTHREAD_PRIO_INHERIT, 0);
  pthread_mutex_lock(&m);
  EXPECT_IS(pthread_mutex_lock(&m), EDEADLK);
}
CASE(getprioceiling_of_none) {
  make(PTHREAD_MUTEX_NORMAL, 0, 0);
  int x;
  EXPECT_IS(pthread_mutex_getprioceiling(&m, &x), EINVAL);
  EXPECT_IS(pthread_mutex_setprioceiling(&m, 5, &x), EINVAL);
}
CASE(robust_pi_owner_died) {
  make(PTHREAD_MUTEX_NORMAL, PTHREAD_PRIO_INHERIT, 1);
  join(start(die_locked, NULL));
  EXPECT_IS(pthread_mutex_lock(&m), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_consistent(&m), 0);
  EXPECT_IS(pthread_mutex_unlock(&m), 0);
  EXPECT_IS(pthread_mutex_lock(&m), 0);
}
CASE(robust_pi_not_recoverable) {
  make(PTHREAD_MUTEX_NORMAL, PTHREAD_PRIO_INHERIT, 1);
  join(start(die_locked, NULL));
  EXPECT_IS(pthread_mutex_trylock(&m), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_unlock(&m), 0);
  EXPECT_IS(pthread_mutex_lock(&m), ENOTRECOVERABLE);
  EXPECT_IS(pthread_mutex_trylock(&m), ENOTRECOVERABLE);
}
CASE(cond_pi) {
  make(PTHREAD_MUTEX_NORMAL, PTHREAD_PRIO_INHERIT, 0);
  pthread_cond_init(&c, NULL);
  pthread_mutex_lock(&m);
  struct timespec t = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_cond_timedwait(&c, &m, &t), ETIMEDOUT);
  EXPECT_IS(pthread_mutex_unlock(&m), 0);
}
CASE(cond_errorcheck_unlocked) {
  make(PTHREAD_MUTEX_ERRORCHECK, 0, 0);
  pthread_cond_init(&c, NULL);
  EXPECT_IS(pthread_cond_wait(&c, &m), EPERM);
  struct timespec t = in_ms(CLOCK_REALTIME, 5);
  EXPECT_IS(pthread_cond_timedwait(&c, &m, &t), EPERM);
}
