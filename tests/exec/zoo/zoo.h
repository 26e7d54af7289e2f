// SPDX-License-Identifier: BSD-3-Clause
// The zoo as programs: the planted bugs of tests/zoo with the threads of the C library and of C++, independent of the
// simulation.
//
//   PROGRAM                   lists the names, each after the switch points needed to find it
//   PROGRAM NAME [mended]     runs one: 0 if its checks hold, otherwise 1 with a line on standard error
//
// Each passes if a thread runs until it blocks, and threads run in order of creation.
#ifndef WAITPOINT_TESTS_EXEC_ZOO_H
#define WAITPOINT_TESTS_EXEC_ZOO_H

#ifdef __cplusplus
extern "C" {
#endif

struct specimen {
  const char* name;
  const char* needs;
  int threads;  // number of threads started
  void (*run)(int threads);
};

// The switch points needed: library calls only, or also accesses to variables; or these in so few schedules that it is
// not expected to be found.
#define SYNCHRONIZATION "synchronization"
#define MEMORY "memory"
#define RARE "rare"

// One table per file, terminated by a specimen without a name; the list of tables is terminated by null.
extern const struct specimen deadlocks[], atomicities[], signals[], timings[];
extern const struct specimen lock_free[], orders[], endings[], robots[], hard[];
extern const struct specimen* const tables[];

extern int mended;

// Unless `holds`, ends the program with status 1 and prints `otherwise` on standard error.
void check(int holds, const char* otherwise);

#ifdef __cplusplus
}
#endif

#endif
