// SPDX-License-Identifier: BSD-3-Clause
// Calls that wait while a signal comes: which end with EINTR, which go on, and which do so if SA_RESTART asks for it.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <poll.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/msg.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>

static atomic_int handled, done;
static pthread_t main_id;
static void handle(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}
static void act(int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handle;
  action.sa_flags = flags;
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
  main_id = pthread_self();
}

// Sends the signal to the thread that waits, then does what it waits for.
static void (*then)(void);
static void* disturb(void* unused) {
  sleep_ms(10);
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  sleep_ms(10);
  if (then != NULL) then();
  return unused;
}
static pthread_t begin(int flags, void (*after)(void)) {
  act(flags);
  then = after;
  return start(disturb, NULL);
}
static void end(pthread_t id) {
  EXPECT_IS(handled, 1);
  join(id);
}

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

static int ends[2];
static void write_one(void) { EXPECT_IS(write(ends[1], "x", 1), 1); }
static void read_all(void) {
  static char bytes[1 << 20];
  EXPECT(read(ends[0], bytes, sizeof bytes) > 0);
}
CASE(read_ends) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(read(ends[0], &byte, 1), EINTR);
  end(id);
}
CASE(read_goes_on_if_asked) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, write_one);
  EXPECT_IS(read(ends[0], &byte, 1), 1);
  end(id);
}
CASE(readv_ends) {
  EXPECT_IS(pipe(ends), 0);
  char byte;
  const struct iovec piece = {&byte, 1};
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(readv(ends[0], &piece, 1), EINTR);
  end(id);
}
static void fill(int descriptor) {
  static const char bytes[4096];
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  while (write(descriptor, bytes, sizeof bytes) > 0) {
  }
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
}
CASE(write_ends) {
  EXPECT_IS(pipe(ends), 0);
  fill(ends[1]);
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(write(ends[1], "x", 1), EINTR);
  end(id);
}
CASE(write_goes_on_if_asked) {
  EXPECT_IS(pipe(ends), 0);
  fill(ends[1]);
  const pthread_t id = begin(SA_RESTART, read_all);
  EXPECT_IS(write(ends[1], "x", 1), 1);
  end(id);
}
CASE(write_that_was_begun_tells_how_much) {
  EXPECT_IS(pipe(ends), 0);
  static char bytes[1 << 20];
  const pthread_t id = begin(0, NULL);
  const ssize_t written = write(ends[1], bytes, sizeof bytes);
  EXPECT(written > 0 && written < (ssize_t)sizeof bytes);
  end(id);
}
CASE(recv_ends) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  char byte;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EINTR);
  end(id);
}
CASE(recv_goes_on_if_asked) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, write_one);
  EXPECT_IS(recv(ends[0], &byte, 1, 0), 1);
  end(id);
}
CASE(recv_with_a_timeout_ends_whatever_is_asked) {
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  const struct timeval timeout = {5, 0};
  EXPECT_IS(setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout), 0);
  char byte;
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(recv(ends[0], &byte, 1, 0), EINTR);
  end(id);
}
CASE(an_eventfd_ends) {
  const int descriptor = eventfd(0, 0);
  eventfd_t value;
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(read(descriptor, &value, sizeof value), EINTR);
  end(id);
}
CASE(poll_ends_whatever_is_asked) {
  EXPECT_IS(pipe(ends), 0);
  struct pollfd one = {ends[0], POLLIN, 0};
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(poll(&one, 1, -1), EINTR);
  end(id);
}
CASE(poll_with_a_timeout_ends) {
  EXPECT_IS(pipe(ends), 0);
  struct pollfd one = {ends[0], POLLIN, 0};
  const pthread_t id = begin(0, NULL);
  EXPECT_FAILS(poll(&one, 1, 5000), EINTR);
  end(id);
}
CASE(select_ends) {
  EXPECT_IS(pipe(ends), 0);
  fd_set set;
  FD_ZERO(&set);
  FD_SET(ends[0], &set);
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(select(ends[0] + 1, &set, NULL, NULL, NULL), EINTR);
  end(id);
}
CASE(epoll_ends) {
  EXPECT_IS(pipe(ends), 0);
  const int descriptor = epoll_create1(0);
  struct epoll_event event = {.events = EPOLLIN};
  EXPECT_IS(epoll_ctl(descriptor, EPOLL_CTL_ADD, ends[0], &event), 0);
  const pthread_t id = begin(SA_RESTART, NULL);
  EXPECT_FAILS(epoll_wait(descriptor, &event, 1, -1), EINTR);
  end(id);
}
CASE(ppoll_waits_with_its_mask) {
  act(0);
  sigset_t set, none;
  sigemptyset(&none);
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  const struct timespec none_at_all = {0, 0};
  raise(SIGUSR1);
  EXPECT_IS(ppoll(NULL, 0, &none_at_all, NULL), 0);
  EXPECT_IS(handled, 0);
  EXPECT_FAILS(ppoll(NULL, 0, NULL, &none), EINTR);
  EXPECT_IS(handled, 1);
  sigset_t now;
  pthread_sigmask(SIG_BLOCK, NULL, &now);
  EXPECT_IS(sigismember(&now, SIGUSR1), 1);
}
CASE(pselect_waits_with_its_mask) {
  act(0);
  sigset_t set, none;
  sigemptyset(&none);
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  raise(SIGUSR1);
  EXPECT_FAILS(pselect(0, NULL, NULL, NULL, NULL, &none), EINTR);
  EXPECT_IS(handled, 1);
}
CASE(epoll_pwait_waits_with_its_mask) {
  act(0);
  const int descriptor = epoll_create1(0);
  struct epoll_event event;
  sigset_t set, none;
  sigemptyset(&none);
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  raise(SIGUSR1);
  EXPECT_FAILS(epoll_pwait(descriptor, &event, 1, -1, &none), EINTR);
  EXPECT_IS(handled, 1);
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
