// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "tests/exec/several/counts.hpp"

static int of_upper = 0;

struct InUpper {
  InUpper() { note("upper"); }
  ~InUpper() { std::printf("upper destroyed at %d\n", of_upper); }
};
static InUpper in_upper;

int count_in_upper() {
  ++of_all;
  ++Kept<int>::value;
  count_in_lower();
  return ++of_upper;
}
