// SPDX-License-Identifier: BSD-3-Clause
//
// linked NAME ROUNDS: counts in its libraries, once in a millisecond, and prints NAME and what it finds there.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/exec/several/counts.hpp"

struct InProgram {
  InProgram() { note("program"); }
  ~InProgram() { std::printf("program destroyed\n"); }
};
static InProgram in_program;

int main(int argc, char** argv) {
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 0;
  int upper = 0, in_thread = 0;
  for (int i = 0; i < rounds; ++i, usleep(1000)) upper = count_in_upper();
  std::thread([&] { in_thread = count_in_lower(); }).join();
  std::printf("%s:%s, %d %d %d %d %d, %d\n", argv[1], order(), upper, of_lower, of_all, Kept<int>::value, in_thread,
              chosen_when_loaded());
  return upper;
}
