// SPDX-License-Identifier: BSD-3-Clause
// Signals during waits for primitives or time: which calls end, and which continue.
#include "tests/exec/conformance/interruptions.h"

#include <linux/futex.h>
#include <semaphore.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/syscall.h>

static atomic_int done;
static sem_t semaphore;
static void post(void) { sem_post(&semaphore); }

CASE(sem_wait_ends) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(sem_wait(&semaphore), EINTR);
  end(id);
}
CASE(sem_wait_goes_on_if_asked) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(SA_RESTART, post);
  EXPECT_IS(sem_wait(&semaphore), 0);
  end(id);
}
CASE(sem_timedwait_ends) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(0, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  EXPECT_FAILS(sem_timedwait(&semaphore, &deadline), EINTR);
  end(id);
}
CASE(sem_clockwait_ends) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(0, NULL);
  const struct timespec deadline = in_ms(CLOCK_MONOTONIC, 5000);
  EXPECT_FAILS(sem_clockwait(&semaphore, CLOCK_MONOTONIC, &deadline), EINTR);
  end(id);
}
CASE(nanosleep_ends_and_tells_what_is_left) {
  const pthread_t id = begin(SA_RESTART, NULL);
  struct timespec time = {50, 0};
  EXPECT_FAILS(nanosleep(&time, &time), EINTR);
  EXPECT(time.tv_sec >= 45 && time.tv_sec < 50);
  end(id);
}
CASE(clock_nanosleep_ends) {
  const pthread_t id = begin(SA_RESTART, NULL);
  const struct timespec time = {50, 0};
  struct timespec left = {0, 0};
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC, 0, &time, &left), EINTR);
  EXPECT(left.tv_sec >= 45 && left.tv_sec < 50);
  end(id);
}
CASE(clock_nanosleep_to_a_time_tells_nothing) {
  const pthread_t id = begin(SA_RESTART, NULL);
  const struct timespec time = in_ms(CLOCK_MONOTONIC, 50000);
  struct timespec left = {7, 7};
  EXPECT_IS(clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, &left), EINTR);
  EXPECT(left.tv_sec == 7 && left.tv_nsec == 7);
  end(id);
}
CASE(sleep_ends_and_tells_what_is_left) {
  const pthread_t id = begin(SA_RESTART, NULL);
  const unsigned left = sleep(50);
  EXPECT(left >= 45 && left <= 50);
  end(id);
}
CASE(usleep_ends) {
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(usleep(900000), EINTR);
  end(id);
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
static pthread_barrier_t barrier;
static atomic_int is_true;

static void* hold_mutex(void* unused) {
  pthread_mutex_lock(&mutex);
  atomic_fetch_add(&done, 1);
  sleep_ms(50);
  pthread_mutex_unlock(&mutex);
  return unused;
}
CASE(a_mutex_is_waited_for_on) {
  const pthread_t holder = start(hold_mutex, NULL);
  while (!done) sched_yield();
  const pthread_t id = begin(0, NULL);
  EXPECT_IS(pthread_mutex_lock(&mutex), 0);
  end(id);
  join(holder);
}
CASE(a_mutex_is_waited_for_on_until_its_time) {
  const pthread_t holder = start(hold_mutex, NULL);
  while (!done) sched_yield();
  const pthread_t id = begin(0, NULL);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 30);
  EXPECT_IS(pthread_mutex_timedlock(&mutex, &deadline), ETIMEDOUT);
  end(id);
  join(holder);
}

static void make_true(void) {
  pthread_mutex_lock(&mutex);
  is_true = 1;
  pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
}
CASE(a_condition_gives_no_EINTR) {
  const pthread_t id = begin(0, make_true);
  pthread_mutex_lock(&mutex);
  while (!is_true) EXPECT_IS(pthread_cond_wait(&condition, &mutex), 0);
  pthread_mutex_unlock(&mutex);
  end(id);
}
CASE(a_timed_condition_gives_no_EINTR) {
  const pthread_t id = begin(0, make_true);
  const struct timespec deadline = in_ms(CLOCK_REALTIME, 5000);
  pthread_mutex_lock(&mutex);
  while (!is_true) EXPECT_IS(pthread_cond_timedwait(&condition, &mutex, &deadline), 0);
  pthread_mutex_unlock(&mutex);
  end(id);
}

static void* hold_lock(void* unused) {
  pthread_rwlock_wrlock(&lock);
  atomic_fetch_add(&done, 1);
  sleep_ms(50);
  pthread_rwlock_unlock(&lock);
  return unused;
}
CASE(a_lock_is_waited_for_on_to_read) {
  const pthread_t holder = start(hold_lock, NULL);
  while (!done) sched_yield();
  const pthread_t id = begin(0, NULL);
  EXPECT_IS(pthread_rwlock_rdlock(&lock), 0);
  end(id);
  join(holder);
}
CASE(a_lock_is_waited_for_on_to_write) {
  const pthread_t holder = start(hold_lock, NULL);
  while (!done) sched_yield();
  const pthread_t id = begin(0, NULL);
  EXPECT_IS(pthread_rwlock_wrlock(&lock), 0);
  end(id);
  join(holder);
}

static void arrive(void) { pthread_barrier_wait(&barrier); }
CASE(a_barrier_is_waited_at_on) {
  pthread_barrier_init(&barrier, NULL, 2);
  const pthread_t id = begin(0, arrive);
  const int result = pthread_barrier_wait(&barrier);
  EXPECT(result == 0 || result == PTHREAD_BARRIER_SERIAL_THREAD);
  end(id);
}
CASE(a_join_goes_on) {
  const pthread_t holder = start(hold_mutex, NULL);
  const pthread_t id = begin(0, NULL);
  EXPECT_IS(pthread_join(holder, NULL), 0);
  end(id);
}

static int word;

static void wake_word(void) {
  word = 1;
  syscall(SYS_futex, &word, FUTEX_WAKE, 1, NULL, NULL, 0);
}
CASE(a_futex_ends) {
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(syscall(SYS_futex, &word, FUTEX_WAIT, 0, NULL, NULL, 0), EINTR);
  end(id);
}
CASE(a_futex_goes_on_if_asked) {
  const pthread_t id = begin(SA_RESTART, wake_word);
  EXPECT_IS(syscall(SYS_futex, &word, FUTEX_WAIT, 0, NULL, NULL, 0), 0);
  end(id);
}
CASE(semop_ends_whatever_is_asked) {
  const int set = semget(IPC_PRIVATE, 1, 0600);
  struct sembuf one = {0, -1, 0};
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(semop(set, &one, 1), EINTR);
  EXPECT_IS(semctl(set, 0, GETNCNT), 0);
  end(id);
  semctl(set, 0, IPC_RMID);
}
CASE(msgrcv_ends_whatever_is_asked) {
  const int queue = msgget(IPC_PRIVATE, 0600);
  long message[2];
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(msgrcv(queue, message, 8, 0, 0), EINTR);
  end(id);
  msgctl(queue, IPC_RMID, NULL);
}
CASE(msgsnd_ends_whatever_is_asked) {
  const int queue = msgget(IPC_PRIVATE, 0600);
  static char message[8200] = {1};
  EXPECT_IS(msgsnd(queue, message, 8192, 0), 0);
  EXPECT_IS(msgsnd(queue, message, 8192, 0), 0);
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(msgsnd(queue, message, 8192, 0), EINTR);
  end(id);
  msgctl(queue, IPC_RMID, NULL);
}

// What ends the wait comes right behind the signal, in the same instant.
static int set, queue;

static void* signal_and_release(void* unused) {
  struct sembuf one = {0, 1, 0};
  sleep_ms(2);
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  EXPECT_IS(semop(set, &one, 1), 0);
  return unused;
}
CASE(a_signal_may_come_together_with_a_semaphore) {
  act(0);
  set = semget(IPC_PRIVATE, 1, 0600);
  for (int i = 0; i < 20; ++i) {
    struct sembuf one = {0, -1, 0};
    const pthread_t id = start(signal_and_release, NULL);
    const int result = semop(set, &one, 1);
    EXPECT(result == 0 || errno == EINTR);
    join(id);
    EXPECT_IS(semctl(set, 0, GETVAL), result == 0 ? 0 : 1);
    EXPECT_IS(semctl(set, 0, SETVAL, 0), 0);
  }
  EXPECT_IS(handled, 20);
  semctl(set, 0, IPC_RMID);
}
static void* signal_and_send(void* unused) {
  const long message[2] = {1, 2};
  sleep_ms(2);
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  EXPECT_IS(msgsnd(queue, message, 8, 0), 0);
  return unused;
}
CASE(a_signal_may_come_together_with_a_message) {
  act(0);
  queue = msgget(IPC_PRIVATE, 0600);
  for (int i = 0; i < 20; ++i) {
    long message[2] = {0, 0};
    const pthread_t id = start(signal_and_send, NULL);
    const ssize_t result = msgrcv(queue, message, 8, 0, 0);
    EXPECT(result == 8 || errno == EINTR);
    join(id);
    if (result < 0) EXPECT_IS(msgrcv(queue, message, 8, 0, IPC_NOWAIT), 8);
    EXPECT_IS(message[1], 2);
  }
  EXPECT_IS(handled, 20);
  msgctl(queue, IPC_RMID, NULL);
}
CASE(an_ignored_signal_ends_nothing) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(0, post);
  signal(SIGUSR1, SIG_IGN);
  EXPECT_IS(sem_wait(&semaphore), 0);
  join(id);
}
CASE(a_blocked_signal_ends_nothing) {
  sem_init(&semaphore, 0, 0);
  const pthread_t id = begin(0, post);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  EXPECT_IS(sem_wait(&semaphore), 0);
  EXPECT_IS(handled, 0);
  join(id);
}
