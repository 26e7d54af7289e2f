// SPDX-License-Identifier: BSD-3-Clause
//
// Counts its arguments, as a program of its own or one of several.
#include <stdio.h>
#include <unistd.h>

int count;

int main(int argc, char** argv) {
  (void)argv;
  for (; count < argc; ++count) usleep(1);
  printf("counted %d\n", count);
  return 0;
}
