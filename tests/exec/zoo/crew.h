// SPDX-License-Identifier: BSD-3-Clause
// The threads of a specimen in C.
#ifndef WAITPOINT_TESTS_EXEC_ZOO_CREW_H
#define WAITPOINT_TESTS_EXEC_ZOO_CREW_H

#include <pthread.h>

enum { crew_max = 100 };

// A thread of this body, which is given its number in the order of their making: see number_of().
void start(void* (*body)(void*));
int number_of(void* argument);
// Waits for the end of all.
void join_all(void);

#endif
