// SPDX-License-Identifier: BSD-3-Clause
#include "tests/exec/zoo/crew.h"

#include <stdint.h>

#include "tests/exec/zoo/zoo.h"

static pthread_t crew[crew_max];
static int members;

void start(void* (*body)(void*)) {
  check(members < crew_max && pthread_create(&crew[members], NULL, body, (void*)(intptr_t)members) == 0,
        "there are too many threads");
  ++members;
}

int number_of(void* argument) { return (int)(intptr_t)argument; }

void join_all(void) {
  for (int i = 0; i < members; ++i) pthread_join(crew[i], NULL);
  members = 0;
}
