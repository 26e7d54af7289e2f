// SPDX-License-Identifier: BSD-3-Clause
// The threads of a specimen in C.
#ifndef WAITPOINT_TESTS_EXEC_ZOO_CREW_H
#define WAITPOINT_TESTS_EXEC_ZOO_CREW_H

#include <pthread.h>

enum { crew_max = 100 };

// Starts a thread, which is given its number in order of creation: see number_of().
void start(void* (*body)(void*));
int number_of(void* argument);
// Joins all threads.
void join_all(void);

#endif
