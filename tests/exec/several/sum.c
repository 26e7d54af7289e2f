// SPDX-License-Identifier: BSD-3-Clause
// sum NAME: adds the numbers below 100 by three threads of OpenMP, whose waits are system calls of its library.
#include <stdio.h>

int main(int argc, char** argv) {
  int sum = 0;
  if (argc < 2) return 2;
#pragma omp parallel for reduction(+ : sum) num_threads(3)
  for (int i = 0; i < 100; ++i) sum += i;
  printf("%s: sum %d\n", argv[1], sum);
  return 0;
}
