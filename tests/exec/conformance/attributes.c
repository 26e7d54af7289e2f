// SPDX-License-Identifier: BSD-3-Clause
// Attributes of threads that can be read and set: names, stacks, priorities, processors.
#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <limits.h>
#include <sched.h>
#include <stdint.h>

static void* sleep_long(void* unused) {
  sleep_ms(5000);
  return unused;
}

CASE(a_name_is_read_as_it_was_written) {
  char name[16] = "";
  EXPECT_IS(pthread_setname_np(pthread_self(), "worker"), 0);
  EXPECT_IS(pthread_getname_np(pthread_self(), name, sizeof name), 0);
  EXPECT(strcmp(name, "worker") == 0);
}
CASE(another_thread_is_named) {
  char name[16] = "";
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_setname_np(id, "a b"), 0);
  EXPECT_IS(pthread_getname_np(id, name, sizeof name), 0);
  EXPECT(strcmp(name, "a b") == 0);
  EXPECT_IS(pthread_getname_np(pthread_self(), name, sizeof name), 0);
  EXPECT(strcmp(name, "a b") != 0);
}
CASE(a_name_of_15_bytes_is_not_cut) {
  char name[16] = "";
  EXPECT_IS(pthread_setname_np(pthread_self(), "123456789012345"), 0);
  EXPECT_IS(pthread_getname_np(pthread_self(), name, sizeof name), 0);
  EXPECT(strcmp(name, "123456789012345") == 0);
}
CASE(a_name_of_16_bytes_is_refused) { EXPECT_IS(pthread_setname_np(pthread_self(), "1234567890123456"), ERANGE); }
CASE(a_name_wants_room_for_16_bytes) {
  char name[15];
  EXPECT_IS(pthread_getname_np(pthread_self(), name, sizeof name), ERANGE);
}
static void* own_name(void* name) {
  EXPECT_IS(pthread_getname_np(pthread_self(), name, 16), 0);
  return NULL;
}
CASE(a_new_thread_has_its_makers_name) {
  char name[16] = "";
  pthread_setname_np(pthread_self(), "maker");
  join(start(own_name, name));
  EXPECT(strcmp(name, "maker") == 0);
}
CASE(main_has_the_programs_name) {
  char name[16] = "";
  own_name(name);
  EXPECT(strcmp(name, "attributes") == 0);
}

static void* own_stack(void* unused) {
  pthread_attr_t attributes;
  void* low = NULL;
  size_t size = 0, guard = 77;
  int state = -1;
  EXPECT_IS(pthread_getattr_np(pthread_self(), &attributes), 0);
  EXPECT_IS(pthread_attr_getstack(&attributes, &low, &size), 0);
  EXPECT((char*)&size >= (char*)low && (char*)&size < (char*)low + size);
  EXPECT(size >= (size_t)PTHREAD_STACK_MIN);
  EXPECT_IS(pthread_attr_getguardsize(&attributes, &guard), 0);
  EXPECT(guard % 4096 == 0);
  EXPECT_IS(pthread_attr_getdetachstate(&attributes, &state), 0);
  EXPECT_IS(state, PTHREAD_CREATE_JOINABLE);
  EXPECT_IS(pthread_attr_destroy(&attributes), 0);
  return unused;
}
CASE(getattr_tells_the_stack_of_a_thread) { join(start(own_stack, NULL)); }
CASE(getattr_tells_the_stack_of_main) { own_stack(NULL); }
CASE(getattr_tells_the_stack_of_another_thread) {
  pthread_attr_t mine, its;
  void *my_low, *its_low;
  size_t size;
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_getattr_np(pthread_self(), &mine), 0);
  EXPECT_IS(pthread_getattr_np(id, &its), 0);
  pthread_attr_getstack(&mine, &my_low, &size);
  pthread_attr_getstack(&its, &its_low, &size);
  EXPECT(my_low != its_low);
}
CASE(getattr_tells_that_a_thread_is_detached) {
  pthread_attr_t attributes;
  int state = -1;
  const pthread_t id = start(sleep_long, NULL);
  pthread_detach(id);
  EXPECT_IS(pthread_getattr_np(id, &attributes), 0);
  pthread_attr_getdetachstate(&attributes, &state);
  EXPECT_IS(state, PTHREAD_CREATE_DETACHED);
}

static void* use_stack(void* bytes) {
  const size_t size = (size_t)(uintptr_t)bytes;
  volatile char* const block = __builtin_alloca(size);
  for (size_t at = 0; at < size; at += 1024) block[at] = 1;
  return NULL;
}
static pthread_t start_with_stack(size_t size, void* (*function)(void*), void* argument) {
  pthread_attr_t attributes;
  pthread_t id;
  EXPECT_IS(pthread_attr_init(&attributes), 0);
  EXPECT_IS(pthread_attr_setstacksize(&attributes, size), 0);
  EXPECT_IS(pthread_create(&id, &attributes, function, argument), 0);
  return id;
}
CASE(a_thread_can_use_the_stack_that_was_asked_for) {
  join(start_with_stack(4 << 20, use_stack, (void*)(3 << 20)));
  join(start_with_stack(PTHREAD_STACK_MIN, use_stack, (void*)2048));
}
CASE(a_thread_can_use_a_stack_larger_than_the_default) {
  join(start_with_stack(32 << 20, use_stack, (void*)(28 << 20)));
}
CASE(a_thread_can_use_most_of_the_default_stack) { join(start(use_stack, (void*)(7 << 20))); }

static char* own_low;
static void* where(void* unused) {
  char local;
  EXPECT(&local >= own_low && &local < own_low + (1 << 20));
  return unused;
}
CASE(a_thread_runs_on_the_stack_that_it_was_given) {
  pthread_attr_t attributes;
  pthread_t id;
  EXPECT_IS(posix_memalign((void**)&own_low, 4096, 1 << 20), 0);
  pthread_attr_init(&attributes);
  EXPECT_IS(pthread_attr_setstack(&attributes, own_low, 1 << 20), 0);
  EXPECT_IS(pthread_create(&id, &attributes, where, NULL), 0);
  join(id);
}

CASE(attributes_of_threads_have_defaults) {
  pthread_attr_t attributes;
  int value = -1;
  size_t size = 0;
  EXPECT_IS(pthread_attr_init(&attributes), 0);
  EXPECT_IS(pthread_attr_getdetachstate(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_CREATE_JOINABLE);
  EXPECT_IS(pthread_attr_getschedpolicy(&attributes, &value), 0);
  EXPECT_IS(value, SCHED_OTHER);
  EXPECT_IS(pthread_attr_getscope(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_SCOPE_SYSTEM);
  EXPECT_IS(pthread_attr_getinheritsched(&attributes, &value), 0);
  EXPECT_IS(value, PTHREAD_INHERIT_SCHED);
  EXPECT_IS(pthread_attr_getstacksize(&attributes, &size), 0);
  EXPECT(size >= (size_t)PTHREAD_STACK_MIN);
}
CASE(attributes_of_threads_refuse_what_is_none) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  EXPECT_IS(pthread_attr_setdetachstate(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_attr_setstacksize(&attributes, 1), EINVAL);
  EXPECT_IS(pthread_attr_setschedpolicy(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_attr_setinheritsched(&attributes, 77), EINVAL);
  EXPECT_IS(pthread_attr_setscope(&attributes, 77), EINVAL);
}

CASE(a_threads_policy_is_the_default_one) {
  int policy = -1;
  struct sched_param parameters = {77};
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_getschedparam(id, &policy, &parameters), 0);
  EXPECT_IS(policy, SCHED_OTHER);
  EXPECT_IS(parameters.sched_priority, 0);
}
CASE(a_policy_is_read_as_it_was_written) {
  int policy = -1;
  struct sched_param parameters = {0};
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_setschedparam(id, SCHED_BATCH, &parameters), 0);
  EXPECT_IS(pthread_getschedparam(id, &policy, &parameters), 0);
  EXPECT_IS(policy, SCHED_BATCH);
}
CASE(a_priority_out_of_the_policys_range_is_refused) {
  const struct sched_param parameters = {77};
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_setschedparam(id, SCHED_OTHER, &parameters), EINVAL);
  EXPECT_IS(pthread_setschedprio(id, 77), EINVAL);
  EXPECT_IS(pthread_setschedprio(id, 0), 0);
}
CASE(a_policy_that_is_none_is_refused) {
  const struct sched_param parameters = {0};
  EXPECT_IS(pthread_setschedparam(start(sleep_long, NULL), 77, &parameters), EINVAL);
}

CASE(a_thread_has_processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_getaffinity_np(id, sizeof set, &set), 0);
  EXPECT(CPU_COUNT(&set) >= 1);
}
CASE(processors_are_read_as_they_were_written) {
  cpu_set_t all, one, read;
  const pthread_t id = start(sleep_long, NULL);
  EXPECT_IS(pthread_getaffinity_np(id, sizeof all, &all), 0);
  int first = 0;
  while (!CPU_ISSET(first, &all)) ++first;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  EXPECT_IS(pthread_setaffinity_np(id, sizeof one, &one), 0);
  EXPECT_IS(pthread_getaffinity_np(id, sizeof read, &read), 0);
  EXPECT(CPU_EQUAL(&read, &one));
  EXPECT_IS(pthread_getaffinity_np(pthread_self(), sizeof read, &read), 0);
  EXPECT(CPU_EQUAL(&read, &all));
}
CASE(no_processors_are_refused) {
  cpu_set_t none;
  CPU_ZERO(&none);
  EXPECT_IS(pthread_setaffinity_np(start(sleep_long, NULL), sizeof none, &none), EINVAL);
}
CASE(the_level_of_concurrency_is_read_as_it_was_written) {
  EXPECT_IS(pthread_setconcurrency(7), 0);
  EXPECT_IS(pthread_getconcurrency(), 7);
  EXPECT_IS(pthread_setconcurrency(-1), EINVAL);
}

// By thread ids.

CASE(scheduling_can_be_asked_for_by_number) {
  struct sched_param parameters = {7};
  EXPECT_IS(sched_getscheduler(0), SCHED_OTHER);
  EXPECT_IS(sched_getparam(0, &parameters), 0);
  EXPECT_IS(parameters.sched_priority, 0);
  EXPECT_IS(sched_setparam(0, &parameters), 0);
  EXPECT_IS(sched_setscheduler(0, SCHED_OTHER, &parameters), 0);
  EXPECT_IS(sched_setscheduler(gettid(), SCHED_BATCH, &parameters), 0);
  EXPECT_IS(sched_getscheduler(gettid()), SCHED_BATCH);
  parameters.sched_priority = 5;
  EXPECT_FAILS(sched_setscheduler(0, SCHED_OTHER, &parameters), EINVAL);
  EXPECT_FAILS(sched_setparam(0, &parameters), EINVAL);
  EXPECT_FAILS(sched_setscheduler(0, 77, &parameters), EINVAL);
  EXPECT_FAILS(sched_getscheduler(0x3FFFFFF0), ESRCH);
  EXPECT_FAILS(sched_getparam(0x3FFFFFF0, &parameters), ESRCH);
}
CASE(who_takes_turns_has_a_length_of_them) {
  const struct sched_param parameters = {.sched_priority = 1};
  if (sched_setscheduler(0, SCHED_RR, &parameters) != 0) return;  // without privileges
  struct timespec interval = {0, 0};
  EXPECT_IS(sched_rr_get_interval(0, &interval), 0);
  EXPECT(interval.tv_sec > 0 || interval.tv_nsec > 0);
}
CASE(affinity_can_be_asked_for_by_number) {
  cpu_set_t set, one;
  EXPECT(sched_getaffinity(0, sizeof set, &set) >= 0);
  const int first = sched_getcpu();
  EXPECT(first >= 0);
  CPU_ZERO(&one);
  for (int i = 0; CPU_COUNT(&one) == 0; ++i)
    if (CPU_ISSET(i, &set)) CPU_SET(i, &one);
  EXPECT_IS(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT(sched_getaffinity(gettid(), sizeof set, &set) >= 0);
  EXPECT(CPU_EQUAL(&set, &one));
  CPU_ZERO(&one);
  EXPECT_FAILS(sched_setaffinity(0, sizeof one, &one), EINVAL);
  EXPECT_FAILS(sched_getaffinity(0x3FFFFFF0, sizeof set, &set), ESRCH);
}
static void* set_batch(void* unused) {
  const struct sched_param parameters = {0};
  EXPECT_IS(sched_setscheduler(0, SCHED_BATCH, &parameters), 0);
  return unused;
}
CASE(each_thread_has_its_own_policy) {
  join(start(set_batch, NULL));
  EXPECT_IS(sched_getscheduler(0), SCHED_OTHER);
}
CASE(what_was_used_is_told) {
  struct rusage usage;
  memset(&usage, 0x55, sizeof usage);
  EXPECT_IS(getrusage(RUSAGE_SELF, &usage), 0);
  EXPECT(usage.ru_maxrss > 0 && usage.ru_utime.tv_sec < 1000);
  EXPECT_IS(getrusage(RUSAGE_THREAD, &usage), 0);
  EXPECT_IS(getrusage(RUSAGE_CHILDREN, &usage), 0);
  EXPECT_IS(usage.ru_utime.tv_sec, 0);
  EXPECT_FAILS(getrusage((__rusage_who_t)77, &usage), EINVAL);
}
CASE(the_processor_it_runs_on_is_told) {
  unsigned processor = ~0U, node = ~0U;
  EXPECT_IS(getcpu(&processor, &node), 0);
  EXPECT(processor < CPU_SETSIZE && node < CPU_SETSIZE);
  EXPECT_IS(syscall(SYS_getcpu, &processor, NULL, NULL), 0);
}
static atomic_int nice_id, nice_ready;
static int nice_at_first;
static int nicer_by(int more) { return nice_at_first + more < 19 ? nice_at_first + more : 19; }
static void* be_nice(void* unused) {
  EXPECT_IS(getpriority(PRIO_PROCESS, 0), nicer_by(1));
  EXPECT_IS(nice(2), nicer_by(3));
  nice_id = gettid();
  while (!nice_ready) sched_yield();
  EXPECT_IS(getpriority(PRIO_PROCESS, 0), 19);
  return unused;
}
CASE(each_thread_is_as_nice_as_it_was_made) {
  nice_at_first = getpriority(PRIO_PROCESS, 0);
  EXPECT_IS(nice(1), nicer_by(1));
  const pthread_t id = start(be_nice, NULL);
  while (!nice_id) sched_yield();
  EXPECT_IS(getpriority(PRIO_PROCESS, (id_t)nice_id), nicer_by(3));
  EXPECT_IS(getpriority(PRIO_PROCESS, 0), nicer_by(1));
  EXPECT_IS(setpriority(PRIO_PROCESS, (id_t)nice_id, 100), 0);
  EXPECT_IS(nice(4), nicer_by(5));
  nice_ready = 1;
  join(id);
  EXPECT_IS(getpriority(PRIO_PROCESS, 0), nicer_by(5));
  EXPECT_FAILS(getpriority(PRIO_PROCESS, 0x3FFFFFF0), ESRCH);
  EXPECT_FAILS(setpriority((__priority_which_t)77, 0, 5), EINVAL);
}
CASE(the_first_threads_name_is_that_of_the_process) {
  char name[16] = {0};
  EXPECT_IS(pthread_setname_np(pthread_self(), "another"), 0);
  FILE* const file = fopen("/proc/self/comm", "r");
  EXPECT(fgets(name, sizeof name, file) != NULL);
  EXPECT_IS(strcmp(name, "another\n"), 0);
}

static void* ask_by_number(void* unused) {
  struct sched_param parameters = {99};
  EXPECT_IS(sched_getparam(gettid(), &parameters), 0);
  EXPECT_IS(parameters.sched_priority, 0);
  EXPECT_IS(sched_setparam(gettid(), &parameters), 0);
  cpu_set_t all;
  EXPECT_IS(sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_IS(sched_setaffinity(gettid(), sizeof all, &all), 0);
  parameters.sched_priority = 1;
  EXPECT_FAILS(sched_setparam(gettid(), &parameters), EINVAL);
  return unused;
}

CASE(thread_is_asked_about_by_its_number) { join(start(ask_by_number, NULL)); }
