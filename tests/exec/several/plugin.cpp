// SPDX-License-Identifier: BSD-3-Clause
//
// A library that programs open while they run. It calls the program's own function, and a library of both.
#include <cstdio>

#include "tests/exec/several/counts.hpp"

extern "C" void count_in_program();
static int of_plugin = 0;

struct InPlugin {
  InPlugin() { note("plugin"); }
  ~InPlugin() { std::printf("plugin destroyed at %d\n", of_plugin); }
};
static InPlugin in_plugin;

extern "C" int count_in_plugin() {
  count_in_program();
  count_in_lower();
  return ++of_plugin;
}
