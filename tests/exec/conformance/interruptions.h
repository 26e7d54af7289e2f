// SPDX-License-Identifier: BSD-3-Clause
// Shared by cases on interruptions: a thread that sends the first one a signal, and then does what the first one waits
// for.
#pragma once

#include "tests/exec/conformance/harness.h"

#include <signal.h>
#include <stdatomic.h>

static atomic_int handled;
static pthread_t main_id;

static inline void handle(int signal) {
  (void)signal;
  atomic_fetch_add(&handled, 1);
}

static inline void act(int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handle;
  action.sa_flags = flags;
  EXPECT_IS(sigaction(SIGUSR1, &action, NULL), 0);
  main_id = pthread_self();
}

// Sends the signal to the waiting thread, then does what it waits for.
static void (*then)(void);

static inline void* disturb(void* unused) {
  sleep_ms(10);
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  sleep_ms(10);
  if (then != NULL) then();
  return unused;
}

static inline pthread_t begin(int flags, void (*after)(void)) {
  act(flags);
  then = after;
  return start(disturb, NULL);
}

static inline void end(pthread_t id) {
  EXPECT_IS(handled, 1);
  join(id);
}
