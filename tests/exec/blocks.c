// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the durations of a loop of 1000 iterations and one of 10000, in nanoseconds.
#include <stdio.h>
#include <time.h>

static volatile int turned;

static long long now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

static long long take_ns(int turns) {
  const long long begin_ns = now_ns();
  for (int i = 0; i < turns; ++i) turned = i;
  return now_ns() - begin_ns;
}

int main(void) {
  const long long few_ns = take_ns(1000), many_ns = take_ns(10000);
  printf("%lld %lld\n", few_ns, many_ns);
  return 0;
}
