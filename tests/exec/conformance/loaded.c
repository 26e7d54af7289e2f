// SPDX-License-Identifier: BSD-3-Clause
// Loaded while threads run: has thread-local variables, and creates a thread by the next pthread_create in search
// order.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>

static __thread int counter = 40;
static __thread char zeros[10000];

int* address_of_counter(void);
int next_count(void);
char* address_of_zeros(void);

int* address_of_counter(void) { return &counter; }
int next_count(void) { return ++counter; }
char* address_of_zeros(void) { return zeros; }

int start_thread(pthread_t* id, void* (*function)(void*), void* argument);
int start_thread(pthread_t* id, void* (*function)(void*), void* argument) {
  int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) = NULL;
  *(void**)&create = dlsym(RTLD_NEXT, "pthread_create");
  return create(id, NULL, function, argument);
}
