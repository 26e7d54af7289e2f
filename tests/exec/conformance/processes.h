// SPDX-License-Identifier: BSD-3-Clause
// Shared by cases on processes: the end of a child.
#pragma once

#include "tests/exec/conformance/harness.h"

#include <sys/mman.h>
#include <sys/wait.h>

static inline int status_of(pid_t child) {
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  return status;
}

static inline void expect_exit(const char* file, int line, pid_t child, int expected) {
  const int status = status_of(child);
  expect_equal(file, line, "it exited", WIFEXITED(status), 1);
  expect_equal(file, line, "its status", WEXITSTATUS(status), expected);
}

#define EXPECT_EXIT(child, expected) expect_exit(__FILE__, __LINE__, child, expected)

/// Memory shared with children.
static inline volatile int* shared(void) {
  volatile int* const word = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  EXPECT(word != MAP_FAILED);
  return word;
}

static inline void* run_on(void* unused) {
  for (;;) sleep_ms(1);
  return unused;
}

static inline void nothing(int signal) { (void)signal; }
static char* const say_11[] = {"sh", "-c", "exit 11", NULL};
