// SPDX-License-Identifier: BSD-3-Clause
// Operations intended to be atomic that consist of several steps.
#include <stdatomic.h>
#include <stdbool.h>

#include "tests/exec/zoo/crew.h"
#include "tests/exec/zoo/zoo.h"

// Two wheels count their ticks in one odometer: read, add, write.
static int ticks;

static void* turn_wheel(void* unused) {
  if (mended)
    __atomic_fetch_add(&ticks, 1, __ATOMIC_SEQ_CST);
  else
    ++ticks;
  return unused;
}

static void run_lost_update(int threads) {
  for (int i = 0; i < threads; ++i) start(turn_wheel);
  join_all();
  check(ticks == threads, "a tick is lost");
}

// Two motions check the battery's charge in one critical section, and take it in another.
static pthread_mutex_t battery = PTHREAD_MUTEX_INITIALIZER;
static int charge = 10;

static void* use_battery(void* unused) {
  pthread_mutex_lock(&battery);
  const bool is_enough = charge >= 7;
  if (!mended) {
    pthread_mutex_unlock(&battery);
    pthread_mutex_lock(&battery);
  }
  if (is_enough) charge -= 7;
  pthread_mutex_unlock(&battery);
  return unused;
}

static void run_check_then_act(int threads) {
  for (int i = 0; i < threads; ++i) start(use_battery);
  join_all();
  check(charge >= 0, "more is taken than there is");
}

// The map has a lock; the resizing thread takes a different one.
static pthread_mutex_t map = PTHREAD_MUTEX_INITIALIZER, goals = PTHREAD_MUTEX_INITIALIZER;
static int width = 4, cells = 16;

static void* resize_map(void* unused) {
  pthread_mutex_t* const lock = mended ? &map : &goals;
  pthread_mutex_lock(lock);
  width = 8;
  atomic_signal_fence(memory_order_seq_cst);  // keeps the order of the stores in the compiler
  cells = 64;
  pthread_mutex_unlock(lock);
  return unused;
}

static void* read_map(void* unused) {
  pthread_mutex_lock(&map);
  check(cells == width * width, "the map is half resized");
  pthread_mutex_unlock(&map);
  return unused;
}

static void run_wrong_lock(int threads) {
  (void)threads;
  start(resize_map);
  start(read_map);
  join_all();
}

// The first value is published in one critical section and the derived one in the next; a reader between them sees an
// inconsistent pair. Other threads only pass through.
static pthread_mutex_t first_lock = PTHREAD_MUTEX_INITIALIZER, second_lock = PTHREAD_MUTEX_INITIALIZER;
static int first, second;

static void* pass_by(void* unused) {
  pthread_mutex_lock(&first_lock);
  pthread_mutex_unlock(&first_lock);
  return unused;
}

static void* write_both(void* unused) {
  pthread_mutex_lock(&first_lock);
  const int written = first = 1;
  if (!mended) pthread_mutex_unlock(&first_lock);
  pthread_mutex_lock(&second_lock);
  second = written + 1;
  pthread_mutex_unlock(&second_lock);
  if (mended) pthread_mutex_unlock(&first_lock);
  return unused;
}

static void* read_both(void* unused) {
  pthread_mutex_lock(&first_lock);
  const int seen = first;
  pthread_mutex_unlock(&first_lock);
  if (seen == 0) return unused;
  pthread_mutex_lock(&second_lock);
  check(second == seen + 1, "the second stage is missing");
  pthread_mutex_unlock(&second_lock);
  return unused;
}

static void run_two_stage(int threads) {
  for (int i = 0; i < threads - 2; ++i) start(pass_by);
  start(write_both);
  start(read_both);
  join_all();
}

// Lazy initialisation: the flag is set before everything is initialised.
static pthread_mutex_t making = PTHREAD_MUTEX_INITIALIZER;
static atomic_bool is_made;
static atomic_int calibration[3];

static void* use_calibration(void* unused) {
  if (!is_made) {
    pthread_mutex_lock(&making);
    if (!is_made) {
      if (!mended) is_made = true;
      for (int i = 0; i < 3; ++i) calibration[i] = 1;
      if (mended) is_made = true;
    }
    pthread_mutex_unlock(&making);
  }
  check(calibration[2] == 1, "used before it is made");
  return unused;
}

static void run_double_checked_locking(int threads) {
  for (int i = 0; i < threads; ++i) start(use_calibration);
  join_all();
}

// Two counters advance by each other's value, in turns: only perfect alternation reaches the limit.
static pthread_mutex_t both = PTHREAD_MUTEX_INITIALIZER;
static atomic_int gains[2] = {1, 1};

static void* advance(void* argument) {
  const int mine = number_of(argument), other = 1 - mine;
  if (mended) pthread_mutex_lock(&both);
  for (int round = 0; round < 3; ++round) atomic_fetch_add(&gains[mine], gains[other]);
  if (mended) pthread_mutex_unlock(&both);
  return NULL;
}

static void run_alternation(int threads) {
  for (int i = 0; i < threads; ++i) start(advance);
  join_all();
  check(gains[0] < 21 && gains[1] < 21, "the gain is higher than any controller can bear");
}

// A reader that needs to write releases the read lock for the write lock, and does not check again.
static pthread_rwlock_t register_lock = PTHREAD_RWLOCK_INITIALIZER;
static int entries;

static void* enter(void* unused) {
  pthread_rwlock_rdlock(&register_lock);
  bool is_first = entries == 0;
  pthread_rwlock_unlock(&register_lock);
  if (!is_first) return unused;
  pthread_rwlock_wrlock(&register_lock);
  if (mended) is_first = entries == 0;
  if (is_first) ++entries;
  pthread_rwlock_unlock(&register_lock);
  return unused;
}

static void run_lock_upgrade(int threads) {
  for (int i = 0; i < threads; ++i) start(enter);
  join_all();
  check(entries == 1, "entered twice");
}

// Two drivers of one bus: selecting the device and writing to it are two calls, each locked by itself.
static pthread_mutex_t bus = PTHREAD_MUTEX_INITIALIZER, session = PTHREAD_MUTEX_INITIALIZER;
static int selected;

static void* talk(void* argument) {
  const int device = number_of(argument) + 1;
  if (mended) pthread_mutex_lock(&session);
  for (int i = 0; i < 2; ++i) {
    pthread_mutex_lock(&bus);
    selected = device;
    pthread_mutex_unlock(&bus);
    pthread_mutex_lock(&bus);
    check(selected == device, "a command to the wrong device");
    pthread_mutex_unlock(&bus);
  }
  if (mended) pthread_mutex_unlock(&session);
  return NULL;
}

static void run_wrong_device(int threads) {
  for (int i = 0; i < threads; ++i) start(talk);
  join_all();
}

// The last user switches off the light; two consider themselves the last.
static atomic_int users, switched_off;

static void* leave(void* unused) {
  int left = atomic_fetch_sub(&users, 1) - 1;
  if (!mended) left = users;
  if (left == 0) atomic_fetch_add(&switched_off, 1);
  return unused;
}

static void run_reference_count(int threads) {
  users = threads;
  for (int i = 0; i < threads; ++i) start(leave);
  join_all();
  check(switched_off == 1, "freed twice");
}

const struct specimen atomicities[] = {
    {"lost update", MEMORY, 2, run_lost_update},
    {"check then act", SYNCHRONIZATION, 2, run_check_then_act},
    {"wrong lock", MEMORY, 2, run_wrong_lock},
    {"two-stage", SYNCHRONIZATION, 2, run_two_stage},
    {"two-stage among 20", SYNCHRONIZATION, 20, run_two_stage},
    {"two-stage among 100", SYNCHRONIZATION, 100, run_two_stage},
    {"double-checked locking", MEMORY, 2, run_double_checked_locking},
    {"alternation", MEMORY, 2, run_alternation},
    {"lock upgrade", SYNCHRONIZATION, 3, run_lock_upgrade},
    {"wrong device", SYNCHRONIZATION, 2, run_wrong_device},
    {"reference count", MEMORY, 3, run_reference_count},
    {0},
};
