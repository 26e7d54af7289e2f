// SPDX-License-Identifier: BSD-3-Clause
//
// again: prints how often it has begun in its memory, and stays with a variable of a thread and a library that is open.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "tests/exec/several/counts.hpp"

static thread_local std::string of_this_thread;
static int begun = 0;

int main() {
  of_this_thread = "a destructor is due at the end of the thread";
  void* const lower = dlopen("liblower.so", RTLD_NOW | RTLD_NODELETE);
  void* const self = dlopen(nullptr, RTLD_NOW);
  count_in_lower();
  std::printf("begun %d and %d times\n", ++begun, of_lower);
  std::fflush(stdout);
  dlclose(self);
  for (;;) sleep(lower != nullptr ? 1000 : 1);
}
