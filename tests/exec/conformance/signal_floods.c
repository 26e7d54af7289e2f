// SPDX-License-Identifier: BSD-3-Clause
// Signals from another process: thousands at once, and to a computing thread.
#include "tests/exec/conformance/signals.h"

#include <setjmp.h>
#include <spawn.h>
#include <sys/wait.h>

enum { signals = 2000 };

/// A program of its own, as its parent computes without a call at which a simulated process would get its turn.
static pid_t begin_program(const char* how, int signal) {
  char number[16];
  sprintf(number, "%d", signal);
  char* const words[] = {(char*)"sender", (char*)how, number, NULL};
  pid_t child = 0;
  EXPECT_IS(posix_spawn(&child, "/proc/self/exe", NULL, NULL, words, environ), 0);
  return child;
}

/// Numbers the signals.
static pid_t begin_sender(int signal) { return begin_program("--send-all", signal); }
static pid_t begin_late_sender(int signal) { return begin_program("--send-late", signal); }

/// The sender's process ends here.
__attribute__((constructor)) static void send_as_program(int argc, char** argv) {
  if (argc != 3 || strncmp(argv[1], "--send", 6) != 0) return;
  const pid_t receiver = getppid();
  const int signal = atoi(argv[2]);
  if (strcmp(argv[1], "--send-late") == 0) {
    sleep_ms(20);
    _exit(kill(receiver, signal));
  }
  for (int i = 0; i < signals;) {
    const union sigval value = {.sival_int = i};
    if (sigqueue(receiver, signal, value) == 0)
      ++i;
    else
      usleep(1000);  // the limit of all processes together
  }
  _exit(0);
}

static void end(pid_t child) {
  int status = -1;
  while (waitpid(child, &status, 0) < 0) EXPECT_IS(errno, EINTR);
  EXPECT_IS(status, 0);
}

CASE(all_that_are_blocked_are_taken_in_their_order) {
  block(SIGRTMIN, 0);
  const sigset_t set = set_of(SIGRTMIN, 0);
  const pid_t child = begin_sender(SIGRTMIN);
  for (int i = 0; i < signals; ++i) {
    siginfo_t information;
    EXPECT_IS(sigwaitinfo(&set, &information), SIGRTMIN);
    EXPECT_IS(information.si_int, i);
  }
  end(child);
}

CASE(all_are_handled_where_a_thread_makes_no_call_that_waits) {
  act(SIGRTMIN, handle, 0);
  const pid_t child = begin_sender(SIGRTMIN);
  while (handled < signals) getppid();
  end(child);
  EXPECT_IS(handled, signals);
}

// C library calls take nearly all of the time.
static void* (*volatile fill)(void*, int, size_t) = memset;
static long double (*volatile number)(const char*, char**) = strtold;
enum { size = 16 << 20 };

CASE(one_is_handled_where_a_thread_computes_in_the_c_library) {
  char* const bytes = malloc(size);
  EXPECT(bytes != NULL);
  act(SIGUSR1, handle, 0);
  const pid_t child = begin_late_sender(SIGUSR1);
  while (handled == 0) EXPECT(fill(bytes, 1, size) == bytes);
  end(child);
  free(bytes);
}

CASE(one_that_is_handled_there_changes_no_result) {
  char* const text = malloc(size);
  EXPECT(text != NULL);
  memset(text, '0', size);
  strcpy(text + size - 5, "1.25");
  act(SIGUSR1, handle, 0);
  for (int i = 1; i <= 5; ++i) {
    const pid_t child = begin_late_sender(SIGUSR1);
    char* rest = NULL;
    while (handled < i) EXPECT(number(text, &rest) == 1.25L && rest == text + size - 1);
    end(child);
  }
  free(text);
}

static sigjmp_buf before;
static void leave(int signal) {
  (void)signal;
  siglongjmp(before, 1);
}

CASE(one_that_comes_there_has_a_handler_that_does_not_return) {
  char* const bytes = malloc(size);
  EXPECT(bytes != NULL);
  act(SIGUSR1, leave, 0);
  for (int i = 0; i < 5; ++i) {
    const pid_t child = begin_late_sender(SIGUSR1);
    if (sigsetjmp(before, 1) == 0)
      for (;;) fill(bytes, 1, size);
    end(child);
  }
  free(bytes);
}
