// SPDX-License-Identifier: BSD-3-Clause
// Threads that wait for each other in a cycle.
#include <semaphore.h>
#include <stdbool.h>

#include "tests/exec/zoo/crew.h"
#include "tests/exec/zoo/zoo.h"

// A crossing without a rule: each robot holds its own cell of the floor and waits for the one ahead.
static struct {
  pthread_mutex_t cells[8];
  int robots;
} crossing;

static void* cross(void* argument) {
  int first = number_of(argument), second = (first + 1) % crossing.robots;
  if (mended && first > second) {
    second = first;
    first = 0;
  }
  pthread_mutex_lock(&crossing.cells[first]);
  pthread_mutex_lock(&crossing.cells[second]);
  pthread_mutex_unlock(&crossing.cells[second]);
  pthread_mutex_unlock(&crossing.cells[first]);
  return NULL;
}

static void run_crossing(int threads) {
  crossing.robots = threads;
  for (int i = 0; i < threads; ++i) pthread_mutex_init(&crossing.cells[i], NULL);
  for (int i = 0; i < threads; ++i) start(cross);
  join_all();
}

// Philosophers who take both forks several times; mended, a butler seats all but one.
static struct {
  pthread_mutex_t forks[5];
  sem_t butler;
  int seats;
} table;

static void* dine(void* argument) {
  const int left = number_of(argument), right = (left + 1) % table.seats;
  for (int meal = 0; meal < 2; ++meal) {
    sem_wait(&table.butler);
    pthread_mutex_lock(&table.forks[left]);
    pthread_mutex_lock(&table.forks[right]);
    pthread_mutex_unlock(&table.forks[right]);
    pthread_mutex_unlock(&table.forks[left]);
    sem_post(&table.butler);
  }
  return NULL;
}

static void run_philosophers(int threads) {
  table.seats = threads;
  sem_init(&table.butler, 0, (unsigned)(mended ? threads - 1 : threads));
  for (int i = 0; i < threads; ++i) pthread_mutex_init(&table.forks[i], NULL);
  for (int i = 0; i < threads; ++i) start(dine);
  join_all();
}

// The planner notifies its listeners while it holds its lock; a listener queries the planner while it holds its own.
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER, display = PTHREAD_MUTEX_INITIALIZER;
static int plan, shown;

static void* make_plan(void* unused) {
  pthread_mutex_lock(&planner);
  ++plan;
  if (mended) pthread_mutex_unlock(&planner);
  pthread_mutex_lock(&display);
  ++shown;
  pthread_mutex_unlock(&display);
  if (!mended) pthread_mutex_unlock(&planner);
  return unused;
}

static void* draw_plan(void* unused) {
  pthread_mutex_lock(&display);
  pthread_mutex_lock(&planner);
  shown = plan;
  pthread_mutex_unlock(&planner);
  pthread_mutex_unlock(&display);
  return unused;
}

static void run_callback_under_lock(int threads) {
  (void)threads;
  start(make_plan);
  start(draw_plan);
  join_all();
}

// The stopping thread joins the worker while it holds a lock that the worker takes at its end.
static pthread_mutex_t statistics = PTHREAD_MUTEX_INITIALIZER;
static sem_t finished;
static int jobs;

static void count_job(void) {
  pthread_mutex_lock(&statistics);
  ++jobs;
  pthread_mutex_unlock(&statistics);
}

static void* work(void* unused) {
  for (int i = 0; i < 3; ++i) count_job();
  sem_post(&finished);
  count_job();
  return unused;
}

static void run_join_under_lock(int threads) {
  (void)threads;
  sem_init(&finished, 0, 0);
  start(work);
  sem_wait(&finished);
  pthread_mutex_lock(&statistics);
  if (mended) pthread_mutex_unlock(&statistics);
  join_all();
  if (!mended) pthread_mutex_unlock(&statistics);
}

// A nested monitor: the wait for the gripper releases the gripper's lock, but not the arm's, which the thread that
// would open the gripper needs.
static pthread_mutex_t arm = PTHREAD_MUTEX_INITIALIZER, gripper = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t opened = PTHREAD_COND_INITIALIZER;
static bool is_open;

static void* open_gripper(void* unused) {
  pthread_mutex_lock(&arm);
  if (mended) pthread_mutex_unlock(&arm);
  pthread_mutex_lock(&gripper);
  is_open = true;
  pthread_cond_broadcast(&opened);
  pthread_mutex_unlock(&gripper);
  if (!mended) pthread_mutex_unlock(&arm);
  return unused;
}

static void* pick(void* unused) {
  pthread_mutex_lock(&arm);
  if (mended) pthread_mutex_unlock(&arm);
  pthread_mutex_lock(&gripper);
  while (!is_open) pthread_cond_wait(&opened, &gripper);
  pthread_mutex_unlock(&gripper);
  if (!mended) pthread_mutex_unlock(&arm);
  return unused;
}

static void run_nested_monitor(int threads) {
  (void)threads;
  start(open_gripper);
  start(pick);
  join_all();
}

// Three locks with a wrong order only on the path for a low battery.
static pthread_mutex_t map = PTHREAD_MUTEX_INITIALIZER, path = PTHREAD_MUTEX_INITIALIZER,
                       logbook = PTHREAD_MUTEX_INITIALIZER, gauge = PTHREAD_MUTEX_INITIALIZER;
static int battery = 3;

static int change_battery(int by) {
  pthread_mutex_lock(&gauge);
  const int left = battery += by;
  pthread_mutex_unlock(&gauge);
  return left;
}

static void* monitor(void* unused) {
  for (int i = 0; i < 3; ++i) change_battery(-1);
  change_battery(3);
  return unused;
}

static void* draw_map(void* unused) {
  pthread_mutex_lock(&map);
  pthread_mutex_lock(&path);
  pthread_mutex_lock(&logbook);
  pthread_mutex_unlock(&logbook);
  pthread_mutex_unlock(&path);
  pthread_mutex_unlock(&map);
  return unused;
}

static void* move(void* unused) {
  const bool is_rare = change_battery(0) == 0 && !mended;
  pthread_mutex_t* const first = is_rare ? &logbook : &map;
  pthread_mutex_t* const second = is_rare ? &map : &logbook;
  pthread_mutex_lock(first);
  pthread_mutex_lock(second);
  pthread_mutex_unlock(second);
  pthread_mutex_unlock(first);
  return unused;
}

static void run_rare_path(int threads) {
  (void)threads;
  start(monitor);
  start(draw_map);
  start(move);
  join_all();
}

const struct specimen deadlocks[] = {
    {"crossing of 2", SYNCHRONIZATION, 2, run_crossing},
    {"crossing of 3", SYNCHRONIZATION, 3, run_crossing},
    {"crossing of 5", SYNCHRONIZATION, 5, run_crossing},
    {"crossing of 8", SYNCHRONIZATION, 8, run_crossing},
    {"philosophers", SYNCHRONIZATION, 5, run_philosophers},
    {"callback under lock", SYNCHRONIZATION, 2, run_callback_under_lock},
    {"join under lock", SYNCHRONIZATION, 1, run_join_under_lock},
    {"nested monitor", SYNCHRONIZATION, 2, run_nested_monitor},
    {"rare path", SYNCHRONIZATION, 3, run_rare_path},
    {0},
};
