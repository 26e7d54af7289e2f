// SPDX-License-Identifier: BSD-3-Clause
// Shared by cases on signals: a counting handler, and operations on masks.
#pragma once

#include "tests/exec/conformance/harness.h"

#include <signal.h>
#include <stdatomic.h>

static atomic_int handled, last;

// Volatile: the compiler assumes that the sending calls do not modify objects of this file.
static volatile siginfo_t told;

static volatile pthread_t handled_by;
static atomic_int blocked_USR1, blocked_USR2;

static inline void handle(int signal) {
  handled_by = pthread_self();
  last = signal;
  atomic_fetch_add(&handled, 1);
}

static inline void handle_with_information(int signal, siginfo_t* information, void* context) {
  EXPECT(context != NULL);
  told = *information;
  handle(signal);
}

static inline void look_at_mask(int signal) {
  sigset_t set;
  pthread_sigmask(SIG_SETMASK, NULL, &set);
  blocked_USR1 = sigismember(&set, SIGUSR1);
  blocked_USR2 = sigismember(&set, SIGUSR2);
  handle(signal);
}

static inline sigset_t set_of(int first, int second) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, first);
  if (second != 0) sigaddset(&set, second);
  return set;
}

static inline void act(int signal, void (*handler)(int), int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  action.sa_flags = flags;
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}

static inline void act_with_information(int signal, int flags) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = handle_with_information;
  action.sa_flags = flags | SA_SIGINFO;
  EXPECT_IS(sigaction(signal, &action, NULL), 0);
}

static inline void block(int first, int second) {
  const sigset_t set = set_of(first, second);
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, &set, NULL), 0);
}

static inline void unblock(int first, int second) {
  const sigset_t set = set_of(first, second);
  EXPECT_IS(pthread_sigmask(SIG_UNBLOCK, &set, NULL), 0);
}

static inline int is_blocked(int signal) {
  sigset_t set;
  EXPECT_IS(pthread_sigmask(SIG_BLOCK, NULL, &set), 0);
  return sigismember(&set, signal);
}

static inline int is_pending(int signal) {
  sigset_t set;
  EXPECT_IS(sigpending(&set), 0);
  return sigismember(&set, signal);
}

static pthread_t main_id;

static inline void* send_to_main(void* unused) {
  let_others_wait();
  EXPECT_IS(pthread_kill(main_id, SIGUSR1), 0);
  return unused;
}
