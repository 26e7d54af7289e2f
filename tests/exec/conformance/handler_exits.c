// SPDX-License-Identifier: BSD-3-Clause
// A signal handler that ends its thread by pthread_exit(): whatever call it interrupted, the thread's cleanup handlers
// run, and the thread ends.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/sem.h>

static void leave(int signal) {
  (void)signal;
  pthread_exit(&noted);
}
static void act(void) {
  struct sigaction action = {.sa_handler = leave};
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
}
static atomic_int cleaned;
static void clean(void* unused) {
  (void)unused;
  ++cleaned;
}
static void* call(void* body) {
  pthread_cleanup_push(clean, NULL);
  (*(void (**)(void))body)();
  pthread_cleanup_pop(0);
  return NULL;
}
/// The thread ends while it executes `body`, in a handler of a signal from another thread.
static void expect_left(void (*body)(void)) {
  act();
  const pthread_t id = start(call, &body);
  let_others_wait();
  EXPECT_IS(pthread_kill(id, SIGUSR1), 0);
  EXPECT(join(id) == noted);
  EXPECT_IS(cleaned, 1);
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static void lock(void) { pthread_mutex_lock(&mutex); }
CASE(a_wait_for_a_mutex_is_left) {
  lock();
  expect_left(lock);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
}
static void lock_soon(void) {
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  pthread_mutex_timedlock(&mutex, &deadline);
}
CASE(a_wait_for_a_mutex_with_a_deadline_is_left) {
  lock();
  expect_left(lock_soon);
}
static pthread_spinlock_t spin_lock;
static void spin(void) { pthread_spin_lock(&spin_lock); }
CASE(a_spin_is_left) {
  pthread_spin_init(&spin_lock, PTHREAD_PROCESS_PRIVATE);
  spin();
  expect_left(spin);
  EXPECT_IS(pthread_spin_unlock(&spin_lock), 0);
  EXPECT_IS(pthread_spin_trylock(&spin_lock), 0);
}
static atomic_int spinning;
static void* spin_too(void* unused) {
  ++spinning;
  spin();
  EXPECT_IS(pthread_spin_unlock(&spin_lock), 0);
  return unused;
}
CASE(a_spin_beside_another_is_left) {
  pthread_spin_init(&spin_lock, PTHREAD_PROCESS_PRIVATE);
  spin();
  const pthread_t other = start(spin_too, NULL);
  expect_left(spin);
  EXPECT_IS(spinning, 1);
  EXPECT_IS(pthread_spin_unlock(&spin_lock), 0);
  join(other);
}
static void hold_and_leave(void) {
  spin();
  raise(SIGUSR1);
}
CASE(a_spin_lock_of_a_thread_that_has_left_stays_taken) {
  pthread_spin_init(&spin_lock, PTHREAD_PROCESS_PRIVATE);
  act();
  void (*body)(void) = hold_and_leave;
  EXPECT(join(start(call, &body)) == noted);
  EXPECT_IS(pthread_spin_trylock(&spin_lock), EBUSY);
  const pthread_t other = start(spin_too, NULL);
  let_others_wait();
  EXPECT_IS(pthread_tryjoin_np(other, NULL), EBUSY);
  EXPECT_IS(pthread_spin_unlock(&spin_lock), 0);
  join(other);
}
static pthread_rwlock_t rwlock = PTHREAD_RWLOCK_INITIALIZER;
static void read_lock(void) { pthread_rwlock_rdlock(&rwlock); }
static void write_lock(void) { pthread_rwlock_wrlock(&rwlock); }
CASE(a_wait_to_read_is_left) {
  write_lock();
  expect_left(read_lock);
}
CASE(a_wait_to_write_is_left) {
  read_lock();
  expect_left(write_lock);
}
static pthread_barrier_t barrier;
static void arrive(void) { pthread_barrier_wait(&barrier); }
CASE(a_wait_at_a_barrier_is_left) {
  pthread_barrier_init(&barrier, NULL, 2);
  expect_left(arrive);
}
static sem_t semaphore;
static void take(void) { sem_wait(&semaphore); }
CASE(a_wait_for_a_semaphore_is_left) {
  sem_init(&semaphore, 0, 0);
  expect_left(take);
  EXPECT_IS(sem_post(&semaphore), 0);
  EXPECT_IS(sem_trywait(&semaphore), 0);
}
static int set;
static void decrease(void) {
  struct sembuf one = {0, -1, 0};
  semop(set, &one, 1);
}
CASE(a_wait_for_a_System_V_semaphore_is_left) {
  set = semget(IPC_PRIVATE, 1, 0600);
  expect_left(decrease);
  EXPECT_IS(semctl(set, 0, GETNCNT), 0);
  EXPECT_IS(semctl(set, 0, IPC_RMID), 0);
}
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static void unlock(void* unused) {
  (void)unused;
  EXPECT_IS(pthread_mutex_trylock(&mutex), EBUSY);
  EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
}
static void wait_for_it(void) {
  lock();
  pthread_cleanup_push(unlock, NULL);
  pthread_cond_wait(&condition, &mutex);
  pthread_cleanup_pop(0);
}
CASE(a_wait_at_a_condition_is_left_with_the_mutex) {
  expect_left(wait_for_it);
  EXPECT_IS(pthread_mutex_trylock(&mutex), 0);
}
static void* sleep_long(void* unused) {
  sleep_ms(30);
  return unused;
}
static pthread_t sleeper;
static void join_it(void) { pthread_join(sleeper, NULL); }
CASE(a_thread_whose_join_was_left_can_be_joined) {
  sleeper = start(sleep_long, NULL);
  expect_left(join_it);
  join(sleeper);
}

static void raise_it(void) { raise(SIGUSR1); }
static void kill_itself(void) { pthread_kill(pthread_self(), SIGUSR1); }
static void block_and_unblock(void) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &signals, NULL);
  raise(SIGUSR1);
  pthread_sigmask(SIG_UNBLOCK, &signals, NULL);
}
static void expect_to_leave(void (*body)(void)) {
  act();
  EXPECT(join(start(call, &body)) == noted);
  EXPECT_IS(cleaned, 1);
}
CASE(raise_is_left) { expect_to_leave(raise_it); }
CASE(pthread_kill_is_left) { expect_to_leave(kill_itself); }
CASE(pthread_sigmask_is_left) { expect_to_leave(block_and_unblock); }

static void lock_and_unlock(void) {
  for (;;) {
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
  }
}
CASE(a_loop_of_locks_is_left) { expect_left(lock_and_unlock); }
static void post(void) {
  for (;;) {
    sem_post(&semaphore);
    sem_trywait(&semaphore);
  }
}
CASE(a_loop_of_posts_is_left) { expect_left(post); }
static void read_clock(void) {
  for (;;) now_ns(CLOCK_MONOTONIC);
}
CASE(a_loop_of_clock_readings_is_left) { expect_left(read_clock); }

static void take_on_a_stack(void) {
  void* const memory = mmap(NULL, 65536, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  EXPECT(memory != MAP_FAILED);
  const stack_t stack = {.ss_sp = memory, .ss_size = 65536};
  EXPECT_IS(sigaltstack(&stack, NULL), 0);
  take();
}
CASE(a_wait_is_left_from_a_handler_on_its_own_stack) {
  struct sigaction action = {.sa_handler = leave, .sa_flags = SA_ONSTACK};
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
  sem_init(&semaphore, 0, 0);
  void (*body)(void) = take_on_a_stack;
  const pthread_t id = start(call, &body);
  let_others_wait();
  EXPECT_IS(pthread_kill(id, SIGUSR1), 0);
  EXPECT(join(id) == noted);
  EXPECT_IS(cleaned, 1);
}
