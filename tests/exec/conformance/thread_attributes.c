// SPDX-License-Identifier: BSD-3-Clause
// Initial state of a thread: from its attributes, and inherited.
#include "tests/exec/conformance/harness.h"

#include <limits.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>

static pthread_attr_t a;
static void* nothing(void* p) { return p; }
static void* own_stacksize(void* p) {
  pthread_attr_t b;
  size_t z;
  void* s;
  EXPECT_IS(pthread_getattr_np(pthread_self(), &b), 0);
  EXPECT_IS(pthread_attr_getstack(&b, &s, &z), 0);
  *(size_t*)p = z;
  char local;
  EXPECT((char*)s < &local && &local < (char*)s + z);
  return NULL;
}
static void* own_guard(void* p) {
  pthread_attr_t b;
  EXPECT_IS(pthread_getattr_np(pthread_self(), &b), 0);
  EXPECT_IS(pthread_attr_getguardsize(&b, p), 0);
  return NULL;
}
static void* own_sched(void* p) {
  int pol;
  struct sched_param sp;
  EXPECT_IS(pthread_getschedparam(pthread_self(), &pol, &sp), 0);
  ((int*)p)[0] = pol;
  ((int*)p)[1] = sp.sched_priority;
  return NULL;
}
static void* own_mask(void* p) {
  pthread_sigmask(SIG_SETMASK, NULL, p);
  return NULL;
}
static void* own_affinity(void* p) {
  EXPECT_IS(pthread_getaffinity_np(pthread_self(), sizeof(cpu_set_t), p), 0);
  return NULL;
}
static void* recursive(void* p) {
  volatile char buffer[4096];
  buffer[0] = 1;
  long d = (long)p;
  if (d > 0) recursive((void*)(d - 1));
  return buffer[0] ? p : NULL;
}
static size_t told_when_asked_for(size_t stack_size) {
  size_t z = 0;
  pthread_t t;
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setstacksize(&a, stack_size), 0);
  EXPECT_IS(pthread_create(&t, &a, own_stacksize, &z), 0);
  join(t);
  return z;
}
CASE(getattr_tells_default_stack_size) {
  size_t z = 0;
  join(start(own_stacksize, &z));
  EXPECT_IS(z, 8 << 20);
}
CASE(getattr_tells_asked_stack_size) { EXPECT_IS(told_when_asked_for(1 << 20), 1 << 20); }
CASE(getattr_tells_minimal_stack_size) {
  const size_t z = told_when_asked_for(PTHREAD_STACK_MIN + 16384);
  EXPECT(z >= 16384);
  EXPECT(z <= 65536);
}
CASE(getattr_tells_large_stack_size) { EXPECT_IS(told_when_asked_for(64 << 20), 64 << 20); }
CASE(getattr_tells_guard) {
  size_t z = 0;
  join(start(own_guard, &z));
  EXPECT_IS(z, 4096);
  pthread_t t;
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setguardsize(&a, 16384), 0);
  EXPECT_IS(pthread_create(&t, &a, own_guard, &z), 0);
  join(t);
  EXPECT_IS(z, 16384);
  EXPECT_IS(pthread_attr_setguardsize(&a, 0), 0);
  EXPECT_IS(pthread_create(&t, &a, own_guard, &z), 0);
  join(t);
  EXPECT_IS(z, 0);
}
CASE(stacksize_too_small) {
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setstacksize(&a, 100), EINVAL);
}
CASE(explicit_batch) {
  int r[2];
  pthread_t t;
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setinheritsched(&a, PTHREAD_EXPLICIT_SCHED), 0);
  EXPECT_IS(pthread_attr_setschedpolicy(&a, SCHED_OTHER), 0);
  EXPECT_IS(pthread_create(&t, &a, own_sched, r), 0);
  join(t);
  EXPECT_IS(r[0], SCHED_OTHER);
}
CASE(explicit_fifo_thread) {
  int r[2];
  pthread_t t;
  pthread_attr_init(&a);
  struct sched_param p = {10};
  pthread_attr_setinheritsched(&a, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&a, SCHED_FIFO);
  pthread_attr_setschedparam(&a, &p);
  int e = pthread_create(&t, &a, own_sched, r);
  if (e == 0) {
    join(t);
    EXPECT_IS(r[0], SCHED_FIFO);
    EXPECT_IS(r[1], 10);
  } else
    EXPECT_IS(e, EPERM);
}
CASE(inherits_sched_of_maker) {
  struct sched_param p = {0};
  if (pthread_setschedparam(pthread_self(), SCHED_BATCH, &p) == 0) {
    int r[2];
    join(start(own_sched, r));
    EXPECT_IS(r[0], SCHED_BATCH);
  }
}
CASE(sigmask_of_attributes) {
  sigset_t s, r;
  sigemptyset(&s);
  sigaddset(&s, SIGUSR1);
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setsigmask_np(&a, &s), 0);
  pthread_t t;
  EXPECT_IS(pthread_create(&t, &a, own_mask, &r), 0);
  join(t);
  EXPECT_IS(sigismember(&r, SIGUSR1), 1);
  EXPECT_IS(sigismember(&r, SIGUSR2), 0);
}
CASE(affinity_of_attributes) {
  cpu_set_t s, r;
  CPU_ZERO(&s);
  CPU_SET(0, &s);
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setaffinity_np(&a, sizeof s, &s), 0);
  pthread_t t;
  EXPECT_IS(pthread_create(&t, &a, own_affinity, &r), 0);
  join(t);
  EXPECT_IS(CPU_COUNT(&r), 1);
  EXPECT(CPU_ISSET(0, &r));
}
CASE(affinity_is_inherited) {
  cpu_set_t s, r;
  CPU_ZERO(&s);
  CPU_SET(0, &s);
  EXPECT_IS(pthread_setaffinity_np(pthread_self(), sizeof s, &s), 0);
  join(start(own_affinity, &r));
  EXPECT_IS(CPU_COUNT(&r), 1);
}
CASE(affinity_of_a_cpu_that_is_not_there) {
  cpu_set_t s;
  CPU_ZERO(&s);
  CPU_SET(1000, &s);
  EXPECT_IS(pthread_setaffinity_np(pthread_self(), sizeof s, &s), EINVAL);
  EXPECT_FAILS(sched_setaffinity(0, sizeof s, &s), EINVAL);
}
CASE(default_attributes_are_used) {
  pthread_attr_t d;
  EXPECT_IS(pthread_attr_init(&d), 0);
  EXPECT_IS(pthread_attr_setstacksize(&d, 1 << 20), 0);
  EXPECT_IS(pthread_setattr_default_np(&d), 0);
  size_t z = 0;
  join(start(own_stacksize, &z));
  EXPECT_IS(z, 1 << 20);
}
CASE(stack_of_the_program) {
  size_t z = 1 << 20;
  char* m = mmap(0, z, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setstack(&a, m, z), 0);
  size_t r = 0;
  pthread_t t;
  EXPECT_IS(pthread_create(&t, &a, own_stacksize, &r), 0);
  join(t);
  EXPECT_IS(r, z);
}
CASE(default_stack_takes_7_mb) { join(start(recursive, (void*)1700)); }
CASE_ENDING_WITH(-SIGSEGV, overflow_of_a_stack_is_a_fault) { join(start(recursive, (void*)100000)); }
/// Some runtimes protect the low end of a stack like this, and leave it so.
static void* protecting(void* p) {
  pthread_attr_t b;
  size_t z;
  void* s;
  EXPECT_IS(pthread_getattr_np(pthread_self(), &b), 0);
  EXPECT_IS(pthread_attr_getstack(&b, &s, &z), 0);
  EXPECT_IS((size_t)s % 4096, 0);
  EXPECT(mmap(s, 16384, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == s);
  return p;
}
CASE(getattr_tells_whole_pages) {
  for (int i = 0; i < 8; ++i) join(start(protecting, NULL));
}
CASE(pages_that_a_thread_protected_are_not_the_next_ones) {
  pthread_t t;
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setstacksize(&a, 1 << 20), 0);
  for (int i = 0; i < 8; ++i) {
    EXPECT_IS(pthread_create(&t, &a, protecting, NULL), 0);
    join(t);
  }
  join(start(recursive, (void*)1700));
}
CASE(create_with_bad_stack) {
  pthread_attr_init(&a);
  EXPECT_IS(pthread_attr_setstacksize(&a, (size_t)1 << 46), 0);
  pthread_t t;
  EXPECT_IS(pthread_create(&t, &a, nothing, NULL), EAGAIN);
}
static void* prctl_name(void* p) {
  prctl(PR_SET_NAME, "other");
  return p;
}
CASE(prctl_name_is_each_threads) {
  char n[17];
  prctl(PR_SET_NAME, "first");
  join(start(prctl_name, NULL));
  prctl(PR_GET_NAME, n);
  EXPECT(strcmp(n, "first") == 0);
}
CASE(prctl_name_is_pthread_name) {
  char n[17];
  prctl(PR_SET_NAME, "first");
  EXPECT_IS(pthread_getname_np(pthread_self(), n, 17), 0);
  EXPECT(strcmp(n, "first") == 0);
  pthread_setname_np(pthread_self(), "second");
  prctl(PR_GET_NAME, n);
  EXPECT(strcmp(n, "second") == 0);
}
