// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/sync/counted_code.hpp"

namespace waitpoint {

unsigned collatz_steps(unsigned long n) {
  unsigned steps = 0;
  for (; n != 1; ++steps) n = n % 2 == 0 ? n / 2 : 3 * n + 1;
  return steps;
}

}  // namespace waitpoint
