// SPDX-License-Identifier: BSD-3-Clause
//
// Misuses of primitives and threads, and what is none: misuse WAY. Each thread comes at a later second.
#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER, other = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static pthread_rwlock_t rwlock = PTHREAD_RWLOCK_INITIALIZER;
static sem_t semaphore;

static void* unlock(void* of) {
  pthread_mutex_unlock(of);
  return of;
}
static void* lock_and_unlock(void* of) {
  sleep(1);
  pthread_mutex_lock(of);
  pthread_mutex_unlock(of);
  return of;
}
static void* wait_with(void* of) {
  pthread_mutex_lock(of);
  pthread_cond_wait(&condition, of);
  pthread_mutex_unlock(of);
  return of;
}
static void* wait_for_post(void* of) {
  sem_wait(&semaphore);
  return of;
}
static void* unlock_rwlock(void* of) {
  pthread_rwlock_unlock(&rwlock);
  return of;
}
static void* post(void* of) {
  sem_post(&semaphore);
  return of;
}
static void* try_and_crash(void* of) {
  if (sem_trywait(&semaphore) == 0) __builtin_trap();
  return of;
}
static void* nothing(void* of) { return of; }

static pthread_t make(void* (*body)(void*), void* argument) {
  pthread_t thread;
  pthread_create(&thread, NULL, body, argument);
  return thread;
}
static void join(pthread_t thread) { pthread_join(thread, NULL); }

// Objects at one address, one after the other, each properly made: in a static variable, on the stack, on the heap.
static void reuse(void) {
  for (int i = 0; i < 3; ++i) {
    pthread_mutex_t here = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&here);
    pthread_mutex_unlock(&here);
    pthread_mutex_destroy(&here);
    pthread_mutex_init(&mutex, NULL);
    join(make(lock_and_unlock, &mutex));
    pthread_mutex_destroy(&mutex);
    pthread_cond_init(&condition, NULL);
    pthread_cond_signal(&condition);
    pthread_cond_destroy(&condition);
    sem_init(&semaphore, 0, 1);
    sem_wait(&semaphore);
    sem_destroy(&semaphore);
    pthread_mutex_t* const made = malloc(sizeof *made);
    pthread_mutex_init(made, NULL);
    join(make(lock_and_unlock, made));
    pthread_mutex_destroy(made);
    free(made);
    // A copy has a state of its own.
    pthread_mutex_t* grown = malloc(sizeof *grown);
    pthread_mutex_init(grown, NULL);
    pthread_mutex_lock(grown);
    pthread_mutex_unlock(grown);
    grown = realloc(grown, 4096 * sizeof *grown);
    pthread_mutex_t copy = *grown;
    pthread_mutex_lock(grown);
    pthread_mutex_lock(&copy);
    pthread_mutex_unlock(&copy);
    pthread_mutex_unlock(grown);
    pthread_mutex_destroy(&copy);
    pthread_cond_t made_condition = PTHREAD_COND_INITIALIZER;
    pthread_cond_signal(&made_condition);
    pthread_cond_t* copied = malloc(sizeof *copied);
    memcpy(copied, &made_condition, sizeof *copied);
    pthread_cond_t again = *copied;
    free(copied);
    pthread_cond_signal(&again);
    pthread_cond_destroy(&again);
    free(grown);
    pthread_mutex_t* const zeroed = calloc(1, sizeof *zeroed);
    join(make(lock_and_unlock, zeroed));
    free(zeroed);
  }
}

static int is_open;
static void* wait_until_open(void* of) {
  pthread_mutex_lock(of);
  while (!is_open) pthread_cond_wait(&condition, of);
  pthread_mutex_unlock(of);
  return of;
}

// Whoever was signalled is not blocked on the condition any more: the next one may wait with its own mutex.
static void change_mutex(void) {
  const struct timespec past = {1, 0};
  for (int i = 0; i < 3; ++i) {
    is_open = 0;
    pthread_cond_init(&condition, NULL);
    const pthread_t thread = make(wait_until_open, &mutex);
    sleep(1);
    pthread_mutex_lock(&mutex);
    is_open = 1;
    pthread_cond_broadcast(&condition);
    pthread_mutex_lock(&other);
    pthread_cond_timedwait(&condition, &other, &past);
    pthread_mutex_unlock(&other);
    pthread_mutex_unlock(&mutex);
    join(thread);
    pthread_cond_destroy(&condition);
  }
}

static void free_in_between(void) {
  pthread_mutex_t* const made = malloc(sizeof *made);
  pthread_mutex_init(made, NULL);
  const pthread_t thread = make(lock_and_unlock, made);
  pthread_mutex_lock(made);
  pthread_mutex_unlock(made);
  free(made);
  join(thread);
}

static void* write_and_lock(void* of) {
  pthread_rwlock_wrlock(&rwlock);
  pthread_rwlock_unlock(&rwlock);
  return lock_and_unlock(of);
}
static void destroy_meanwhile(void) {
  const pthread_t thread = make(write_and_lock, &mutex);
  pthread_rwlock_destroy(&rwlock);
  sleep(1);
  pthread_mutex_destroy(&mutex);
  join(thread);
}

int main(int count, char** words) {
  const char* const way = count > 1 ? words[1] : "";
  if (strcmp(way, "unlocked by another") == 0) {
    pthread_mutex_lock(&mutex);
    join(make(unlock, &mutex));
  } else if (strcmp(way, "unlocked twice") == 0) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
    pthread_mutex_unlock(&mutex);
  } else if (strcmp(way, "destroyed while locked") == 0) {
    pthread_mutex_lock(&mutex);
    if (pthread_mutex_destroy(&mutex) != EBUSY) return 1;
  } else if (strcmp(way, "locked when destroyed") == 0) {
    pthread_mutex_destroy(&mutex);
    if (pthread_mutex_lock(&mutex) != EINVAL) return 1;
  } else if (strcmp(way, "locked when freed") == 0) {
    free_in_between();
  } else if (strcmp(way, "destroyed meanwhile") == 0) {
    destroy_meanwhile();
  } else if (strcmp(way, "two mutexes") == 0) {
    const pthread_t one = make(wait_with, &mutex);
    sleep(1);
    const pthread_t two = make(wait_with, &other);
    sleep(1);
    pthread_cond_broadcast(&condition);
    join(one);
    join(two);
  } else if (strcmp(way, "waits without mutex") == 0) {
    const struct timespec past = {1, 0};
    pthread_cond_timedwait(&condition, &mutex, &past);
  } else if (strcmp(way, "condition destroyed") == 0) {
    make(wait_with, &mutex);
    sleep(1);
    pthread_cond_destroy(&condition);
    _exit(0);
  } else if (strcmp(way, "semaphore destroyed") == 0) {
    sem_init(&semaphore, 0, 0);
    make(wait_for_post, NULL);
    sleep(1);
    sem_destroy(&semaphore);
    _exit(0);
  } else if (strcmp(way, "rwlock unlocked by another") == 0) {
    pthread_rwlock_wrlock(&rwlock);
    join(make(unlock_rwlock, NULL));
  } else if (strcmp(way, "joined twice") == 0) {
    const pthread_t thread = make(nothing, NULL);
    join(thread);
    if (pthread_join(thread, NULL) != ESRCH) return 1;
  } else if (strcmp(way, "joined when detached") == 0) {
    const pthread_t thread = make(wait_with, &mutex);
    pthread_detach(thread);
    if (pthread_join(thread, NULL) != EINVAL) return 1;
    _exit(0);
  } else if (strcmp(way, "beside a crash") == 0) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
    pthread_mutex_unlock(&mutex);
    const pthread_t one = make(try_and_crash, NULL), two = make(post, NULL);
    join(one);
    join(two);
  } else if (strcmp(way, "another mutex afterwards") == 0) {
    change_mutex();
  } else {
    reuse();
  }
  return 0;
}
