// SPDX-License-Identifier: BSD-3-Clause
//
// Objects shared by forked processes: primitives in shared memory, named semaphores.
#include <fcntl.h>
#include <linux/futex.h>
#include <sched.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include "tests/exec/conformance/harness.h"

static void* shared_memory(size_t size) {
  void* const memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  EXPECT(memory != MAP_FAILED);
  return memory;
}

static void join_child(pid_t child) {
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(status, 0);
}

// With it a child lets the parent continue.
static sem_t* step(void) {
  sem_t* const semaphore = shared_memory(sizeof *semaphore);
  EXPECT_IS(sem_init(semaphore, 1, 0), 0);
  return semaphore;
}

static pthread_mutex_t* shared_mutex(int type, int robust) {
  pthread_mutex_t* const mutex = shared_memory(sizeof *mutex);
  pthread_mutexattr_t attributes;
  EXPECT_IS(pthread_mutexattr_init(&attributes), 0);
  EXPECT_IS(pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_mutexattr_settype(&attributes, type), 0);
  EXPECT_IS(pthread_mutexattr_setrobust(&attributes, robust), 0);
  EXPECT_IS(pthread_mutex_init(mutex, &attributes), 0);
  return mutex;
}

static pthread_cond_t* shared_condition(void) {
  pthread_cond_t* const condition = shared_memory(sizeof *condition);
  pthread_condattr_t attributes;
  EXPECT_IS(pthread_condattr_init(&attributes), 0);
  EXPECT_IS(pthread_condattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_cond_init(condition, &attributes), 0);
  return condition;
}

CASE(semaphore_is_waited_for_in_the_parent) {
  sem_t* const semaphore = shared_memory(sizeof *semaphore);
  EXPECT_IS(sem_init(semaphore, 1, 0), 0);
  const pid_t child = fork();
  if (child == 0) _exit(sem_post(semaphore));
  EXPECT_IS(sem_wait(semaphore), 0);
  join_child(child);
  EXPECT_IS(sem_trywait(semaphore), -1);
  EXPECT_IS(sem_destroy(semaphore), 0);
}

CASE(semaphore_is_waited_for_in_the_child) {
  sem_t* const semaphore = shared_memory(sizeof *semaphore);
  EXPECT_IS(sem_init(semaphore, 1, 0), 0);
  const pid_t child = fork();
  if (child == 0) _exit(sem_wait(semaphore));
  EXPECT_IS(sem_post(semaphore), 0);
  join_child(child);
  int count = -1;
  EXPECT_IS(sem_getvalue(semaphore, &count), 0);
  EXPECT_IS(count, 0);
}

CASE(semaphore_is_waited_for_until_a_deadline) {
  sem_t* const semaphore = shared_memory(sizeof *semaphore);
  EXPECT_IS(sem_init(semaphore, 1, 0), 0);
  const pid_t child = fork();
  if (child == 0) {
    pause();
    _exit(0);
  }
  struct timespec deadline;
  clock_gettime(CLOCK_REALTIME, &deadline);
  deadline.tv_nsec += 20000000;
  if (deadline.tv_nsec >= 1000000000) ++deadline.tv_sec, deadline.tv_nsec -= 1000000000;
  EXPECT_FAILS(sem_timedwait(semaphore, &deadline), ETIMEDOUT);
  EXPECT_IS(kill(child, SIGKILL), 0);
  EXPECT_IS(waitpid(child, NULL, 0), child);
}

static sem_t* taken;
static void* wait_for_semaphore(void* semaphore) {
  EXPECT_IS(sem_wait(semaphore), 0);
  return NULL;
}

CASE(thread_that_waits_at_a_fork_is_woken_by_the_child) {
  taken = shared_memory(sizeof *taken);
  EXPECT_IS(sem_init(taken, 1, 0), 0);
  pthread_t thread;
  EXPECT_IS(pthread_create(&thread, NULL, wait_for_semaphore, taken), 0);
  usleep(1000);
  const pid_t child = fork();
  if (child == 0) _exit(sem_post(taken));
  EXPECT_IS(pthread_join(thread, NULL), 0);
  join_child(child);
}

CASE(named_semaphore_is_the_family_s) {
  char name[64];
  snprintf(name, sizeof name, "/waitpoint-shared-%d", (int)getpid());
  sem_t* const semaphore = sem_open(name, O_CREAT | O_EXCL, 0600, 0);
  EXPECT(semaphore != SEM_FAILED);
  const pid_t child = fork();
  if (child == 0) {
    sem_t* const own = sem_open(name, 0);
    if (own == SEM_FAILED || sem_post(own) != 0 || sem_close(own) != 0) _exit(1);
    _exit(sem_close(semaphore));
  }
  EXPECT_IS(sem_wait(semaphore), 0);
  join_child(child);
  EXPECT_IS(sem_unlink(name), 0);
  EXPECT_IS(sem_close(semaphore), 0);
}

CASE(named_semaphore_of_a_child_is_there_after_it) {
  char name[64];
  snprintf(name, sizeof name, "/waitpoint-of-child-%d", (int)getpid());
  const pid_t child = fork();
  if (child == 0) _exit(sem_open(name, O_CREAT | O_EXCL, 0600, 7) == SEM_FAILED);
  join_child(child);
  sem_t* const semaphore = sem_open(name, 0);
  EXPECT(semaphore != SEM_FAILED);
  int count = 0;
  EXPECT_IS(sem_getvalue(semaphore, &count), 0);
  EXPECT_IS(count, 7);
  EXPECT_IS(sem_unlink(name), 0);
}

// Four processes increment a number: each must write it back before another reads it.
CASE(mutex_keeps_processes_apart) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_STALLED);
  volatile int* const number = shared_memory(sizeof *number);
  pid_t children[4];
  for (int i = 0; i < 4; ++i) {
    children[i] = fork();
    if (children[i] != 0) continue;
    for (int turn = 0; turn < 50; ++turn) {
      EXPECT_IS(pthread_mutex_lock(mutex), 0);
      const int read = *number;
      if (turn % 10 == 0) usleep(100);
      *number = read + 1;
      EXPECT_IS(pthread_mutex_unlock(mutex), 0);
    }
    _exit(0);
  }
  for (int i = 0; i < 4; ++i) join_child(children[i]);
  EXPECT_IS(*number, 200);
  EXPECT_IS(pthread_mutex_destroy(mutex), 0);
}

CASE(mutex_of_the_parent_is_not_the_child_s) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_ERRORCHECK, PTHREAD_MUTEX_STALLED);
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), EDEADLK);
  sem_t* const tried = step();
  const pid_t child = fork();
  if (child == 0) {
    EXPECT_IS(pthread_mutex_trylock(mutex), EBUSY);
    EXPECT_IS(pthread_mutex_unlock(mutex), EPERM);
    EXPECT_IS(sem_post(tried), 0);
    EXPECT_IS(pthread_mutex_lock(mutex), 0);
    _exit(pthread_mutex_unlock(mutex));
  }
  EXPECT_IS(sem_wait(tried), 0);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  join_child(child);
}

CASE(recursive_mutex_is_given_up_at_the_last_unlock) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_RECURSIVE, PTHREAD_MUTEX_STALLED);
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  pid_t child = fork();
  if (child == 0) _exit(pthread_mutex_trylock(mutex) != EBUSY);
  join_child(child);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  child = fork();
  if (child == 0) _exit(pthread_mutex_trylock(mutex));
  join_child(child);
}

CASE(robust_mutex_tells_that_a_process_ended_with_it) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_ROBUST);
  const pid_t child = fork();
  if (child == 0) _exit(pthread_mutex_lock(mutex));
  join_child(child);
  EXPECT_IS(pthread_mutex_lock(mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_consistent(mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
}

CASE(robust_mutex_is_waited_for_until_its_process_is_killed) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_ROBUST);
  sem_t* const ready = shared_memory(sizeof *ready);
  EXPECT_IS(sem_init(ready, 1, 0), 0);
  const pid_t child = fork();
  if (child == 0) {
    pthread_mutex_lock(mutex);
    sem_post(ready);
    usleep(20000);
    kill(getpid(), SIGKILL);
  }
  EXPECT_IS(sem_wait(ready), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), EOWNERDEAD);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), ENOTRECOVERABLE);
  EXPECT_IS(waitpid(child, NULL, 0), child);
}

static volatile int* turn;
static void take_turns(pthread_mutex_t* mutex, pthread_cond_t* condition, int own) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_IS(pthread_mutex_lock(mutex), 0);
    while (*turn != own) EXPECT_IS(pthread_cond_wait(condition, mutex), 0);
    *turn = 1 - own;
    EXPECT_IS(pthread_cond_signal(condition), 0);
    EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  }
}

CASE(condition_hands_over_between_processes) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_STALLED);
  pthread_cond_t* const condition = shared_condition();
  turn = shared_memory(sizeof *turn);
  const pid_t child = fork();
  take_turns(mutex, condition, child == 0);
  if (child == 0) _exit(0);
  join_child(child);
  EXPECT_IS(pthread_cond_destroy(condition), 0);
}

CASE(condition_is_told_to_all_processes) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_STALLED);
  pthread_cond_t* const condition = shared_condition();
  volatile int* const state = shared_memory(2 * sizeof *state);
  pid_t children[3];
  for (int i = 0; i < 3; ++i) {
    children[i] = fork();
    if (children[i] != 0) continue;
    EXPECT_IS(pthread_mutex_lock(mutex), 0);
    ++state[1];
    while (!state[0]) EXPECT_IS(pthread_cond_wait(condition, mutex), 0);
    _exit(pthread_mutex_unlock(mutex));
  }
  for (int all = 0; !all;) {
    EXPECT_IS(pthread_mutex_lock(mutex), 0);
    all = state[1] == 3;
    if (all) state[0] = 1;
    EXPECT_IS(pthread_mutex_unlock(mutex), 0);
    usleep(1000);
  }
  EXPECT_IS(pthread_cond_broadcast(condition), 0);
  for (int i = 0; i < 3; ++i) join_child(children[i]);
}

CASE(condition_is_waited_for_until_a_deadline) {
  pthread_mutex_t* const mutex = shared_mutex(PTHREAD_MUTEX_NORMAL, PTHREAD_MUTEX_STALLED);
  pthread_cond_t* const condition = shared_condition();
  const struct timespec past = {1, 0};
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_cond_timedwait(condition, mutex, &past), ETIMEDOUT);
  EXPECT_IS(pthread_mutex_unlock(mutex), 0);
  // Without waiters, the signal is lost.
  EXPECT_IS(pthread_cond_signal(condition), 0);
  EXPECT_IS(pthread_mutex_lock(mutex), 0);
  EXPECT_IS(pthread_cond_timedwait(condition, mutex, &past), ETIMEDOUT);
}

CASE(rwlock_lets_readers_of_processes_in_together) {
  pthread_rwlock_t* const lock = shared_memory(sizeof *lock);
  pthread_rwlockattr_t attributes;
  EXPECT_IS(pthread_rwlockattr_init(&attributes), 0);
  EXPECT_IS(pthread_rwlockattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_rwlock_init(lock, &attributes), 0);
  EXPECT_IS(pthread_rwlock_rdlock(lock), 0);
  sem_t* const tried = step();
  pid_t child = fork();
  if (child == 0) {
    EXPECT_IS(pthread_rwlock_tryrdlock(lock), 0);
    EXPECT_IS(pthread_rwlock_unlock(lock), 0);
    EXPECT_IS(pthread_rwlock_trywrlock(lock), EBUSY);
    EXPECT_IS(sem_post(tried), 0);
    EXPECT_IS(pthread_rwlock_wrlock(lock), 0);
    _exit(pthread_rwlock_unlock(lock));
  }
  EXPECT_IS(sem_wait(tried), 0);
  EXPECT_IS(pthread_rwlock_unlock(lock), 0);
  join_child(child);
  EXPECT_IS(pthread_rwlock_wrlock(lock), 0);
  child = fork();
  if (child == 0) {
    EXPECT_IS(pthread_rwlock_tryrdlock(lock), EBUSY);
    EXPECT_IS(sem_post(tried), 0);
    EXPECT_IS(pthread_rwlock_rdlock(lock), 0);
    _exit(pthread_rwlock_unlock(lock));
  }
  EXPECT_IS(sem_wait(tried), 0);
  EXPECT_IS(pthread_rwlock_unlock(lock), 0);
  join_child(child);
  EXPECT_IS(pthread_rwlock_destroy(lock), 0);
}

CASE(barrier_waits_for_processes) {
  pthread_barrier_t* const barrier = shared_memory(sizeof *barrier);
  int* const serial = shared_memory(sizeof *serial);
  pthread_barrierattr_t attributes;
  EXPECT_IS(pthread_barrierattr_init(&attributes), 0);
  EXPECT_IS(pthread_barrierattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_barrier_init(barrier, &attributes, 3), 0);
  pid_t children[2];
  for (int i = 0; i < 2; ++i) {
    children[i] = fork();
    if (children[i] != 0) continue;
    for (int round = 0; round < 5; ++round)
      if (pthread_barrier_wait(barrier) == PTHREAD_BARRIER_SERIAL_THREAD) __atomic_add_fetch(serial, 1, __ATOMIC_SEQ_CST);
    _exit(0);
  }
  for (int round = 0; round < 5; ++round)
    if (pthread_barrier_wait(barrier) == PTHREAD_BARRIER_SERIAL_THREAD) __atomic_add_fetch(serial, 1, __ATOMIC_SEQ_CST);
  for (int i = 0; i < 2; ++i) join_child(children[i]);
  EXPECT_IS(*serial, 5);
}

CASE(spin_lock_keeps_processes_apart) {
  pthread_spinlock_t* const lock = shared_memory(sizeof *lock);
  EXPECT_IS(pthread_spin_init(lock, PTHREAD_PROCESS_SHARED), 0);
  EXPECT_IS(pthread_spin_lock(lock), 0);
  sem_t* const tried = step();
  const pid_t child = fork();
  if (child == 0) {
    EXPECT_IS(pthread_spin_trylock(lock), EBUSY);
    EXPECT_IS(sem_post(tried), 0);
    EXPECT_IS(pthread_spin_lock(lock), 0);
    _exit(pthread_spin_unlock(lock));
  }
  EXPECT_IS(sem_wait(tried), 0);
  EXPECT_IS(pthread_spin_unlock(lock), 0);
  join_child(child);
}

static long futex(int* word, int operation, int value) { return syscall(SYS_futex, word, operation, value, NULL); }

CASE(futex_wakes_who_waits_in_another_process) {
  int* const word = shared_memory(sizeof *word);
  const pid_t child = fork();
  if (child == 0) _exit(futex(word, FUTEX_WAIT, 0) != 0);
  long woken = 0;
  while (woken == 0) {
    woken = futex(word, FUTEX_WAKE, 2);
    usleep(1000);
  }
  EXPECT_IS(woken, 1);
  join_child(child);
}

CASE(futex_is_not_waited_for_where_it_has_another_value) {
  int* const word = shared_memory(sizeof *word);
  *word = 1;
  EXPECT_FAILS(futex(word, FUTEX_WAIT, 0), EAGAIN);
  EXPECT_IS(futex(word, FUTEX_WAKE, 1), 0);
}

CASE(grandchild_and_its_uncle_meet) {
  sem_t* const semaphores = shared_memory(2 * sizeof *semaphores);
  EXPECT_IS(sem_init(&semaphores[0], 1, 0), 0);
  EXPECT_IS(sem_init(&semaphores[1], 1, 0), 0);
  const pid_t uncle = fork();
  if (uncle == 0) _exit(sem_wait(&semaphores[0]) | sem_post(&semaphores[1]));
  const pid_t father = fork();
  if (father == 0) {
    const pid_t child = fork();
    if (child == 0) _exit(sem_post(&semaphores[0]) | sem_wait(&semaphores[1]));
    join_child(child);
    _exit(0);
  }
  join_child(father);
  join_child(uncle);
}
