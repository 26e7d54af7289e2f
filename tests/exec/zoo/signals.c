// SPDX-License-Identifier: BSD-3-Clause
// Signals without a waiter, to the wrong one, or with less meaning than assumed.
#include <semaphore.h>
#include <stdatomic.h>
#include <stdbool.h>

#include "tests/exec/zoo/crew.h"
#include "tests/exec/zoo/zoo.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

// The flag is set and the signal sent without the lock: between the check of the flag and the wait.
static pthread_cond_t arrived = PTHREAD_COND_INITIALIZER;
static atomic_bool is_there;

static void* bring_letter(void* unused) {
  if (mended) pthread_mutex_lock(&lock);
  is_there = true;
  pthread_cond_signal(&arrived);
  if (mended) pthread_mutex_unlock(&lock);
  return unused;
}

static void* await_letter(void* unused) {
  pthread_mutex_lock(&lock);
  while (!is_there) pthread_cond_wait(&arrived, &lock);
  pthread_mutex_unlock(&lock);
  return unused;
}

static void run_lost_wake_up(int threads) {
  (void)threads;
  start(bring_letter);
  start(await_letter);
  join_all();
}

// A bounded buffer whose producers and consumers wait on one condition variable, of whom one is woken: it may be of the
// same kind.
static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;
static int items;

static void change_items(int from, int to) {
  pthread_mutex_lock(&lock);
  while (items != from) pthread_cond_wait(&changed, &lock);
  items = to;
  if (mended)
    pthread_cond_broadcast(&changed);
  else
    pthread_cond_signal(&changed);
  pthread_mutex_unlock(&lock);
}

static void* make_item(void* unused) { return change_items(0, 1), unused; }
static void* use_item(void* unused) { return change_items(1, 0), unused; }

static void run_one_condition(int threads) {
  for (int i = 0; i < threads / 2; ++i) start(make_item);
  for (int i = 0; i < threads / 2; ++i) start(use_item);
  join_all();
}

// The woken thread assumes a letter: another may have taken it.
static pthread_cond_t filled = PTHREAD_COND_INITIALIZER;
static int letters;

static void* read_letter(void* unused) {
  pthread_mutex_lock(&lock);
  if (letters == 0) pthread_cond_wait(&filled, &lock);
  while (mended && letters == 0) pthread_cond_wait(&filled, &lock);
  check(letters > 0, "an empty mailbox is read");
  --letters;
  pthread_mutex_unlock(&lock);
  return unused;
}

static void* write_letters(void* unused) {
  for (int i = 0; i < 2; ++i) {
    pthread_mutex_lock(&lock);
    ++letters;
    pthread_cond_signal(&filled);
    pthread_mutex_unlock(&lock);
  }
  return unused;
}

static void run_if_in_place_of_while(int threads) {
  for (int i = 0; i < threads - 1; ++i) start(read_letter);
  start(write_letters);
  join_all();
}

// A barrier that the last thread to leave resets. The next round begins when the first is out: it may reach the barrier
// again while others have yet to leave, which then find a count that is too high, and wait forever.
static struct {
  pthread_cond_t full;
  sem_t out, next_round;
  int members, arrived, left, generation;
} barrier = {.full = PTHREAD_COND_INITIALIZER};

static void pass_barrier(void) {
  pthread_mutex_lock(&lock);
  const int mine = barrier.generation;
  if (++barrier.arrived == barrier.members) {
    if (mended) barrier.arrived = 0;
    ++barrier.generation;
    pthread_cond_broadcast(&barrier.full);
  } else {
    while (mended ? barrier.generation == mine : barrier.arrived != barrier.members)
      pthread_cond_wait(&barrier.full, &lock);
  }
  if (!mended && ++barrier.left == barrier.members) barrier.arrived = barrier.left = 0;
  pthread_mutex_unlock(&lock);
}

static void* meet_twice(void* unused) {
  pass_barrier();
  sem_post(&barrier.out);
  sem_wait(&barrier.next_round);
  pass_barrier();
  return unused;
}

static void run_barrier_reuse(int threads) {
  barrier.members = threads;
  sem_init(&barrier.out, 0, 0);
  sem_init(&barrier.next_round, 0, 0);
  for (int i = 0; i < threads; ++i) start(meet_twice);
  sem_wait(&barrier.out);
  for (int i = 0; i < threads; ++i) sem_post(&barrier.next_round);
  join_all();
}

// A token ring: all wait on one condition variable, and the woken thread need not be the next.
static pthread_cond_t passed = PTHREAD_COND_INITIALIZER;
static int holder;

static void* pass_token(void* argument) {
  pthread_mutex_lock(&lock);
  while (holder != number_of(argument)) pthread_cond_wait(&passed, &lock);
  ++holder;
  if (mended)
    pthread_cond_broadcast(&passed);
  else
    pthread_cond_signal(&passed);
  pthread_mutex_unlock(&lock);
  return NULL;
}

static void run_token_ring(int threads) {
  for (int i = 0; i < threads; ++i) start(pass_token);
  join_all();
}

// Two docks and, by a miscount, three permits.
static sem_t permits;
static int docked;

static void change_docked(int by) {
  pthread_mutex_lock(&lock);
  docked += by;
  check(docked <= 2, "three robots at two docks");
  pthread_mutex_unlock(&lock);
}

static void* dock(void* unused) {
  sem_wait(&permits);
  change_docked(1);
  change_docked(-1);
  sem_post(&permits);
  return unused;
}

static void run_one_permit_too_many(int threads) {
  sem_init(&permits, 0, mended ? 2 : 3);
  for (int i = 0; i < threads; ++i) start(dock);
  join_all();
}

// The start signal is an event without memory: of four workers, one that does not wait yet never starts.
static pthread_cond_t begin = PTHREAD_COND_INITIALIZER;
static bool has_begun;

static void* begin_work(void* unused) {
  pthread_mutex_lock(&lock);
  if (!mended) pthread_cond_wait(&begin, &lock);
  while (mended && !has_begun) pthread_cond_wait(&begin, &lock);
  pthread_mutex_unlock(&lock);
  return unused;
}

static void* command(void* unused) {
  pthread_mutex_lock(&lock);
  has_begun = true;
  pthread_cond_broadcast(&begin);
  pthread_mutex_unlock(&lock);
  return unused;
}

static void run_start_signal(int threads) {
  for (int i = 0; i < threads - 1; ++i) start(begin_work);
  start(command);
  join_all();
}

// A mailbox of two letters: the check for room precedes the lock.
static atomic_int mailbox;

static void* send_letter(void* unused) {
  if (mended) pthread_mutex_lock(&lock);
  const bool has_room = mailbox < 2;
  if (!mended) pthread_mutex_lock(&lock);
  if (has_room) check(atomic_fetch_add(&mailbox, 1) < 2, "a letter falls out of the mailbox");
  pthread_mutex_unlock(&lock);
  return unused;
}

static void run_mailbox_full(int threads) {
  for (int i = 0; i < threads; ++i) start(send_letter);
  join_all();
}

const struct specimen signals[] = {
    {"lost wake-up", SYNCHRONIZATION, 2, run_lost_wake_up},
    {"one condition for two", SYNCHRONIZATION, 4, run_one_condition},
    {"if in place of while", SYNCHRONIZATION, 3, run_if_in_place_of_while},
    {"barrier reuse", SYNCHRONIZATION, 3, run_barrier_reuse},
    {"token ring", SYNCHRONIZATION, 4, run_token_ring},
    {"one permit too many", SYNCHRONIZATION, 4, run_one_permit_too_many},
    {"start signal", SYNCHRONIZATION, 5, run_start_signal},
    {"mailbox full", SYNCHRONIZATION, 3, run_mailbox_full},
    {0},
};
