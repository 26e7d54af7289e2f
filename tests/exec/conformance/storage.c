// SPDX-License-Identifier: BSD-3-Clause
// Thread-local storage: of the program, and of libraries loaded while threads run.
#include "tests/exec/conformance/harness.h"

#include <ctype.h>
#include <dlfcn.h>
#include <libgen.h>
#include <locale.h>
#include <netdb.h>
#include <stdatomic.h>
#include <stdint.h>

static __thread int counter = 7;
static __thread int zero;
static __thread char large[20000];
static __thread struct { _Alignas(64) char line[64]; } aligned;

static void* look(void* unused) {
  EXPECT_IS(counter, 7);
  EXPECT_IS(zero, 0);
  counter = 100;
  zero = 5;
  sched_yield();
  EXPECT_IS(counter, 100);
  EXPECT_IS(zero, 5);
  return unused;
}
CASE(each_thread_begins_with_initial_values) {
  counter = 1;
  zero = 2;
  for (int i = 0; i < 5; ++i) {
    const pthread_t a = start(look, NULL), b = start(look, NULL);
    join(a);
    join(b);
  }
  EXPECT_IS(counter, 1);
  EXPECT_IS(zero, 2);
}
static void* address_of(void* unused) {
  (void)unused;
  return &counter;
}
CASE(each_thread_has_an_address_of_its_own) { EXPECT(join(start(address_of, NULL)) != &counter); }
static void* fill(void* value) {
  for (size_t at = 0; at < sizeof large; ++at) EXPECT_IS(large[at], 0);
  memset(large, (int)(intptr_t)value, sizeof large);
  sleep_ms(1);
  for (size_t at = 0; at < sizeof large; ++at) EXPECT_IS(large[at], (intptr_t)value);
  return NULL;
}
CASE(large_variables_are_each_threads_own) {
  pthread_t ids[4];
  for (int i = 0; i < 4; ++i) ids[i] = start(fill, (void*)(intptr_t)(i + 1));
  for (int i = 0; i < 4; ++i) join(ids[i]);
  fill((void*)9);
}
static void* check_alignment(void* unused) {
  EXPECT_IS((uintptr_t)&aligned % 64, 0);
  return unused;
}
CASE(variables_are_aligned) {
  check_alignment(NULL);
  for (int i = 0; i < 8; ++i) join(start(check_alignment, NULL));
}
static void* write_through(void* address) {
  *(int*)address = 99;
  return NULL;
}
CASE(another_threads_variable_can_be_written) {
  join(start(write_through, &counter));
  EXPECT_IS(counter, 99);
}

static void* library;
static void load(void) {
  char path[4096];
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 20);
  EXPECT(length > 0);
  path[length] = '\0';
  strcat(dirname(path), "/loaded.so");
  library = dlopen(path, RTLD_NOW);
  EXPECT(library != NULL);
}
static int next_count(void) { return ((int (*)(void))dlsym(library, "next_count"))(); }
static char* zeros(void) { return ((char* (*)(void))dlsym(library, "address_of_zeros"))(); }

CASE(a_loaded_library_has_initial_values_in_main) {
  load();
  EXPECT_IS(next_count(), 41);
  EXPECT_IS(next_count(), 42);
  EXPECT_IS(dlclose(library), 0);
}
static void* count_in_library(void* unused) {
  EXPECT_IS(next_count(), 41);
  sched_yield();
  EXPECT_IS(next_count(), 42);
  for (int at = 0; at < 10000; ++at) EXPECT_IS(zeros()[at], 0);
  zeros()[77] = 1;
  return unused;
}
CASE(a_loaded_library_has_initial_values_in_threads_made_later) {
  load();
  next_count();
  const pthread_t a = start(count_in_library, NULL), b = start(count_in_library, NULL);
  join(a);
  join(b);
  EXPECT_IS(next_count(), 42);
}
static atomic_int loaded;
static void* wait_and_count(void* unused) {
  while (!loaded) sched_yield();
  return count_in_library(unused);
}
CASE(a_loaded_library_has_initial_values_in_threads_made_before) {
  const pthread_t a = start(wait_and_count, NULL), b = start(wait_and_count, NULL);
  let_others_wait();
  load();
  loaded = 1;
  join(a);
  join(b);
}
static void* load_there(void* unused) {
  load();
  EXPECT_IS(next_count(), 41);
  return unused;
}
CASE(a_library_loaded_by_another_thread_serves_all) {
  join(start(load_there, NULL));
  EXPECT_IS(next_count(), 41);
}
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t is_up = PTHREAD_COND_INITIALIZER;
static int up = 0;
static void* come_up(void* unused) {
  pthread_mutex_lock(&lock);
  up = 1;
  pthread_cond_signal(&is_up);
  pthread_mutex_unlock(&lock);
  return unused;
}
CASE(a_library_makes_threads_by_the_function_behind_its_own) {
  load();
  int (*start_thread)(pthread_t*, void* (*)(void*), void*) = NULL;
  *(void**)&start_thread = dlsym(library, "start_thread");
  pthread_t id;
  pthread_mutex_lock(&lock);
  EXPECT_IS(start_thread(&id, come_up, NULL), 0);
  while (up == 0) pthread_cond_wait(&is_up, &lock);
  pthread_mutex_unlock(&lock);
  join(id);
}
CASE(a_library_loaded_again_begins_anew) {
  for (int i = 0; i < 5; ++i) {
    load();
    join(start(count_in_library, NULL));
    EXPECT_IS(next_count(), 41);
    EXPECT_IS(dlclose(library), 0);
  }
}

static void* use_locale(void* unused) {
  EXPECT(isalpha('a') && !isalpha('1') && toupper('b') == 'B');
  const locale_t posix = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  const locale_t old = uselocale(posix);
  EXPECT(old == LC_GLOBAL_LOCALE);
  sched_yield();
  EXPECT(uselocale((locale_t)0) == posix);
  uselocale(old);
  freelocale(posix);
  return unused;
}
CASE(the_locale_is_each_threads_own) {
  const pthread_t a = start(use_locale, NULL), b = start(use_locale, NULL);
  EXPECT(uselocale((locale_t)0) == LC_GLOBAL_LOCALE);
  join(a);
  join(b);
}
static void* fail_to_load(void* unused) {
  EXPECT(dlerror() == NULL);
  EXPECT(dlopen("/nowhere/at-all.so", RTLD_NOW) == NULL);
  sched_yield();
  EXPECT(dlerror() != NULL);
  return unused;
}
CASE(errors_of_the_dynamic_linker_are_each_threads_own) {
  const pthread_t a = start(fail_to_load, NULL), b = start(fail_to_load, NULL);
  join(a);
  join(b);
  EXPECT(dlerror() == NULL);
}
static void* set_h_errno(void* value) {
  h_errno = (int)(intptr_t)value;
  sched_yield();
  EXPECT_IS(h_errno, (intptr_t)value);
  return NULL;
}
CASE(h_errno_is_each_threads_own) {
  const pthread_t a = start(set_h_errno, (void*)1), b = start(set_h_errno, (void*)2);
  join(a);
  join(b);
}
static void* allocate(void* unused) {
  (void)unused;
  for (int i = 0; i < 200; ++i) {
    char* const block = malloc((size_t)(i + 1) * 10);
    memset(block, 1, (size_t)(i + 1) * 10);
    if (i % 50 == 0) sched_yield();
    free(block);
  }
  return malloc(100);
}
CASE(memory_of_one_thread_is_freed_by_another) {
  pthread_t ids[8];
  for (int i = 0; i < 8; ++i) ids[i] = start(allocate, NULL);
  for (int i = 0; i < 8; ++i) free(join(ids[i]));
}
