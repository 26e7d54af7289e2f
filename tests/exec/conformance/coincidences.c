// SPDX-License-Identifier: BSD-3-Clause
// What ends a wait comes right behind a signal or a cancellation, in the same instant of virtual time: the call has
// either done its work, or nothing.
#include "tests/exec/conformance/harness.h"

#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/msg.h>
#include <sys/sem.h>

enum { rounds = 20 };
static pthread_t waiter;
static int set, queue, result, error;
static atomic_int handled;
static void handle(int signal) {
  (void)signal;
  ++handled;
}
static void act(void) {
  struct sigaction action = {.sa_handler = handle};
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
}
static void* wait_once(void* body) {
  errno = 0;
  result = (*(int (**)(void))body)();
  error = errno;
  return NULL;
}
/// A thread waits in `wait`, gets a signal, and right behind it comes `release`.
static void disturb(int (*wait)(void), void (*release)(void)) {
  act();
  result = -77;
  waiter = start(wait_once, &wait);
  sleep_ms(2);
  EXPECT_IS(pthread_kill(waiter, SIGUSR1), 0);
  release();
  join(waiter);
}

static int decrease(void) {
  struct sembuf one = {0, -1, 0};
  return semop(set, &one, 1);
}
static int wait_for_zero(void) {
  struct sembuf one = {0, 0, 0};
  return semop(set, &one, 1);
}
static void set_all(void) {
  unsigned short values[2] = {1, 5};
  EXPECT_IS(semctl(set, 0, SETALL, values), 0);
}
static void set_all_to_zero(void) {
  unsigned short values[2] = {0, 0};
  EXPECT_IS(semctl(set, 0, SETALL, values), 0);
}
static void remove_set(void) { EXPECT_IS(semctl(set, 0, IPC_RMID), 0); }

CASE(a_signal_and_SETALL) {
  for (int i = 0; i < rounds; ++i) {
    set = semget(IPC_PRIVATE, 2, 0600);
    disturb(decrease, set_all);
    EXPECT(result == 0 || error == EINTR);
    EXPECT_IS(semctl(set, 0, GETVAL), result == 0 ? 0 : 1);
    remove_set();
  }
  EXPECT_IS(handled, rounds);
}
CASE(a_signal_and_SETALL_to_zero) {
  for (int i = 0; i < rounds; ++i) {
    set = semget(IPC_PRIVATE, 2, 0600);
    set_all();
    disturb(wait_for_zero, set_all_to_zero);
    EXPECT(result == 0 || error == EINTR);
    EXPECT_IS(semctl(set, 0, GETZCNT), 0);
    remove_set();
  }
  EXPECT_IS(handled, rounds);
}
CASE(a_signal_and_the_removal_of_the_semaphores) {
  for (int i = 0; i < rounds; ++i) {
    set = semget(IPC_PRIVATE, 2, 0600);
    disturb(decrease, remove_set);
    EXPECT_IS(result, -1);
    EXPECT(error == EIDRM || error == EINTR);
  }
  EXPECT_IS(handled, rounds);
}
static void* wait_twice(void* unused) {
  for (int i = 0; i < 2; ++i)
    while (decrease() != 0) EXPECT_IS(errno, EINTR);
  return unused;
}
CASE(signals_to_all_waiters_and_SETALL) {
  act();
  set = semget(IPC_PRIVATE, 2, 0600);
  for (int i = 0; i < rounds; ++i) {
    pthread_t ids[4];
    unsigned short values[2] = {8, 0};
    for (int k = 0; k < 4; ++k) ids[k] = start(wait_twice, NULL);
    sleep_ms(2);
    for (int k = 0; k < 4; ++k) pthread_kill(ids[k], SIGUSR1);
    EXPECT_IS(semctl(set, 0, SETALL, values), 0);
    for (int k = 0; k < 4; ++k) pthread_kill(ids[k], SIGUSR1);
    for (int k = 0; k < 4; ++k) join(ids[k]);
    EXPECT_IS(semctl(set, 0, GETVAL), 0);
  }
  remove_set();
}

static char bytes[8300];
static int receive(void) { return (int)msgrcv(queue, bytes, 8, 0, 0); }
static int send_much(void) {
  *(long*)(void*)bytes = 1;
  return msgsnd(queue, bytes, 8192, 0);
}
static void remove_queue(void) { EXPECT_IS(msgctl(queue, IPC_RMID, NULL), 0); }
CASE(a_signal_and_the_removal_of_the_queue) {
  for (int i = 0; i < rounds; ++i) {
    queue = msgget(IPC_PRIVATE, 0600);
    disturb(receive, remove_queue);
    EXPECT_IS(result, -1);
    EXPECT(error == EIDRM || error == EINTR);
  }
}
static void make_room(void) {
  static char message[8300];
  EXPECT_IS(msgrcv(queue, message, 8192, 0, 0), 8192);
}
CASE(a_signal_and_room_in_the_queue) {
  for (int i = 0; i < rounds; ++i) {
    queue = msgget(IPC_PRIVATE, 0600);
    while (msgsnd(queue, (*(long*)(void*)bytes = 1, bytes), 8192, IPC_NOWAIT) == 0) ++result;
    struct msqid_ds before, after;
    EXPECT_IS(msgctl(queue, IPC_STAT, &before), 0);
    disturb(send_much, make_room);
    EXPECT(result == 0 || error == EINTR);
    EXPECT_IS(msgctl(queue, IPC_STAT, &after), 0);
    EXPECT_IS(after.msg_qnum, result == 0 ? before.msg_qnum : before.msg_qnum - 1);
    remove_queue();
  }
}

static sem_t semaphore;
static int take(void) { return sem_wait(&semaphore); }
static void post(void) { EXPECT_IS(sem_post(&semaphore), 0); }
static int value(void) {
  int is = -1;
  EXPECT_IS(sem_getvalue(&semaphore, &is), 0);
  return is;
}
CASE(a_signal_and_a_post) {
  for (int i = 0; i < rounds; ++i) {
    sem_init(&semaphore, 0, 0);
    disturb(take, post);
    EXPECT(result == 0 || error == EINTR);
    EXPECT_IS(value(), result == 0 ? 0 : 1);
  }
}

/// A thread waits in `wait`; `first` and `second` follow each other. Returns what pthread_join() says.
static void* cancel_with(int (*wait)(void), void (*first)(void), void (*second)(void)) {
  result = -77;
  waiter = start(wait_once, &wait);
  sleep_ms(2);
  first();
  second();
  return join(waiter);
}
static void cancel(void) { EXPECT_IS(pthread_cancel(waiter), 0); }
CASE(a_cancellation_and_a_post) {
  for (int i = 0; i < rounds; ++i) {
    sem_init(&semaphore, 0, 0);
    const int is_cancelled = cancel_with(take, cancel, post) == PTHREAD_CANCELED;
    EXPECT_IS(value(), is_cancelled ? 1 : 0);
  }
}
CASE(a_post_and_a_cancellation) {
  for (int i = 0; i < rounds; ++i) {
    sem_init(&semaphore, 0, 0);
    const int is_cancelled = cancel_with(take, post, cancel) == PTHREAD_CANCELED;
    EXPECT_IS(value(), is_cancelled ? 1 : 0);
  }
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
static int woken, cancelled, waiting;
static void leave_cancelled(void* unused) {
  (void)unused;
  ++cancelled;
  pthread_mutex_unlock(&mutex);
}
static void* wait_for_it(void* unused) {
  pthread_mutex_lock(&mutex);
  pthread_cleanup_push(leave_cancelled, NULL);
  ++waiting;
  pthread_cond_wait(&condition, &mutex);
  ++woken;
  pthread_cleanup_pop(0);
  pthread_mutex_unlock(&mutex);
  return unused;
}
/// POSIX: a thread that is cancelled at a condition consumes no signal if others wait for it.
static void cancel_one_of_two(int signals_first) {
  pthread_t ids[2];
  waiting = woken = cancelled = 0;
  for (int i = 0; i < 2; ++i) ids[i] = start(wait_for_it, NULL);
  for (int both = 0; !both;) {
    sleep_ms(1);
    pthread_mutex_lock(&mutex);
    both = waiting == 2;
    pthread_mutex_unlock(&mutex);
  }
  pthread_mutex_lock(&mutex);
  if (signals_first) pthread_cond_signal(&condition);
  pthread_cancel(ids[0]);
  if (!signals_first) pthread_cond_signal(&condition);
  pthread_mutex_unlock(&mutex);
  for (int i = 0; i < 100 && woken + cancelled < 2; ++i) sleep_ms(1);
  pthread_mutex_lock(&mutex);
  EXPECT(woken >= 1);
  pthread_cond_broadcast(&condition);
  pthread_mutex_unlock(&mutex);
  for (int i = 0; i < 2; ++i) join(ids[i]);
}
CASE(a_signal_of_a_condition_and_a_cancellation) {
  for (int i = 0; i < rounds; ++i) cancel_one_of_two(1);
}
CASE(a_cancellation_and_a_signal_of_a_condition) {
  for (int i = 0; i < rounds; ++i) cancel_one_of_two(0);
}
