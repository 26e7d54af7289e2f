// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <string>

#include "tests/exec/several/counts.hpp"

int of_lower = 0;

static std::string& noted() {
  static std::string names;
  return names;
}

void note(const char* who) { noted() += std::string(" ") + who; }
const char* order() { return noted().c_str(); }

struct InLower {
  InLower() { note("lower"); }
  ~InLower() { std::printf("lower destroyed at %d\n", of_lower); }
};
static InLower in_lower;

static thread_local int of_this_thread = 0;

int count_in_lower() {
  ++of_lower;
  ++of_all;
  ++Kept<int>::value;
  return ++of_this_thread;
}

extern "C" {
static int seven() { return 7; }
[[gnu::used]] static auto choose() { return seven; }
static int chosen() __attribute__((ifunc("choose")));
}
int chosen_when_loaded() { return chosen(); }
