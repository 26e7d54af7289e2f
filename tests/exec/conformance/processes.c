// SPDX-License-Identifier: BSD-3-Clause
// fork(), and its handlers.
#include "tests/exec/conformance/processes.h"

CASE(a_child_has_another_number_and_knows_its_parent) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) _exit(getppid() == parent && getpid() != parent && gettid() == getpid() ? 5 : 6);
  EXPECT(child > 0);
  EXPECT_EXIT(child, 5);
}
CASE(a_child_has_its_own_memory) {
  static int word = 1;
  const pid_t child = fork();
  if (child == 0) {
    word = 2;
    _exit(word);
  }
  EXPECT_EXIT(child, 2);
  EXPECT_IS(word, 1);
}
CASE(a_child_can_become_a_daemon) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    start(run_on, NULL);
    if (daemon(1, 1) != 0) _exit(1);  // forks within the C library
    sleep_ms(2);
    _exit(write(ends[1], gettid() == getpid() ? "y" : "n", 1) == 1 ? 0 : 1);
  }
  char is_first = '\0';
  EXPECT_IS(read(ends[0], &is_first, 1), 1);
  EXPECT_IS(is_first, 'y');
  EXPECT_EXIT(child, 0);
}
CASE(a_child_shares_descriptors) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) _exit(write(ends[1], "hello", 5) == 5 ? 0 : 1);
  char text[8] = "";
  EXPECT_IS(read(ends[0], text, 5), 5);
  EXPECT_IS(strcmp(text, "hello"), 0);
  EXPECT_EXIT(child, 0);
}
CASE(a_child_can_be_spoken_with) {
  int there[2], back[2];
  char byte = 0;
  EXPECT_IS(pipe(there), 0);
  EXPECT_IS(pipe(back), 0);
  const pid_t child = fork();
  if (child == 0) {
    for (int i = 0; i < 10; ++i) {
      if (read(there[0], &byte, 1) != 1) _exit(1);
      ++byte;
      if (write(back[1], &byte, 1) != 1) _exit(1);
    }
    _exit(0);
  }
  for (char i = 0; i < 20; i += 2) {
    EXPECT_IS(write(there[1], &i, 1), 1);
    EXPECT_IS(read(back[0], &byte, 1), 1);
    EXPECT_IS(byte, i + 1);
  }
  EXPECT_EXIT(child, 0);
}
CASE(a_child_has_only_the_thread_that_made_it) {
  start(run_on, NULL);
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(5);
    _exit(3);
  }
  EXPECT_EXIT(child, 3);
}

static void* give_7(void* unused) {
  (void)unused;
  sleep_ms(1);
  return (void*)7;
}
CASE(a_child_can_have_threads) {
  const pid_t child = fork();
  if (child == 0) _exit((int)(long)join(start(give_7, NULL)));
  EXPECT_EXIT(child, 7);
}

static void* fork_in_thread(void* unused) {
  const pid_t child = fork();
  if (child == 0) exit((int)(long)join(start(give_7, NULL)));
  EXPECT_EXIT(child, 7);
  return unused;
}
CASE(a_thread_can_have_children) { join(start(fork_in_thread, NULL)); }
CASE(a_child_of_a_child_is_waited_for_by_it) {
  const pid_t child = fork();
  if (child == 0) {
    const pid_t grandchild = fork();
    if (grandchild == 0) _exit(4);
    EXPECT_EXIT(grandchild, 4);
    _exit(5);
  }
  EXPECT_EXIT(child, 5);
}
CASE(a_child_inherits_masks_and_handlers_but_nothing_pends) {
  sigset_t set, now;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, NULL);
  signal(SIGUSR2, nothing);
  raise(SIGUSR1);
  const pid_t child = fork();
  if (child == 0) {
    sigprocmask(SIG_BLOCK, NULL, &now);
    EXPECT_IS(sigismember(&now, SIGUSR1), 1);
    sigpending(&now);
    EXPECT_IS(sigismember(&now, SIGUSR1), 0);
    EXPECT(signal(SIGUSR2, SIG_DFL) == nothing);
    _exit(0);
  }
  EXPECT_EXIT(child, 0);
  sigpending(&now);
  EXPECT_IS(sigismember(&now, SIGUSR1), 1);
}
CASE(a_child_has_no_alarm) {
  alarm(100);
  const pid_t child = fork();
  if (child == 0) _exit((int)alarm(0));
  EXPECT_EXIT(child, 0);
  EXPECT(alarm(0) > 90);
}
CASE(vfork_waits_until_the_child_is_another) {
  const pid_t child = vfork();
  if (child == 0) {
    execv("/bin/sh", say_11);
    _exit(1);
  }
  EXPECT_EXIT(child, 11);
}
CASE(vfork_waits_until_the_child_has_ended) {
  volatile int* const word = shared();
  const pid_t child = vfork();
  if (child == 0) {
    *word = 1;
    _exit(17);
  }
  EXPECT_IS(*word, 1);
  EXPECT_EXIT(child, 17);
}
CASE(_Fork_calls_no_handlers) {
  extern void note_prepare(void);
  EXPECT_IS(pthread_atfork(note_prepare, NULL, NULL), 0);
  const pid_t child = _Fork();
  if (child == 0) _exit(gettid() == getpid() ? 3 : 4);
  EXPECT_EXIT(child, 3);
  EXPECT_NOTED("");
}

void note_prepare(void);
void note_prepare(void) { note("a"); }
static void note_parent(void) { note("b"); }
static void note_child(void) { note("c"); }
static void note_prepare_2(void) { note("A"); }
static void note_parent_2(void) { note("B"); }
static void note_child_2(void) { note("C"); }
CASE(handlers_of_fork_are_called_in_their_order) {
  EXPECT_IS(pthread_atfork(note_prepare, note_parent, note_child), 0);
  EXPECT_IS(pthread_atfork(note_prepare_2, note_parent_2, note_child_2), 0);
  const pid_t child = fork();
  if (child == 0) {
    EXPECT_NOTED("AacC");
    _exit(0);
  }
  EXPECT_NOTED("AabB");
  EXPECT_EXIT(child, 0);
}

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static void lock_it(void) { pthread_mutex_lock(&mutex); }
static void unlock_it(void) { pthread_mutex_unlock(&mutex); }

static void* use_mutex(void* unused) {
  for (int i = 0; i < 200; ++i) {
    pthread_mutex_lock(&mutex);
    if (i % 10 == 0) sleep_ms(1);
    pthread_mutex_unlock(&mutex);
    sched_yield();
  }
  return unused;
}
CASE(a_mutex_can_be_kept_free_for_children) {
  EXPECT_IS(pthread_atfork(lock_it, unlock_it, unlock_it), 0);
  const pthread_t id = start(use_mutex, NULL);
  for (int i = 0; i < 3; ++i) {
    sleep_ms(1);
    const pid_t child = fork();
    if (child == 0) {
      EXPECT_IS(pthread_mutex_lock(&mutex), 0);
      EXPECT_IS(pthread_mutex_unlock(&mutex), 0);
      _exit(0);
    }
    EXPECT_EXIT(child, 0);
  }
  join(id);
}

static void wait_before_fork(void) { sleep_ms(3); }
CASE(handlers_before_a_fork_can_wait) {
  EXPECT_IS(pthread_atfork(wait_before_fork, wait_before_fork, NULL), 0);
  const pid_t first = fork();
  if (first == 0) {
    for (int i = 0; i < 10; ++i) sleep_ms(1);
    _exit(1);
  }
  const pid_t second = fork();
  if (second == 0) _exit(2);
  EXPECT_EXIT(second, 2);
  EXPECT_EXIT(first, 1);
}

static void* do_nothing(void* argument) { return argument; }
static void make_threads(int count) {
  for (int i = 0; i < count; ++i) {
    pthread_t thread;
    EXPECT_IS(pthread_create(&thread, NULL, do_nothing, NULL), 0);
    EXPECT_IS(pthread_join(thread, NULL), 0);
  }
}
CASE(a_child_makes_threads_after_its_parent_has) {
  make_threads(3);
  const pid_t child = fork();
  if (child == 0) {
    make_threads(5);
    _exit(5);
  }
  EXPECT_EXIT(child, 5);
  make_threads(3);
}
