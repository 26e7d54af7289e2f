// SPDX-License-Identifier: BSD-3-Clause
// The zoo as programs: the planted bugs of tests/zoo against the threads of the C library and of C++ alone, which know
// of no simulation.
//
//   PROGRAM                   the names, each behind what it needs to be found
//   PROGRAM NAME [mended]     runs one: 0 if what it checks holds, 1 with a line on standard error if not
//
// Each passes if a thread goes on until it waits, and threads follow each other in the order of their making.
#ifndef WAITPOINT_TESTS_EXEC_ZOO_H
#define WAITPOINT_TESTS_EXEC_ZOO_H

#ifdef __cplusplus
extern "C" {
#endif

struct specimen {
  const char* name;
  const char* needs;
  int threads;  // that it starts
  void (*run)(int threads);
};

// What switches of threads must come at: calls of the library alone, or accesses to variables too.
#define SYNCHRONIZATION "synchronization"
#define MEMORY "memory"

// One table a file, each up to a specimen without a name; and of these, up to one that is null.
extern const struct specimen deadlocks[], atomicities[], signals[], timings[];
extern const struct specimen lock_free[], orders[], endings[], robots[];
extern const struct specimen* const tables[];

extern int mended;

// Ends the program with status 1, and those words on standard error, unless it holds.
void check(int holds, const char* otherwise);

#ifdef __cplusplus
}
#endif

#endif
